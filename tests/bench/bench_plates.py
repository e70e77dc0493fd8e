#!/usr/bin/env python3
"""How near the loads of measured walks come to what force plates said: a table anyone can run.

    PYTHONPATH=addon python tests/bench/bench_plates.py [trial ..]      (all)

First walkers whose forces are known because they were there first, walks to landings; these need no data.
Then each measured trial as it is, then seen otherwise (fewer frames, noise, another floor, fewer bones), then every
constant of contact and loads moved by 30 % either way: what the errors of a foot gain at most.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from scenes import plates, trials  # noqa: E402

from desire_path.loads import walker  # noqa: E402

SEEN = (
    ("as it is", {}, lambda g: g),
    ("120 frames a second", {}, lambda g: g.resample(120.0)),
    ("60", {}, lambda g: g.resample(60.0)),
    ("30", {}, lambda g: g.resample(30.0)),
    ("24", {}, lambda g: g.resample(24.0)),
    ("noise of 1 mm", {}, lambda g: plates.noisy(g, 0.001)),
    ("floor 5 cm up", {}, lambda g: plates.raised(g, 0.05)),
    ("floor 5 cm down", {}, lambda g: plates.raised(g, -0.05)),
    ("floor tilted by 0.5 deg", {}, lambda g: plates.tilted(g, np.radians(0.5))),
    ("floor tilted by 4 deg", {}, lambda g: plates.tilted(g, np.radians(4.0))),
    ("mirrored", {}, plates.mirrored),
    ("no toes", {"without": ("Toe",)}, lambda g: g),
    ("no knees", {"without": ("LeftLeg", "RightLeg", "UpLeg")}, lambda g: g),
    ("no spine", {"without": ("Spine", "Neck")}, lambda g: g),
)


def row(name, found):
    late = 1000 * abs(found.late)
    print(
        f"  {name:26s} {found.rmse[0]:.3f} {found.rmse[1]:.3f}  {found.r[0]:.3f} {found.r[1]:.3f}  "
        f"{found.drive[0]:.3f} {found.drive[1]:.3f}  {found.mean:.3f}  {late.mean():3.0f} {late.max():3.0f}  "
        f"{100 * found.apart[0]:.1f} {100 * found.apart[1]:.1f}"
    )


def known(names):
    print(f"{'known forces':20s} {'RMSE of left and right foot [body weights] at frames a second':s}")
    rates = (240.0, 120.0, 60.0, 48.0, 30.0, 25.0, 24.0)
    print(f"{'':20s} " + "".join(f"{rate:<14.0f}" for rate in rates) + "120, trunk wobbles")
    for name in names:
        rows = [trials.errors(name, rate).rmse for rate in rates] + [trials.errors(name, 120.0, shake=0.0025).rmse]
        print(f"{name:20s} " + "".join(f"{r[0]:.3f} {r[1]:.3f}   " for r in rows))
    print()


def main():
    chosen = sys.argv[1:] or [*trials.TRIALS, *plates.TRIALS]
    unknown = sorted({*chosen} - {*trials.TRIALS, *plates.TRIALS})
    if unknown:
        raise SystemExit(f"There is no trial {unknown[0]}: name some of {', '.join([*trials.TRIALS, *plates.TRIALS])}.")
    known([name for name in trials.TRIALS if name in chosen])
    measured([name for name in plates.TRIALS if name in chosen])


def measured(names):
    print(f"{'left and right foot each':28s} {'RMSE':11s}  {'r':11s}  {'forward':11s}  mean   contacts  pressure")
    print(f"{'':28s} {'body weights':11s} {'':11s}   {'body weights':11s} {'':5s}  mean, most ms  cm")
    for name in names:
        print(name)
        for model in ("inertia", "impulse"):
            gait = plates.trial(name)
            row(model, plates.errors(name, walker.loads(gait, model), gait))
        for words, bones, change in SEEN[1:]:
            gait = change(plates.trial(name, **bones))
            row(words, plates.errors(name, walker.loads(gait), gait))
    print("each constant 30 % less and more: what the RMSE of the foot that suffers most gains [body weights]")
    gaits = {name: plates.trial(name) for name in names}
    rmse = lambda name, **more: plates.errors(name, walker.loads(gaits[name], **more), gaits[name]).rmse
    base = {name: rmse(name) for name in gaits}
    for table, kind in ((walker.LIMITS, "limits"), (walker.OPTIONS, "options")):
        for constant, value in table.items():
            moved = [rmse(name, **{kind: {constant: value * by}}) - base[name] for name in gaits for by in (0.7, 1.3)]
            print(f"  {constant:26s} " + "  ".join(f"{m[np.argmax(abs(m))]:+.3f}" for m in moved))


if __name__ == "__main__":
    main()
