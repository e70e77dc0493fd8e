"""bench_lane.py - seconds of a lane that is trodden: 0.5 x 5 m, 200 plants, soil at 1 cm.

    python tests/bench/bench_lane.py [passes, 500]

Aim: 500 passes in under 60 s on two cores. The lane's cover and soil are worked out on one core and on all;
making the passes and finding their forces is told apart.
"""

import os
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
from desire_path.ground.plants import KINDS  # noqa: E402
from desire_path.loads import walker  # noqa: E402
from desire_path.motion.scatter import Scatter  # noqa: E402
from desire_path.study import trampling  # noqa: E402


def main():
    passes = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    begun = time.perf_counter()
    gait = trampling.walk().along(
        [(-trampling.BEYOND, 0.0), (5.0 + trampling.BEYOND, 0.0)], passes, scatter=Scatter(trampling.SCATTER * 0.5)
    )
    made = time.perf_counter()
    walker.loads(gait)
    print(
        f"{passes} passes, {len(gait.time)} samples: made in {made - begun:.2f} s, "
        f"forces in {time.perf_counter() - made:.2f} s"
    )
    for threads in sorted({1, os.cpu_count() or 1}):
        sim, marks = trampling.trodden(
            KINDS["carex"], passes, lane=trampling.Lane(cell_size=0.01, density=80.0), threads=threads
        )
        begun, spent = time.perf_counter(), time.process_time()
        sim.run(marks[-1])
        took, spent = time.perf_counter() - begun, time.process_time() - spent
        print(
            f"{threads} threads: {took:.1f} s ({spent:.1f} s of processors), {1e3 * spent / len(gait.time):.3f} ms a "
            f"step, {sim.plants_count()} plants, cover {trampling.cover(sim):.1f} %"
        )


if __name__ == "__main__":
    main()
