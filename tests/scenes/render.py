"""render.py - the demo's pictures, from its saved file and nothing else.

    blender -b demo.blend --python-exit-code 1 -P render.py -- still PATH WIDTH HEIGHT SAMPLES
    blender -b demo.blend --python-exit-code 1 -P render.py -- prints FOLDER WIDTH HEIGHT SAMPLES
    blender -b demo.blend --python-exit-code 1 -P render.py -- film FOLDER WIDTH HEIGHT SAMPLES STEP
    blender -b demo.blend --python-exit-code 1 -P render.py -- frames FOLDER WIDTH HEIGHT SAMPLES N
    blender -b meadow.blend --python-exit-code 1 -P render.py -- view PATH WIDTH HEIGHT SAMPLES FRAME

`view` looks through the file's own camera; `prints` makes FOLDER/sand.png, snow.png and mud.png, `frames` frames
N, N .. of the film.
"""

import os
import sys

import bpy

what, path, *numbers = sys.argv[sys.argv.index("--") + 1 :]
width, height, samples, *which = map(int, numbers)
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.cycles.samples = samples
scene.cycles.use_denoising = False
scene.render.image_settings.file_format = "PNG"


def picture(camera, frame, file):
    scene.camera = bpy.data.objects[camera]
    scene.frame_set(frame)
    scene.render.filepath = file
    bpy.ops.render.render(write_still=True)


if what == "film":
    scene.camera = bpy.data.objects["Film"]
    scene.frame_step = which[0]
    # the last frames the recording holds are left as they are; one file a frame
    scene.render.filepath = os.path.join(path, "")
    bpy.ops.render.render(animation=True)
elif what == "frames":
    for number, frame in enumerate(which, 1):
        picture("Film", frame, os.path.join(path, f"film_{number}.png"))
elif what == "prints":
    for soil in ("sand", "snow", "mud"):
        picture("Print in " + soil, scene.frame_end, os.path.join(path, soil + ".png"))
elif what == "view":
    picture(scene.camera.name, which[0], path)
else:
    picture("Still", scene.frame_end, path)
