"""Plants as they are seen: standing, trodden, broken, and gone again."""

import bpy
import numpy as np
from scenes import meshes
from test_bake import refused, state
from test_plants import CELL, NX, NY, add, bed, blank, everything, images, paint, play, roots
from test_playback import fresh

from desire_path.blender import compat, grass, grass_tree, plants, playback, playback_tree

# ---- what is seen ------------------------------------------------------------------------------------


def grown(obj, frame=None):
    """(instances as {(x, y): height}, real vertices (n, 3), their attributes) of an object of grass."""
    scene = bpy.context.scene
    scene.frame_set(scene.frame_current if frame is None else frame)
    graph = bpy.context.evaluated_depsgraph_get()
    found = {}
    for each in graph.object_instances:
        if each.is_instance and each.parent is not None and each.parent.original == obj:
            matrix = np.array(each.matrix_world)
            if len(each.object.data.vertices) and not _is_real(each.object.data):
                found[tuple(np.round(matrix[:2, 3], 4).tolist())] = float(matrix[2, 3])
    mesh = obj.evaluated_get(graph).data
    real = compat.positions(mesh) if _is_real(mesh) else np.zeros((0, 3), np.float32)
    values = {}
    if len(real):
        for name in (grass_tree.PLACE, grass_tree.ROOT, grass_tree.AT, grass_tree.LOOK):
            values[name] = np.empty((len(real), 3), np.float32)
            mesh.attributes[name].data.foreach_get("vector", values[name].ravel())
        values[grass_tree.STRENGTH] = compat.float_attribute(mesh, grass_tree.STRENGTH)
        values[grass_tree.SIZE] = compat.float_attribute(mesh, grass_tree.SIZE)
    return found, real, values


def _is_real(mesh):
    return grass_tree.PLACE in mesh.attributes


def test_standing_grass_is_instances_at_the_roots():
    ground = bed(lambda x, y: 0.3 * x)
    each = add(ground, "meadow")
    found, real, _ = grown(each.grass)
    place = roots(each)
    assert len(real) == 0 and len(found) == each.count == len(place)
    seen = np.array([(*at, height) for at, height in found.items()])
    apart = np.abs(seen[:, None] - place[None]).max(axis=2)
    assert apart.min(axis=0).max() < 1e-4 and apart.min(axis=1).max() < 1e-4


def test_trodden_stems_lie_along_the_lean_and_standing_ones_stay(folder):
    ground = bed()
    each = add(ground, "carex")
    trail, lean, x, y = blank()
    trodden = (abs(x - 0.96) < 0.25) & (abs(y - 0.6) < 0.2)
    trail[trodden, 0] = -0.03
    lean[trodden] = (1.0, 0.0, 1.0, 1.0)
    play(ground, images(folder, trail, lean))
    standing, none, _ = grown(each.grass, 0)
    assert len(none) == 0 and len(standing) == each.count
    found, real, told = grown(each.grass, 1)
    # those far away are the very same, those under the foot are real now
    assert all(standing[at] == height for at, height in found.items())
    away = [at for at in standing if abs(at[0] - 0.96) > 0.4 or abs(at[1] - 0.6) > 0.35]
    assert len(away) > 50 and all(at in found for at in away) and len(found) < len(standing)
    size = told[grass_tree.SIZE]
    foot = told[grass_tree.PLACE][:, :2]
    deep = (abs(foot[:, 0] - 0.96) < 0.16) & (abs(foot[:, 1] - 0.6) < 0.11)
    above = told[grass_tree.AT][:, 2] > 1e-4
    assert deep.sum() > 1000
    # flat on the pressed ground, none below it
    height = real[deep & above, 2]
    assert height.min() > -0.0301 and np.percentile(height, 90) < -0.03 + 0.012 and height.max() < 0.02, height.max()
    # tips point along +x, at about the stem's length
    tip = deep & (told[grass_tree.LOOK][:, 0] > 0.99)
    reach = (real[tip, 0] - foot[tip, 0]) / (told[grass_tree.ROOT][tip, 2] * size[tip])
    assert np.median(reach) > 0.75 and (reach > 0.3).mean() > 0.95, np.median(reach)


