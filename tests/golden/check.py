"""Golden digests: what the product computes, in one number for each world, law and field.

    python tests/golden/check.py            compare with expected.json; what differs is named, and the code is 1
    python tests/golden/check.py flat walk  only these worlds
    python tests/golden/check.py --write    renew expected.json

A change that alters results renews the file in the same commit, and that commit says why. Every world is computed by
1, 2 and 5 workers, under both contact laws and both heap laws; `walk` is a recorded walk whose contacts and forces are
found by every load model. worlds.py tells what the worlds hold.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(HERE)]

from worlds import worlds  # noqa: E402

from desire_path import Gait, _native, maps, walker  # noqa: E402

EXPECTED = HERE / "expected.json"
WORKERS = (1, 2, 5)
LAWS, HEAPS = ("sole", "uniform"), ("rest", "paper")
FIELDS = ("compression", "heap", "pressure_time", "rest", "young_modulus", "soil", "plant_strength", "height_change")
LEAN = ("lean_x", "lean_y", "crushed")
DIGITS = 9  # of forces that are compared [-]


def digest(*arrays):
    """16 letters for arrays, by shape, type and bits; any NaN is like another."""
    sum_ = hashlib.blake2b(digest_size=8)
    for array in arrays:
        array = np.array(array, order="C")
        if array.dtype.kind == "f":
            array[np.isnan(array)] = np.nan
        sum_.update(f"{array.shape} {array.dtype.str}".encode())
        sum_.update(array.tobytes())
    return sum_.hexdigest()


def read_file(path):
    picture = maps.read(path)
    return digest(
        *(picture.planes[name] for name in sorted(picture.planes)),
        np.array([sorted(picture.planes)]),
        np.array([repr(sorted(picture.notes.items()))]),
    )


def plants_of(sim, shown):
    """How the plants are now: a float32 array for each stand and property; beyond that exp() differs by machine."""
    read = [sim.plants_positions, sim.plants_strength, sim.plants_alpha] + ([sim.plants_shown] if shown else [])
    return [each(stand).astype(np.float32) for stand, _, _ in sim.stands for each in read]


def compute(world, law, heap, threads):
    """Digest of every field of a world: name -> 16 letters."""
    sim, found, pressure, stems = world.make(law, heap, threads), {}, [], []
    if world.shown:
        sim.lay_plants()
    with tempfile.TemporaryDirectory() as folder:
        film, planted = sim.open_frames(*world.film), bool(sim.plantings)
        film.open_maps(
            [*FIELDS[:3], "pressure"] + (["plant_strength", *LEAN] if planted else []), [("world", "golden")]
        )
        frames = []
        for gait, loads in world.walks:
            sim.load(gait, loads)
            for share in world.frames:
                sample = int(share * (len(gait.time) - 1))
                sim.run(sample)
                pressure.append(sim.read("pressure", *world.window))
                stems += plants_of(sim, world.shown)
                for write, kind in ((film.write_frame, "frame"), (film.write_lean, "lean")):
                    if kind == "frame" or planted:
                        frames.append(f"{folder}/{kind}_{len(frames):02d}.exr")
                        write(frames[-1], gait.time[sample])
            sim.run(len(gait.time) - 1)
            sim.rest_plants(world.rest)
        found["before_settling"] = digest(sim.read("heap", *world.window))
        sim.settle()
        film.write_maps(f"{folder}/maps.exr", 1.0)
        sim.flush()
        for kind in ("frame", "lean"):
            names = [name for name in frames if f"/{kind}_" in name]
            if names:
                found[f"{kind}s"] = digest(np.array([read_file(name) for name in names]))
        found["maps"] = read_file(f"{folder}/maps.exr")
    for name in FIELDS + (LEAN if planted else ()):
        found[name] = digest(sim.read(name, *world.window))
    found["pressure"] = digest(*pressure)
    found["normal"] = digest(np.array([sim.normal((x, 0.02), 0.05) for x in (0.1, 0.3, 0.7)]))
    if planted:
        found["stems"], found["stems_rested"] = digest(*stems), digest(*plants_of(sim, world.shown))
    told = sim.report()
    for name in sorted(told):
        found[f"report_{name}"] = f"{told[name]:.10g}"
    return found


def rounded(array):
    """To DIGITS digits of its largest number: machines differ beyond them in what NumPy adds up."""
    size = np.nanmax(np.abs(array), initial=0.0)
    return np.round(np.asarray(array) / (size or 1.0), DIGITS) + 0.0


def recorded_walk():
    """Digests of contacts and forces of the walk that comes with the product, by every load model."""
    gait = Gait.load(ROOT / "addon/desire_path/walks/walk.npz")
    tilted = lambda xy: 0.05 * xy[:, 0] - 0.02 * xy[:, 1]
    found = {}
    for name, ground in (("flat", None), ("tilted", tilted)):
        touching, clearance = walker.contacts(gait, ground)
        found[f"contacts {name}"] = {"touching": digest(touching), "clearance": digest(rounded(clearance))}
        for model, options in (("inertia", {}), ("impulse", {}), ("impulse half-sine", {"half_sine": True})):
            loads = walker.loads(gait, model.split()[0], ground, **options)
            found[f"loads {name} {model}"] = {
                "touching": digest(loads.touching),
                "force": digest(rounded(loads.force)),
                "point": digest(rounded(loads.point)),
                "clearance": digest(rounded(loads.clearance)),
                "warnings": repr(loads.warnings),
            }
    return found


def all_worlds(names=()):
    """What is computed now: {world: {law: {field: digest}}}, and sentences about workers that disagree."""
    found, complaints = {}, []
    for name, world in worlds().items():
        if names and name not in names:
            continue
        found[name] = {}
        for law in LAWS:
            for heap in HEAPS:
                case = f"{law} {heap}"
                by = [compute(world, law, heap, threads) for threads in WORKERS]
                found[name][case] = {"all": digest(np.array([sorted(by[0].items())])), **by[0]}
                for threads, other in zip(WORKERS[1:], by[1:]):
                    complaints += [
                        f"{name}, {case}, {field}: {threads} workers compute {other.get(field)}, one "
                        f"computes {by[0][field]}"
                        for field in by[0]
                        if other.get(field) != by[0][field]
                    ]
    if not names or "walk" in names:
        found["walk"] = recorded_walk()
    if not names or "bytes" in names:
        found["bytes"] = {"digest": {"of 1000 bytes": _native.digest(bytes(k % 251 for k in range(1000))).hex()[:32]}}
    return found, complaints


def compare(expected, found):
    """Sentences about what differs."""
    told = []
    for name, cases in found.items():
        known = expected.get(name, {})
        for case in sorted(set(cases) | set(known)):
            now, then = cases.get(case, {}), known.get(case, {})
            told += [
                f"{name}, {case}, {field}: expected {then.get(field)}, computed {now.get(field)}"
                for field in sorted(set(now) | set(then))
                if field != "all" and now.get(field) != then.get(field)
            ]
    return told


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("worlds", nargs="*", help="flat, hill, meadow, passes, walk, bytes; default: all")
    parser.add_argument("--write", action="store_true", help="renew expected.json")
    chosen = parser.parse_args(words)
    expected = json.loads(EXPECTED.read_text(encoding="utf-8")) if EXPECTED.exists() else {}
    found, told = all_worlds(chosen.worlds)
    if not found:
        parser.error(f"there is no world {' '.join(chosen.worlds)}")
    if chosen.write and not told:
        EXPECTED.write_text(json.dumps({**expected, **found}, indent=1) + "\n", encoding="utf-8")
        print(f"{EXPECTED.name} is renewed")
        return 0
    told += compare(expected, found)
    for sentence in told:
        print(sentence)
    print(f"{len(told)} digests differ" if told else "all digests are as expected")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main())
