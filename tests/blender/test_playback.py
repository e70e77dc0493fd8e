"""Frames come back from the files bit for bit, in this process and in one without the add-on."""

import os
import subprocess
import sys
import types

import bpy
import numpy as np
from scenes import exr, meshes

from desire_path.bake.atlas import EDGE, PAGE, Atlas
from desire_path.blender import axes, compat, playback, playback_tree
from desire_path.ground.sim import TILE

NX, NY, CELL = 48, 40, 0.02


def frames(folder, count=5, nx=NX, ny=NY, seed=1):
    """A sequence of random frames; file 0 is all zero. Returns their values (count + 1, ...)."""
    os.makedirs(folder / "frames", exist_ok=True)
    rng = np.random.default_rng(seed)
    value = rng.normal(0.0, 0.03, (count + 1, ny, nx, 4)).astype(np.float32)
    value[..., 3] *= 1e5
    value[0] = 0.0
    for n, each in enumerate(value):
        exr.write(folder / "frames" / f"trail_{n:04d}.exr", each)
    return value


def index(x0=0.0, y0=0.0, frame_start=10, count=5, nx=NX, ny=NY, cell=CELL):
    return types.SimpleNamespace(
        cell=cell, x0=x0, y0=y0, nx=nx, ny=ny, frame_start=frame_start, frame_end=frame_start + count - 1
    )


def corners(obj):
    low, high = (f(compat.positions(obj.data), axis=0) for f in (np.min, np.max))
    return np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])


def play(obj, folder, where, count=5, smooth=False, scale=1.0, layer_depth=0.0):
    bpy.context.view_layer.update()
    world = axes.matrix(obj.matrix_world, obj.name)
    how = playback_tree.Playing(where, count, world, scale, smooth, corners(obj), layer_depth)
    return playback.attach(obj, playback.join(str(folder), "frames"), how)


def shown(obj, frame, subframe=0.0):
    """Positions and colour attribute of the evaluated mesh."""
    bpy.context.scene.frame_set(frame, subframe=subframe)
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return compat.positions(mesh), compat.colour_attribute(mesh, playback_tree.ATTRIBUTE)


def pixel_ground(**more):
    """A grid whose vertices are the cell centres of `index()`."""
    return meshes.grid(NX, NY, CELL, CELL / 2, CELL / 2, **more)


def test_exact_at_random_access(folder):
    value = frames(folder)
    obj = pixel_ground(height=lambda x, y: 0.1 * np.sin(9 * x) * y)
    rest = compat.positions(obj.data)
    play(obj, folder, index())
    for frame in (12, 14, 10, 99, 3, 11, 13, 9, -5, 12):
        n = min(max(frame - 10 + 1, 0), 5)
        position, colour = shown(obj, frame)
        assert colour.tobytes() == value[n].reshape(-1, 4).tobytes(), frame
        wanted = rest.copy()
        wanted[:, 2] += value[n][..., 0].ravel()
        assert position.tobytes() == wanted.tobytes(), frame
    assert compat.positions(obj.data).tobytes() == rest.tobytes()


def paged(folder, value, nx, ny, reached):
    """The same frames as pages of some tiles alone, and which cells these show."""
    atlas = Atlas.over(reached)
    os.makedirs(folder / "frames", exist_ok=True)
    atlas.write(str(folder / "frames"))
    for n, each in enumerate(value):
        full = np.pad(each, ((EDGE, 2 * TILE), (EDGE, 2 * TILE), (0, 0)))
        picture = np.zeros((atlas.rows * TILE, atlas.columns * TILE, 4), np.float32)
        for number, (x, y) in enumerate(atlas.pages.tolist()):
            row, column = (TILE * k for k in divmod(number, atlas.columns))
            part = full[y * PAGE : y * PAGE + TILE, x * PAGE : x * PAGE + TILE]
            picture[row : row + TILE, column : column + TILE] = part
        exr.write(folder / "frames" / f"trail_{n:04d}.exr", picture)
    i, j = np.meshgrid(np.arange(nx), np.arange(ny))
    where = index(nx=nx, ny=ny, count=len(value) - 1)
    where.columns, where.rows = atlas.columns, atlas.rows
    return where, atlas.find(i, j)[2]