def lengths(real, told, many=200):
    """Length of every real stem along its middle over its length when straight."""
    key = np.column_stack([told[grass_tree.PLACE], told[grass_tree.ROOT]])
    out = []
    for stem in np.unique(key, axis=0)[:many]:
        at = np.flatnonzero((key == stem).all(axis=1))
        s = told[grass_tree.AT][at, 2]
        rows = np.unique(np.round(s, 6))
        rows = rows[rows >= -1e-6]
        middle = np.array([real[at][np.abs(s - row) < 2e-6].mean(axis=0) for row in rows])
        straight = (rows[-1] - rows[0]) * told[grass_tree.SIZE][at[0]]
        if straight > 0.01:
            out.append(np.linalg.norm(np.diff(middle, axis=0), axis=1).sum() / straight)
    return np.array(out)


def test_leaning_stems_are_arcs_of_the_same_length(folder):
    ground = bed()
    each = add(ground, "lawn")
    each.density = 40.0
    trail, lean, *_ = blank()
    for lean_x, crushed in ((0.5, 0.15), (0.8, 0.5), (0.0, 0.3)):
        lean[...] = (lean_x, 0.0, crushed, 1.0)
        play(ground, images(folder, trail, lean))
        found, real, told = grown(each.grass, 1)
        assert len(found) == 0
        kept = lengths(real, told)  # along the blades' few pieces: chords of an arc are a little shorter
        assert len(kept) > 100 and np.median(kept) > 0.93 and kept.max() < 1.02, (kept.min(), kept.max())
        # bent more towards the tip: the lower half rises higher than the upper
        s, high = told[grass_tree.LOOK][:, 0], real[:, 2] / (told[grass_tree.ROOT][:, 2] * told[grass_tree.SIZE])
        half = high[abs(s - 1 / 3) < 0.01].mean()
        top = high[s > 0.99].mean()
        assert half > 1.2 * top / 3, (half, top)


def test_images_at_rest_change_nothing(folder):
    # real stems in their own shape are what the instances are
    ground = bed(lambda x, y: 0.1 * x)
    each = add(ground, "meadow")
    trail, lean, *_ = blank()
    lean[..., 3] = 0.98  # just enough to be made real; hardly a stem is broken
    play(ground, images(folder, trail, lean))
    _, real, told = grown(each.grass, 1)
    assert len(real) > 10000
    shape = dict(enumerate(grass.scattered(each.grass.modifiers[0].node_group).objects))
    graph = bpy.context.evaluated_depsgraph_get()
    bpy.context.scene.frame_set(0)
    graph = bpy.context.evaluated_depsgraph_get()
    wanted = []
    for instance in graph.object_instances:
        mine = instance.is_instance and instance.parent is not None and instance.parent.original == each.grass
        if mine and not _is_real(instance.object.data):
            local = compat.positions(instance.object.data)
            matrix = np.array(instance.matrix_world)
            wanted.append(local @ matrix[:3, :3].T + matrix[:3, 3])
    wanted = np.concatenate(wanted)
    assert len(shape) == 8 and len(wanted) == len(real)
    order, other = (np.lexsort(np.round(a[:, :2], 3).T) for a in (wanted, real))
    # roots follow the slope stem by stem, which instances do not; sideways all is the same
    gap = np.abs(wanted[order][:, :2] - real[other][:, :2]).max(axis=1)
    assert np.percentile(gap, 95) < 2e-3, np.percentile(gap, 95)


