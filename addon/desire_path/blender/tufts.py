"""tufts.py - the meshes that grass scatters, and what they are made of.

    tuft.py --arrays--> a collection of tufts that is in no scene, all of one native material
Every vertex knows the straight stem it belongs to (see tuft.Tuft), so that grass.py can bend it.
"""

import bpy
import numpy as np

from ..ground import tuft
from . import playback_tree, wiring

TAG = playback_tree.TAG
ROOT, AT, TILT, ARCH, LOOK = "tuft_root", "tuft_at", "tuft_tilt", "tuft_arch", "tuft_look"  # see Tuft
TONE = "tuft_tone"  # of a plant, 0..1
STRENGTH = playback_tree.STRENGTH


def collection(name, kind):
    """The collection of a kind's tufts, in no scene: what the nodes scatter. Made when needed."""
    mark = f"{name} {kind!r}"
    for each in bpy.data.collections:
        if each.get(TAG) == mark and each.library is None:
            return each
    look = tuft.look_of(name, kind)
    found = bpy.data.collections.new(f"{label(name)} Tufts")
    found[TAG] = mark
    new = material(name, look)
    for number in range(look.tufts):
        shape = tuft.tuft(kind, look, number)
        mesh = bpy.data.meshes.new(f"{label(name)} {number + 1}")
        mesh.from_pydata(shape.vertices.tolist(), [], [list(face) for face in shape.faces])
        mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
        for key, value in (
            (ROOT, shape.root),
            (AT, shape.at),
            (TILT, shape.tilt),
            (ARCH, shape.arch),
            (LOOK, shape.look),
        ):
            store(mesh, key, "FLOAT_VECTOR", value)
        mesh.materials.append(new)
        mesh.update()
        found.objects.link(bpy.data.objects.new(mesh.name, mesh))
    return found


def store(mesh, name, kind, value):
    """Values of a mesh's points as an attribute."""
    layer = mesh.attributes.get(name) or mesh.attributes.new(name, kind, "POINT")
    key = "vector" if kind == "FLOAT_VECTOR" else "value"
    layer.data.foreach_set(key, np.ascontiguousarray(value, np.int32 if kind == "INT" else np.float32).ravel())


def root_radius(collection):
    """How far from a plant's middle its stems are rooted, at most [m]."""
    out = 0.0
    for obj in collection.objects:
        layer = obj.data.attributes.get(ROOT)
        if layer is not None and len(layer.data):
            root = np.empty((len(layer.data), 3), np.float32)
            layer.data.foreach_get("vector", root.ravel())
            out = max(out, float(np.hypot(root[:, 0], root[:, 1]).max()))
    return out


def label(name):
    """A kind's name for people: a file's is its own name."""
    return tuft.Path(str(name)).stem.replace("_", " ").replace("-", " ").title()


def discard(collection):
    """Remove tufts that nothing scatters any more, with their meshes and material."""
    if collection is None or TAG not in collection or collection.users > 0:
        return
    objects = list(collection.objects)
    bpy.data.collections.remove(collection)
    for obj in objects:
        if obj.users > 0:
            continue
        mesh = obj.data
        bpy.data.objects.remove(obj)
        discard_mesh(mesh)


def discard_mesh(mesh):
    if mesh is None or mesh.users > 0:
        return
    used = [each for each in mesh.materials if each is not None]
    bpy.data.meshes.remove(mesh)
    for each in used:
        discard_material(each)


def discard_material(material):
    if TAG in material and material.users == 0:
        bpy.data.materials.remove(material)


# ---- the material ------------------------------------------------------------------------------------


def material(name, look):
    """Leaves that let light through, dark at the root, each plant and stem of its own tone; straw
    where `plant_strength` is low. Native nodes, to be changed at will."""
    new = bpy.data.materials.new(label(name))
    new[TAG] = 1
    new.diffuse_color = (*(2.2 * each**0.8 for each in look.high), 1.0)
    new.use_nodes = True
    tree = new.node_tree
    tree.nodes.clear()
    wire = wiring.Wiring(tree)

    def attribute(key, kind):
        return wire.add("ShaderNodeAttribute", {"attribute_name": key, "attribute_type": kind}).outputs

    def either(key):
        """An attribute of the mesh, or of the instance."""
        return wire.math("ADD", attribute(key, "GEOMETRY")[2], attribute(key, "INSTANCER")[2])

    def mix(share, a, b):
        if isinstance(a, tuple) and isinstance(b, tuple):
            more = tuple(y - x for x, y in zip(a, b))
        else:
            more = wire.vector("SUBTRACT", b, a)
        return wire.vector("MULTIPLY_ADD", more, wire.xyz(share, share, share), a)

    along, tone, head = wire.split(attribute(LOOK, "GEOMETRY")[1])
    plant, strength = either(TONE), either(STRENGTH)
    colour = mix(head, mix(along, look.low, look.high), look.head)
    colour = mix(wire.math("SUBTRACT", 1.0, strength), colour, look.dead)
    # brightness differs from stem to stem and plant to plant, and so, a little, does the hue
    light = wire.math("ADD", wire.math("MULTIPLY_ADD", tone, 0.5, 0.62), wire.math("MULTIPLY", plant, 0.32))
    hue = wire.math("MULTIPLY_ADD", wire.math("SUBTRACT", plant, tone), 0.016, 0.5)
    colour = wire.add("ShaderNodeHueSaturation", Hue=hue, Value=light, Color=colour).outputs[0]
    leaf = wire.add("ShaderNodeBsdfPrincipled", Roughness=0.5, **{"Base Color": colour})
    for key in ("Specular", "Specular IOR Level"):
        if key in leaf.inputs:
            leaf.inputs[key].default_value = 0.25
    through = wire.add("ShaderNodeBsdfTranslucent", Color=mix(0.35, colour, (0.55, 0.60, 0.05)))
    both = wire.add("ShaderNodeMixShader", _0=0.3, _1=leaf.outputs[0], _2=through.outputs[0])
    wire.add("ShaderNodeOutputMaterial", Surface=both.outputs[0])
    return new
