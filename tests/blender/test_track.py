"""Tracks: a curve shows where its marks will lie, and the tracks of a ground are pressed into it at once."""

import bpy
import numpy as np
from scenes import meshes

from desire_path.bake.bake import read_index
from desire_path.blender import compat, op_crowd, playback, pressed, props_track
from desire_path.crowd.covers import COVERS
from desire_path.ground.sim import Ground
from desire_path.placement import stamps, tyre
from desire_path.placement.vehicle import VEHICLES


def curve(*places, name="Track"):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("POLY")
    spline.points.add(len(places) - 1)
    for point, place in zip(spline.points, places):
        point.co = (*place, 0.0, 1.0) if len(place) == 2 else (*place, 1.0)
    obj = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


def field(folder, cell=0.01):
    land = meshes.grid(2, 2, 4.0, -2.0, -2.0)
    land.name = "Ground"
    land.desire_path.is_ground = True
    land.desire_path.folder = str(folder / "bake")
    land.desire_path.cell_size = cell
    return land


def use(obj):
    for each in bpy.context.scene.objects:
        each.select_set(each == obj)
    bpy.context.view_layer.objects.active = obj


def add(obj, **more):
    use(obj)
    return bpy.ops.object.desire_path_track_add(**more)


def refused(words, obj, operator="track_add", **more):
    use(obj)
    try:
        getattr(bpy.ops.object, f"desire_path_{operator}")(**more)
    except RuntimeError as problem:
        assert words in str(problem), problem
        assert str(problem).count("\n") <= 1, problem
        return
    raise AssertionError(f"nobody said: {words}")


def box(side):
    corner = 0.5 * side * np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)])
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    mesh = bpy.data.meshes.new("Box")
    mesh.from_pydata(corner.tolist(), [], faces)
    obj = bpy.data.objects.new("Box", mesh)
    bpy.context.collection.objects.link(obj)
    return obj


def pressed_map(land):
    return Ground.read(f"{pressed.folder(land)}/maps_final.exr").trail


def depth_at(land, x, y):
    left = pressed_map(land)
    return float(left.compression[int((y - left.y0) / left.cell), int((x - left.x0) / left.cell)])


def test_marks_are_shown_where_they_will_lie_and_follow_the_settings(folder):
    land, line = field(folder), curve((-1.5, 0.0), (1.5, 0.0))
    assert add(line) == {"FINISHED"}
    settings = line.desire_path.track
    shown = settings.marks
    assert settings.is_track and line.desire_path.ground == land and shown.name == "Track Marks"
    assert shown.hide_render and shown.display_type == "WIRE"
    count = len(shown.data.vertices) // 5
    assert count == int(3.0 / 0.72) + 1, count
    at = compat.positions(shown.data).reshape(count, 5, 3)
    assert (np.ptp(at[..., 0], axis=1) > 0.29).all() and abs(at[0, :, 0].mean() + 1.5) < 0.05
    settings.spacing, settings.width = 0.5, 0.4
    at = compat.positions(settings.marks.data).reshape(-1, 5, 3)
    assert len(at) == 7 and np.allclose(np.sign(at[:, :, 1].mean(axis=1)), (-1.0) ** np.arange(7))
    settings.kind = "WHEEL"
    assert np.ptp(compat.positions(settings.marks.data)[:, 1]) < 0.21
    use(line)
    assert bpy.ops.object.desire_path_track_remove() == {"FINISHED"}
    assert not settings.is_track and "Track Marks" not in bpy.data.objects


def test_stamps_are_pressed_and_play_and_are_pressed_anew(folder):
    land, line = field(folder), curve((-1.5, 0.0), (1.5, 0.0))
    add(line, stamp="shoe")
    settings = line.desire_path.track
    settings.depth, settings.spacing, settings.width = 0.03, 0.75, 0.001
    assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
    assert playback.modifier(land) is not None and pressed.plays(land)
    index = read_index(pressed.folder(land))
    assert index.inputs[pressed.TRACKS] and index.inputs[pressed.HAND]
    for x in (-1.5, -0.75, 0.0, 0.75, 1.5):
        assert 0.02 < depth_at(land, x - 0.08, 0.0) < 0.031, (x, depth_at(land, x - 0.08, 0.0))
    assert depth_at(land, -0.35, 0.0) == 0.0
    first = pressed.folder(land)
    settings.depth = 0.01
    use(land)
    assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
    assert pressed.folder(land) != first and 0.005 < depth_at(land, -0.08, 0.0) < 0.0101, "pressed twice"