def test_broken_stems_are_pale_and_wear_away(folder):
    ground = bed()
    each = add(ground, "lawn")
    trail, lean, *_ = blank()
    heights, pale = [], []
    for strength in (0.9, 0.5, 0.02):
        trail[..., 3] = 3e5 * (1 - strength)  # trodden that often
        lean[...] = (0.9 * (1 - strength), 0.0, 1 - strength, strength)
        play(ground, images(folder, trail, lean))
        _, real, told = grown(each.grass, 1)
        tips = told[grass_tree.LOOK][:, 0] > 0.99
        heights.append(real[tips, 2].mean())
        pale.append(told[grass_tree.STRENGTH][tips].mean())
    assert heights[0] > 1.4 * heights[1] > 5 * heights[2], heights
    assert pale[0] > pale[1] > pale[2] and pale[2] < 0.15, pale


# ---- attributes for any other grass -------------------------------------------------------------------


def test_the_ground_says_how_plants_lie(folder):
    random = np.random.default_rng(5)
    lean = random.uniform(-0.7, 0.7, (NY, NX, 4)).astype(np.float32)
    lean[..., 2:] = np.abs(lean[..., 2:])
    trail = blank()[0]
    trail[..., 1] = lean[..., 3]
    # wider than the images, on all sides
    ground = meshes.grid(NX + 40, NY + 40, CELL, CELL / 2 - 20 * CELL, CELL / 2 - 20 * CELL)
    bpy.ops.object.desire_path_ground_add()
    paint(ground, lambda x, y: np.where(y < 0.0, 0.25, 1.0))
    each = add(ground, "lycopodium", grass=False)
    assert each.grass is None and plants.shown(each) is None
    each.density_group, each.density = "grown", 32.0
    rest = compat.positions(ground.data)
    group = ground.vertex_groups.new(name=playback_tree.group_name("plant_strength"))
    play(ground, images(folder, trail, lean), layer_depth=0.3)
    bpy.context.scene.frame_set(1)
    mesh = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    at = np.empty((len(rest), 3), np.float32)
    mesh.attributes[playback_tree.LEAN].data.foreach_get("vector", at.ravel())
    strength = compat.float_attribute(mesh, playback_tree.STRENGTH)
    i, j = np.round(rest[:, :2] / CELL - 0.5).astype(int).T
    inside = (i >= 0) & (i < NX) & (j >= 0) & (j < NY)
    assert at[inside].tobytes() == lean[..., :3].reshape(-1, 3).tobytes()
    np.testing.assert_allclose(strength[inside], lean[..., 3].ravel(), atol=1e-6)
    # off the images they stand as they grew: 32 of the 40 a square metre that are full cover, thinned below
    assert not at[~inside].any()
    wanted = np.where(rest[~inside, 1] < -CELL, 0.25, 1.0) * 0.8
    clear = abs(rest[~inside, 1]) > 2 * CELL
    np.testing.assert_allclose(strength[~inside][clear], wanted[clear], atol=1e-5)
    weight = {v.index: g.weight for v in mesh.vertices for g in v.groups if g.group == group.index}
    for vertex in range(0, len(rest), 371):
        assert abs(weight[vertex] - strength[vertex]) < 1e-5
    assert compat.positions(ground.data).tobytes() == rest.tobytes()


def test_bare_ground_plays_by_the_same_nodes(folder):
    ground = bed()
    index = images(folder, *blank()[:2])
    index.lean = False
    play(ground, index)
    nodes = [node.bl_idname for node in playback.modifier(ground).node_group.nodes]
    assert nodes.count("GeometryNodeImageTexture") == 1
    assert nodes.count("GeometryNodeStoreNamedAttribute") == 1
    assert set(playback.images(playback.modifier(ground).node_group)) == {"trail"}


# ---- nothing is left ----------------------------------------------------------------------------------


def test_grass_without_the_addon(folder):
    ground = bed()
    each = add(ground, "carex")
    trail, lean, x, y = blank()
    lean[(abs(x - 0.9) < 0.2)] = (0.2, 0.9, 0.9, 0.8)
    play(ground, images(folder, trail, lean))
    found, real, _ = grown(each.grass, 1)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    fresh(FRESH, folder / "a.blend", folder / "out.npz", each.grass.name)
    with np.load(folder / "out.npz") as out:
        assert out["count"] == len(found) > 10 and out["real"].tobytes() == real.tobytes() and len(real)


