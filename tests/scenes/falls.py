"""falls.py - a bicycle whose rider falls, and the whole pattern that both leave, under a low sun.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/falls.py -- FOLDER
        [--width 640 --height 360 --samples 48 --scenes lying,left]

Writes FOLDER/lying.png, with both where they came to lie, and FOLDER/left.png, when they are gone. After Sumner,
O'Brien and Hodgins 1999. Two wheels, a frame and a rider all of whose limbs press.
"""

import math
import pathlib
import sys

import bpy
from mathutils import Matrix, Vector

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "addon"), str(HERE.parent)]

from scenes import demo, materials, meshes, noise, people, shots  # noqa: E402

RATE = 24
SPEED = 2.6  # of the ride [m/s]
TILTS, LIES, END = 30, 46, 60  # frames: the bicycle begins to fall, lies, all is still
RADIUS, TYRE = 0.34, 0.022  # of a wheel, of its tyre [m]
HUBS = (-0.52, 0.52)  # along the bicycle [m]
LEAN = math.radians(62.0)  # of the bicycle that lies on pedal and handle
SINKS = 0.012  # tyres into the ground [m]
TUBES = (
    ((-0.52, 0, 0.34), (-0.1, 0, 0.29)),
    ((-0.52, 0, 0.34), (-0.2, 0, 0.72)),
    ((-0.1, 0, 0.29), (-0.23, 0, 0.9)),
    ((-0.19, 0, 0.7), (0.34, 0, 0.74)),
    ((-0.1, 0, 0.29), (0.36, 0, 0.64)),
    ((0.52, 0, 0.34), (0.33, 0, 0.86)),
    ((0.33, 0, 0.86), (0.42, 0.29, 0.8)),
    ((0.33, 0, 0.86), (0.42, -0.29, 0.8)),
    ((-0.25, 0.1, 0.29), (-0.1, 0.1, 0.29)),
    ((0.05, -0.1, 0.29), (-0.1, -0.1, 0.29)),
    ((-0.25, 0.08, 0.29), (-0.25, 0.2, 0.29)),
    ((0.05, -0.08, 0.29), (0.05, -0.2, 0.29)),
    ((-0.1, -0.1, 0.29), (-0.1, 0.1, 0.29)),
    ((-0.36, 0, 0.92), (-0.12, 0, 0.92)),
)
THICK = 0.016  # of a tube [m]


def tube(start, end, radius=THICK, sides=10):
    """(corners, faces) of a cylinder from one place to another."""
    along = Vector(end) - Vector(start)
    across = along.orthogonal().normalized()
    other = along.cross(across).normalized()
    corners, faces = [], []
    for at in (Vector(start), Vector(end)):
        for k in range(sides):
            turn = 2.0 * math.pi * k / sides
            corners.append(at + radius * (math.cos(turn) * across + math.sin(turn) * other))
    for k in range(sides):
        after = (k + 1) % sides
        faces.append((k, after, after + sides, k + sides))
    return corners, [*faces, tuple(reversed(range(sides))), tuple(range(sides, 2 * sides))]


def solid(name, parts):
    """A mesh object of several closed parts."""
    corners, faces = [], []
    for places, sides in parts:
        faces += [tuple(len(corners) + k for k in side) for side in sides]
        corners += [tuple(place) for place in places]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    return meshes.link(bpy.data.objects.new(name, mesh))


def key(obj, frame, **values):
    for name, value in values.items():
        setattr(obj, name, value)
        obj.keyframe_insert(name, frame=frame)


