"""The core, loaded when it is first asked for something: Blender lists and registers the add-on without it."""

from . import lazy

_native = lazy.module("._native", __package__)
