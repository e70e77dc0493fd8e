"""From measured cover to a kind of plant: which reserves, and how different ones, wear as the table says. MODEL 7.7

    lane of stems that cannot break ---how long each is bent---> model of cover ---SciPy---> strength, spread
                         ^                                                                      |
                         +------ measured minus modelled, after a lane with that kind <---------+

How long a stem is bent does not depend on its reserve but for what hangs limp, so one lane serves for any
reserve; what the model leaves out is measured on lanes with the kind that was found, and fitted for again.
Needs SciPy, which nothing else here does: pip install desire-path[fit].
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any, TypeVar

import numpy as np

from .. import lazy
from ..core import _native, side_by_side
from ..errors import DesirePathError
from ..ground.plants import YEAR, Kind, as_kind, share_below
from ..keywords import fields_of
from . import trampling
from .trampling import Lane, Progress, Row

_optimize = lazy.module("scipy.optimize")  # a machine may lack it

TOUGH = 1e6  # a reserve that does not end
SEEDS = (101, 102)  # of the lanes that are fitted to; use others to judge a fit
ROUNDS = 3  # of measuring and fitting again, at most
NEAR = 0.25  # measured and modelled agree [points]
RECOVER_DAYS = 14.0  # a stem that did not break has all its reserve again after so long
WORST = 8.0  # power of the mean error that is made small: high, so that the worst count tells
STRENGTH, SPREAD = (0.01, 1000.0), (0.05, 4.0)  # what is looked at: reserves [s of bending], spreads


T = TypeVar("T")


@dataclass(frozen=True)
class Fitted:
    """A kind and how well it does: counts, the cover that was wanted and that its lanes had [per cent]."""

    kind: Kind
    passes: tuple[int, ...]
    wanted: tuple[float, ...]
    reached: tuple[float, ...]

    @property
    def worst(self) -> float:
        """Largest difference [points]."""
        return max(abs(a - b) for a, b in zip(self.wanted, self.reached))

    @property
    def rms(self) -> float:
        """Root mean square difference [points]."""
        return math.sqrt(sum((a - b) ** 2 for a, b in zip(self.wanted, self.reached)) / len(self.wanted))


@fields_of(lane=Lane)
def fit(
    rows: Iterable[Row],
    kind: Kind | str = "carex",
    *,
    lane: Lane = Lane(),
    seeds: Sequence[int] = SEEDS,
    rounds: int = ROUNDS,
    threads: int = 0,
    progress: Progress | None = None,
) -> Fitted:
    """The kind that wears as a table says, from a kind that looks like it: a Fitted.

    rows: (passes, cover [per cent], days of rest) of trampling.read(), of which those with the same passes count by
    their mean; rows with days of rest tell how fast it grows again, from the lane's mean cover to its mean cover.
    lane: what is trodden, once for each of the seeds, which stand in the place of its own. rounds: how often at most
    lanes are trodden to check, 1 or more. threads: of each lane, 0 = one for each processor. progress: called with
    0..1.
    Found are strength and spread, and regrow_rate and seed_share from rows with days; stems break by wear alone, and
    what did not break recovers in two weeks.
    """
    try:
        optimize = lazy.load(_optimize)
    except ImportError:
        raise DesirePathError(
            "Fitting needs SciPy, which is not here: install it with pip install desire-path[fit], "
            "or pip install scipy."
        ) from None
    if rounds < 1 or not len(seeds):
        raise DesirePathError("A fit treads lanes: give it at least one of rounds and one of seeds.")
    rows, covers = list(rows), dict[int, list[float]]()
    for count, cover, days in rows:
        if not days:
            covers.setdefault(count, []).append(cover)
    fresh = [(count, sum(each) / len(each)) for count, each in sorted(covers.items())]
    if len(fresh) < 2:
        raise DesirePathError("A fit needs the cover after at least two counts of passes: add rows to the table.")
    passes, wanted = tuple(count for count, _ in fresh), np.array([cover for _, cover in fresh])
    if wanted.max() <= 1.0:
        raise DesirePathError("The table's cover seems to be in shares: give it in per cent.")
    tough = _with(as_kind(kind), break_angle=math.pi, recover_rate=0.0, spread=0.0)
    lanes = _Lanes(tough, passes, seeds, rounds, lane, threads, progress)
    bent = lanes.bent()
    missed = np.zeros(len(wanted))  # what the model leaves out [points]
    for _ in range(rounds):
        strength, spread = _solved(optimize, bent, wanted - missed)
        reserve = strength * tough.degrade_rate
        found = _with(tough, strength=reserve, spread=spread, recover_rate=reserve / (RECOVER_DAYS * trampling.DAY))
        reached = lanes.cover(found)
        before, missed = missed, reached - _model(bent, strength, spread)
        if abs(missed - before).max() < NEAR:
            break
    later = [(count, cover, days) for count, cover, days in rows if days]
    if later:
        rate, share = _regrowth(optimize, found, dict(zip(passes, reached)), later)
        found = _with(found, regrow_rate=rate, seed_share=share)
    return Fitted(found, passes, tuple(wanted.tolist()), tuple(reached.tolist()))


def _with(kind: Kind, **numbers: float) -> Kind:
    """A kind with other numbers, which are fields that the core's table gives it."""
    changed: dict[str, Any] = numbers
    return replace(kind, **changed)


