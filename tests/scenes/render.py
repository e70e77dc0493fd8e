"""render.py - the still or the frames of the film, from the demo's saved file and nothing else.

    blender -b demo.blend --python-exit-code 1 -P render.py -- still PATH WIDTH HEIGHT SAMPLES
    blender -b demo.blend --python-exit-code 1 -P render.py -- film FOLDER WIDTH HEIGHT SAMPLES STEP
"""
import os
import sys

import bpy

what, path, *numbers = sys.argv[sys.argv.index("--") + 1:]
width, height, samples, *step = map(int, numbers)
scene = bpy.context.scene
scene.camera = bpy.data.objects["Film" if what == "film" else "Still"]
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.cycles.samples = samples
scene.cycles.use_denoising = False
scene.render.image_settings.file_format = "PNG"
if what == "film":
    scene.frame_step = step[0]
    # the last frames the recording holds are left as they are; one file a frame
    scene.render.filepath = os.path.join(path, "")
    bpy.ops.render.render(animation=True)
else:
    scene.frame_set(scene.frame_end)
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
