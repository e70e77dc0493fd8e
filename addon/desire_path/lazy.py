"""Names and modules that are looked up when first asked for: the one door through which anything is loaded late."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from types import ModuleType
from typing import Any


def names(
    package: str, homes: Mapping[str, str], other: Callable[[str], Any] = lambda name: None
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """(__getattr__, __dir__, __all__) for the package `package`: homes = {name: module of the package}.

    other: what is asked for any further name; None = there is none.
    """

    def __getattr__(name: str) -> Any:
        found = getattr(import_module("." + homes[name], package), name) if name in homes else other(name)
        if found is None:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return found

    def __dir__() -> list[str]:
        return sorted(homes)

    return __getattr__, __dir__, sorted(homes)


class module:
    """A module that is imported when it is first asked for an attribute; ImportError then, where it is not there.

    For the core, for what a machine may lack, and for what is another room's work and only named here.
    """

    def __init__(self, name: str, package: str | None = None) -> None:
        self.__dict__.update(_name=name, _package=package)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") and name.endswith("__"):
            raise AttributeError(name)  # who looks at the door, as makers of pages do, does not open it
        return getattr(load(self), name)

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(load(self), name, value)


def load(door: module) -> ModuleType:
    """The module behind a door, imported now; ImportError where it is not there."""
    return import_module(door._name, door._package)
