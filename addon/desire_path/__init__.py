"""Desire Path - a recorded walk presses its trail into the ground.

Without Blender: `Gait`, `Walker`, `Soil`, `Simulation`, `Bake` and `python -m desire_path`.
With Blender: the same from the Physics tab, after `register()`.
"""
bl_info = {
    "name": "Desire Path",
    "author": "Desire Path contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Physics > Desire Path",
    "description": "Walking characters press prints, rims and trails into a ground mesh",
    "category": "Physics",
}

__version__ = ".".join(str(part) for part in bl_info["version"])

_HOME = {"Gait": "gait", "Sole": "gait", "Walker": "walker", "place_feet": "place", "Soil": "soil",
         "SOILS": "soil", "Kind": "plants", "KINDS": "plants", "Planting": "plants", "Ground": "sim",
         "Simulation": "sim", "Bake": "bake", "Parcel": "parcels", "read_index": "bake", "DesirePathError": "errors"}


def __getattr__(name):
    # looked up when first asked for, so that importing the package needs nothing but Python
    if name in _HOME:
        from importlib import import_module
        return getattr(import_module("." + _HOME[name], __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def register():
    from . import blender
    blender.register()


def unregister():
    from . import blender
    blender.unregister()
