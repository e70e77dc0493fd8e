"""compat.py - what differs between Blender 3.4 and 5.2, asked for by feature, never by version."""

import contextlib
import sys

import bpy

from .drawing import gpu
from .late import meshes, np

# a path property takes Blender's `//` only when it says so, where it can say so
RELATIVE = (
    {"PATH_SUPPORTS_BLEND_RELATIVE"}
    if "is_path_supports_blend_relative" in bpy.types.Property.bl_rna.properties
    else set()
)


CONTEXTS = "translation_context" in (bpy.props.BoolProperty.__doc__ or "")  # whether properties have one
WORDS = "Desire Path"  # that of what objects remember: Blender's own catalogue has other words for some


def positions(mesh):
    """Local vertex positions, float32 (n, 3)."""
    out = np.empty((len(mesh.vertices), 3), np.float32)
    if not len(out):
        return out
    attribute = mesh.attributes.get("position")
    if attribute is not None:
        attribute.data.foreach_get("vector", out.ravel())
    else:
        mesh.vertices.foreach_get("co", out.ravel())
    return out


def set_numbers(mesh, attribute, of, values, data, name):
    """Set what elements of a mesh have: by an attribute and its property, which is quick, or else one by one in `data`
    by the property `name`."""
    found = mesh.attributes.get(attribute)
    if found is not None and len(found.data) == len(data):
        found.data.foreach_set(of, values.ravel())
    else:
        data.foreach_set(name, values.ravel())


def triangles(mesh):
    """Vertex indices of the faces cut into triangles, int32 (m, 3)."""
    mesh.calc_loop_triangles()
    out = np.empty((len(mesh.loop_triangles), 3), np.int32)
    if len(out):
        mesh.loop_triangles.foreach_get("vertices", out.ravel())
    return out


def triangle_corners(mesh):
    """The corners of those triangles among the mesh's, int32 (m, 3)."""
    out = np.empty((len(mesh.loop_triangles), 3), np.int32)
    if len(out):
        mesh.loop_triangles.foreach_get("loops", out.ravel())
    return out


def uv(mesh, name):
    """Image coordinates of every corner of a UV map, float64 (corners, 2), or None where there is none."""
    layer = mesh.uv_layers.get(name)
    if layer is None or not len(mesh.loops):
        return None
    out = np.empty((len(mesh.loops), 2), np.float32)
    if hasattr(layer, "uv"):
        layer.uv.foreach_get("vector", out.ravel())
    else:
        layer.data.foreach_get("uv", out.ravel())
    return out.astype(np.float64)


def set_uv(mesh, name, values):
    """Set the image coordinates of every corner of a UV map, float32 (corners, 2)."""
    layer = mesh.uv_layers[name]
    if hasattr(layer, "uv"):
        layer.uv.foreach_set("vector", values.ravel())
    else:
        layer.data.foreach_set("uv", values.ravel())


def faces(mesh):
    """The faces in 3 or 4 corners each: the vertex of every corner, int32 (c,); where each face's corners
    begin, int32 (f + 1,), or None where each has as many; how many that is."""
    count, corners = len(mesh.polygons), np.empty(len(mesh.loops), np.int32)
    if not _ints(mesh, ".corner_vert", corners) and count:
        mesh.loops.foreach_get("vertex_index", corners)
    if len(corners) == 3 * count:
        return corners, None, 3  # no face has fewer
    if len(corners) == 4 * count and _are_quads(mesh, corners):
        return corners, None, 4
    starts = np.empty(count + 1, np.int32)
    starts[-1] = len(corners)
    mesh.polygons.foreach_get("loop_start", starts[:-1])
    if np.diff(starts).max() > 4:
        return triangles(mesh).ravel(), None, 3
    return corners, starts, 0


def _ints(mesh, name, out):
    """Fill an array from an attribute of whole numbers, which is quick; False where there is none."""
    attribute = mesh.attributes.get(name)
    if attribute is None:
        return False
    attribute.data.foreach_get("value", out)
    return True


def _are_quads(mesh, corners):
    """Whether all faces are known to be quads; asking each face would take longer than all else."""
    around, edges = np.empty(len(corners), np.int32), np.empty((len(mesh.edges), 2), np.int32)
    return (
        _ints(mesh, ".corner_edge", around)
        and _ints(mesh, ".edge_verts", edges.ravel())
        and meshes.are_quads(corners, around, edges)
    )


def _values(attribute, key, *wide):
    """All values of an attribute, float32 (n, *wide); key: what Blender calls one."""
    out = np.empty((len(attribute.data), *wide), np.float32)
    if len(out):
        attribute.data.foreach_get(key, out.ravel())
    return out


