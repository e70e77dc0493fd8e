"""drawing.py - Blender's modules that draw into viewports, loaded when it is drawn: there may be no display."""

from .. import lazy

blf = lazy.module("blf")
gpu = lazy.module("gpu")
batch = lazy.module("gpu_extras.batch")
