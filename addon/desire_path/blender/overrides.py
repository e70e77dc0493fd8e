"""overrides.py - what library overrides were told outlives the file, where Blender would forget it.

From 5.0 on Blender drops what an override adds to a property group that its library never had. The file therefore
keeps it a second time, on a scene, and gives it back when it is read.
"""

import json
from contextlib import suppress

import bpy

from . import compat, replant

KEPT = "desire_path_overrides"  # on a scene: what each of them was told, as JSON by name


def at_risk():
    """(override, the names of what its library says nothing of) of every override that has some; None: of all."""
    found = []
    for obj in bpy.data.objects:
        if obj.override_library is None or obj.library is not None or obj.override_library.reference is None:
            continue
        reference, settings = obj.override_library.reference, obj.desire_path
        if not (settings.is_ground or settings.is_walker):
            continue
        if not reference.is_property_set("desire_path"):
            found.append((obj, None))
            continue
        parts = [name for name, each in type(settings).__annotations__.items() if compat.is_group(each)]
        unknown = [
            name for name in parts if settings.is_property_set(name) and not reference.desire_path.is_property_set(name)
        ]
        found += [(obj, unknown)] if unknown else []
    return found


def keep():
    """Before the file is saved."""
    scenes = [scene for scene in bpy.data.scenes if scene.library is None]
    kept = {
        obj.name: values_of(obj.desire_path)
        if names is None
        else {name: values_of(getattr(obj.desire_path, name)) for name in names}
        for obj, names in at_risk()
    }
    for scene in scenes:
        if KEPT in scene:
            del scene[KEPT]
    if kept and scenes:
        scenes[0][KEPT] = json.dumps(kept)


def restore():
    """After it was read."""
    for scene in bpy.data.scenes:
        if scene.library is None and KEPT in scene:
            with suppress(ValueError, AttributeError):  # somebody else's
                kept = json.loads(scene[KEPT])
                for obj in bpy.data.objects:
                    if obj.override_library is not None and obj.name in kept:
                        tell(obj.desire_path, kept[obj.name])


def values_of(group):
    """The numbers, words and names of a property group, by name."""
    out = {}
    for name, each in type(group).__annotations__.items():
        if "get" in each.keywords:
            continue  # it is told by something else
        value = getattr(group, name)
        if each.function is bpy.props.CollectionProperty:
            out[name] = [values_of(one) | {"name": one.name} for one in value]
        elif compat.is_group(each):
            out[name] = values_of(value)
        elif each.function is bpy.props.PointerProperty:
            out[name] = (
                [value.bl_rna.identifier, value.name, value.library and value.library.filepath] if value else None
            )
        else:
            out[name] = value
    return out


def tell(group, kept):
    """Set those that differ; whatever follows by itself last, since setting something by hand ends that."""
    kinds = type(group).__annotations__
    with replant.quietly():
        for name in sorted((each for each in kinds if each in kept), key=lambda name: name.endswith("_auto")):
            value, kind = kept[name], kinds[name].function
            if kind is bpy.props.CollectionProperty:
                there = getattr(group, name)
                for number, one in enumerate(value):
                    each = there[number] if number < len(there) else there.add()
                    each.name = one["name"]
                    tell(each, one)
            elif compat.is_group(kinds[name]):
                tell(getattr(group, name), value)
            elif kind is bpy.props.PointerProperty:
                tell_pointer(group, name, value)
            elif getattr(group, name) != value:
                with suppress(TypeError):  # an enum that is no more
                    setattr(group, name, value)


def tell_pointer(group, name, value):
    data = {"Image": bpy.data.images}.get(value[0], bpy.data.objects) if value else ()
    for each in data:
        if each.name == value[1] and (each.library and each.library.filepath) == value[2]:
            with suppress(TypeError):
                setattr(group, name, each)
