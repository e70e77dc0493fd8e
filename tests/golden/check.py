"""Golden digests: what the product computes, in one number for each world, law and field.

    python tests/golden/check.py            compare with expected.json; what differs is named, and the code is 1
    python tests/golden/check.py flat walk  only these worlds
    python tests/golden/check.py --write    renew expected.json

A change that alters results renews the file in the same commit, and that commit says why. Every world is computed
under both contact laws and both heap laws by one worker, and by 2 or 5. `walk` is a recorded walk whose contacts and
forces are found by every load model, and which is carried along a path and placed on a slope; `bake` is the same walk
baked, in one go and broken off, frame by frame, pass by pass and with spray; `soils` is every soil that has a name,
trodden by one worker and by 2, under both heap laws. worlds.py tells what the worlds hold.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
import tempfile
from dataclasses import fields
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT), str(HERE)]

from worlds import trodden, worlds  # noqa: E402

from desire_path import SOILS, Bake, BakeOptions, BakeOutput, Gait, Ground, Planting, _native, place_feet  # noqa: E402
from desire_path.ground import maps  # noqa: E402
from desire_path.loads import walker  # noqa: E402
from desire_path.motion.scatter import Scatter  # noqa: E402

EXPECTED = HERE / "expected.json"
WORKERS = (2, 5)
LAWS, HEAPS = ("sole", "uniform"), ("rest", "paper")
FIELDS = ("compression", "heap", "pressure_time", "rest", "young_modulus", "soil", "plant_strength", "height_change")
NEW = ("surface_", "carried_", "layer_")  # fields that some grounds have
LEAN = ("lean_x", "lean_y", "crushed")
WALK = ROOT / "addon/desire_path/walks/walk.npz"
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
    """Digest of an EXR's planes and notes, but for the version that wrote it."""
    picture = maps.read(path)
    picture.notes.pop("software", None)
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
    for name in (*FIELDS, *(LEAN if planted else ()), *(name for name in sim.fields if name.startswith(NEW))):
        found[name] = digest(sim.read(name, *world.window))
    found["pressure"] = digest(*pressure)
    found["normal"] = digest(np.array([sim.normal((x, 0.02), 0.05) for x in (0.1, 0.3, 0.7)]))
    if planted:
        found["stems"], found["stems_rested"] = digest(*stems), digest(*plants_of(sim, world.shown))
    told = sim.report() | {f"{name}_{what}": v for name, of in sim.carried().items() for what, v in of.items()}
    for name in sorted(told):
        found[f"report_{name}"] = f"{told[name]:.10g}"
    return found


def soils():
    """Digests of each soil that has a name, {name: {laws: 16 letters}}, and sentences about workers that disagree."""
    found, told = {}, []
    for name in SOILS:
        found[name] = {}
        for law, heap in zip(LAWS, HEAPS):
            alone, other = (
                digest(*(sim.read(each, *window) for each in FIELDS))
                for sim, window in (trodden(name, law, heap, threads) for threads in (1, WORKERS[0]))
            )
            found[name][f"{law} {heap}"] = alone
            if other != alone:
                told.append(f"soils, {name}, {law} {heap}: {WORKERS[0]} workers compute {other}, one computes {alone}")
    return found, told


def rounded(array):
    """To DIGITS digits of its largest number: machines differ beyond them in what NumPy adds up."""
    size = np.nanmax(np.abs(array), initial=0.0)
    return np.round(np.asarray(array) / (size or 1.0), DIGITS) + 0.0


def recorded_walk():
    """Digests of contacts and forces of the walk that comes with the product, by every load model."""
    gait = Gait.load(WALK)

    def tilted(xy):
        return 0.05 * xy[:, 0] - 0.02 * xy[:, 1]

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
    hill = Ground.heights(np.add.outer(np.zeros(40), 0.01 * np.arange(80)), 0.1, -3.0, -2.0)
    for name, moved in (("along", lane(gait)), ("placed", place_feet(gait, hill)), ("resampled", gait.resample(50.0))):
        found[name] = {
            "time": digest(rounded(moved.time)),
            "com": digest(rounded(moved.com)),
            "pose": digest(rounded(moved.pose)),
            "cut": digest(moved.cut),
        }
    return found


