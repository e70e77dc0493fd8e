"""Desire Path - a recorded walk presses its trail into the ground.

Without Blender: `Gait`, `Walker`, `Soil`, `Simulation`, `Bake` and `python -m desire_path`.
With Blender: the same from the Physics tab, after `register()`.
"""

from . import lazy, old_names

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

__getattr__, __dir__, __all__ = lazy.names(
    __name__,
    {
        "Gait": "motion.gait",
        "Sole": "motion.gait",
        "Walker": "loads.walker",
        "place_feet": "placement.place",
        "wade": "placement.wade",
        "Soil": "ground.soil",
        "SoilKeys": "ground.soil_keys",
        "SOILS": "ground.soil",
        "Kind": "ground.plants",
        "KINDS": "ground.plants",
        "Planting": "ground.plants",
        "Ground": "ground.sim",
        "Simulation": "ground.sim",
        "SimulationOptions": "ground.options",
        "Spray": "ground.spray",
        "SPRAYS": "ground.spray",
        "Parcel": "ground.parcels",
        "Bake": "bake.bake",
        "BakeOptions": "bake.options",
        "BakeOutput": "bake.options",
        "LivePress": "bake.press",
        "PressBody": "bake.press",
        "read_index": "bake.folder",
        "DesirePathError": "errors",
    },
    other=old_names.serve(__name__),
)

_blender = lazy.module(".blender", __name__)  # bpy is needed for this half alone


def register() -> None:
    _blender.register()


def unregister() -> None:
    _blender.unregister()
