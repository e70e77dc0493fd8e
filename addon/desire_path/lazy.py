"""Names and modules that are looked up when first asked for: the one door through which anything is loaded late."""

from importlib import import_module


def names(package, homes, other=lambda name: None):
    """(__getattr__, __dir__, __all__) for the package `package`: homes = {name: module of the package}.

    other: what is asked for any further name; None = there is none.
    """

    def __getattr__(name):
        found = getattr(import_module("." + homes[name], package), name) if name in homes else other(name)
        if found is None:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return found

    def __dir__():
        return sorted(homes)

    return __getattr__, __dir__, sorted(homes)


class module:
    """A module that is imported when it is first asked for an attribute; ImportError then, where it is not there.

    For the core, for what a machine may lack, and for what is another room's work and only named here.
    """

    def __init__(self, name, package=None):
        self.__dict__.update(_name=name, _package=package)

    def __getattr__(self, name):
        if name.startswith("__") and name.endswith("__"):
            raise AttributeError(name)  # who looks at the door, as makers of pages do, does not open it
        return getattr(load(self), name)


def load(door):
    """The module behind a door, imported now; ImportError where it is not there."""
    return import_module(door._name, door._package)
