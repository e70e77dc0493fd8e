"""refined.py - a copy of a ground's mesh that is fine along the trail, which our tree shows in the ground's place.

    the ground as modifiers before ours make it --ground/refine.py--> a mesh of an object in no collection
                                                                      --Object Info--> our tree (playback.py)

The ground's own mesh is never touched. The copy goes with the tree, its only user: into the file, into other files,
and away again. What is no mesh of the ground, as instances and curves on it, is shown as it was.
"""

from contextlib import contextmanager
from dataclasses import dataclass, replace

import bpy
import numpy as np

from ..ground import mesh as meshes
from ..ground import refine
from . import axes, compat, cover, ground, looks, moves, playback, private, seen, stack, surfaces

SIDE, BESIDE = 512, 4  # cells of a square that is looked at for itself, and beyond it: multiples of refine.BLOCK
CAMERA_FRAMES = 64  # of a bake at which the camera is looked for, at most
FINE = 1.5  # cells between points that show prints by themselves
CREASE = np.radians(1.0)  # faces that meet at a smaller angle are one
WRITTEN = {"position", "material_index", "sharp_face", "sharp_edge", "custom_normal", "edge_creases"}
KINDS = {  # data type of an attribute -> (its property, numbers in it, NumPy's type)
    "FLOAT": ("value", 1, np.float32),
    "INT": ("value", 1, np.int32),
    "INT8": ("value", 1, np.int32),
    "BOOLEAN": ("value", 1, bool),
    "FLOAT_VECTOR": ("vector", 3, np.float32),
    "FLOAT2": ("vector", 2, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32),
    "BYTE_COLOR": ("color", 4, np.float32),
    "QUATERNION": ("value", 4, np.float32),
    "INT32_2D": ("value", 2, np.int32),
    "INT16_2D": ("value", 2, np.int32),
    "FLOAT4X4": ("value", 16, np.float32),
}


@dataclass(frozen=True)
class Copy:
    """A refined copy, None where there may be none, and what could not be done, in sentences."""

    object: bpy.types.Object
    warnings: tuple


def make(scene, obj, surface, index, planes, standing=(), into=None):
    """The refined Copy of a ground for a bake, or None where its mesh is fine enough, or it is not asked for.

    planes: the maps after the last frame by name; surface: the ground as it was baked;
    standing: see playback_tree.Playing
    into: the object of an earlier copy, which is made anew then
    """
    settings = obj.desire_path
    if not settings.refine:
        return None
    changed = (planes["compression"] > 0.0) | (planes["heap"] > 0.0)
    if not changed.any() or cover.spacing(surface, index, planes) < FINE:
        return None
    why = held(scene, obj, surface.place)
    if why:
        return Copy(None, (f"The mesh of '{obj.name}' is not refined where the prints are, since {why}.",))
    wanted = _as_seen(scene, obj, surface, index, wishes(settings, planes, index))
    found = cut(scene, obj, surface, index.frame_start, wanted, into)
    if found is None:
        return None
    carrier, copied = found.carrier, found.carrier.data
    if settings.detail_size:
        seen.write(carrier, surface, obj, found, index, planes)
    seen.water(carrier, obj, found)
    if settings.attributes:
        value = cover.values(carrier, surface, index, planes, standing)
        for name in planes:
            if name not in copied.attributes:
                new = copied.attributes.new(name, "FLOAT", "POINT")
                if name in value:
                    new.data.foreach_set("value", value[name])
    warnings = [
        f"The refined copy of '{obj.name}' lacks its attribute '{name}', which is of a kind that is not known here."
        for name in found.left
    ]
    if not found.refined.valid:
        warnings.append(
            f"Prints on '{obj.name}' are shown coarser than asked for: finer, they would take more than "
            f"{refine.MAX_TRIANGLES // 10**6} million faces. Set Refined Size higher."
        )
    return Copy(carrier, tuple(warnings))