def ease(share):
    share = min(max(share, 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


def ride(frame):
    """Where the bicycle's middle is on the ground, how it is turned and leans, how far it has rolled."""
    t = (frame - 1) / RATE
    fall = (TILTS - 1) / RATE
    slide = (LIES - 1) / RATE - fall
    rolled = SPEED * min(t, fall)
    if t > fall:
        gone = min(t - fall, slide)
        rolled += SPEED * (gone - 0.5 * gone * gone / slide)  # brakes until it lies
    turn = 0.5 * ease((t - 0.5 * fall) / (fall + slide - 0.5 * fall))
    lean = -0.1 * ease(t / fall) + (LEAN + 0.1) * max(0.0, min(1.0, (t - fall) / slide)) ** 2
    return (rolled - 2.6, 0.25 * turn * rolled - 0.3, turn, lean, rolled)


def bicycle():
    """(carrier, wheels, frame), keyed."""
    carrier = meshes.link(bpy.data.objects.new("Bicycle", None))
    wheels = []
    for name, at in zip(("Rear wheel", "Front wheel"), HUBS):
        bpy.ops.mesh.primitive_torus_add(
            major_radius=RADIUS - TYRE, minor_radius=TYRE, major_segments=120, minor_segments=12
        )
        wheel = bpy.context.object
        wheel.name = name
        wheel.data.transform(Matrix.Rotation(0.5 * math.pi, 4, "X"))
        wheel.parent, wheel.location = carrier, (at, 0.0, RADIUS)
        wheels.append(wheel)
    frame = solid("Frame", [tube(*each) for each in TUBES])
    frame.parent = carrier
    for each in range(1, END + 1):
        x, y, turn, lean, rolled = ride(each)
        key(carrier, each, location=(x, y, -SINKS), rotation_euler=(lean, 0.0, turn))
        for wheel in wheels:
            key(wheel, each, rotation_euler=(0.0, rolled / RADIUS, 0.0))
    return carrier, wheels, frame


# ---- who rides ----------------------------------------------------------------------------------------------

HIPS = 0.93  # over the feet of the character [m]
SADDLE = (-0.24, 1.0)  # of the hips, behind the bicycle's middle and over the ground [m]
FLIES = TILTS + 5  # frame in which the rider leaves it
CHEST = 0.075  # of the hips that lie, over the ground [m]
# how bones are turned [degrees]: about which axis of the body, the left one, the right one
SITS = (("UpLeg", "X", -62.0, -78.0), ("Leg", "X", 70.0, 85.0), ("Arm", "Y", 50.0, -50.0), ("Arm", "X", -48.0, -48.0))
SPRAWLS = (
    ("UpLeg", "Y", -9.0, 12.0),
    ("UpLeg", "X", -5.0, -6.0),
    ("Leg", "X", 8.0, 5.0),
    ("Foot", "X", 66.0, 60.0),
    ("Arm", "Y", -28.0, 40.0),
    ("Arm", "Z", -15.0, 17.0),
    ("ForeArm", "X", -6.0, -8.0),
)


def pose(rider, turns, frame):
    """Turn bones of both sides from the rest pose, and key all of them."""
    for bone in rider.pose.bones:
        bone.matrix_basis.identity()
    for name, axis, *angles in turns:
        for side, angle in zip(("Left", "Right"), angles):
            bone = rider.pose.bones[f"mixamorig:{side}{name}"]
            bpy.context.view_layer.update()
            at = Matrix.Translation(bone.matrix.translation)
            bone.matrix = at @ Matrix.Rotation(math.radians(angle), 4, axis) @ at.inverted() @ bone.matrix
    bpy.context.view_layer.update()
    for bone in rider.pose.bones:
        bone.rotation_mode = "QUATERNION"
        bone.keyframe_insert("rotation_quaternion", frame=frame)


def falls(rider):
    """The rider sits, flies over the handlebar, lands on chest and hands, and slides."""
    rider.animation_data_clear()
    pose(rider, SITS, 1)
    pose(rider, SITS, FLIES)
    pose(rider, SPRAWLS, LIES - 2)
    x, y, turn, _, _ = ride(FLIES)
    for frame in range(1, END + 1):
        share = (frame - FLIES) / (LIES - FLIES)
        here = ride(min(frame, FLIES))
        gone = 2.1 * min(max(share, 0.0), 1.0) + 0.3 * (1.0 - (1.0 - min(max(share - 1.0, 0.0), 1.0)) ** 2)
        ahead = SADDLE[0] + gone
        drop = min(max(share, 0.0), 1.0) ** 3
        lean = here[3] * (1.0 - min(max(share, 0.0), 1.0))
        hips = Vector((here[0] + ahead * math.cos(here[2]), here[1] + ahead * math.sin(here[2]), 0.0))
        hips.z = SADDLE[1] + (CHEST - SADDLE[1]) * drop
        pitch = math.radians(88.0) * ease(1.25 * share)
        turned = Matrix.Rotation(here[2] + 0.5 * math.pi, 4, "Z") @ Matrix.Rotation(lean, 4, "Y")
        turned = turned @ Matrix.Rotation(pitch, 4, "X")
        rider.rotation_mode = "QUATERNION"
        key(rider, frame, location=hips - turned @ Vector((0.0, 0.0, HIPS)), rotation_quaternion=turned.to_quaternion())


# ---- the scene ----------------------------------------------------------------------------------------------


def waves(x, y):
    return 0.006 * (noise.rough(x, y, 1.3, 5) + 0.4 * noise.rough(x, y, 0.3, 7, octaves=2))


def walks(obj, **settings):
    meshes.activate(obj)
    bpy.ops.object.desire_path_walker_add()
    for name, value in settings.items():
        setattr(obj.desire_path, name, value)


def make(name):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps, scene.frame_start, scene.frame_end = RATE, 1, END
    ground = demo.add_mesh(demo.lines(-3.2, 4.4, 0.04, 25.0, 1.15), demo.lines(-1.6, 2.2, 0.04, 25.0, 1.15), waves)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.soil, ground.desire_path.cell_size = "dry-sand", 0.008
    _, wheels, frame = bicycle()
    rider = people.glb(HERE / "characters" / "human_mixamo_names_inplace.glb")
    falls(rider)
    for each in (*wheels, frame):
        walks(each, contact_law="CARVE")
    walks(rider, limbs="ALL", contact_law="CARVE")
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    bpy.ops.object.desire_path_material_add()
    scene.frame_set(END)
    black = bpy.data.materials.new("Rubber")
    black.diffuse_color = (0.02, 0.02, 0.02, 1.0)
    black.use_nodes = True
    black.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.02, 0.02, 0.02, 1.0)
    for each in (*wheels, frame):
        each.data.materials.append(black)
        each.hide_render = name == "left"
    for each in rider.children:
        each.hide_render = name == "left"
    sun = demo.add_sun()
    turn, up = math.radians(190.0), math.radians(24.0)
    sun.location = 9.0 * Vector((math.cos(turn) * math.cos(up), math.sin(turn) * math.cos(up), math.sin(up)))
    demo.aim(sun, (0.0, 0.0, 0.0))
    materials.sky(scene)
    scene.camera = demo.add_camera("View", (1.6, -2.3, 2.1), (1.85, 0.2, 0.0), 24.0)
    demo.cycles(scene)
    scene.cycles.max_bounces, scene.cycles.diffuse_bounces = 4, 3
    scene.view_settings.exposure = 0.3


if __name__ == "__main__":
    shots.take(__doc__, "--scenes", ("lying", "left"), make, (640, 360, 48))
