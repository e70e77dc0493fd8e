"""All modules of the package but those of Blender."""

import importlib
import pkgutil

import desire_path


def modules():
    for found in pkgutil.walk_packages(desire_path.__path__, "desire_path."):
        if not found.name.startswith("desire_path.blender") and not found.name.endswith("__main__"):
            yield importlib.import_module(found.name)
