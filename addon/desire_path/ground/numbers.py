"""Records of numbers that people choose, as soils and kinds of plant: what the core tells of them, and checks."""

from __future__ import annotations

import numbers
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeVar

from ..errors import DesirePathError

Made = TypeVar("Made", bound=type)


@dataclass(frozen=True)
class Number:
    """One number of a record, as the core declares it."""

    unit: str  # "m", "rad", "1/s" .., "-" of a share
    low: float  # low <= value <= high
    high: float
    usual: float  # of a record that does not say
    meaning: str


def table(rows: Iterable[tuple[Any, ...]], names: Mapping[str, str] = MappingProxyType({})) -> Mapping[str, Number]:
    """Numbers by name, in the core's order, from its rows; names: what some of them are called here."""
    return MappingProxyType({names.get(name, name): Number(*of) for name, *of in rows})


def with_numbers(known: Mapping[str, Number]):
    """For a class that becomes a dataclass: a field for each number, behind its own, and what each means."""

    def make(kind: Made) -> Made:
        for name, number in known.items():
            kind.__annotations__[name] = "float"
            setattr(kind, name, number.usual)
        lines = [f"    {name} [{of.unit}], {of.low:.4g} to {of.high:.4g}: {of.meaning}" for name, of in known.items()]
        kind.__doc__ = "\n".join([f"{kind.__doc__}\n", *lines])
        return kind

    return make


def check(record: object, known: Mapping[str, Number], whose: str) -> None:
    """DesirePathError if one of a record's numbers is none, or not within its range; whose: "A soil's"."""
    for name, of in known.items():
        value = getattr(record, name)
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise DesirePathError(f"{whose} {name} of {str(value)[:40]!r} is no number: give one.")
        if not of.low <= value <= of.high:  # type: ignore[operator]
            raise DesirePathError(
                f"{whose} {name} of {in_words(value)} cannot be used: choose one from {of.low:.4g} to {of.high:.4g}."
            )


def in_words(value: numbers.Real) -> str:
    """A number as a sentence shows it."""
    try:
        return f"{float(value):g}"
    except OverflowError:  # a whole number of hundreds of digits
        return "more than 1e300"
