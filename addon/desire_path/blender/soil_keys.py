"""soil_keys.py - keys on the numbers of a ground's soils, and on the mass of a walker, as a bake takes them.

F-curves of the object's action ------------------,--every frame--> SoilKeys, or a Soil where nothing changes;
drivers, strips --what private.following sees----'                   keys of a mass
"""

from dataclasses import replace
from types import SimpleNamespace

import bpy

from ..ground.soil import NUMBERS
from ..ground.soil_keys import SoilKeys
from . import axes, clock, compat, private, soils

ROOT = "desire_path."
OWN, PAINTED = ROOT + "soil_numbers.", ROOT + "painted[{}].soil_numbers."
LAID = ROOT + "layers["  # of what lies on them
MASSES = {"mass": lambda value: value, "weight": lambda value: value * axes.unit_scale(bpy.context.scene) ** 3}


def _curves(obj, path):
    """F-curves of an object's properties below a path, by what follows it."""
    found = compat.all_curves(obj.animation_data) if obj.animation_data is not None else ()
    return {each.data_path[len(path) :]: each for each in found if each.data_path.startswith(path) and not each.mute}


def _numbers(name, value):
    """What a property of a soil comes to: numbers by their names."""
    if name in soils.WORDS:
        return {name: value}
    word = soils.EASY.get(name)
    if word is None:
        return {}
    into = SimpleNamespace()
    word.keywords["set"](into, value)
    return vars(into)


def _frames(scene, first, last):
    """(frames of the animation, their times since the first [s])"""
    frames = range(first, last + 1)
    return [each / clock.stretch(scene) for each in frames], [k / clock.frame_rate(scene) for k in range(len(frames))]


def _thin(times, values):
    """Keys without those between two that are alike."""
    kept = [
        k for k, value in enumerate(values) if k in (0, len(values) - 1) or not values[k - 1] == value == values[k + 1]
    ]
    return [(times[k], values[k]) for k in kept]


def _within(name, values):
    """Numbers by name, at each frame, within their ranges, of what a property of a soil comes to."""
    found = {}
    for each in values:
        for number, value in _numbers(name, each).items():
            low, high = NUMBERS[number].low, NUMBERS[number].high
            found.setdefault(number, []).append(min(max(axes.typed(value), low), high))
    return found


def led(obj):
    """Paths of properties of ours that drivers or strips of the NLA editor lead, which keys alone do not tell."""
    animation = obj.animation_data
    if animation is None:
        return set()
    found = {each.data_path for each in animation.drivers if not each.mute}
    tracks = animation.nla_tracks if animation.use_nla else ()
    for strip in (strip for track in tracks for strip in track.strips):
        found |= {each.data_path for each in compat.strip_curves(strip)}
    return {path for path in found if _is_ours(path)}


def _moving(scene, obj, first, last):
    """What properties of ours that are keyed, driven or in strips come to at each frame, by path."""
    frames, _ = _frames(scene, first, last)
    paths = led(obj)
    if not paths:
        curves = _curves(obj, ROOT)
        return {ROOT + rest: [curve.evaluate(at) for at in frames] for rest, curve in curves.items()}
    paths |= {ROOT + rest for rest in _curves(obj, ROOT)}
    found = {path: [] for path in paths}
    with private.following(scene, obj) as (own, each):
        for frame in range(first, last + 1):
            now = private.evaluated(own, each, frame)
            for path, values in found.items():
                values.append(now.path_resolve(path))
    return found


def _soil(scene, moving, settings, path, first, last):
    soil = soils.soil_of(settings)
    if settings.soil_file:
        return soil
    _, times = _frames(scene, first, last)
    keys = {}
    for each, values in moving.items():
        if each.startswith(path):
            for number, sampled in _within(each[len(path) :], values).items():
                keys[number] = _thin(times, sampled)
    moving = {name: pairs for name, pairs in keys.items() if len({value for _, value in pairs}) > 1}
    # whatever frame is shown now: it begins as it is keyed
    soil = soils.with_numbers(settings, soil, {name: pairs[0][1] for name, pairs in keys.items()})
    return SoilKeys(soil, moving) if moving else soil


def of_ground(scene, obj, first, last):
    """The soils of a ground from scene frame to frame: its own, then the painted ones."""
    settings, moving = obj.desire_path, _moving(scene, obj, first, last)
    each = [(settings, OWN), *((painted, PAINTED.format(k)) for k, painted in enumerate(settings.painted))]
    return [_soil(scene, moving, one, path, first, last) for one, path in each]


def laid(obj):
    """(soil, thickness [m]) of each layer of a ground, as it is at the first frame of its bake."""
    settings, first = obj.desire_path, obj.desire_path.frame_start
    is_moved = any(path.startswith(LAID) for path in _paths(obj))
    scene = bpy.context.scene
    moving = _moving(scene, obj, first, first) if is_moved else {}
    found = []
    for k, each in enumerate(settings.layers):
        path = f"{LAID}{k}]."
        soil = _soil(scene, moving, each, path + "soil_numbers.", first, first)
        found.append((soil, axes.typed(moving.get(path + "thickness", [each.thickness])[0])))
    return found


def change_layers(scene, obj, first, last):
    """Whether keys, drivers or strips make the layers of a ground others between two frames."""
    if not any(path.startswith(LAID) for path in _paths(obj)):
        return False
    moving = _moving(scene, obj, first, last)
    return any(path.startswith(LAID) and len(set(map(axes.typed, values))) > 1 for path, values in moving.items())


def _paths(obj):
    """Of all properties of ours that are keyed, driven or in strips."""
    return led(obj) | {ROOT + rest for rest in _curves(obj, ROOT)}


def keyed(obj):
    """Whether anything moves properties of ours."""
    return bool(_paths(obj))


def names(obj):
    """The numbers of soils that keys, drivers or strips lead, and whether they lead how thick layers lie."""
    found = {path.rpartition(".")[2] for path in _paths(obj) if ".soil_numbers." in path}
    thick = {"thickness" for path in _paths(obj) if path.startswith(LAID) and path.endswith(".thickness")}
    return {number for name in found for number in _numbers(name, 0.5)} | thick


def weighed(scene, gait, obj, last):
    """A recording of one walker, from its first frame to a last one, with what keys, drivers and strips make of its
    mass."""
    if not any(path[len(ROOT) :] in MASSES for path in _paths(obj)):
        return gait
    moving = _moving(scene, obj, gait.frame_start, last)
    _, times = _frames(scene, gait.frame_start, last)
    for name, into in MASSES.items():
        if ROOT + name in moving:
            keys = _thin(times, [axes.typed(into(value)) for value in moving[ROOT + name]])
            steady = len({kilograms for _, kilograms in keys}) == 1
            return replace(gait, mass=[keys[0][1]], mass_keys=() if steady else (keys,)).check()
    return gait


def uncounted(grounds, on_paths):
    """Sentences about keys that do not count. on_paths: whether a frame is a pass"""
    if on_paths:
        return [
            f"The keys on the soils of '{each.name}' do not count where a frame is a pass: they are as at frame "
            f"{each.desire_path.frame_start}."
            for each in grounds
            if names(each)
        ]
    sentences = []
    for each in grounds:
        if each.desire_path.soil_file and any(path.startswith(OWN) for path in _paths(each)):
            sentences.append(f"The keys on the soil of '{each.name}' do not count while a soil file is set: clear it.")
    return sorted(sentences)


def _is_ours(path):
    name = path[len(ROOT) :]
    return path.startswith(ROOT) and (".soil_numbers." in path or path.startswith(LAID) or name in MASSES)
