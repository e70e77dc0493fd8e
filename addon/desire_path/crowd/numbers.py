"""Numbers of a crowd's scene, checked. Experimental."""

from __future__ import annotations

from typing import Any

from ..errors import DesirePathError


def number(value: Any, what: str, low: float, high: float) -> float:
    """A number in its range; else a sentence that begins with `what`."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
        raise DesirePathError(f"{what} cannot be {str(value)[:40]}: give a number from {low:g} to {high:g}.")
    return float(value)


def whole_number(value: Any, what: str, low: int, high: int) -> int:
    """A whole number in its range; else a sentence that begins with `what`."""
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise DesirePathError(f"{what} cannot be {str(value)[:40]}: give a whole number from {low} to {high}.")
    return value


def pair(value: Any, what: str) -> tuple[float, float]:
    """Two numbers, a place; else a sentence."""
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        raise DesirePathError(f"{what} cannot be {str(value)[:40]}: write two numbers, as [10, 20].")
    x, y = (number(each, what, -1e6, 1e6) for each in value)
    return x, y