def test_pages_are_found(folder):
    """A sparse picture shows at every cell that it has what one of all cells shows, and nothing at others."""
    reached = np.zeros((2, 4), bool)
    reached[0, :2] = reached[1, 3] = True
    nx, ny = 4 * TILE, 2 * TILE
    value = frames(folder / "all", 2, nx, ny)
    where, there = paged(folder / "pages", value, nx, ny, reached)
    assert 0.3 < there.mean() < 0.9
    obj = meshes.grid(nx + 40, ny + 40, CELL, -19.5 * CELL, -19.5 * CELL)
    rest = compat.positions(obj.data)
    play(obj, folder / "pages", where, 2)
    for frame in (10, 11, 5, 30):
        position, colour = shown(obj, frame)
        wanted = np.where(there[..., None], value[min(max(frame - 9, 0), 2)], np.float32(0.0))
        wanted = np.pad(wanted, ((20, 20), (20, 20), (0, 0)))
        assert colour.tobytes() == wanted.reshape(-1, 4).tobytes(), frame
        np.testing.assert_allclose(position[:, 2], rest[:, 2] + wanted[..., 0].ravel(), atol=1e-6)
    fine = meshes.grid(300, 170, 0.0137, 0.03, 0.03)
    at = (compat.positions(fine.data)[:, :2] / CELL).astype(int)
    clear = there[at[:, 1], at[:, 0]]
    play(fine, folder / "pages", where, 2, smooth=True)
    _, some = shown(fine, 11)
    play(fine, folder / "all", index(nx=nx, ny=ny, count=2), 2, smooth=True)
    _, everything = shown(fine, 11)
    np.testing.assert_allclose(some[clear][:, :3], everything[clear][:, :3], atol=2e-4)
    assert clear.mean() > 0.3 and not some[~clear].any()


def test_steps_between_frames(folder):
    value = frames(folder)
    obj = pixel_ground()
    play(obj, folder, index())
    _, colour = shown(obj, 11, 0.75)
    assert colour.tobytes() == value[2].reshape(-1, 4).tobytes()


def test_points_outside_stay(folder):
    value = frames(folder)
    obj = meshes.grid(3 * NX, 3 * NY, CELL, CELL / 2 - NX * CELL, CELL / 2 - NY * CELL)
    rest = compat.positions(obj.data)
    for smooth in (False, True):
        play(obj, folder, index(), smooth=smooth)
        position, colour = shown(obj, 14)
        colour = colour.reshape(3 * NY, 3 * NX, 4)
        inner = (slice(NY, 2 * NY), slice(NX, 2 * NX))
        if smooth:
            np.testing.assert_allclose(colour[inner][..., :3], value[5][..., :3], atol=1e-6)
        else:
            assert colour[inner].tobytes() == value[5].tobytes()
        colour[NY - 1 : 2 * NY + 1, NX - 1 : 2 * NX + 1] = 0.0  # 3.4 repeats the last cell once
        assert not colour.any()
        away = np.ones((3 * NY, 3 * NX), bool)
        away[inner] = False
        assert (position[away.ravel()] == rest[away.ravel()]).all()


def test_between_cells_is_smooth(folder):
    value = frames(folder)
    obj = meshes.grid(60, 50, 0.0137, 0.03, 0.03)
    play(obj, folder, index(), smooth=True)
    _, colour = shown(obj, 12)
    at = compat.positions(obj.data)[:, :2].astype(np.float64) / CELL - 0.5
    i, j = np.floor(at).astype(int).T
    fx, fy = (at - np.floor(at)).T
    v = value[3][..., 0].astype(np.float64)
    wanted = (1 - fy) * ((1 - fx) * v[j, i] + fx * v[j, i + 1]) + fy * ((1 - fx) * v[j + 1, i] + fx * v[j + 1, i + 1])
    np.testing.assert_allclose(colour[:, 0], wanted, atol=2e-6)


def test_tilted_scaled_ground_in_centimetres(folder):
    # one unit is a centimetre, the object is turned, tilted, stretched and moved
    value = frames(folder)
    obj = meshes.grid(30, 26, 1.0, 0.0, 0.0)
    obj.rotation_euler = (0.3, -0.2, 0.7)
    obj.scale = (2.0, 3.0, 0.5)
    obj.location = (40.0, -30.0, 7.0)
    scale = 0.01
    bpy.context.view_layer.update()
    world = np.array(obj.matrix_world, np.float64)
    rest = axes.points(world, compat.positions(obj.data), scale)
    where = index(rest[:, 0].min() - 0.05, rest[:, 1].min() - 0.05, nx=NX, ny=NY, cell=0.03)
    play(obj, folder, where, smooth=True, scale=scale)
    position, colour = shown(obj, 13)
    moved = axes.points(world, position, scale)
    np.testing.assert_allclose(moved[:, :2], rest[:, :2], atol=1e-6)
    np.testing.assert_allclose(moved[:, 2] - rest[:, 2], colour[:, 0], atol=1e-6)
    at = (rest[:, :2] - (where.x0, where.y0)) / where.cell - 0.5
    i, j = np.floor(at).astype(int).T
    fx, fy = (at - np.floor(at)).T
    v = value[4][..., 0].astype(np.float64)
    wanted = (1 - fy) * ((1 - fx) * v[j, i] + fx * v[j, i + 1]) + fy * ((1 - fx) * v[j + 1, i] + fx * v[j + 1, i + 1])
    assert np.abs(colour[:, 0]).max() > 0.02
    np.testing.assert_allclose(colour[:, 0], wanted, atol=1e-5)


