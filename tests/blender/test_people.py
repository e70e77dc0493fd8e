"""Recorded people and skinned characters bake with default settings: armature, ground and mass."""

import hashlib
import json
import os
import pathlib

import bpy
import numpy as np
from scenes import meshes, people
from test_playback import shown

from desire_path.bake import bake
from desire_path.bake.options import BakeOptions
from desire_path.blender import clock, moves, sample
from desire_path.ground import maps, sim
from desire_path.loads import walker
from desire_path.motion.gait import Gait

CMU = 2.54 / 0.45 / 100.0  # metres in a unit of the mocap clips


def ground_under(walker, height, margin=0.6, spacing=0.05, name="Ground"):
    """A grid under all the feet do, at a height."""
    first, last = moves.frame_range(bpy.context.scene, walker)
    gait = sample.record(bpy.context.scene, walker, first, last)
    low = gait.pose[..., :2].min(axis=(0, 1)) - margin
    high = gait.pose[..., :2].max(axis=(0, 1)) + margin
    nx, ny = (np.ceil((high - low) / spacing)).astype(int) + 1
    return meshes.grid(nx, ny, spacing, *low, height=lambda x, y: height + 0 * x, name=name), gait


def walk_over(walker, ground, folder, mass=75.0):
    """The three presses a user makes; returns the report."""
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    ground.desire_path.folder = str(folder / "bake")
    meshes.activate(walker)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    walker.desire_path.mass = mass
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    return json.loads((folder / "bake" / "report.json").read_text())


def check(report, ground, folder, contacts, deepest=(0.004, 0.12)):
    print(
        f"        {report['contacts']} contacts, deepest {1000 * report['deepest_m']:.0f} mm, "
        f"{1000 * report['pressed_m3']:.2f} l pressed, {1000 * report['heaped_m3']:.2f} l in rims, "
        f"{report['seconds']:.1f} s; {report['warnings']}"
    )
    assert contacts[0] <= report["contacts"] <= contacts[1], report["contacts"]
    assert deepest[0] < report["deepest_m"] < deepest[1], report["deepest_m"]
    index = bake.read_index(str(folder / "bake"))
    assert index.complete
    final = maps.read(str(folder / "bake" / "maps_final.exr")).planes
    there = np.isfinite(final["rest"])
    assert all(np.isfinite(plane[there]).all() for plane in final.values())
    assert final["heap"].max() > 0.001
    position, _ = shown(ground, index.frame_end)
    rest, _ = shown(ground, index.frame_start - 1)
    assert (position[:, 2] - rest[:, 2]).min() < -0.002


def clip(name, folder, contacts, lift=0.0, **more):
    person = people.bvh(people.SCENES.joinpath("walks", name + ".bvh"), global_scale=CMU)
    ground, gait = ground_under(person, lift)
    first, last = moves.frame_range(bpy.context.scene, person)
    assert gait.frame_start == first and len(gait.time) == last - first + 1
    report = walk_over(person, ground, folder)
    settings = ground.desire_path
    assert (settings.frame_start, settings.frame_end) == (first, last)
    check(report, ground, folder, contacts, **more)


def test_cmu_walk(folder):
    clip("cmu_12_01_walk", folder, (6, 9))


def test_cmu_run(folder):
    clip("cmu_02_03_run", folder, (3, 6))


def test_cmu_jump(folder):
    clip("cmu_02_04_jump", folder, (2, 12))


def test_cmu_uneven(folder):
    clip("cmu_03_02_uneven", folder, (2, 9))  # over blocks that no ground has: what stands on them leaves no print


def character(name, action, folder, speed):
    walker = people.glb(people.SCENES.joinpath("characters", name + ".glb"))
    walker.animation_data_create()
    for track in walker.animation_data.nla_tracks:
        track.mute = True
    found = next(a for a in bpy.data.actions if a.name.startswith(action))
    walker.animation_data.action = found
    if hasattr(walker.animation_data, "action_slot") and walker.animation_data.action_slot is None:
        walker.animation_data.action_slot = found.slots[0]
    # the clips walk on the spot: carry the character along
    carrier = meshes.link(bpy.data.objects.new("Carrier", None))
    first, last = moves.frame_range(bpy.context.scene, walker)
    for frame in (first, last):
        carrier.location.y = -speed * (frame - first) / clock.frame_rate(bpy.context.scene)
        carrier.keyframe_insert("location", index=1, frame=frame)
    for curve in carrier_curves(carrier):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    walker.parent = carrier
    ground, gait = ground_under(walker, 0.0)
    assert sum(len(sole.triangles) for sole in gait.soles) > 100  # its own shoes, not built-in soles
    report = walk_over(walker, ground, folder)
    check(report, ground, folder, (2, 6))


def carrier_curves(obj):
    action = obj.animation_data.action
    if hasattr(action, "fcurves"):
        return action.fcurves
    return action.layers[0].strips[0].channelbag(action.slots[0]).fcurves


def test_character_with_mixamo_names(folder):
    character("human_mixamo_names_inplace", "Walk_Loop", folder, 1.1)


def test_character_with_rigify_names(folder):
    character("human_defrig_inplace", "Walk_Loop", folder, 1.1)


