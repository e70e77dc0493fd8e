"""A walk over several ground objects, as the tiles of a terrain: one bake presses them all, and leaves others alone."""

import json

import bpy
import numpy as np
from scenes import hands, meshes, people
from test_bake import refused
from test_playback import shown

from desire_path.bake import bake
from desire_path.blender import op_forces, op_place, playback

CELL = 0.02


def tile(folder, name, y0, y1, *, x0=-0.6, x1=0.6, cell=CELL, height=None, spacing=0.02):
    """A strip of ground across the walk, which leads from y = 0 to y = -3."""
    ground = meshes.grid(round((x1 - x0) / spacing) + 1, round((y1 - y0) / spacing) + 1, spacing, x0, y0, height, name)
    return settled(folder, ground, cell)


def settled(folder, ground, cell=CELL):
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    ground.desire_path.cell_size = cell
    ground.desire_path.folder = str(folder / ground.name)
    return ground


def walker(ground, frames=50, name="Walker"):
    obj = people.walk(people.biped(name), frames=frames)
    ground.select_set(True)
    bpy.context.view_layer.objects.active = obj
    for other in list(bpy.context.view_layer.objects):
        other.select_set(other in (ground, obj))
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    return obj


def bake_it(ground):
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    return json.loads(ground.desire_path.summary) if ground.desire_path.summary else None


def told(ground):
    return json.loads(ground.desire_path.summary)


def seen(obj, frame):
    """World points (n, 3) of a ground as it plays."""
    at, _ = shown(obj, frame)
    world = np.array(obj.matrix_world, float)
    return at.reshape(-1, 3).astype(float) @ world[:3, :3].T + world[:3, 3]


def seam(one, other, frame):
    """Heights of the points that two grounds have in common, from either, and how many there are."""
    a, b = seen(one, frame), seen(other, frame)
    places = {tuple(np.round(p[:2], 4)): p[2] for p in a}
    common = [(places[tuple(np.round(p[:2], 4))], p[2]) for p in b if tuple(np.round(p[:2], 4)) in places]
    return np.array(common).T


def hill(x, y):
    return 0.02 * np.sin(4.0 * x) + 0.03 * np.sin(2.0 * y)


def test_tiles_are_pressed_as_the_ground_they_were_cut_from(folder):
    for number, height in enumerate((None, hill)):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        place = folder / str(number)
        north, south = tile(place, "north", -1.2, 0.6, height=height), tile(place, "south", -3.2, -1.2, height=height)
        walker(north)
        both = bake_it(north)
        assert both["with"] == ["south"] and told(south)["with"] == ["north"]
        assert both["contacts"] >= 1 and told(south)["contacts"] >= 1
        last = both["frames"][1]
        pressed = 0.0
        for frame in range(1, last + 1, 7):
            upper, lower = seam(north, south, frame)
            assert len(upper) == 61 and np.abs(upper - lower).max() < 1e-6
        tiles = {tuple(np.round(p[:2], 4)): p[2] for ground in (north, south) for p in seen(ground, last)}

        whole = tile(place, "whole", -3.2, 0.6, height=height)
        for each in (north, south):
            each.hide_render = True
        bpy.data.objects["Walker"].desire_path.ground = whole
        alone = bake_it(whole)
        assert not alone["with"]
        off = [abs(p[2] - tiles[tuple(np.round(p[:2], 4))]) for p in seen(whole, last)]
        assert max(off) < 1e-6
        before = 0.0 if height is None else hill(*seen(whole, 0)[:, :2].T)
        pressed = float((before - seen(whole, last)[:, 2]).max())
        assert pressed > 0.005, pressed
        assert (
            abs(both["deepest_m"] - alone["deepest_m"]) < 1e-6
            or abs(told(south)["deepest_m"] - alone["deepest_m"]) < 1e-6
        )


