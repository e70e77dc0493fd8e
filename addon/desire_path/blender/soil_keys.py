"""soil_keys.py - keys on the numbers of a ground's soils, and on the mass of a walker, as a bake takes them.

    F-curves of the object's action --every frame--> SoilKeys, or a Soil where nothing changes; keys of a mass

Drivers and strips of the NLA editor are not looked at: what they lead counts as it is when the bake begins, and
uncounted() says so.
"""

from dataclasses import replace
from types import SimpleNamespace

import bpy

from ..ground.soil import NUMBERS
from ..ground.soil_keys import SoilKeys
from . import axes, clock, compat, soils

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


def _sampled(curve, name, frames):
    """Numbers by name of a curve, at each frame, within their ranges."""
    found = {}
    for frame in frames:
        for number, value in _numbers(name, curve.evaluate(frame)).items():
            low, high = NUMBERS[number].low, NUMBERS[number].high
            found.setdefault(number, []).append(min(max(axes.typed(value), low), high))
    return found


def _soil(scene, obj, settings, path, first, last):
    soil = soils.soil_of(settings)
    if settings.soil_file:
        return soil
    frames, times = _frames(scene, first, last)
    keys = {}
    for name, curve in _curves(obj, path).items():
        for number, values in _sampled(curve, name, frames).items():
            keys[number] = _thin(times, values)
    moving = {name: pairs for name, pairs in keys.items() if len({value for _, value in pairs}) > 1}
    # whatever frame is shown now: it begins as it is keyed
    soil = soils.with_numbers(settings, soil, {name: pairs[0][1] for name, pairs in keys.items()})
    return SoilKeys(soil, moving) if moving else soil


def of_ground(scene, obj, first, last):
    """The soils of a ground from scene frame to frame: its own, then the painted ones."""
    settings = obj.desire_path
    each = [(settings, OWN), *((painted, PAINTED.format(k)) for k, painted in enumerate(settings.painted))]
    return [_soil(scene, obj, one, path, first, last) for one, path in each]


def keyed(obj):
    """Whether an object has keys of its own on anything of ours."""
    return bool(_curves(obj, ROOT))


def names(obj):
    """The numbers of soils that have keys."""
    paths = [OWN, *(PAINTED.format(k) for k in range(len(obj.desire_path.painted)))]
    return {number for path in paths for name in _curves(obj, path) for number in _numbers(name, 0.5)}


def weighed(scene, gait, obj, last):
    """A recording of one walker, from its first frame to a last one, with the keys on its mass."""
    found = _curves(obj, ROOT)
    for name, into in MASSES.items():
        if name in found:
            frames, times = _frames(scene, gait.frame_start, last)
            keys = _thin(times, [axes.typed(into(found[name].evaluate(frame))) for frame in frames])
            steady = len({kilograms for _, kilograms in keys}) == 1
            return replace(gait, mass=[keys[0][1]], mass_keys=() if steady else (keys,)).check()
    return gait


def uncounted(grounds, walkers, on_paths):
    """Sentences about keys that do not count. on_paths: whether a frame is a pass"""
    sentences = []
    if on_paths:
        return [
            f"The keys on the soils of '{each.name}' do not count where a frame is a pass: they are as now."
            for each in grounds
            if names(each)
        ]
    for each in grounds:
        if each.desire_path.soil_file and _curves(each, OWN):
            sentences.append(f"The keys on the soil of '{each.name}' do not count while a soil file is set: clear it.")
        if _curves(each, LAID):
            sentences.append(f"The keys on the layers of '{each.name}' do not count: they are as now.")
    for each in {*grounds, *walkers}:
        animation = each.animation_data
        if animation is None:
            continue
        strips = any(len(track.strips) for track in animation.nla_tracks if not track.mute)
        led = [curve.data_path for curve in animation.drivers if _is_ours(curve.data_path)]
        if strips:
            led += [
                curve.data_path
                for track in animation.nla_tracks
                for strip in track.strips
                for curve in compat.strip_curves(strip)
                if _is_ours(curve.data_path)
            ]
        if led:
            name = led[0].rpartition(".")[2]
            sentences.append(
                f"'{each.name}' has a driver or a strip of the NLA editor on {name}, which counts as it is now: "
                "key it in the object's own action instead."
            )
    return sorted(sentences)


def _is_ours(path):
    return path.startswith(ROOT) and (".soil_numbers." in path or path[len(ROOT) :] in MASSES)
