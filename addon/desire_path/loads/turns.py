"""A recording in turns: every piece for itself, each size for itself, nothing carries over a cut."""

import re
from dataclasses import dataclass

import numpy as np

from ..core import side_by_side
from ..motion import freeze, tracks
from ..motion import size as sizes
from .below import ground_below
from .checks import Sunk
from .force import GRAVITY, FootForce

ASIDE = 0.3  # a walker put aside is farther up or down than this share of its mass centre's height over its feet


def _spans(gait):
    """(walkers, first sample, sample after the last) of each piece; who jumps has pieces of its own. From a pose
    that stands alone nothing can be told."""
    jumpers = np.unique(gait.jump[:, 1])
    others = np.setdiff1d(np.arange(len(gait.mass)), jumpers)
    for who in [others, *jumpers[:, None]]:
        for first, after in gait.pieces(gait.cuts_of(who)):
            there = np.intersect1d(gait.there(first, after), who)
            if len(there) and (after - first > 1 or len(gait.time) == 1):
                yield there, first, after


@dataclass(frozen=True)
class Turn:
    """Walkers of one size between two cuts, without the holds that interrupt them."""

    gait: object  # their recording
    ground: object
    walkers: np.ndarray
    parts: np.ndarray
    points: np.ndarray
    samples: np.ndarray  # of the whole recording
    holds: tuple  # (first, last) sample of the whole recording
    whole: bool  # no other turn is theirs
    count: int  # points of the whole recording

    def known(self, touching, rest):
        """Clearances (K,), NaN for points that are not there, or whose part never touches where others tell more."""
        clearance = np.full(self.count, np.nan)
        on = self.whole | touching[self.gait.point_part].any(axis=1)
        clearance[self.points] = np.where(on, rest, np.nan)
        return clearance


def turns_of(gait, ground):
    one = ground is None or callable(ground) or np.ndim(ground) == 0
    heights = None if one else ground_below(gait, ground)
    for there, first, after in _spans(gait):
        piece = (gait if len(there) == len(gait.mass) else gait.only(there)).piece(first, after)
        alike = {}
        for number, walker in enumerate(there):
            leg = gait.leg[walker]
            alike.setdefault((leg, freeze.frozen(piece, number, leg / sizes.LEG)), []).append(number)
        for (_, stops), numbers in alike.items():
            own, walkers = piece if len(numbers) == len(there) else piece.only(np.array(numbers)), there[numbers]
            parts = np.flatnonzero(np.isin(gait.limb_walker[gait.part_limb], walkers))
            points = np.flatnonzero(np.isin(gait.point_part, parts))
            samples = first + freeze.kept(after - first, stops)
            yield Turn(
                freeze.without(own, stops) if stops else own,
                ground if one else heights[np.ix_(points, samples)],
                walkers,
                parts,
                points,
                samples,
                tuple((first + a, first + b) for a, b in stops),
                not len(gait.cut),
                len(gait.point),
            )


def let_go(gait, touching):
    """Nothing touches at the samples on either side of a cut, nobody who jumps there: a sole presses all the way
    between two samples if it touches at either."""
    owner = gait.limb_walker[gait.part_limb]
    for w in range(len(gait.mass)):
        cut = gait.cuts_of([w])
        for beside in (cut, cut - 1):
            tracks.put(touching, np.flatnonzero(owner == w), beside, 0)
    return touching


def middle(clearance, points):
    """Clearance of each point (K,) over all pieces; 0 where none knows."""
    clearance = np.array(clearance).reshape(-1, points)
    known = np.isfinite(clearance).any(axis=0)
    clearance[:, ~known] = 0.0
    return np.nanmedian(clearance, axis=0)


def each_found(turns, find, ground):
    """(turn, what find() tells of it) in their order; a ground that has to be asked is asked by one at a time."""
    turns = list(turns)
    if callable(ground) or len(turns) == 1:
        yield from ((turn, find(turn)) for turn in turns)
        return
    yield from zip(turns, side_by_side(find, turns))


def standing(gait, turns):
    """Those turns, each with its touching and clearance, in which feet stand as high over the ground as in the
    longest stay of the same walker, if it jumps: put aside above or below the ground it presses nothing."""
    jumpers = set(gait.jump[:, 1].tolist())
    if not jumpers:
        return turns
    turns, main = list(turns), {}

    def height(turn, touching, clearance):
        rest = clearance[touching[turn.gait.point_part].any(axis=1)]
        return float(np.median(rest)) if len(rest) else 0.0

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


def together(gait, turns):
    """FootForce of the whole recording from those of its turns, or why there is none."""
    touching, held = tracks.blank(gait.pose, (), "u1", 0), tracks.blank(gait.pose, (), bool, False)
    force, point = tracks.blank(gait.pose, (3,), float, 0.0), tracks.blank(gait.pose, (3,), float, np.nan)
    clearance, told, sunk = [], [], []
    weighed, span = np.zeros(len(gait.mass)), np.zeros(len(gait.mass))

    def known():
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
        told += found.warnings
        if found.mean is not None:
            weighed[turn.walkers] += len(turn.samples) * found.mean
            span[turn.walkers] += len(turn.samples)
    if sunk and not clearance:
        raise sunk[0]
    let_go(gait, touching)
    for on, push, centre in zip(*map(tracks.values, (touching, force, point))):
        push[on == 0], centre[on == 0] = 0.0, np.nan
    return FootForce(
        gait.time,
        touching,
        force,
        point,
        middle(clearance, len(gait.point)),
        weighed / np.maximum(span, 1.0) if span.any() else None,
        _once(told),
        held,
    )


def _with_holds(turn, found, samples):
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


def _weighing(force, mass):
    """Forces (P, 3) of one who stands in the middle of what he did: no more than his weight, straight down."""
    down = np.minimum(force * (0.0, 0.0, 1.0), 0.0)
    return down * min(1.0, mass * GRAVITY / max(-down[:, 2].sum(), 1e-9))


def _once(warnings):
    """Sentences that differ in their numbers only are told once."""
    told = {}
    for warning in warnings:
        told.setdefault(re.sub(r"-?\d+\.\d+", "#", warning), warning)
    return tuple(told.values())
