"""The fields a simulation can be asked for, by name, as the core declares them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from ..core import _native


class Field(NamedTuple):
    """One of them."""

    number: int  # by which the core knows it
    unit: str  # "m", "Pa s" .., "-" of a share
    equation: str  # of a paper, "TRAIL (10)", or ""
    meaning: str


FIELDS: Mapping[str, Field] = MappingProxyType({name: Field(*of) for name, *of in _native.fields()})
LEAN = ("lean_x", "lean_y", "crushed")  # how grass lies, axes of the core's read_lean: on planted ground only