def test_crossing_tracks_wheels_images_and_soles_lie_on_one_ground(folder):
    land = field(folder)
    ends = ((-1.0, 0.6), (0.0, 1.5), (1.0, 1.5))
    lines = [curve((-x, y), (x, y), name=f"Track {n}") for n, (y, x) in enumerate(ends)]
    add(lines[0], kind="WHEEL")
    lines[0].desire_path.track.tread = "plain"
    image = bpy.data.images.new("Bar", 8, 16, float_buffer=True)
    image.pixels.foreach_set(np.ones(8 * 16 * 4, np.float32))
    lines[1].desire_path.track.image = image
    assert add(lines[1], stamp="image") == {"FINISHED"}
    sole = meshes.grid(2, 2, 0.2, -0.1, -0.1)
    sole.name = "Sole"
    lines[2].desire_path.track.sole = sole
    assert add(lines[2], kind="SOLE") == {"FINISHED"}
    for each in lines:
        each.desire_path.track.depth = 0.02
    lines[1].desire_path.track.width = lines[2].desire_path.track.width = 0.001
    assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
    assert all(depth_at(land, x, -1.0) > 0.0185 for x in (-0.45, -0.13, 0.0, 0.41)), "no rut"
    assert abs(depth_at(land, -1.5, 0.0) - 0.02) < 1e-3 and abs(depth_at(land, -1.5 + 0.72, 0.1)) < 0.0201
    assert abs(depth_at(land, -1.5, 1.0) - 0.02) < 1e-3 and depth_at(land, -1.14, 1.0) == 0.0


def test_all_wheels_of_a_vehicle_are_shown_and_pressed(folder):
    land, line = field(folder), curve((-0.5, 0.0), (1.5, 0.0))
    assert add(line, kind="WHEEL", vehicle="bicycle") == {"FINISHED"}
    settings = line.desire_path.track
    at = compat.positions(settings.marks.data)
    assert abs(at[:, 0].min() + 0.5 + 1.05) < 0.01 and np.ptp(at[:, 1]) < 0.051, "a front and a rear wheel"
    settings.vehicle = "motorcycle"
    at = compat.positions(settings.marks.data)
    assert abs(at[:, 0].min() + 0.5 + 1.45) < 0.01 and 0.16 < np.ptp(at[:, 1]) < 0.171
    settings.depth = 0.02
    assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
    beside = np.arange(-0.06, 0.06, 0.01)
    for x in (-1.5, -1.0, 0.0, 1.0):
        assert max(depth_at(land, x, y) for y in beside) > 0.0185, f"no rut at {x} m"
    kept = settings.vehicle, settings.kind
    refused("leaves the ground at", line, kind="WHEEL", vehicle="lorry")
    assert (settings.vehicle, settings.kind) == kept, "a refused vehicle is kept"


def test_what_may_be_chosen_is_what_there_is(folder):
    assert {each[0] for each in props_track.VEHICLES} == {"none", *VEHICLES}
    assert {each[0] for each in props_track.TREADS} == set(tyre.TYRES)
    assert {each[0] for each in props_track.STAMPS} == {"image", *stamps.STAMPS}
    assert {each[0] for each in op_crowd.COVERS} == set(COVERS)


