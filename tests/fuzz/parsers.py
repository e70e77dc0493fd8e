"""Every parser of the add-on is given damaged files: it reads them or says so in a sentence, quickly and in little
memory.

    python tests/fuzz/parsers.py                       20,000 files for every parser
    python tests/fuzz/parsers.py --runs 1000000 index  so many for one
    python tests/fuzz/parsers.py --seed 7 ..           other files; the same seed makes the same ones
    python tests/fuzz/parsers.py --longest 60 ..       no new file after a minute of one parser

A find is any exception but DesirePathError, a crash, more than 5 s or 400 MB for one file. It is kept in
the folder --finds. The run closes with `N passed, N failed`.
"""

import argparse
import faulthandler
import json
import math
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
for folder in (ROOT, ROOT / "addon"):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))

from desire_path.bake import folder as bake_folder  # noqa: E402
from desire_path.bake import output  # noqa: E402
from desire_path.bake.bake import Bake  # noqa: E402
from desire_path.errors import DesirePathError  # noqa: E402
from desire_path.ground import maps  # noqa: E402
from desire_path.ground.options import SimulationOptions  # noqa: E402
from desire_path.ground.plants import KINDS, Kind  # noqa: E402
from desire_path.ground.sim import Ground, Simulation  # noqa: E402
from desire_path.ground.soil import SOILS, Soil  # noqa: E402
from desire_path.motion.gait import Gait  # noqa: E402
from desire_path.placement import path  # noqa: E402
from desire_path.study import trampling  # noqa: E402
from tests.fuzz import mutate  # noqa: E402
from tests.scenes import gaits  # noqa: E402

LONG = 5  # [s] of computing for one file
STUCK = 300  # [s] of any time for one file
MUCH = 400 << 20  # [bytes] for one file
ROOM = 4 << 30  # [bytes] of address space that a parser has in all
POOL = 64  # files that are damaged further: good ones, and damaged ones that were read
SHARED = "/dev/shm" if os.path.isdir("/dev/shm") else None  # where files are made: in memory, if there is such a place


class Slow(Exception):
    """Raised in a parser that takes too long."""


# ---- what is parsed: (name, a folder) -> good files, the way to the damaged one, the call -------------------------


def _baked(place):
    """A bake of a few frames, with plants."""
    gait, _ = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=0.2, rate=24.0)
    for _ in Bake(gait, Ground.flat(), "mud", place, cell_size=0.05, plants=["moss"]).run():
        pass


def index(place):
    _baked(place / "bake")
    at = place / "bake" / "frames" / "index.json"
    return [at.read_bytes()], at, lambda: bake_folder.read_index(str(place / "bake")), mutate.tree


def frame(place):
    _baked(place / "bake")
    frames = place / "bake" / "frames"
    good = [(frames / name).read_bytes() for name in ("trail_0001.exr", "lean_0002.exr", "trail_0000.exr")]
    return good, frames / "trail_0001.exr", lambda: bake_folder.read_index(str(place / "bake")), mutate.any_bytes


def sums(place):
    _baked(place / "bake")
    frames = place / "bake" / "frames"
    at = frames / bake_folder.SUMS
    return [at.read_bytes()], at, lambda: bake_folder.frames_sound(str(frames), True), mutate.text


def recording(place):
    made = []
    for number, gait in enumerate(
        (
            gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=0.1, rate=30.0)[0],
            gaits.strides(0.3, rate=24.0)[0],
        )
    ):
        gait.save(place / f"{number}.npz")
        made.append((place / f"{number}.npz").read_bytes())
    return made, place / "walk.npz", lambda: Gait.load(place / "walk.npz"), mutate.archive


def kind(place):
    made = []
    for name in ("carex", "moss"):
        KINDS[name].save(place / f"{name}.json")
        made.append((place / f"{name}.json").read_bytes())
    return made, place / "kind.json", lambda: Kind.load(place / "kind.json").numbers(), mutate.tree


