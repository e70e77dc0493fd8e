"""units.py - numbers in metres and kilograms, shown and typed in the units of the scene.

    a property in SI --get, set--> the same as Blender shows it: 5mm, 2in, 150lb can be typed

Blender multiplies what it shows by the scene's unit scale; what is stored stays SI whatever the scale.
"""

from collections.abc import Callable
from typing import Any

import bpy
from bpy.props import FloatProperty

from .late import axes


def length(name: str, label: str, description: str, **options: Any) -> Any:
    """A property that shows another one [m] of its group as a length."""
    return _shown(name, 1, label, description, subtype="DISTANCE", unit="LENGTH", **options)


def mass(name: str, label: str, description: str, **options: Any) -> Any:
    """A property that shows another one [kg] of its group as a mass."""
    return _shown(name, 3, label, description, unit="MASS", **options)


def share(get: Callable, put: Callable, label: str, description: str) -> Any:
    """A property from 0 to 1 that shows numbers of its group in a way of its own."""
    return FloatProperty(
        name=label,
        description=description,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        options=set(),
        get=lambda self: min(max(get(self), 0.0), 1.0),
        set=put,
    )


def _shown(name: str, power: int, label: str, description: str, *, keyed: bool = False, **options: Any) -> Any:
    def get(self: Any) -> float:
        return float(getattr(self, name)) / axes.unit_scale(bpy.context.scene) ** power

    def put(self: Any, value: float) -> None:
        setattr(self, name, axes.typed(value * axes.unit_scale(bpy.context.scene) ** power))

    flags = {"ANIMATABLE"} if keyed else set()
    return FloatProperty(name=label, description=description, options=flags, get=get, set=put, **options)