def wishes(settings, planes, index):
    """What the planes of a bake ask of the mesh that shows them, square by square: where no print is, none is asked."""
    ny, nx = planes["compression"].shape
    block, found = refine.BLOCK * index.cell, [(np.zeros((0, 2), np.int64), np.zeros(0))]
    for j in range(0, ny, SIDE):
        for i in range(0, nx, SIDE):
            low = np.maximum((i - BESIDE, j - BESIDE), 0)
            at = slice(low[1], j + SIDE + BESIDE), slice(low[0], i + SIDE + BESIDE)
            near = {name: plane[at] for name, plane in planes.items()}
            changed = (near["compression"] > 0.0) | (near["heap"] > 0.0)
            if not changed.any():
                continue
            here = refine.wishes(
                surfaces.shape(near),
                changed,
                index.cell,
                (0.0, 0.0),
                axes.typed(settings.refine_size),
                seen.fine(settings, near, index.cell) if settings.detail_size else None,
            )
            number = np.rint(here.corners / block).astype(np.int64) + low // refine.BLOCK
            own = (number * refine.BLOCK // SIDE == (i // SIDE, j // SIDE)).all(axis=1)
            found.append((number[own], here.sizes[own]))
    number, sizes = (np.concatenate(each) for each in zip(*found))
    order = np.lexsort(number.T)
    corners = number[order] * block + np.array((index.x0, index.y0), np.float64)
    return refine.Wishes(corners, sizes[order], block)


@dataclass(frozen=True)
class Cut:
    """A copy of a ground's mesh, cut."""

    carrier: bpy.types.Object  # in no collection
    refined: refine.Refined
    weights: dict  # of the vertex groups by name, None where nothing is
    left: list  # names of attributes that could not be carried over


@contextmanager
def _as_it_is(scene, obj, surface, frame, groups=()):
    """A ground's mesh at a frame, as modifiers before ours make it; groups: vertex groups that are attributes of it."""
    trees = [stack.realised()] if surface.place.realise else []
    trees += [ground.weights_tree(groups)] if groups else []
    with stack.shaped(scene, obj, surface.place.before, trees) as (own, copy):
        stack.show(scene, copy, obj)
        yield private.evaluated(own, copy, frame).data


def triangles(scene, obj, surface, frame):
    """A ground's mesh as it is at a frame, as refine.Triangles."""
    with _as_it_is(scene, obj, surface, frame) as mesh:
        return _triangles(mesh, surface)


def cut(scene, obj, surface, frame, wanted, into=None, refined=None):
    """The Cut of a ground's mesh as it is at a frame, or None where no wish asks for one.

    wanted: refine.Wishes; into: the object of an earlier copy, which is made anew then
    refined: what refine.refine makes of triangles() for these wishes, if that is known
    """
    groups = [each.name for each in obj.vertex_groups]
    with _as_it_is(scene, obj, surface, frame, groups) as mesh:
        if refined is None or (len(refined.of.points), refined.of.starts[-1]) != (len(mesh.vertices), len(mesh.loops)):
            refined = refine.refine(_triangles(mesh, surface), wanted)
        if not len(refined.triangles):
            return None
        weights = [compat.float_attribute(mesh, ground.WEIGHT.format(k)) for k in range(len(groups))]
        if into is not None:
            into.data.clear_geometry()
            into.data.materials.clear()
            into.vertex_groups.clear()
        carrier = into or bpy.data.objects.new(
            f"Desire Path {obj.name}", bpy.data.meshes.new(f"Desire Path {obj.name}")
        )
        left = _fill(carrier.data, mesh, refined)
    for name, weight in zip(groups, weights):
        group = carrier.vertex_groups.new(name=name)
        if weight is not None and weight.any():
            cover.weigh(group, refined.on_points(weight))
    return Cut(carrier, refined, dict(zip(groups, weights)), left)


def held(scene, obj, place):
    """Why a ground has to be shown by its own points, in words that end a sentence; empty where a copy may be."""
    stack_of = stack.others(obj)
    shown = [each.show_viewport or each.show_render for each in stack_of]
    animation = obj.animation_data
    paths = [each.data_path for each in (*compat.all_curves(animation), *animation.drivers)] if animation else []
    paths = [each for each in paths if not playback.animates_ours(obj, each)]
    if any(each.type == "PARTICLE_SYSTEM" for each in stack_of):
        return "its particles stand on its own points"
    if obj.instance_type in {"VERTS", "FACES"}:
        return "it shows instances on its own points or faces"
    if any(each.parent == obj and each.parent_type in {"VERTEX", "VERTEX_3"} for each in bpy.data.objects):
        return "objects hang on its own points"
    if any(seen and each.type == "NODES" for each, seen in zip(stack_of[place.before :], shown[place.before :])):
        return "geometry nodes after the prints would be given other points"
    if obj.data.shape_keys is not None:
        return "it has shape keys, which the copy would not follow"
    if any(seen and moves.shapes_by_time(each) for each, seen in zip(stack_of[: place.before], shown)) or any(
        path.startswith("modifiers[") for path in paths
    ):
        return "modifiers change its shape in time, which the copy would not follow"
    if stack.differs(scene, obj, place.before):
        return "its modifiers make it otherwise in renders than in the viewport"
    return ""


def mark(obj):
    """A word for all of a ground's own mesh that its copy shows; another one when any of it differs."""
    mesh, arrays = obj.data, [compat.positions(obj.data)]
    arrays.append(_numbers(mesh.loops, "vertex_index", 1, np.int32))
    arrays.append(_numbers(mesh.polygons, "material_index", 1, np.int32))
    arrays += [compat.uv(mesh, each.name).astype(np.float32) for each in mesh.uv_layers]
    shares = sorted(each.name for each in mesh.attributes if each.name.startswith(looks.SHARE[:-2]))
    arrays += [each for each in (compat.float_attribute(mesh, name) for name in shares) if each is not None]
    return meshes.mark(arrays, [len(mesh.polygons), [each.name_full if each else "" for each in mesh.materials]])


def _as_seen(scene, obj, surface, index, wanted):
    """Wishes no finer than so many pixels of the camera, where that is asked for."""
    pixels, camera = obj.desire_path.refine_pixels, scene.camera
    if pixels <= 0.0 or camera is None or camera.type != "CAMERA":
        return wanted
    at = _camera_places(scene, camera, index)
    low, high = surface.vertices[:, 2].min(), surface.vertices[:, 2].max()
    nearest = np.full(len(wanted.sizes), np.inf)
    for place in at:  # to the near side of each square, at the height of the ground that is nearest
        beside = np.maximum(np.maximum(wanted.corners - place[:2], place[:2] - wanted.corners - wanted.block), 0.0)
        above = place[2] - np.clip(place[2], low, high)
        nearest = np.minimum(nearest, np.sqrt((beside**2).sum(axis=1) + above**2))
    return replace(wanted, sizes=np.maximum(wanted.sizes, pixels * pixel(scene, camera, nearest)))


def _camera_places(scene, camera, index):
    """Where the camera is over the frames of a bake (n, 3) [m]."""
    frames = np.unique(np.linspace(index.frame_start, index.frame_end, CAMERA_FRAMES).astype(int))
    with private.private_scene(scene, camera) as own:
        return np.array(
            [private.evaluated(own, camera, int(frame)).matrix_world.translation for frame in frames], np.float64
        ) * axes.unit_scale(scene)


def pixel(scene, camera, distance):
    """How wide a pixel of a camera is at a distance [m]."""
    lens, render = camera.data, scene.render
    sides = np.array((render.resolution_x, render.resolution_y)) * render.resolution_percentage / 100.0
    fit = {"HORIZONTAL": 0, "VERTICAL": 1}.get(lens.sensor_fit, int(sides[1] > sides[0]))
    if lens.type == "ORTHO":
        return np.full(len(distance), lens.ortho_scale * axes.unit_scale(scene) / sides.max())
    if lens.type == "PANO":
        return distance * (_angles(lens) / sides).min()
    sensor = lens.sensor_height if lens.sensor_fit == "VERTICAL" else lens.sensor_width
    return distance * sensor / lens.lens / sides[fit]


def _angles(lens):
    """How much a panorama sees along both sides of its picture [rad]."""
    its = lens if hasattr(lens, "panorama_type") else getattr(lens, "cycles", None)
    kind = getattr(its, "panorama_type", "EQUIRECTANGULAR")
    if kind == "EQUIRECTANGULAR" and its is not None:
        return np.array((its.longitude_max - its.longitude_min, its.latitude_max - its.latitude_min))
    if kind.startswith("FISHEYE"):
        return np.full(2, its.fisheye_fov)
    return np.array((2.0 * np.pi, np.pi))


def _numbers(data, name, count, kind):
    out = np.empty(len(data) * count, kind)
    if len(out):
        data.foreach_get(name, out)
    return out.reshape(-1, count) if count > 1 else out


def _triangles(mesh, surface):
    triangles = compat.triangles(mesh)
    return refine.Triangles(
        axes.points(surface.world, compat.positions(mesh), surface.scale),
        triangles,
        compat.triangle_corners(mesh),
        _numbers(mesh.loop_triangles, "polygon_index", 1, np.int32),
        _starts(mesh),
    )


def _fill(mesh, source, refined):
    """Fill an empty mesh as `refined` cuts another one; returns the names of attributes that are left out."""
    points = refined.on_points(compat.positions(source).astype(np.float64)).astype(np.float32)
    mesh.vertices.add(len(points))
    compat.set_numbers(mesh, "position", "vector", points, mesh.vertices, "co")
    corners = refined.corner_points(_numbers(source.loops, "vertex_index", 1, np.int32))
    mesh.loops.add(len(corners))
    compat.set_numbers(mesh, ".corner_vert", "value", corners, mesh.loops, "vertex_index")
    sizes = refined.sizes.astype(np.int32)
    mesh.polygons.add(len(sizes))
    mesh.polygons.foreach_set("loop_start", (np.cumsum(sizes) - sizes).astype(np.int32))
    if not mesh.polygons[0].bl_rna.properties["loop_total"].is_readonly:  # later Blenders read it off loop_start
        mesh.polygons.foreach_set("loop_total", sizes)
    smooth = _numbers(source.polygons, "use_smooth", 1, bool)
    for name, values in (
        ("material_index", refined.on_faces(_numbers(source.polygons, "material_index", 1, np.int32))),
        ("use_smooth", np.concatenate((smooth[refined.kept], np.ones(len(refined.triangles), bool)))),
    ):
        if (values != getattr(mesh.polygons[0], name)).any():  # all new faces have the same
            mesh.polygons.foreach_set(name, values)
    mesh.update(calc_edges=True)
    along = {
        "POINT": refined.on_points,
        "CORNER": refined.on_corners,
        "FACE": refined.on_faces,
        "EDGE": lambda values: refined.on_edges(
            values, *(_numbers(each.edges, "vertices", 2, np.int32) for each in (source, mesh))
        ),
    }
    left = _attributes(mesh, source, along)
    sharp = _numbers(source.edges, "use_edge_sharp", 1, bool) | _creased(source, smooth)
    for name, values in (("use_edge_sharp", sharp), ("use_seam", _numbers(source.edges, "use_seam", 1, bool))):
        if values.any():
            mesh.edges.foreach_set(name, along["EDGE"](values))
    for each in source.materials:
        mesh.materials.append(each and each.original)
    if hasattr(mesh, "use_auto_smooth"):  # else sharp edges count by themselves
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = source.auto_smooth_angle if source.use_auto_smooth else np.pi
    if source.has_custom_normals:
        mesh.normals_split_custom_set(refined.on_corners(_corner_normals(source)))
    return left


def _creased(mesh, smooth):
    """Edges where faces that are shaded flat meet others at an angle, bool (e,): there their copies, which are shaded
    smooth so that prints are, stay apart."""
    faces = np.repeat(np.arange(len(smooth)), np.diff(_starts(mesh)))
    normals = _numbers(mesh.polygons, "normal", 3, np.float32)
    edges = _numbers(mesh.loops, "edge_index", 1, np.int32)
    count = len(mesh.edges)
    flat = np.zeros(count, bool)
    flat[edges[~smooth[faces]]] = True
    first = np.zeros(count, np.int32)
    first[edges] = faces  # one of its faces
    turned = np.zeros(count, bool)
    turned[edges[(normals[faces] * normals[first[edges]]).sum(axis=1) < np.cos(CREASE)]] = True
    return flat & turned


def _starts(mesh):
    """First corner of each face, and how many corners there are, int32 (f + 1,)."""
    return np.append(_numbers(mesh.polygons, "loop_start", 1, np.int32), np.int32(len(mesh.loops)))


def _corner_normals(mesh):
    if hasattr(mesh, "corner_normals"):
        return _numbers(mesh.corner_normals, "vector", 3, np.float32)
    mesh.calc_normals_split()
    return _numbers(mesh.loops, "normal", 3, np.float32)


def _attributes(mesh, source, along):
    """Carry attributes over, UV maps among them; returns the names of those of unknown kinds."""
    left = []
    maps = {each.name for each in source.uv_layers}
    for each in source.attributes:
        if each.name in WRITTEN or each.name.startswith((".", ground.WEIGHT[:-2])) or each.name in maps:
            continue
        if each.data_type not in KINDS:
            left.append(each.name)
            continue
        name, count, kind = KINDS[each.data_type]
        values = along[each.domain](_numbers(each.data, name, count, kind))
        new = mesh.attributes.get(each.name) or mesh.attributes.new(each.name, each.data_type, each.domain)
        new.data.foreach_set(name, values.ravel())
    for layer in source.uv_layers:
        mesh.uv_layers.new(name=layer.name, do_init=False)
    for layer in source.uv_layers:
        values = along["CORNER"](compat.uv(source, layer.name).astype(np.float32))
        compat.set_uv(mesh, layer.name, values)
        mesh.uv_layers[layer.name].active_render = layer.active_render
    if source.uv_layers.active is not None:
        mesh.uv_layers.active = mesh.uv_layers[source.uv_layers.active.name]
    colours = getattr(source, "color_attributes", None)
    if colours is not None and colours.active_color is not None and colours.active_color.name in mesh.attributes:
        mesh.color_attributes.active_color = mesh.color_attributes[colours.active_color.name]
        mesh.color_attributes.render_color_index = colours.render_color_index
    return left