def soil(place):
    made = []
    for name in ("mud", "dry-sand"):
        SOILS[name].save(place / f"{name}.json")
        made.append((place / f"{name}.json").read_bytes())
    return made, place / "soil.json", lambda: Soil.load(place / "soil.json"), mutate.tree


def way(place):
    made = [b"x,y\n0,0\n1,0.5\n2,3\n", b"name,X , y,z\na,0,0,0\nb,1,2,3\n\nc,-4.5,6,7\n"]
    return made, place / "path.csv", lambda: path.read(place / "path.csv"), mutate.text


def cover(place):
    made = [b"passes,cover\n25,86.3\n75,70.4\n", b"Passes , cover,days\n25,86.3,14\n200,39.8,365\n"]
    return made, place / "cover.csv", lambda: trampling.read(place / "cover.csv"), mutate.text


def picture(place):
    import numpy as np

    made = []
    grid = np.linspace(0, 1, 35, dtype=np.float32).reshape(5, 7)
    notes = {"cell": 0.1, "originX": 1.0, "originY": -2.0, "parameters": '{"ground": "flat"}'}
    for names in (("height",), ("rest", "compression", "heap", "pressure_time", "plant_strength")):
        maps.write(place / "good.exr", dict.fromkeys(names, grid), notes)
        made.append((place / "good.exr").read_bytes())

    def read():
        ground = Ground.read(place / "map.exr")
        for cell in (0.1, 0.25):  # the good trail's own, and others
            Simulation(ground, cell_size=cell, options=SimulationOptions(threads=1))

    return made, place / "map.exr", read, mutate.any_bytes


def notes(place):
    """The parameters, soils among them, that a trail's header keeps as JSON."""
    import numpy as np

    (place / "bake").mkdir()
    for _ in Bake(gaits.strides(0.3, rate=24.0)[0], Ground.flat(), "mud", place / "bake", cell_size=0.05).run():
        pass
    good = json.dumps(json.loads((place / "bake" / "report.json").read_text())["parameters"])
    left = np.ones((4, 5), np.float32)
    fixed = {"cell": 0.1, "originX": 1.0, "originY": -2.0}

    def read():
        said = (place / "notes.json").read_bytes().replace(b"\0", b" ").decode("utf-8", "replace")
        maps.write(place / "map.exr", {"rest": left, "compression": left}, {**fixed, "parameters": said})
        assert Ground.read(place / "map.exr").trail.cell == 0.1

    return [good.encode(), b'{"ground": "mesh", "soils": []}'], place / "notes.json", read, mutate.tree


def report(place):
    """What was left of a bake, by which its files are known."""
    _baked(place / "bake")
    at = place / "bake" / "report.json"
    good = at.read_bytes()
    for gone in ("frames", "maps"):
        shutil.rmtree(place / "bake" / gone, ignore_errors=True)

    def read():
        out = output.Output(place / "bake")
        out.open()
        out.release()

    return [good, b'{"version": 1, "parameters": {}}'], at, read, mutate.tree


def shown(place):
    """The list of a bake that is taking another one's place on a disk without links."""
    (place / "bake").mkdir()
    good = [json.dumps(names).encode() for names in (output.NAMES, ["frames", "report.json"])]

    def read():
        out = output.Output(place / "bake")
        out.open()
        out.release()

    return good, place / "bake" / output.SHOWN, read, mutate.tree


PARSERS = {
    each.__name__: each
    for each in (index, frame, sums, recording, kind, soil, way, cover, picture, notes, report, shown)
}


# ---- one parser ---------------------------------------------------------------------------------------------------


def _late(number, stack):
    raise Slow(f"computed for longer than {LONG} s" if number == signal.SIGPROF else f"was stuck for {STUCK} s")


def _limit(computing, any_time):
    signal.setitimer(signal.ITIMER_PROF, computing)
    signal.setitimer(signal.ITIMER_REAL, any_time)


