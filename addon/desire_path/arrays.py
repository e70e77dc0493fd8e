"""Records that hold arrays: compared by value, as records of numbers are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields

import numpy as np

SHOWN = 80  # letters of a record, at most


def read_only(array: np.ndarray) -> np.ndarray:
    """The same numbers, not to be written through it: a view, nothing is copied, and who gave it may still write."""
    view = array.view()
    view.flags.writeable = False
    return view


def kept(value: object) -> object:
    """A field of a record, not to be written: an array, or a tuple or a mapping (as a dict) with some in it."""
    if type(value) is tuple:
        return tuple(map(kept, value))
    if isinstance(value, Mapping):
        return {name: kept(each) for name, each in value.items()}
    if isinstance(value, np.ndarray):
        return read_only(value)
    like_an_array = getattr(type(value), "read_only", None)  # poses in tracks
    return like_an_array(value) if like_an_array else value


def _is_array(value: object) -> bool:
    """Whether it is an array, or is read like one, as poses in tracks are."""
    return isinstance(value, np.ndarray) or (hasattr(value, "ndim") and not np.isscalar(value))


def _alike(a: np.ndarray, b: np.ndarray) -> bool:
    return np.array_equal(a, b, equal_nan=a.dtype.kind == b.dtype.kind == "f")


def same(a: object, b: object) -> bool:
    """Whether two values are alike: arrays in shape and in every number, NaN as NaN; what holds some in all of them."""
    if _is_array(a) or _is_array(b):
        if not (_is_array(a) and _is_array(b)) or a.shape != b.shape:  # type: ignore[attr-defined]
            return False
        if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
            return a is b or _alike(a, b)
        return a is b or all(_alike(np.asarray(x), np.asarray(y)) for x, y in zip(a, b))  # type: ignore[call-overload]
    if isinstance(a, (tuple, list)) and type(a) is type(b):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(same(each, b[key]) for key, each in a.items())
    return bool(a == b)


def _mark(value: object) -> object:
    """The same for values that are alike, and cheap: of arrays their shape."""
    if _is_array(value):
        return value.shape  # type: ignore[attr-defined]
    if isinstance(value, Mapping):
        return tuple(sorted(value))
    return tuple(map(_mark, value)) if isinstance(value, (tuple, list)) else value


class Record:
    """A frozen dataclass (eq=False) with arrays among its fields: == compares values, and hash() goes with it.

    All its arrays are read only; they share memory with what it was given where that has the right type. A record
    that makes something of what it is given does so in a __post_init__ of its own, which ends with this one.
    """

    def __post_init__(self) -> None:
        for each in fields(self):  # type: ignore[arg-type]
            object.__setattr__(self, each.name, kept(getattr(self, each.name)))

    def __repr__(self) -> str:
        said = []
        for each in fields(self):  # type: ignore[arg-type]
            value = getattr(self, each.name)
            if _is_array(value):
                said.append(f"{each.name} {value.shape}")
            elif isinstance(value, (str, int, float)):
                said.append(f"{each.name} {value!r}")
        text = ", ".join(said)
        return f"{type(self).__name__}({text if len(text) <= SHOWN else text[:SHOWN] + '..'})"

    def __setstate__(self, state: dict) -> None:
        """From a copy or a pickle, whose arrays are as new."""
        for name, value in state.items():
            object.__setattr__(self, name, kept(value))

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self is other or all(
            same(getattr(self, each.name), getattr(other, each.name))
            for each in fields(self)  # type: ignore[arg-type]
            if each.compare
        )

    def __hash__(self) -> int:
        return hash(tuple(_mark(getattr(self, each.name)) for each in fields(self) if each.compare))  # type: ignore[arg-type]
