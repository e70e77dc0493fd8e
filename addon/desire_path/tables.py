"""Tables of numbers that people choose, as the core declares them: of soils, kinds of plant, contacts and loads."""

from __future__ import annotations

import numbers
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeGuard, TypeVar

from .errors import DesirePathError

Record = TypeVar("Record", bound=type)


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


def with_numbers(known: Mapping[str, Number]) -> Callable[[Record], Record]:
    """For a class that becomes a dataclass: a field for each number, behind its own, and what each means."""

    def make(kind: Record) -> Record:
        for name, number in known.items():
            kind.__annotations__[name] = "float"
            setattr(kind, name, number.usual)
        lines = [f"    {name} [{of.unit}], {of.low:.4g} to {of.high:.4g}: {of.meaning}" for name, of in known.items()]
        kind.__doc__ = "\n".join([f"{kind.__doc__}\n", *lines])
        return kind

    return make


def check(record: object, known: Mapping[str, Number], whose: str) -> None:
    """DesirePathError if one of a record's numbers is none, or not within its range; whose: "A soil's"."""
    check_some({name: getattr(record, name) for name in known}, known, whose)


def check_some(values: Mapping[str, object], known: Mapping[str, Number], whose: str) -> None:
    """The same for some of the numbers, by name."""
    for name, value in values.items():
        of = known[name]
        if not is_number(value):
            raise DesirePathError(f"{whose} {name} of {str(value)[:40]!r} is no number: give one.")
        if not of.low <= value <= of.high:
            raise DesirePathError(
                f"{whose} {name} of {in_words(value)} cannot be used: choose one from {of.low:.4g} to {of.high:.4g}."
            )


def from_words(texts: Iterable[str], known: Mapping[str, Number], what: str, example: str) -> dict[str, float]:
    """Numbers by name out of words `name=value`; what: "soil"; example: one of them, as people may write it."""
    found = {}
    for text in texts:
        name, _, value = text.partition("=")
        if name not in known:
            raise DesirePathError(f"No {what} has '{name[:40]}': choose one of {', '.join(known)}, as in {example}.")
        try:
            found[name] = float(value)
        except ValueError:
            raise DesirePathError(f"'{value[:40]}' is no number for a {what}'s {name}: give one.") from None
    return found


def is_number(value: object) -> TypeGuard[float]:
    """Whether it can be counted with; True and False cannot."""
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def in_words(value: float) -> str:
    """A number as a sentence shows it."""
    try:
        return f"{float(value):g}"
    except OverflowError:  # a whole number of hundreds of digits
        return "more than 1e300"
