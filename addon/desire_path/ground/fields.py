"""The fields a simulation can be asked for, by name."""

from __future__ import annotations

FIELDS = {  # name -> number in native/terrain/terrain.h, DpField
    "compression": 0,
    "heap": 1,
    "pressure_time": 2,
    "rest": 3,
    "young_modulus": 4,
    "soil": 5,
    "plant_strength": 6,
    "height_change": 7,
    "pressure": 67,
}
LEAN = ("lean_x", "lean_y", "crushed")  # axes of the core's read_lean
FIRST_LEAN = 64  # the number of the first of them among a map's fields