def attempt(call):
    """What is wrong with how a call ends, and whether it read its file."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    _limit(LONG, STUCK)
    try:
        call()
        wrong, read = None, True
    except DesirePathError as told:
        said = str(told)
        wrong, read = None if said.endswith(".") and len(said) < 1000 else f"says {said[:1000]!r}", False
    except Exception:
        wrong, read = traceback.format_exc(limit=-4), False
    finally:
        _limit(0, 0)
    taken = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) << 10
    return wrong or (f"took {taken >> 20} MB" if taken > MUCH else None), read


def fuzz(name, runs, seed, place, finds, longest=math.inf, most=3):
    """Damage the good files of a parser in the folder `place`, `runs` times or for `longest` seconds.

    What was found, at most `most`, and how many files were tried.
    """
    end = time.monotonic() + longest
    for limit in (signal.SIGPROF, signal.SIGALRM):
        signal.signal(limit, _late)
    warnings.simplefilter("ignore")
    chance = random.Random(f"{name} {seed}")
    good, at, call, change = PARSERS[name](place)
    for data in good:
        at.write_bytes(data)
        wrong, read = attempt(call)
        if wrong or not read:
            return [f"a good file is not read: {wrong}"], 0
    pool, found = list(good), []
    run = 0
    while run < runs and time.monotonic() < end and len(found) < most:
        data = chance.choice(pool)
        for _ in range(chance.choice((1, 1, 2, 3, 8))):
            data = change(chance, data, chance.choice(good))
        at.write_bytes(data)
        wrong, read = attempt(call)
        if read and len(data) < 1 << 16 and chance.random() < 0.2:  # to be damaged further
            if len(pool) < POOL:
                pool.append(data)
            else:
                pool[chance.randrange(len(good), POOL)] = data
        if wrong:
            shutil.copy(at, finds / f"fuzz_{name}_{run}")
            found.append(f"file {run}, kept as fuzz_{name}_{run}: {wrong}")
        run += 1
    return found, run


def crashed(name, place, finds):
    """Keep what lies in the folder of a parser that ended badly."""
    kept = finds / f"fuzz_{name}_crash"
    shutil.rmtree(kept, ignore_errors=True)
    shutil.copytree(place, kept)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("parsers", nargs="*", choices=[[], *PARSERS], help="all, if none is named")
    parser.add_argument("--runs", type=int, default=20000, help="damaged files for each (20000)")
    parser.add_argument("--longest", type=float, default=math.inf, help="seconds for each (no limit)")
    parser.add_argument("--seed", type=int, default=1, help="of the damage (1)")
    parser.add_argument(
        "--finds", type=pathlib.Path, default=pathlib.Path(), help="folder for what was found (this one)"
    )
    parser.add_argument("--place", type=pathlib.Path, help="fuzz the one parser in this process, in this folder")
    args = parser.parse_args()
    names = args.parsers or list(PARSERS)
    if args.place:
        faulthandler.enable()
        resource.setrlimit(resource.RLIMIT_AS, (ROOM, ROOM))
        found, tried = fuzz(names[0], args.runs, args.seed, args.place, args.finds, args.longest)
        print("\n".join([*found, f"{tried} files"]))
        sys.exit(1 if found else 0)

    def one(name):
        with tempfile.TemporaryDirectory(prefix="desire_path_fuzz_", dir=SHARED) as place:
            done = subprocess.run(
                [
                    sys.executable,
                    __file__,
                    name,
                    "--place",
                    place,
                    "--finds",
                    args.finds,
                    "--runs",
                    str(args.runs),
                    "--longest",
                    str(args.longest),
                    "--seed",
                    str(args.seed),
                ],
                capture_output=True,
                text=True,
            )
            if done.returncode not in (0, 1):
                crashed(name, place, args.finds)
        return done

    failed = 0
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        for name, done in zip(names, pool.map(one, names)):
            bad = done.returncode != 0
            failed += bad
            tried = done.stdout.splitlines()[-1] if done.returncode in (0, 1) and done.stdout else "no count of files"
            print(f"{'FAIL' if bad else 'ok  '} {name}, {tried}", flush=True)
            if bad:
                print(f"{done.stdout}{done.stderr}ended with code {done.returncode}", flush=True)
    print(f"{len(names) - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
