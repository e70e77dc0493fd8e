"""A recording in turns: every piece for itself, each size for itself, nothing carries over a cut."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from ..arrays import Record
from ..core import side_by_side
from ..motion import freeze, tracks
from ..motion import size as sizes
from ..motion.gait import Gait
from ..motion.tracks import Array
from .below import GivenHeights, GroundHeights, heights_given, heights_of, is_alike
from .checks import Sunk, never
from .force import GRAVITY, FootForce

ASIDE = 0.3  # a walker put aside is farther up or down than this share of its mass centre's height over its feet


T = TypeVar("T")


def _spans(gait: Gait) -> Iterator[tuple[np.ndarray, int, int]]:
    """(walkers, first sample, sample after the last) of each piece; who jumps has pieces of its own. From a pose
    that stands alone nothing can be told. Who carves is asked for no forces."""
    carving = gait.carving()
    jumpers = np.unique(gait.jump[:, 1])
    others = np.setdiff1d(np.arange(len(gait.mass)), jumpers)
    for who in [others, *jumpers[:, None]]:
        for first, after in gait.pieces(gait.cuts_of(who)):
            there = np.intersect1d(gait.there(first, after), who)
            there = there[~carving[there]]
            if len(there) and (after - first > 1 or len(gait.time) == 1):
                yield there, first, after


@dataclass(frozen=True, eq=False, repr=False)
class Turn(Record):
    """Walkers of one size between two cuts, without the holds that interrupt them."""

    gait: Gait  # their recording
    ground: GivenHeights  # heights at its own points and samples, where those are given
    walkers: np.ndarray
    parts: np.ndarray
    points: np.ndarray
    samples: np.ndarray  # of all of the recording
    holds: tuple[tuple[int, int], ...]  # first and last sample of each, of all of the recording
    only: bool  # no other turn is theirs
    count: int  # points of all of the recording

    def known(self, touching: np.ndarray, rest_clearance: np.ndarray) -> np.ndarray:
        """Clearances (K,), NaN for points that are not there, or whose part never touches where others tell more."""
        clearance = np.full(self.count, np.nan)
        on = self.only | touching[self.gait.point_part].any(axis=1)
        clearance[self.points] = np.where(on, rest_clearance, np.nan)
        return clearance


def turns_of(gait: Gait, ground: GroundHeights) -> Iterator[Turn]:
    """The turns of a recording with its legs, over a ground as ground_below() takes it."""
    heights = heights_of(ground)
    given = None if is_alike(heights) else heights_given(gait, heights)
    for there, first, after in _spans(gait):
        piece = (gait if len(there) == len(gait.mass) else gait.only(there)).piece(first, after)
        alike = dict[tuple[float, tuple[tuple[int, int], ...]], list[int]]()
        for number, walker in enumerate(there):
            leg = gait.leg[walker]
            alike.setdefault((leg, freeze.frozen(piece, number, leg / sizes.LEG)), []).append(number)
        for (_, stops), numbers in alike.items():
            own = piece if len(numbers) == len(there) else piece.only(np.array(numbers))
            walkers = there[numbers]
            parts = np.flatnonzero(np.isin(gait.limb_walker[gait.part_limb], walkers))
            points = np.flatnonzero(np.isin(gait.point_part, parts))
            samples = first + freeze.kept(after - first, stops)
            yield Turn(
                freeze.without(own, stops) if stops else own,
                heights if given is None else given[points, first:after][:, samples - first],
                walkers,
                parts,
                points,
                samples,
                tuple((first + a, first + b) for a, b in stops),
                not len(gait.cut),
                len(gait.point),
            )


def let_go(gait: Gait, touching: Array) -> None:
    """Nothing touches at the samples on either side of a cut, nobody who jumps there: a sole presses all the way
    between two samples if it touches at either."""
    owner = gait.limb_walker[gait.part_limb]
    for w in range(len(gait.mass)):
        cut = gait.cuts_of([w])
        for beside in (cut, cut - 1):
            tracks.put(touching, np.flatnonzero(owner == w), beside, 0)


def middle(clearance: Sequence[np.ndarray], points: int) -> np.ndarray:
    """Clearance of each point (K,) over all pieces; 0 where none knows."""
    if not clearance:
        return np.zeros(points)
    pieces = np.array(clearance).reshape(-1, points)
    pieces[:, ~np.isfinite(pieces).any(axis=0)] = 0.0
    return np.asarray(np.nanmedian(pieces, axis=0))


def each_found(turns: Iterable[Turn], find: Callable[[Turn], T], ground: GroundHeights) -> Iterator[tuple[Turn, T]]:
    """(turn, what find() tells of it) in their order; a ground that has to be asked is asked by one at a time."""
    turns = list(turns)
    if callable(ground) or len(turns) == 1:
        yield from ((turn, find(turn)) for turn in turns)
        return
    yield from zip(turns, side_by_side(find, turns))


def standing(gait: Gait, turns: Iterable[tuple[Any, ...]]) -> Iterable[tuple[Any, ...]]:
    """Those turns, each with its touching and clearance, in which feet stand as high over the ground as in the
    longest stay of the same walker, if it jumps: put aside above or below the ground it presses nothing."""
    jumpers = set(gait.jump[:, 1].tolist())
    if not jumpers:
        return turns
    turns = list(turns)
    main: dict[int, tuple[int, float]] = {}

    def height(turn: Turn, touching: np.ndarray, clearance: np.ndarray) -> float:
        used = clearance[touching[turn.gait.point_part].any(axis=1)]
        return float(np.median(used)) if len(used) else 0.0

    for turn, touching, clearance, *_ in turns:
        stay = int(np.count_nonzero(touching))
        main[turn.walkers[0]] = max(main.get(turn.walkers[0], (0, 0.0)), (stay, height(turn, touching, clearance)))
    return [
        (turn, touching, clearance, *more)
        for turn, touching, clearance, *more in turns
        if turn.walkers[0] not in jumpers
        or abs(height(turn, touching, clearance) - main[turn.walkers[0]][1])
        <= ASIDE * np.median(turn.gait.com[0, :, 2] - turn.gait.pose[..., 2].min(axis=0))
    ]


def together(gait: Gait, turns: Iterable[tuple[Turn, FootForce | Sunk]]) -> FootForce:
    """FootForce of the whole recording from those of its turns, or why there is none."""
    touching, held = tracks.blank(gait.pose, (), "u1", 0), tracks.blank(gait.pose, (), bool, False)
    force, point = tracks.blank(gait.pose, (3,), float, 0.0), tracks.blank(gait.pose, (3,), float, np.nan)
    clearance, warnings, sunk, touched = list[np.ndarray](), list[str](), list[Sunk](), set[int]()
    weighed, span = np.zeros(len(gait.mass)), np.zeros(len(gait.mass))

    def known() -> Iterator[tuple[Turn, Array, np.ndarray, FootForce]]:
        for turn, found in turns:
            if isinstance(found, Sunk):
                sunk.append(found)
            else:
                yield turn, found.touching, found.clearance, found

    for turn, *_, found in standing(gait, known()):
        samples = np.union1d(turn.samples, [k for a, b in turn.holds for k in range(a, b + 1)]).astype(np.int64)
        for array, values in zip((touching, force, point, held), _with_holds(turn, found, samples)):
            tracks.put(array, turn.parts, samples, values)
        clearance.append(turn.known(found.touching, found.clearance))
        warnings += found.warnings
        touched.update(gait.limb_walker[gait.part_limb[turn.parts[found.touching.any(axis=1)]]].tolist())
        if found.mean is not None:
            weighed[turn.walkers] += len(turn.samples) * found.mean
            span[turn.walkers] += len(turn.samples)
    there = {never(str(gait.walker_name[walker])) for walker in touched}  # in another piece
    warnings = [each for each in warnings if each not in there]
    if sunk and not clearance:
        raise sunk[0]
    for on, push, centre in zip(*map(tracks.values, (touching, force, point))):
        push[on == 0], centre[on == 0] = 0.0, np.nan
    let_go(gait, touching)  # the interval up to a cut and that after it have the forces of both of their ends
    return FootForce(
        gait.time,
        touching,
        force,
        point,
        middle(clearance, len(gait.point)),
        weighed / np.maximum(span, 1.0) if span.any() else None,
        _once(warnings),
        held,
    )


def _with_holds(
    turn: Turn, found: FootForce, samples: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """touching, force, point and held of a turn at all of its samples, those of its holds among them."""
    shape = (len(turn.parts), len(samples))
    touching, force, point, held = (
        np.zeros(shape, "u1"),
        np.zeros(shape + (3,)),
        np.full(shape + (3,), np.nan),
        np.zeros(shape, bool),
    )
    at = np.searchsorted(samples, turn.samples)
    touching[:, at], force[:, at], point[:, at] = found.touching, found.force, found.point
    for first, last in np.searchsorted(samples, np.array(turn.holds, int).reshape(-1, 2)).tolist():
        held[:, first:last] = True
        stay = slice(first + 1, last + 1)
        touching[:, stay], point[:, stay] = touching[:, first, None], point[:, first, None]
        force[:, stay] = _weighing(force[:, first], turn.gait.mass[0])[:, None]
        force[:, last] = force[:, first]  # and goes on as it came
    return touching, force, point, held


def _weighing(force: np.ndarray, mass: float) -> np.ndarray:
    """Forces (P, 3) of one who stands in the middle of what he did: no more than his weight, straight down."""
    down = np.minimum(force * (0.0, 0.0, 1.0), 0.0)
    return np.asarray(down * min(1.0, mass * GRAVITY / max(-down[:, 2].sum(), 1e-9)))


def _once(warnings: Iterable[str]) -> tuple[str, ...]:
    """Sentences that differ in their numbers only are told once."""
    first: dict[str, str] = {}
    for warning in warnings:
        first.setdefault(re.sub(r"-?\d+\.\d+", "#", warning), warning)
    return tuple(first.values())