FRESH = """
import bpy, numpy as np, sys
assert not hasattr(bpy.types.Object, "desire_path")
bpy.ops.wm.open_mainfile(filepath=sys.argv[-3])
bpy.context.scene.frame_set(1)
graph = bpy.context.evaluated_depsgraph_get()
mesh = bpy.data.objects[sys.argv[-1]].evaluated_get(graph).data
co = np.empty(3 * len(mesh.vertices), np.float32)
mesh.vertices.foreach_get("co", co)
real = sum(1 for each in graph.object_instances
           if each.is_instance and "tuft_place" not in each.object.data.attributes)
np.savez(sys.argv[-2], real=co.reshape(-1, 3), count=real)
"""


def test_removed_plants_leave_nothing(folder):
    ground = bed()
    before, have = state(ground), everything()
    add(ground, "carex"), add(ground, "carex"), add(ground, "wheat", grass=False)
    trail, lean, *_ = blank()
    lean[..., 2] = 0.5
    play(ground, images(folder, trail, lean))
    assert bpy.ops.object.desire_path_plants_remove() == {"FINISHED"}
    assert [each.kind for each in ground.desire_path.plants] == ["carex", "carex"]
    playback.detach(ground)
    plants.show(ground)
    assert not [image for image in bpy.data.images if grass.TAG in image]
    for _ in range(2):
        assert bpy.ops.object.desire_path_plants_remove() == {"FINISHED"}
    assert everything() == have and state(ground) == before
    assert not bpy.ops.object.desire_path_plants_remove.poll()
    # with its ground
    add(ground, "moss")
    assert bpy.ops.object.desire_path_remove() == {"FINISHED"}
    assert everything() == have


def test_grass_that_was_deleted_can_be_shown_again():
    ground = bed()
    each = add(ground, "fern")
    meshes.activate(each.grass)
    bpy.ops.object.delete()
    meshes.activate(ground)
    assert plants.shown(each) is None
    assert bpy.ops.object.desire_path_plants_update() == {"FINISHED"}
    assert bpy.ops.object.desire_path_grass_add() == {"FINISHED"}
    assert len(grown(each.grass)[0]) == each.count > 0
    assert "already" in refused(bpy.ops.object.desire_path_grass_add)


def test_the_users_own_tufts_stay(folder):
    ground = bed()
    each = add(ground, "carex")
    own = bpy.data.collections.new("mine")
    stick = bpy.data.meshes.new("mine")
    stick.from_pydata([(0, 0, 0.1 * k) for k in range(2)], [(0, 1)], [])
    own.objects.link(bpy.data.objects.new("mine", stick))
    node = [n for n in each.grass.modifiers[0].node_group.nodes if n.bl_idname == "GeometryNodeCollectionInfo"][0]
    node.inputs["Collection"].default_value = own
    each.seed = 4
    play(ground, images(folder, *blank()[:2]))
    assert grass.scattered(each.grass.modifiers[0].node_group) == own
    each.kind = "lawn"
    assert grass.scattered(each.grass.modifiers[0].node_group) == own
    # meshes of the user bend as one stem each
    each.kind = "carex"
    trail, lean, *_ = blank()
    lean[...] = (0.0, 1.0, 1.0, 1.0)
    play(ground, images(folder, trail, lean))
    bpy.context.scene.frame_set(1)
    mesh = each.grass.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    ends = compat.positions(mesh).reshape(-1, 2, 3)
    assert len(ends) == each.count and np.abs(ends[:, 0, 2]).max() < 0.003
    way, size = ends[:, 1] - ends[:, 0], compat.float_attribute(mesh, grass_tree.SIZE).reshape(-1, 2)[:, 0]
    np.testing.assert_allclose(np.linalg.norm(way, axis=1), 0.1 * size, rtol=0.1)
    assert way[:, 2].max() < 0.03 and np.median(way[:, 1] / size) > 0.08
