"""Modules by the names they had when all of them lay in one folder: found where they are, with a DeprecationWarning.

    from desire_path import walker     the very module desire_path.loads.walker

The package has another name inside Blender (bl_ext.user_default.desire_path), so a finder serves one package.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.machinery import ModuleSpec
from types import ModuleType

MODULES = {
    name: f"{room}.{name}"
    for room, names in {
        "files": "disk npz table",
        "motion": "gait rotation jumps stays freeze size",
        "loads": "walker report plot",
        "ground": "sim soil maps mesh plants tuft plant_mesh trail parcels",
        "placement": "cycle passes path place",
        "rig": "rigs rig_bones rig_feet rig_names rig_shape body foot sole mass solid leg slope",
        "bake": "folder output share",
    }.items()
    for name in names.split()
} | {
    "whole": "files.atomic_file",
    "sink": "placement.settle_feet",
    "tread": "rig.sole_mesh",
    "lane": "study.trampling",
    "fit": "study.calibrate",
}


class Loader:
    """Gives the module that is there already, under one more name."""

    def __init__(self, name: str) -> None:
        self.name = name

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        module = import_module(self.name)
        self.spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        module.__spec__ = self.spec  # the import system puts the asked one there


class Finder:
    """Finds a package's modules by their old names."""

    def __init__(self, package: str) -> None:
        self.package = package

    def asked(self, name: str, calls: int) -> str:
        """What a module is called, after a warning to who asks for it, so many calls up."""
        new = f"{self.package}.{MODULES[name]}"
        warnings.warn(
            f"{self.package}.{name} is an old name of {new}: import that.", DeprecationWarning, stacklevel=calls + 1
        )
        return new

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        package, _, last = name.rpartition(".")
        if package == self.package and last in MODULES:
            return ModuleSpec(name, Loader(self.asked(last, 2)))  # type: ignore[arg-type]
        return None

    def attribute(self, name: str) -> ModuleType | None:
        """The module of an old name, from now on an attribute of the package; None where it is none."""
        if name not in MODULES:
            return None
        module = import_module(self.asked(name, 3))
        setattr(sys.modules[self.package], name, module)
        return module


def serve(package: str) -> Callable[[str], ModuleType | None]:
    """Let the package's modules be imported by their old names, however often it is loaded anew.

    Returns what finds them as the package's attributes: name -> module or None.
    """
    finder = Finder(package)
    sys.meta_path[:] = [each for each in sys.meta_path if getattr(each, "package", None) != package]
    sys.meta_path.append(finder)
    return finder.attribute