def test_either_tile_bakes_both_alike(folder):
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    walker(north)
    files = []
    for each in (north, south):
        bake_it(each)
        files.append(
            {
                (name, path.name): path.read_bytes()
                for name in ("north", "south")
                for path in (folder / name / "frames").glob("*.exr")
            }
        )
    assert len(files[0]) > 90 and files[0] == files[1]


def test_turned_scaled_and_parented_tiles_close_at_their_edge(folder):
    """One edge at y = -1.2, shared by a tile as it is and one that is turned, scaled and hung on an empty."""
    north = tile(folder, "north", -1.2, 0.6)
    mesh = meshes.grid(61, 101, 0.1, -3.0, 0.0, name="south")
    empty = bpy.data.objects.new("empty", None)
    bpy.context.scene.collection.objects.link(empty)
    empty.location, empty.rotation_euler.z, empty.scale = (0.0, -1.2, 0.0), np.pi, (0.4, 0.4, 0.4)
    mesh.parent = empty
    mesh.scale = (0.5, 0.5, 0.5)
    bpy.context.view_layer.update()
    south = settled(folder, mesh)
    walker(north)
    summary = bake_it(south)
    assert summary["with"] == ["north"]
    for frame in (10, 25, 50):
        upper, lower = seam(north, south, frame)
        assert len(upper) == 61 and np.abs(upper - lower).max() < 1e-6
    assert seen(south, 50)[:, 2].min() < -0.005 and seen(north, 50)[:, 2].min() < -0.005


def test_the_finest_cells_count_and_it_is_told(folder):
    north, south = tile(folder, "north", -1.2, 0.6, cell=0.04), tile(folder, "south", -3.2, -1.2)
    walker(north)
    summary = bake_it(north)
    assert any("'south' with cells of 0.02 m" in each and "'north'" in each for each in summary["warnings"])
    assert {bake.read_index(str(folder / name)).cell for name in ("north", "south")} == {CELL}
    upper, lower = seam(north, south, 50)
    assert np.abs(upper - lower).max() < 1e-6


def test_each_tile_keeps_its_soil_and_its_plants(folder):
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    north.desire_path.soil, south.desire_path.soil = "snow", "mud"
    group = south.vertex_groups.new(name="snowy")
    group.add([v.index for v in south.data.vertices if v.co.x > 0], 1.0, "REPLACE")
    meshes.activate(south)
    assert bpy.ops.object.desire_path_paint_add() == {"FINISHED"}
    south.desire_path.painted[0].vertex_group, south.desire_path.painted[0].soil = "snowy", "snow"
    meshes.activate(north)
    assert bpy.ops.object.desire_path_plants_add(kind="carex") == {"FINISHED"}
    walker(north)
    bake_it(north)
    depth = -seen(south, 50)[:, 2]
    side = seen(south, 0)[:, 0] > 0.0
    assert depth[side].max() > 1.3 * depth[~side].max() > 0.0, (depth[side].max(), depth[~side].max())
    assert bake.read_index(str(folder / "north")).lean and not bake.read_index(str(folder / "south")).lean
    assert playback.images(playback.modifier(north).node_group).keys() == {"trail", "lean"}


def test_walkers_of_both_tiles_press_both(folder):
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    walker(north)
    bake_it(north)
    one = {each.name: told(each)["contacts"] for each in (north, south)}
    other = walker(south, name="Second")
    other.location.x = 0.3
    for each in (north, south):
        bake_it(each)
        assert {ground.name: told(ground)["contacts"] for ground in (north, south)} == {
            name: 2 * count for name, count in one.items()
        }


