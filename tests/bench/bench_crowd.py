"""bench_crowd.py - what it takes to press the feet of a crowd, and how it grows with walkers and ground.

    python tests/bench/bench_crowd.py [walkers, 8] [steps of each, 60] [side of the ground, 100 m]

Walkers go one after the other, as the feet of a crowd do, straight and from anywhere; cells of 1 cm, soil, no plants.
Told for half of them and for all: seconds of processors for poses and forces and for the ground, tiles that were
touched, and memory. Steps and tiles grow with the walkers; what a step takes does not.
"""

import pathlib
import resource
import sys
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
from desire_path.ground.sim import Ground, Simulation  # noqa: E402
from desire_path.loads import walker  # noqa: E402
from desire_path.study import trampling  # noqa: E402

STRIDE = 0.75  # of a step [m], about


def main():
    walkers, steps, side = (int(sys.argv[k]) if len(sys.argv) > k else n for k, n in ((1, 8), (2, 60), (3, 100)))
    rng, gait = np.random.default_rng(1), trampling.walk()
    sim = Simulation(Ground.flat(), "soil", 0.01)
    spent, before = {"poses": 0.0, "ground": 0.0}, _memory()
    for number in range(1, walkers + 1):
        begun = time.process_time()
        start, turn = rng.uniform(0, side, 2), rng.uniform(0, 2 * np.pi)
        goal = start + STRIDE * steps * np.array([np.cos(turn), np.sin(turn)])
        walk = gait.along([start, goal]).resample(60.0)
        loads = walker.loads(walk)
        made = time.process_time()
        sim.load(walk, loads)
        sim.run(len(walk.time) - 1)
        spent["poses"] += made - begun
        spent["ground"] += time.process_time() - made
        if number in (walkers // 2, walkers):
            found = sim.report()
            feet = max(found["contacts"], 1)
            print(
                f"{number} walkers, {feet} contacts: {1e3 * spent['poses'] / feet:.2f} ms of poses and forces and "
                f"{1e3 * spent['ground'] / feet:.2f} ms of ground for each, {found['tiles']} tiles, "
                f"{(_memory() - before) / max(found['tiles'], 1):.0f} KB for each"
            )


def _memory():
    """The most that this process has held [KB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


if __name__ == "__main__":
    main()