class _Lanes:
    """The lanes of all seeds, trodden side by side."""

    def __init__(
        self,
        kind: Kind,
        passes: Sequence[int],
        seeds: Sequence[int],
        rounds: int,
        lane: Lane,
        threads: int,
        progress: Progress | None,
    ) -> None:
        self.kind, self.passes, self.threads, self.progress = kind, passes, threads, progress
        self.lanes = [replace(lane, seed=seed) for seed in seeds]
        self.begun, self.all = 0, rounds + 1

    def _each(self, tread: Callable[[Lane, Progress], T]) -> list[T]:
        base, share = self.begun, [0.0] * len(self.lanes)
        self.begun += 1

        def one(number: int) -> T:
            def report(done: float) -> None:
                share[number] = done
                if self.progress:
                    self.progress((base + sum(share) / len(share)) / self.all)

            return tread(self.lanes[number], report)

        return list(side_by_side(one, range(len(self.lanes)), len(self.lanes)))

    def bent(self) -> list[np.ndarray]:
        """For each count, how long each bend and those below it were bent [s], all seeds together."""
        tough = _with(self.kind, strength=TOUGH)

        def tread(lane: Lane, report: Progress) -> list[np.ndarray]:
            sim, marks = trampling.trodden(tough, self.passes[-1], lane=lane, threads=self.threads)
            bends = sim.plants_shape(0)[0] - 2
            return trampling.read_at(
                sim,
                [marks[n - 1] for n in self.passes],
                marks[-1],
                report,
                lambda: _largest_below(TOUGH - sim.plants_strength(0), bends) / tough.degrade_rate,
            )

        return [np.concatenate(each) for each in zip(*self._each(tread))]

    def cover(self, kind: Kind) -> np.ndarray:
        """Mean cover of the lanes after each count [per cent]."""
        rows = self._each(
            lambda lane, report: trampling.measure(
                kind, lane=lane, passes=self.passes, threads=self.threads, progress=report
            )
        )
        return np.asarray(np.mean([[share for _, share in row] for row in rows], axis=0))


def _largest_below(lost: np.ndarray, bends: int) -> np.ndarray:
    """The most lost by each bend or one below it, for stems of so many bends."""
    return np.maximum.accumulate(lost.reshape(-1, bends), axis=1).ravel()


def _model(bent: list[np.ndarray], strength: float, spread: float) -> np.ndarray:
    """Cover after each count [per cent] where reserves are strength exp(spread z) seconds of bending: the chance that
    a reserve outlasts its stem's bending, TRAIL (6) and (7), over all bends."""
    return np.array(
        [100.0 * share_below((math.log(strength) - np.log(np.maximum(each, 1e-9))) / spread).mean() for each in bent]
    )


def _solved(optimize: ModuleType, bent: list[np.ndarray], wanted: np.ndarray) -> tuple[float, float]:
    """Strength [s] and spread whose modelled cover is nearest to what is wanted."""
    bent = [np.quantile(each, (np.arange(2000) + 0.5) / 2000) for each in bent]  # as good, and faster

    def error(x: np.ndarray) -> float:
        return float((abs(_model(bent, math.exp(x[0]), x[1]) - wanted) ** WORST).mean() ** (1.0 / WORST))

    bounds = [tuple(map(math.log, STRENGTH)), SPREAD]
    first = optimize.brute(error, bounds, Ns=24, finish=None)
    best = optimize.minimize(
        error, first, method="Nelder-Mead", bounds=bounds, options={"xatol": 1e-4, "fatol": 1e-4, "maxiter": 400}
    )
    return float(math.exp(best.x[0])), float(best.x[1])


def _regrowth(
    optimize: ModuleType, kind: Kind, reached: Mapping[int, float], later: Sequence[Row]
) -> tuple[float, float]:
    """(rate [1/s], share of seeds) with which cover comes back as rows with days of rest say; by the rate alone
    where they are one or two."""
    known = [(reached[count] / 100.0, cover / 100.0, days) for count, cover, days in later if count in reached]
    if not known:
        raise DesirePathError("Rows with days of rest have counts of passes that no row without has: add those.")

    def error(rate: float, share: float) -> float:
        grown = _with(kind, regrow_rate=float(rate) / YEAR, seed_share=float(share)).numbers()
        off = [
            abs(_native.plants_regrow(grown, min(alpha, 1.0), days * trampling.DAY) - cover)
            for alpha, cover, days in known
        ]
        return float(sum(each**WORST for each in off) ** (1.0 / WORST))

    def best(share: float) -> Any:
        return optimize.minimize_scalar(lambda rate: error(rate, share), bounds=(0.0, 50.0), method="bounded")

    shares = np.linspace(0.0, 1.0, 101) if len(known) > 2 else [0.0]
    found = min(((best(share), share) for share in shares), key=lambda each: each[0].fun)
    return float(found[0].x) / YEAR, float(found[1])