def test_vertex_groups(folder):
    value = np.abs(frames(folder))
    for n, each in enumerate(value):
        exr.write(folder / "frames" / f"trail_{n:04d}.exr", each)
    obj = pixel_ground()
    groups = [obj.vertex_groups.new(name=playback_tree.group_name(name)) for name in playback_tree.GROUPS]
    play(obj, folder, index(), layer_depth=0.3)
    bpy.context.scene.frame_set(12)
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    weight = np.zeros((2, NX * NY), np.float32)
    for vertex in evaluated.data.vertices:
        for member in vertex.groups:
            weight[member.group, vertex.index] = member.weight
    np.testing.assert_allclose(weight[groups[0].index], value[3][..., 1].ravel(), atol=1e-6)
    np.testing.assert_allclose(weight[groups[1].index], value[3][..., 2].ravel() / 0.3, atol=1e-6)


def test_detach_leaves_nothing(folder):
    frames(folder)
    obj = pixel_ground()
    obj.modifiers.new("Keep", "SMOOTH")
    before = ids()
    play(obj, folder, index())
    assert ids() != before
    play(obj, folder, index())
    assert [m.name for m in obj.modifiers] == ["Keep", playback_tree.MODIFIER]
    obj.modifiers.new("After", "SMOOTH")
    play(obj, folder, index())
    assert [m.name for m in obj.modifiers] == ["Keep", playback_tree.MODIFIER, "After"]
    obj.modifiers.remove(obj.modifiers["After"])
    playback.detach(obj)
    assert ids() == before and [m.name for m in obj.modifiers] == ["Keep"]


def ids():
    return {
        (kind, each.name)
        for kind in ("node_groups", "images", "objects", "meshes", "scenes")
        for each in getattr(bpy.data, kind)
    }


FRESH = """
import bpy, numpy as np, sys
assert not hasattr(bpy.types.Object, "desire_path")
bpy.ops.wm.open_mainfile(filepath=sys.argv[-2])
obj = bpy.data.objects["Ground"]
out = []
for frame in (14, 10, 3, 12, 99):
    bpy.context.scene.frame_set(frame)
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    colour = np.empty(4 * len(mesh.vertices), np.float32)
    mesh.attributes["desire_path"].data.foreach_get("color", colour)
    co = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", co)
    out.append((colour.reshape(-1, 4), co.reshape(-1, 3)))
np.savez(sys.argv[-1], **{f"{k}{i}": v for i, o in enumerate(out) for k, v in zip("cp", o)})
"""


def fresh(script, *arguments):
    """Run a script in a new process of this Blender, without the add-on."""
    if bpy.app.binary_path:
        command = [
            bpy.app.binary_path,
            "-b",
            "--factory-startup",
            "--python-exit-code",
            "1",
            "--python-expr",
            script,
            "--",
            *map(str, arguments),
        ]
    else:
        command = [sys.executable, "-c", script, *map(str, arguments)]
    path = "/usr/bin:/bin" if bpy.app.binary_path else os.environ.get("PATH", "")
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PATH": path})
    assert done.returncode == 0, done.stdout + done.stderr


def test_fresh_process_without_the_addon(folder):
    # relative paths: the .blend and its frames move together
    here = folder / "one"
    here.mkdir()
    value = frames(here / "desire_path" / "Ground")
    obj = pixel_ground(height=lambda x, y: 0.2 * x)
    rest = compat.positions(obj.data)
    bpy.ops.wm.save_as_mainfile(filepath=str(here / "a.blend"))
    play(obj, "//desire_path/Ground", index())
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    here.rename(folder / "two")
    fresh(FRESH, folder / "two" / "a.blend", folder / "out.npz")
    with np.load(folder / "out.npz") as out:
        for i, frame in enumerate((14, 10, 3, 12, 99)):
            n = min(max(frame - 10 + 1, 0), 5)
            assert out[f"c{i}"].tobytes() == value[n].reshape(-1, 4).tobytes()
            wanted = rest.copy()
            wanted[:, 2] += value[n][..., 0].ravel()
            assert out[f"p{i}"].tobytes() == wanted.tobytes()
