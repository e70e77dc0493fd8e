"""Names of a package that are looked up when first asked for, so that importing it needs nothing but Python."""

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
