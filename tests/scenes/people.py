"""people.py - walkers for Blender tests: a small biped built here, and the recordings in the data."""

import builtins
import math
import pathlib

import bpy
import numpy as np
from mathutils import Matrix

from . import meshes

SCENES = pathlib.Path(__file__).resolve().parent  # walks/, measured/ and characters/, each with its README


# name, parent, head, tail [m]; the biped faces -Y as Blender's do
BONES = (
    ("hips", None, (0, 0, 0.95), (0, 0, 1.10)),
    ("neck", "hips", (0, 0, 1.50), (0, 0, 1.60)),
    ("thigh.L", "hips", (0.10, 0, 0.92), (0.10, -0.01, 0.50)),
    ("shin.L", "thigh.L", (0.10, -0.01, 0.50), (0.10, 0.02, 0.08)),
    ("foot.L", "shin.L", (0.10, 0.02, 0.08), (0.10, -0.11, 0.02)),
    ("toe.L", "foot.L", (0.10, -0.11, 0.02), (0.10, -0.17, 0.02)),
)


def biped(name="Walker", size=1.0):
    """An armature at rest with two legs; `size` units to a metre."""
    armature = bpy.data.armatures.new(name)
    obj = meshes.link(bpy.data.objects.new(name, armature))
    bpy.ops.object.mode_set(mode="EDIT")
    for bone, parent, head, tail in BONES:
        for side in ((1.0, ".L"), (-1.0, ".R")) if bone.endswith(".L") else ((1.0, ""),):

            def swap(text):
                return text[:-2] + side[1] if text and text.endswith(".L") else text

            made = armature.edit_bones.new(swap(bone))
            made.head = (side[0] * head[0] * size, head[1] * size, head[2] * size)
            made.tail = (side[0] * tail[0] * size, tail[1] * size, tail[2] * size)
            if parent:
                made.parent = armature.edit_bones[swap(parent)]
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


def walk(obj, frames=48, period=24, speed=1.3, rate=24, size=1.0):
    """Key a simple walk along -Y from frame 1 on: legs swing in turn, the stance foot stays low."""
    obj.rotation_mode = "XYZ"
    for bone in obj.pose.bones:
        bone.rotation_mode = "XYZ"
    for frame in range(1, frames + 1):
        t = (frame - 1) / period
        hips = obj.pose.bones["hips"]
        hips.location = (0, 0.015 * size * math.cos(4 * math.pi * t), 0)
        hips.keyframe_insert("location", frame=frame)
        obj.location[1] = -speed * size * (frame - 1) / rate
        obj.keyframe_insert("location", index=1, frame=frame)
        for side, shift in ((".L", 0.0), (".R", 0.5)):
            swing = math.sin(2 * math.pi * (t + shift))
            lift = max(0.0, math.cos(2 * math.pi * (t + shift)))
            for bone, angle in (
                ("thigh", 0.45 * swing + 0.35 * lift),
                ("shin", -0.8 * lift),
                ("foot", -0.45 * swing + 0.3 * lift),
            ):
                pose = obj.pose.bones[bone + side]
                pose.rotation_euler = (angle, 0, 0)
                pose.keyframe_insert("rotation_euler", index=0, frame=frame)
    return obj


def bvh(path, **options):
    """Import a BVH as an armature that stands upright in metres, with options of the importer; returns the object."""
    import importlib

    for place in ("io_anim_bvh.import_bvh", "bl_ext.core.io_anim_bvh.import_bvh"):
        try:
            module = importlib.import_module(place)
        except ImportError:
            continue
        # Debian's 3.4 opens files with a mode its Python no longer knows
        module.open = lambda f, mode="r", *a, **k: builtins.open(f, mode.replace("U", "") or "r", *a, **k)  # noqa: SIM115
    addon("io_anim_bvh", "import_anim", "bvh")
    before = set(bpy.data.objects)
    usual = {"use_fps_scale": False, "update_scene_fps": True, "update_scene_duration": True}
    bpy.ops.import_anim.bvh(filepath=str(path), **{**usual, **options})
    obj = next(iter(set(bpy.data.objects) - before))
    meshes.activate(obj)
    return obj


def glb(path):
    """Import a glTF character; returns its armature."""
    np.__dict__.setdefault("bool", bool)  # Debian's 3.4 uses an alias its NumPy no longer has
    addon("io_scene_gltf2", "import_scene", "gltf")
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=str(path))
    new = set(bpy.data.objects) - before
    obj = next(each for each in new if each.type == "ARMATURE")
    meshes.activate(obj)
    return obj


def addon(name, group, operator):
    """Switch a bundled importer on if its operator is not there."""
    if not hasattr(getattr(bpy.ops, group), operator) or not _known(group, operator):
        import addon_utils

        addon_utils.enable(name, default_set=False)


def _known(group, operator):
    try:
        getattr(getattr(bpy.ops, group), operator).get_rna_type()
    except KeyError:
        return False
    return True


def lead(obj, body, foot, frames=48, period=24, stride=1.0, roll=None, pitch=0.5):
    """Key a body bone and two foot bones to a walk along -Y: a foot stands, then swings ahead, lifted and rolled."""
    for name in (body, foot.format("L"), foot.format("R")):
        obj.pose.bones[name].rotation_mode = "QUATERNION"
    rest = {name: obj.data.bones[name].matrix_local.copy() for name in (body, foot.format("L"), foot.format("R"))}

    def put(name, frame, way, up, pitch):
        bone, scene = obj.pose.bones[name], bpy.context.scene
        at = rest[name].translation
        turn = Matrix.Translation(at) @ Matrix.Rotation(pitch, 4, "X") @ Matrix.Translation(-at)
        scene.frame_set(frame)
        bone.matrix = Matrix.Translation((0, -way, up)) @ turn @ rest[name]
        bpy.context.view_layer.update()
        bone.keyframe_insert("location", frame=frame)
        bone.keyframe_insert("rotation_quaternion", frame=frame)

    for frame in range(1, frames + 1):
        t = (frame - 1) / period
        put(body, frame, stride * t, -0.06 + 0.015 * math.cos(4 * math.pi * t), 0.03)
        for side, shift in (("L", 0.0), ("R", 0.5)):
            step, phase = divmod(t + shift, 1.0)
            swing = max(phase - 0.6, 0.0) / 0.4
            ease = swing * swing * (3 - 2 * swing)
            way = stride * (step + ease - shift + 0.3)  # the foot stands for 0.6 of a stride, the body over its middle
            put(foot.format(side), frame, way, 0.12 * math.sin(math.pi * swing), pitch * math.sin(2 * math.pi * swing))
            if roll:
                bone = obj.pose.bones[roll.format(side)]
                bone.rotation_mode = "ZXY"
                bone.rotation_euler = (0.6 * max(phase - 0.45, 0.0) / 0.15 if phase < 0.6 else 0.6 * (1 - ease), 0, 0)
                bone.keyframe_insert("rotation_euler", index=0, frame=frame)
    bpy.context.scene.frame_set(1)