def float_attribute(mesh, name):
    """Values of a float point attribute, float32 (n,), or None where there is none."""
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != "POINT" or attribute.data_type != "FLOAT":
        return None
    return _values(attribute, "value")


def colour_attribute(mesh, name):
    """Values of a float colour attribute, float32 (n, 4), or None where there is none."""
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.data_type != "FLOAT_COLOR":
        return None
    return _values(attribute, "color", 4)


def vectors(mesh, name):
    """Values of a vector point attribute, float32 (n, 3), or None where there is none."""
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.data_type != "FLOAT_VECTOR":
        return None
    return _values(attribute, "vector", 3)


def geometry_tree(name, new_tree):
    """A node tree with one geometry going in and one coming out."""
    tree = new_tree(name, "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        group_socket(tree, side, "NodeSocketGeometry", "Geometry")
    if hasattr(tree, "is_modifier"):
        tree.is_modifier = True
    return tree


def group_socket(tree, side, kind, name):
    """A new socket of a node group, side "INPUT" or "OUTPUT"."""
    if hasattr(tree, "interface"):
        return tree.interface.new_socket(name, in_out=side, socket_type=kind)
    return (tree.inputs if side == "INPUT" else tree.outputs).new(kind, name)


def tree_input(tree, name, kind):
    """A new input of a node tree; returns its socket in the tree's interface."""
    if hasattr(tree, "interface"):
        return tree.interface.new_socket(name, in_out="INPUT", socket_type=kind)
    return tree.inputs.new(kind, name)


def input_identifier(tree, name):
    """How an input of a tree is called where modifiers keep its value; empty: there is none of that name."""
    if hasattr(tree, "interface"):
        there = [each for each in tree.interface.items_tree if each.item_type == "SOCKET" and each.in_out == "INPUT"]
    else:
        there = tree.inputs
    return next((each.identifier for each in there if each.name == name), "")


def _modifier_inputs(modifier):
    return getattr(getattr(modifier, "properties", None), "inputs", None)


def modifier_input(modifier, identifier):
    """The value of an input of a nodes modifier."""
    inputs = _modifier_inputs(modifier)
    return getattr(inputs, identifier).value if inputs is not None else modifier[identifier]


def set_modifier_input(modifier, identifier, value):
    """Set the value of an input of a nodes modifier."""
    inputs = _modifier_inputs(modifier)
    if inputs is not None:
        getattr(inputs, identifier).value = value
    else:
        modifier[identifier] = value
    modifier.id_data.update_tag()  # Blender sees it by itself only where it is typed


def input_path(modifier, identifier):
    """The data path of an input of a nodes modifier, from the modifier."""
    return f'["{identifier}"]' if _modifier_inputs(modifier) is None else f".properties.inputs.{identifier}.value"


def nodes_modifier(obj, name, tree):
    """A new modifier of an object that runs a tree; older Blenders fill in a tree of their own."""
    modifier = obj.modifiers.new(name, "NODES")
    own = modifier.node_group
    modifier.node_group = tree
    if own is not None and own != tree and own.users == 0:
        bpy.data.node_groups.remove(own)
    return modifier


def node_objects(modifier):
    """The objects that a nodes modifier is given, and that its nodes name."""
    inputs = getattr(getattr(modifier, "properties", None), "inputs", None)
    if inputs is not None:
        given = [
            getattr(getattr(inputs, name, None), "value", None) for name in dir(inputs) if name.startswith("Socket")
        ]
    else:
        given = [modifier[name] for name in modifier.keys()]  # noqa: SIM118  (a modifier is no dict)
    trees = [modifier.node_group]
    for tree in trees:
        for node in tree.nodes:
            given += [getattr(each, "default_value", None) for each in node.inputs if each.type == "OBJECT"]
            inner = getattr(node, "node_tree", None)
            if inner is not None and inner not in trees:
                trees.append(inner)
    return [each for each in given if isinstance(each, bpy.types.Object)]


def move_modifier(obj, modifier, index):
    """Put a modifier at a place of its stack, as far as Blender lets it."""
    first = list(obj.modifiers).index(modifier)
    pinned = [k for k, each in enumerate(obj.modifiers) if getattr(each, "use_pin_to_last", False)]
    index = min([index, len(obj.modifiers) - 1] + [k - (first < k) for k in pinned])
    if index == first:
        return
    if hasattr(obj.modifiers, "move"):
        obj.modifiers.move(first, index)
    else:
        with bpy.context.temp_override(object=obj, active_object=obj, selected_objects=[obj]):
            bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=index)