def test_character_in_place(folder):
    # as imported: it walks on the spot, and into the ground
    walker = people.glb(people.SCENES.joinpath("characters", "human_mixamo_names_inplace.glb"))
    ground = meshes.grid(41, 41, 0.05, -1.0, -1.0)
    report = walk_over(walker, ground, folder)
    assert report["contacts"] >= 2 and 0.002 < report["deepest_m"] < 0.1, report


PLATES = (("gait_bmc_walk1", 77.3, (0.31, 2.42)), ("gait_opensim_walk", 72.6, (0.05, 2.45)))


def test_measured_walks_agree_with_force_plates(folder):
    for name, mass, window in PLATES:
        place = people.SCENES / "measured" / name
        walker_object = people.bvh(place / "armature.bvh")
        walker_object.desire_path.mass = mass
        path = str(folder / f"{name}.npz")
        assert bpy.ops.object.desire_path_record(filepath=path) == {"FINISHED"}
        gait = Gait.load(path)
        first, last = moves.frame_range(bpy.context.scene, walker_object)
        assert len(gait.time) == last - first + 1 and gait.time[0] == 0.0
        table = np.genfromtxt(place / "grf.csv", delimiter=",", names=True)
        for model in ("inertia", "impulse"):
            loads = walker.loads(gait, model)
            inside = (loads.time >= window[0]) & (loads.time <= window[1])
            total, edges = 0.0, []
            for limb, bone in enumerate(gait.limb_name):
                parts = gait.part_limb == limb
                force = -loads.force[parts, :, 2].sum(axis=0) / (mass * 9.81)
                there = table[f"{bone[0]}_fz"]
                true = np.interp(loads.time, table["time"], there) / (mass * 9.81)
                rmse = np.sqrt(np.mean((force - true)[inside] ** 2))
                r = np.corrcoef(force[inside], true[inside])[0, 1]
                total += force[inside].mean()
                on = loads.touching[parts].any(axis=0)
                down = np.interp(loads.time, table["time"], (there > 20) * 1.0) > 0.5
                edges += late(on, down, loads.time, inside)
                print(f"        {name} {bone} {model}: RMSE {rmse:.3f} body weights, r {r:.3f}")
                if model == "inertia":
                    assert rmse <= 0.10 and r >= 0.97
            print(
                f"        {name} {model}: mean total {total:.3f} body weights, {len(edges)} contact "
                f"times within {1000 * max(edges):.0f} ms"
            )
            if model == "inertia":
                assert 0.97 <= total <= 1.05 and len(edges) >= 5 and max(edges) <= 0.060
        bpy.data.objects.remove(walker_object)


def late(on, down, time, inside):
    """Seconds between each touch-down or lift-off of the plates and the nearest of ours."""
    out = []
    for way in (1, -1):
        ours, plates = (np.flatnonzero(np.diff(each.astype(int)) == way) + 1 for each in (on, down))
        out += [np.abs(time[ours] - time[edge]).min() for edge in plates if inside[edge] and 2 < edge < len(time) - 2]
    return out


def test_recordings_agree_in_every_blender(folder):
    # the Blenders of one run meet in the folder DESIRE_PATH_COMPARE
    walker = people.bvh(people.SCENES.joinpath("walks", "cmu_12_01_walk.bvh"), global_scale=CMU)
    first, last = moves.frame_range(bpy.context.scene, walker)
    gait = sample.record(bpy.context.scene, walker, first, last)
    path = os.path.join(os.environ.get("DESIRE_PATH_COMPARE") or folder, "recording.npz")
    if not os.path.exists(path):
        gait.save(path)
    other = Gait.load(path)
    apart = max(np.abs(other.pose[..., :3] - gait.pose[..., :3]).max(), np.abs(other.com - gait.com).max())
    print(f"        differs from the first Blender by {apart:.1e} m")
    assert apart < 1e-5


def test_one_recording_gives_the_same_bits(folder):
    # for any number of threads, and in every Blender that meets in DESIRE_PATH_COMPARE
    place = os.environ.get("DESIRE_PATH_COMPARE")
    path = os.path.join(place, "recording.npz") if place else str(folder / "walk.npz")
    if not os.path.exists(path):
        walker = people.bvh(people.SCENES.joinpath("walks", "cmu_12_01_walk.bvh"), global_scale=CMU)
        first, last = moves.frame_range(bpy.context.scene, walker)
        sample.record(bpy.context.scene, walker, first, last).save(path)
    gait = Gait.load(path)
    found = set()
    for threads in (1, 2, 4):
        job = bake.Bake(
            gait, sim.Ground.flat(), "dry-sand", str(folder / f"t{threads}"), options=BakeOptions(threads=threads)
        )
        for _ in job.run():
            pass
        planes = maps.read(str(folder / f"t{threads}" / "maps_final.exr")).planes
        digest = hashlib.sha256()
        for name in sorted(planes):
            digest.update(planes[name].tobytes())
        last = bake.read_index(str(folder / f"t{threads}"))
        digest.update(pathlib.Path(last.path(last.frames)).read_bytes())
        found.add(digest.hexdigest())
    assert len(found) == 1
    if place:
        note = pathlib.Path(place, "bits.txt")
        if note.exists():
            assert note.read_text() == found.pop()
        else:
            note.write_text(found.pop())