def test_grounds_that_nobody_links_are_left_alone(folder):
    ground = tile(folder, "ground", -3.2, 0.6)
    far = tile(folder, "far", -3.2, 0.6, x0=9.4, x1=10.6)
    above = tile(folder, "above", -3.2, 0.6)
    above.location.z = 2.5
    hidden = tile(folder, "hidden", -3.2, 0.6, x0=0.6, x1=1.8)
    hidden.hide_render = True
    walker(ground)
    alone = walker(far, name="Second")
    alone.location.x = 10.0
    summary = bake_it(ground)
    assert not summary["with"]
    assert not any(name in each for each in summary["warnings"] for name in ("far", "above", "hidden")), summary
    assert playback.modifier(ground) is not None
    assert all(playback.modifier(each) is None for each in (far, above, hidden))
    assert {each.name for each in folder.iterdir()} == {"ground"}
    assert not bake_it(far)["with"]
    for each in (above, hidden):
        meshes.activate(each)
    meshes.activate(above)
    refused(bpy.ops.object.desire_path_bake, "Nobody walks on 'above'")


def test_on_a_bridge_the_bridge_is_pressed(folder):
    """Banks at both ends of a bridge; the bed of the river 0.8 m below."""
    bank, bridge, other = (
        tile(folder, *each) for each in (("bank", -0.7, 0.6), ("bridge", -1.9, -0.7), ("other bank", -3.2, -1.9))
    )
    bed = tile(folder, "bed", -2.0, -0.6)
    bed.location.z = -0.8
    walker(bank)
    summary = bake_it(bank)
    assert summary["with"] == ["bridge", "other bank"]
    assert playback.modifier(bed) is None and not (folder / "bed").exists()
    assert seen(bridge, 50)[:, 2].min() < -0.005
    upper, lower = seam(bank, bridge, 50)
    assert np.abs(upper - lower).max() < 1e-6


def test_what_differs_is_refused_by_name(folder):
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    walker(north)
    south.desire_path.law = "uniform"
    meshes.activate(north)
    refused(bpy.ops.object.desire_path_bake, "'north'", "'south'", "contact law")
    south.desire_path.law = north.desire_path.law
    south.desire_path.folder = north.desire_path.folder
    refused(bpy.ops.object.desire_path_bake, "same folder")
    assert playback.modifier(north) is None


def test_a_path_over_tiles(folder):
    """Passes along a path press every tile the path leads over."""
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    obj = walker(north)
    line = bpy.data.curves.new("line", "CURVE")
    line.dimensions = "3D"
    spline = line.splines.new("POLY")
    spline.points.add(1)
    spline.points[0].co, spline.points[1].co = (0.0, 0.3, 0.0, 1.0), (0.0, -3.0, 0.0, 1.0)
    path = bpy.data.objects.new("path", line)
    bpy.context.scene.collection.objects.link(path)
    obj.desire_path.path, obj.desire_path.passes = path, 3
    summary = bake_it(south)
    assert summary["with"] == ["north"]
    last = bake.read_index(str(folder / "north")).frame_end
    assert min(seen(each, last)[:, 2].min() for each in (north, south)) < -0.005
    upper, lower = seam(north, south, last)
    assert np.abs(upper - lower).max() < 1e-6


def test_forces_and_places_are_those_of_the_whole_ground(folder):
    def look(ground):
        obj = walker(ground)
        read = op_forces.read(bpy.context.scene, obj)
        gait, placed, _ = op_place.read(bpy.context.scene, obj, ground, list(range(1, 51)), False)
        return read.loads.force, placed.pose

    force, pose = look(tile(folder, "whole", -3.2, 0.6, height=hill))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    north = tile(folder, "north", -1.2, 0.6, height=hill)
    tile(folder, "south", -3.2, -1.2, height=hill)
    both = look(north)
    assert force.any() and np.abs(both[0] - force).max() < 1e-3 * np.abs(force).max()
    assert np.abs(both[1] - pose).max() < 1e-5


def test_feet_go_down_into_the_prints_of_both(folder):
    north = tile(folder, "north", -1.2, 0.6)
    tile(folder, "south", -3.2, -1.2)
    obj = walker(north)
    bake_it(north)
    _, placed, _ = op_place.read(bpy.context.scene, obj, north, list(range(1, 51)), True)
    _, level, _ = op_place.read(bpy.context.scene, obj, north, list(range(1, 51)), False)
    down = level.pose[..., 2] - placed.pose[..., 2]
    for side in (placed.pose[..., 1] > -1.0, placed.pose[..., 1] < -1.4):
        assert down[side].max() > 0.004, down[side].max()


