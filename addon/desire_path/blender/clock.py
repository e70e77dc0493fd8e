"""clock.py - the frames of the timeline, and the time the animation runs in.

Time stretching (Output > Frame Range) plays an animation slower or faster: keys, strips, drivers, nodes and
caches then live at other frames than the timeline shows. A walk in slow motion falls and lands as it was keyed,
so that its seconds are those of the animation.
"""

import bpy


def stretch(scene):
    """Scene frames in which one frame of the animation is shown, > 1: slow motion."""
    return scene.render.frame_map_new / scene.render.frame_map_old


def stretch_of(obj):
    """The same for the scene an object is shown in."""
    scene = bpy.context.scene
    if obj.name not in scene.objects and obj.users_scene:
        scene = obj.users_scene[0]
    return stretch(scene)


def frame_rate(scene):
    """Scene frames in a second of the animation [1/s]."""
    return scene.render.fps / scene.render.fps_base * stretch(scene)
