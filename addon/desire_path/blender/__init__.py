"""Blender on top: operators collect, call and write; panels draw; arithmetic lives in the core."""


def register():
    pass


def unregister():
    pass