def socket(sockets, name):
    """The socket of that name in use; None where this Blender's node has none (or hides it).

    Nodes with a data type carry one socket per type up to 4.0, of which one is enabled.
    """
    for each in sockets:
        if each.name == name and each.enabled:
            return each
    return None


def set_default(socket, value):
    """Give a socket a default value, unless it has it: Blender takes whatever is set for a change."""
    same = lambda one: tuple(one) if hasattr(one, "__len__") and not isinstance(one, str) else one
    if same(socket.default_value) != same(value):
        socket.default_value = value


def curves_played(animation):
    """The F-curves of the action an ID plays, of the slot it plays of it."""
    action = animation.action
    if not hasattr(action, "layers"):
        return list(action.fcurves)
    slot, found = animation.action_slot, []
    for layer in action.layers if slot is not None else ():
        for strip in layer.strips:
            bag = strip.channelbag(slot)
            found += bag.fcurves if bag is not None else []
    return found


def curves(animation, owner):
    """The F-curves of an object's action, in the slot it uses; made where there are none yet."""
    action = animation.action
    if not hasattr(action, "layers"):
        return action.fcurves
    slot = animation.action_slot
    if slot is None:
        slot = action.slots.new(id_type="OBJECT", name=owner.name)
        animation.action_slot = slot
    layer = action.layers[0] if len(action.layers) else action.layers.new("Layer")
    strip = layer.strips[0] if len(layer.strips) else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True).fcurves


def strip_curves(strip):
    """The F-curves of the action that a strip of the NLA editor plays, of all its slots."""
    action = strip.action
    if action is None:
        return []
    if not hasattr(action, "layers"):
        return list(action.fcurves)
    bags = [bag for layer in action.layers for each in layer.strips for bag in each.channelbags]
    return [found for bag in bags for found in bag.fcurves]


def curve(animation, path):
    """The F-curve that keys a property of an object, or None."""
    action = animation.action if animation is not None else None
    if action is None:
        return None
    bags = [action]
    if hasattr(action, "layers"):
        bags = [
            bag
            for layer in action.layers
            for strip in layer.strips
            for bag in strip.channelbags
            if bag.slot == animation.action_slot
        ]
    return next(filter(None, (bag.fcurves.find(path) for bag in bags)), None)


def is_keyed(animation, path):
    """Whether an action's curve or a driver leads a property."""
    return animation is not None and (curve(animation, path) is not None or animation.drivers.find(path) is not None)


def asks_scene(driver):
    """Whether a driver asks for properties of a scene, as its frame's number or what is keyed there."""
    return any(
        variable.type == "CONTEXT_PROP" or any(isinstance(each.id, bpy.types.Scene) for each in variable.targets)
        for variable in driver.variables
    )


def use_action(animation, action, slot=None):
    """Let an object play an action; `slot` where actions have slots, else the one that fits."""
    animation.action = action
    if slot is not None and hasattr(animation, "action_slot"):
        animation.action_slot = slot


def flat_shader():
    """The shader that fills with one colour, and how many numbers its positions have."""
    try:
        return gpu.shader.from_builtin("UNIFORM_COLOR"), 3
    except ValueError:
        return gpu.shader.from_builtin("2D_UNIFORM_COLOR"), 2


def is_group(prop):
    """Whether a property, as a property group's annotation has it, holds properties of its own."""
    return prop.function is bpy.props.PointerProperty and issubclass(prop.keywords["type"], bpy.types.PropertyGroup)


def all_curves(animation):
    """The F-curves of the action an ID plays, none where it plays none."""
    return curves_played(animation) if animation.action is not None else []


@contextlib.contextmanager
def bundled_modules():
    """Let modules that Blender brings (pxr and others) be imported in this block, by bpy as a module, too."""
    path = list(sys.path)
    if hasattr(bpy.utils, "expose_bundled_modules"):  # 4.4 and later
        bpy.utils.expose_bundled_modules()
    try:
        yield
    finally:
        sys.path[:] = path


def prop(layout, group, name):
    """Draw what a group of ours remembers, under its name in our words, also where properties have no context."""
    layout.prop(group, name, text=group.bl_rna.properties[name].name, text_ctxt=WORDS)


def held(keys):
    """Which keys of a curve hold their value up to the next one."""
    if keys.id_data.library is not None and bpy.app.version < (4, 5):  # there foreach_get may hand out what memory was
        return np.array([key.interpolation == "CONSTANT" for key in keys], bool)
    form = np.empty(len(keys), np.int32)
    keys.foreach_get("interpolation", form)
    return form == bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items["CONSTANT"].value