def lane(gait):
    """Two passes along a bend."""
    return gait.along([(-1.0, 0.0), (1.0, 0.2), (2.0, 1.0)], 2, scatter=Scatter(lateral=0.1), seed=4, pause=2.0)


def baked():
    """Digests of what bakes write; what workers and a break change is told as a difference."""
    gait, found, told = Gait.load(WALK), {}, []
    plants = [Planting("lawn", density=20.0, seed=3)]
    for name, walk, options in (
        ("frames", gait, {"frame_start": 20, "frame_end": 40, "soils": "soil", "plants": plants, "plant_mesh": True}),
        ("passes", lane(gait), {"soils": "snow", "law": "uniform", "heap": "paper", "load_model": "impulse"}),
        ("spray", gait, {"frame_start": 20, "frame_end": 40, "soils": "dry-sand", "spray": "sand"}),
    ):
        by = [baked_files(walk, threads=1, **options), baked_files(walk, threads=2, broken=True, **options)]
        found[name] = by[0]
        told += [
            f"bake, {name}, {file}: broken off and on two cores it is {by[1].get(file)}, else {by[0].get(file)}"
            for file in sorted(set(by[0]) | set(by[1]))
            if by[0].get(file) != by[1].get(file)
        ]
    return found, told


def baked_files(gait, *, broken=False, **options):
    """Bake, and digest every picture and the plants: {file: 16 letters}, frames as one. broken: off and on again."""
    words = {name: options.pop(name) for name in ("soils", "plants") if name in options}
    records = [
        record(**{each.name: options.pop(each.name) for each in fields(record) if each.name in options})
        for record in (BakeOptions, BakeOutput)
    ]
    if options:
        raise TypeError(f"a bake has no options {', '.join(options)}")
    words |= {"options": records[0], "output": records[1]}
    with tempfile.TemporaryDirectory() as folder:
        if broken:
            steps = Bake(gait, Ground.flat(), folder=folder, cell_size=0.02, **words).run()
            for step in steps:
                if step.fraction > 0.5:
                    break
            steps.close()
        for _ in Bake(gait, Ground.flat(), folder=folder, cell_size=0.02, **words).run():
            pass
        files = {
            file.relative_to(folder).as_posix(): file for file in sorted(Path(folder).rglob("*")) if file.is_file()
        }
        found = {
            name: read_file(file)
            for name, file in files.items()
            if file.suffix == ".exr" and not name.startswith("frames")
        }
        for kind in ("trail", "lean", *(["spray"] if "frames/spray_0000.exr" in files else [])):
            frames = [
                read_file(file)
                for name, file in files.items()
                if name.startswith(f"frames/{kind}_") and file.suffix == ".exr"
            ]
            found[f"{kind} frames"] = digest(np.array(frames, "U16"))
        for name in {"plants.pc2"} & set(files):
            found[name] = digest(np.frombuffer(files[name].read_bytes(), np.uint8))
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
                many = WORKERS[(law == LAWS[0]) == (heap == HEAPS[0])]
                alone, other = (compute(world, law, heap, threads) for threads in (1, many))
                found[name][case] = {"all": digest(np.array([sorted(alone.items())])), **alone}
                complaints += [
                    f"{name}, {case}, {field}: {many} workers compute {other.get(field)}, one computes {alone[field]}"
                    for field in alone
                    if other.get(field) != alone[field]
                ]
    if not names or "walk" in names:
        found["walk"] = recorded_walk()
    if not names or "bake" in names:
        found["bake"], told = baked()
        complaints += told
    if not names or "soils" in names:
        found["soils"], told = soils()
        complaints += told
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
    parser.add_argument(
        "worlds", nargs="*", help="flat, hill, ragged, meadow, passes, walk, bake, soils, bytes; default: all"
    )
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