def test_bad_tracks_are_refused_in_a_sentence(folder):
    lonely = curve((0.0, 0.0), (1.0, 0.0))
    refused("press Add Ground on a mesh first", lonely)
    land = field(folder)
    refused("No track lies on 'Ground'", land, "tracks_press")
    refused("has no length", curve((0.0, 0.0)))
    refused("stands upright", curve((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    refused("leaves the ground at", curve((0.0, 0.0), (9.0, 0.0)))
    assert add(lonely, stamp="image") == {"FINISHED"}
    refused("has no image", lonely, "tracks_press")
    black = bpy.data.images.new("Black", 4, 4)
    lonely.desire_path.track.image = black
    refused("black all over", lonely, "tracks_press")
    lonely.desire_path.track.kind = "WHEEL"
    lonely.desire_path.track.radius = 0.0
    refused("radius of 0 m cannot roll", lonely, "tracks_press")
    assert not land.desire_path.pressed and playback.modifier(land) is None


def test_what_is_chosen_later_is_shown_too(folder):
    lonely = curve((-1.5, 0.0), (1.5, 0.0))
    refused("press Add Ground on a mesh first", lonely, kind="SOLE")
    assert not lonely.desire_path.track.is_track
    field(folder)
    assert add(lonely, kind="SOLE") == {"FINISHED"} and lonely.desire_path.track.marks is None
    lonely.desire_path.track.sole = meshes.grid(2, 2, 0.2, -0.1, -0.1)
    assert len(lonely.desire_path.track.marks.data.vertices) == 5 * 5
    lonely.desire_path.track.end_speed = 0.35  # steps are half as long at the end
    slower = len(lonely.desire_path.track.marks.data.vertices)
    assert slower == 5 * 6
    lonely.desire_path.track.speed = 0.35
    assert len(lonely.desire_path.track.marks.data.vertices) == 5 * 5 < slower


def test_tracks_that_changed_are_outdated(folder):
    land, line = field(folder), curve((-1.0, 0.5), (1.0, 0.5))
    add(line)
    use(land)

    def state():
        bpy.context.view_layer.update()
        return land.desire_path.bake_state

    def press():
        assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
        assert state() == "FRESH", state()

    press()
    line.location.y = -0.3
    assert state() == "OUTDATED" and "The tracks have changed" in land.desire_path.missing, land.desire_path.missing
    press()
    for name, value in (("size", 1.2), ("first", "right"), ("stamp", "wolf"), ("kind", "WHEEL"), ("radius", 0.5)):
        setattr(line.desire_path.track, name, value)
        assert state() == "OUTDATED", name
        press()
    line.desire_path.track.is_track = False
    assert state() == "OUTDATED" and "free the ground" in land.desire_path.missing


def by_hand(land, x, y):
    block = box(0.1)
    block.location = (x, y, 0.03)
    bpy.context.view_layer.update()
    for each in bpy.context.scene.objects:
        each.select_set(each in (land, block))
    bpy.context.view_layer.objects.active = block
    assert bpy.ops.object.desire_path_press() == {"FINISHED"}
    return depth_at(land, x, y)


def test_tracks_go_on_from_what_a_hand_has_pressed(folder):
    land, line = field(folder), curve((-1.0, 0.5), (1.0, 0.5))
    deep = by_hand(land, 0.0, -0.5)
    assert deep > 0.01
    add(line)
    assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
    assert abs(depth_at(land, 0.0, -0.5) - deep) < 1e-4 and pressed_map(land).compression.max() > 0.005
    first = pressed.folder(land)
    refused("would be pressed twice", land, "tracks_press")
    assert pressed.folder(land) == first


def test_a_hand_goes_on_from_tracks_which_are_not_pressed_twice(folder):
    land, line = field(folder), curve((-1.0, 0.5), (1.0, 0.5))
    add(line)
    assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
    before = pressed_map(land).compression.max()
    assert by_hand(land, 0.0, -0.5) > 0.01 and pressed_map(land).compression[150:].max() == before
    assert land.desire_path.bake_state == "FRESH"
    refused("would be pressed twice", land, "tracks_press")
    line.location.y = -0.1
    bpy.context.view_layer.update()
    assert land.desire_path.bake_state == "OUTDATED"


def test_units_of_the_scene_do_not_change_a_track(folder):
    bpy.context.scene.unit_settings.scale_length = 0.5
    land = meshes.grid(2, 2, 8.0, -4.0, -4.0)
    land.desire_path.is_ground = True
    land.desire_path.folder = str(folder / "bake")
    line = curve((-2.0, 0.0), (2.0, 0.0))  # 2 m
    add(line, stamp="shoe")
    line.desire_path.track.spacing, line.desire_path.track.depth = 1.0, 0.03
    assert len(line.desire_path.track.marks.data.vertices) == 15
    assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
    assert abs(pressed_map(land).compression.max() - 0.03) < 2e-3