def test_state_of_all_tiles(folder):
    north, south, beside = (
        tile(folder, *each) for each in (("north", -1.2, 0.6), ("south", -3.2, -1.2), ("beside", -6.0, -3.2))
    )
    obj = walker(north)
    bake_it(north)
    assert [each.desire_path.bake_state for each in (north, south, beside)] == ["FRESH", "FRESH", "NONE"], [
        each.desire_path.missing for each in (north, south, beside)
    ]
    bake_it(south)
    assert [each.desire_path.bake_state for each in (north, south, beside)] == ["FRESH", "FRESH", "NONE"], [
        each.desire_path.missing for each in (north, south, beside)
    ]
    south.desire_path.soil = "mud"
    assert [each.desire_path.bake_state for each in (north, south)] == ["OUTDATED", "OUTDATED"]
    south.desire_path.soil = north.desire_path.soil
    obj.desire_path.mass = 60.0
    assert north.desire_path.bake_state == south.desire_path.bake_state == "OUTDATED"


def test_a_copy_in_the_same_place_is_left_alone(folder):
    ground = tile(folder, "ground", -3.2, 0.6)
    copy = tile(folder, "copy", -3.2, 0.6)
    walker(ground)
    assert not bake_it(ground)["with"]
    assert playback.modifier(copy) is None
    meshes.activate(copy)
    refused(bpy.ops.object.desire_path_bake, "Nobody walks on 'copy'")


def test_what_fails_in_the_middle_plays_on_all_tiles(folder):
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    walker(north)
    meshes.activate(north)
    with hands.full_disk("trail_0045.exr"):
        refused(bpy.ops.object.desire_path_bake, "No space left")
    for each in (north, south):
        assert playback.modifier(each) is not None and each.desire_path.bake_state == "PARTIAL"
        index = bake.read_index(str(folder / each.name))
        assert 40 < index.frames < 50 and not index.complete
    assert bake_it(south)["with"] == ["north"]
    assert all(bake.read_index(str(folder / each.name)).complete for each in (north, south))


def test_a_linked_tile_is_told(folder):
    tile(folder, "south", -3.2, -1.2)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "tiles.blend"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(str(folder / "tiles.blend"), link=True) as (_, wants):
        wants.objects = ["south"]
    meshes.link(wants.objects[0])
    north = tile(folder, "north", -1.2, 0.6)
    walker(north)
    summary = bake_it(north)
    assert not summary["with"] and any("'south' is linked" in each for each in summary["warnings"]), summary


def test_keys_that_move_no_tile_do_not_part_it(folder):
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    for frame, z in ((1, 0.0), (50, 0.0)):
        south.location.z = z
        south.keyframe_insert("location", frame=frame)
    walker(north)
    assert bake_it(north)["with"] == ["south"]


def test_tiles_that_ride_together_are_one_deck(folder):
    """A deck of two on a ship, and a quay that stays where it is."""
    north, south = tile(folder, "north", -1.2, 0.6), tile(folder, "south", -3.2, -1.2)
    quay = tile(folder, "quay", -3.2, 0.6, x0=0.6, x1=3.0)
    ship = bpy.data.objects.new("ship", None)
    bpy.context.scene.collection.objects.link(ship)
    for frame, x in ((1, 0.0), (50, 1.5)):
        ship.location.x = x
        ship.keyframe_insert("location", frame=frame)
    obj = walker(north)
    for each in (north, south, obj):
        each.parent = ship
    bpy.context.scene.frame_set(1)
    assert bake_it(south)["with"] == ["north"]
    assert playback.modifier(quay) is None
    for frame in (25, 50):
        upper, lower = seam(north, south, frame)
        assert len(upper) == 61 and np.abs(upper - lower).max() < 1e-6
    assert seen(north, 50)[:, 2].min() < -0.005 and seen(south, 50)[:, 2].min() < -0.005
