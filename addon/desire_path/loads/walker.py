"""From a recording to the forces its feet put on the ground. TRAIL (3) (4), MODEL 4.2 and 4.3."""

import csv
import re
from dataclasses import dataclass, field, replace
from warnings import warn

import numpy as np

from ..arrays import Record, kept
from ..core import _native, side_by_side
from ..errors import DesirePathError
from ..files import atomic_file
from ..motion import freeze, jumps, tracks
from ..motion import size as sizes
from ..motion.points import point_places

RATE = 240.0  # a person's loads are found at this rate at least, the least multiple of the recording's own [1/s]
PRESSES, ELSEWHERE = 1, 2  # touching: the ground | something else, which carries and takes no print
TELLING = 0.5  # who stands there for less is not told of [s]
OFF_GROUND = 0.06  # what is farther over the ground stands on something else [leg lengths]
MODELS = {"inertia": 0, "impulse": 1}
MEAN_FORCE = (0.9, 1.1)  # what a believable clip's mean vertical force is within [body weights]
GRAVITY = 9.81
SLIDE = 0.4  # a person's feet that stand do not slide faster [m/s]
STILL = 0.25  # who stands moves no foot faster [m/s]
HOVER = 0.1  # a person's feet that stand do not do so farther from the ground [m]
ASIDE = 0.3  # a walker put aside is farther up or down than this share of its mass centre's height over its feet
BESIDE = "Some steps land beside the ground and leave no print there."

# Those of a grown person: lengths go with a walker's leg, times and speeds with its root (see size).
# Names and defaults of DpContactLimits and DpLoadOptions in native/walker/walker.h, in their order.
LIMITS = {
    "touch_height": 0.03,
    "release_height": 0.03,
    "release_height_toe": 0.05,
    "touch_speed": 0.3,
    "touch_speed_share": 0.4,
    "release_speed": 1.2,
    "slow_speed": 0.25,
    "shortest": 0.03,
    "point_cutoff": 20.0,
    "com_cutoff": 3.0,
    "support_fall": 0.5,
    "frame_time": 0.0,
}
OPTIONS = {
    "cutoff_share": 3.0,
    "cutoff_low": 5.0,
    "cutoff_high": 10.0,
    "cutoff_flight": 8.0,
    "cutoff_knock": 20.0,
    "noise_share": 2.0,
    "cutoff_level": 2.0 / 3.0,
    "overlap_most": 0.3,
    "ramp_standing": 0.1,
    "ramp_alone": 0.03,
    "ramp_trust": 0.25,
    "reach": 0.3,
    "frame_time": 0.0,
}


@dataclass(frozen=True, eq=False, repr=False)
class FootForce(Record):
    time: np.ndarray  # (T,) [s]
    touching: np.ndarray  # 1 where the part touches (P, T) u1
    force: np.ndarray  # of the part on the ground (P, T, 3) [N]
    point: np.ndarray  # centre of pressure, NaN in the air (P, T, 3) [m]
    clearance: np.ndarray  # resting height of each contact point over the ground (K,) [m]
    mean: np.ndarray | None = None  # mean vertical force of each walker (W,) [body weights]
    warnings: tuple = ()
    held: np.ndarray | None = None  # parts held in mid-step from these samples to the next press no deeper (P, T)

    def __post_init__(self):
        for name in ("time", "touching", "force", "point", "clearance", "mean", "held"):
            object.__setattr__(self, name, kept(getattr(self, name)))

    def __repr__(self):
        parts, samples = np.shape(self.touching)
        return f"FootForce({parts} parts, {samples} samples, {len(self.warnings)} warnings)"


def native_gait(gait):
    return (
        gait.time,
        gait.com,
        gait.mass,
        gait.pose,
        gait.limb_walker,
        gait.part_limb,
        gait.point,
        gait.point_part,
        gait.point_role,
    )


def _numbers(defaults, chosen):
    unknown = set(chosen or ()) - set(defaults)
    if unknown:
        raise DesirePathError(f"There is no setting {sorted(unknown)[0]}: use one of " + ", ".join(defaults) + ".")
    return np.array([float({**defaults, **(chosen or {})}[name]) for name in defaults])


def ground_below(gait, ground):
    """Height of the ground below each contact point (K, T) [m].

    ground: None = flat at 0; a number; heights (K, T); a function of points (n, 2) -> (n,); or what has one by the
    name of rest_height, as a Simulation. NaN where there is none: feet that step there carry their share and leave it
    to nobody else.
    """
    ground = _heights_of(ground)
    shape = (len(gait.point), len(gait.time))
    if callable(ground):
        xy = point_places(gait)[..., :2].reshape(-1, 2)
        heights = np.asarray(ground(np.ascontiguousarray(xy)), float).reshape(shape)
    else:
        heights = np.asarray(0.0 if ground is None else ground, float)
        if heights.shape not in ((), shape):
            raise DesirePathError(
                f"The ground's heights have shape {heights.shape} where {shape} is "
                "needed: give one height for each contact point and sample."
            )
    return np.ascontiguousarray(np.broadcast_to(heights, shape), "f8").copy()


def _heights_of(ground):
    """A ground as ground_below() takes it, with a Simulation's function of places in its stead."""
    return getattr(ground, "rest_height", ground)


def _even(gait, size):
    """(gait at a rate fit for filters, each how many samples of which are the recording's; 0: they lie elsewhere)."""
    rate, least = gait.rate(), RATE / np.sqrt(size)
    if len(gait.time) == 1:
        return gait, 1
    if rate is None:
        return gait.evenly(least), 0
    finer = int(np.ceil(least / rate - 1e-6))
    return (gait.evenly(rate * finer), finer) if finer > 1 else (gait, 1)


def _frames(gait):
    """Frames a second that were recorded: the scene's, or the recording's if those are fewer."""
    span = gait.time[-1] - gait.time[0]
    return min(gait.frame_rate, (len(gait.time) - 1) / span) if span > 0 else gait.frame_rate


def _find_contacts(gait, below, limits, frame_rate):
    touching = np.zeros((len(gait.part_limb), len(gait.time)), "u1")
    clearance = np.zeros(len(gait.point))
    limits = {"frame_time": 1.0 / frame_rate, **(limits or {})}
    _native.foot_contact(native_gait(gait), below, touching, clearance, _numbers(LIMITS, limits))
    return touching, clearance


def contacts(gait, ground=None, *, limits=None, ground_height=None):
    """(touching (P, T) u1, clearance (K,)) at the recording's samples. TRAIL (4)

    ground: see ground_below; ground_height is an old name of it.
    """
    if ground_height is not None:
        warn("ground_height is an old name: give contacts() ground.", DeprecationWarning, stacklevel=2)
        ground = ground_height
    ground = _heights_of(ground)
    gait = sizes.known(jumps.found(gait.check()))
    touching, clearance = np.zeros((len(gait.part_limb), len(gait.time)), "u1"), []
    known = ((turn, *_contacts_of(turn.gait, turn.ground, limits)) for turn in _turns(gait, ground))
    for turn, on, rest in _standing(gait, known):
        touching[np.ix_(turn.parts, turn.samples)] = on
        clearance.append(turn.known(on, rest))
        for first, last in turn.holds:
            touching[np.ix_(turn.parts, range(first + 1, last + 1))] = touching[turn.parts, first][:, None]
    return _let_go(gait, touching), _middle(clearance, len(gait.point))


def _contacts_of(gait, ground, limits):
    """contacts() of walkers of one size, in one turn."""
    size = gait.leg[0] / sizes.LEG
    even, every = _even(gait, size)
    below = _on_even(gait, even, ground)
    person = sizes.as_person(even, size)
    touching, clearance = _find_contacts(person, _carried_on(even, below) / size, limits, _frames(gait) * np.sqrt(size))
    touching[_beside(even, below)] = 0
    pick = slice(None, None, every) if every else _nearest(even.time, gait.time)
    return touching[:, pick], clearance * size


def _on_even(gait, even, ground):
    """Ground heights for the even recording; heights given for the recording itself are carried over."""
    if even is gait or callable(ground) or np.ndim(ground) == 0:
        return ground_below(even, ground)
    return np.stack([np.interp(even.time, gait.time, row) for row in ground_below(gait, ground)])


def _carried_on(gait, below):
    """Heights as if the ground went on beside its edge and over its holes, between those the same
    point finds before and after, else those of its walker. Who is never over it keeps NaN."""
    if np.isfinite(below).all():
        return below
    below, sample = below.copy(), np.arange(len(gait.time))
    owner = gait.limb_walker[gait.part_limb[gait.point_part]]
    for w in range(len(gait.mass)):
        rows = np.flatnonzero(owner == w)
        there = np.isfinite(below[rows])
        some = there.any(axis=0)
        if not some.any():
            continue
        mean = np.where(there, below[rows], 0.0).sum(axis=0)[some] / there.sum(axis=0)[some]
        for row, known in zip(rows, there):
            if known.any():
                below[row] = np.interp(sample, sample[known], below[row, known])
            else:
                below[row] = np.interp(sample, sample[some], mean)
    return below


def _beside(gait, below):
    """Where the whole limb of a part is beside the ground (P, T)."""
    over = np.zeros((len(gait.limb_walker), len(gait.time)), bool)
    np.logical_or.at(over, gait.part_limb[gait.point_part], np.isfinite(below))
    return ~over[gait.part_limb]


def _nearest(have, want):
    after = np.clip(np.searchsorted(have, want), 1, len(have) - 1) if len(have) > 1 else np.zeros(len(want), int)
    before = np.maximum(after - 1, 0)
    return np.where(abs(have[before] - want) <= abs(have[after] - want), before, after)


def loads(gait, model="inertia", ground=None, *, settle_time=0.2, half_sine=False, limits=None, options=None, cell=0.0):
    """FootForce of a recording at its own samples. TRAIL (3), SOFT22 (3)-(8)

    model: "inertia" (Newton on the recorded mass centre) or "impulse" (the papers'; settle_time is its
    tau [s], of the soil that is landed on: a number, or a function of places (n, 2) [m] that tells it (n,);
    half_sine spreads the landing as a half-sine). ground: see ground_below. cell: of the ground's grid [m], by which
    nothing finer can be told apart.
    What stands on something that is not the ground (a box, a deck, stairs that were left out) is carried there: its
    force is told, and `touching` is ELSEWHERE.
    """
    ground = _heights_of(ground)
    told, gait = len(gait.warnings), sizes.known(jumps.found(gait.check()))
    if model not in MODELS:
        raise DesirePathError(f"There is no load model {model}: use " + " or ".join(MODELS) + ".")
    if not callable(settle_time) and not (np.isfinite(settle_time) and settle_time > 0):
        raise DesirePathError(f"A settle time of {settle_time:g} s cannot be used: give one above 0.")

    def find(turn):
        try:
            return _loads_of(turn.gait, model, turn.ground, settle_time, half_sine, limits, options, cell)
        except _Sunk as problem:
            if len(gait.cut):
                return problem
            raise

    found = _together(gait, _side_by_side(_turns(gait, ground), find, ground))
    return replace(found, warnings=gait.warnings[told:] + found.warnings)


def _loads_of(gait, model, ground, settle_time, half_sine, limits, options, cell):
    """loads() of walkers of one size, in one turn."""
    size = gait.leg[0] / sizes.LEG
    even, every = _even(gait, size)
    below = _on_even(gait, even, ground)
    beside, below = _beside(even, below), _carried_on(even, below)
    person, floor = sizes.as_person(even, size), below / size
    touching, clearance = _find_contacts(person, floor, limits, _frames(gait) * np.sqrt(size))
    force = np.zeros(touching.shape + (3,))
    point = np.zeros(touching.shape + (3,))
    options = {"frame_time": 1.0 / (_frames(gait) * np.sqrt(size)), **(options or {})}
    tau, taus = settle_time, None
    if callable(tau):
        tau = 1.0
        if model == "impulse":  # no other asks for it
            taus = _settles(even, touching, settle_time) / np.sqrt(size)
    _native.foot_force(
        native_gait(person),
        touching,
        floor,
        MODELS[model],
        tau / np.sqrt(size),
        bool(half_sine),
        force,
        point,
        _numbers(OPTIONS, options),
        taus,
    )
    point, clearance = point * size, clearance * size
    mean, warnings = _weigh(person, touching, force) if model == "inertia" else (None, [])
    places = point_places(even)
    told = _sinks(even, below) + _hovers(even, touching, clearance, size) + _slides(even, places, touching, size)
    warnings = told + warnings
    if (touching[beside] != 0).any():
        warnings.append(BESIDE)
    touching[beside], force[beside], point[beside] = 0, 0.0, np.nan
    over = places[..., 2] - below - clearance[:, None]
    warnings += _elsewhere(even, over, touching, max(OFF_GROUND * gait.leg[0], 2.0 * cell), size)
    if every > 1:
        touching, force, point = (np.ascontiguousarray(each[:, ::every]) for each in (touching, force, point))
    elif not every:
        touching, force, point = _at(gait.time, even.time, touching, force, point)
    return FootForce(gait.time, touching, force, point, clearance, mean, tuple(warnings))


def _settles(gait, touching, tau):
    """tau of the soil under each point where its part touches (K, T), 1 elsewhere [s]."""
    on = (touching != 0)[gait.point_part]
    out = np.ones(on.shape)
    if on.any():
        out[on] = tau(np.ascontiguousarray(point_places(gait)[on][:, :2]))
    return out


def _elsewhere(gait, over, touching, most, size):
    """Mark parts that stand farther over the ground than `most` [m]; sentences about who does.

    over: height of each contact point over the ground, less its clearance (K, T) [m]
    """
    lowest = np.stack(
        [
            np.nanmin(np.where(np.isfinite(over), over, np.inf)[gait.point_part == part], axis=0)
            for part in range(len(gait.part_limb))
        ]
    )
    up = (touching == PRESSES) & (lowest > most)
    touching[up] = ELSEWHERE
    told = []
    for w, name in enumerate(gait.walker_name):
        when = up[gait.limb_walker[gait.part_limb] == w].any(axis=0)
        edges = np.flatnonzero(np.diff(np.concatenate([[0], when, [0]])))
        if len(edges) and np.diff(edges)[::2].max() >= TELLING * np.sqrt(size) * (gait.rate() or 1.0):
            high = float(np.median(lowest[gait.limb_walker[gait.part_limb] == w][:, when].min(axis=0)))
            told.append(
                f"{name} stands on something else than the ground, of which there is no print: about {high:.2g} "
                f"m over it, first at frame {gait.frame(when.argmax()):.0f}; make that a ground if it is to "
                "take prints."
            )
    return told


# ---- a recording in turns: every piece for itself, each size for itself, nothing carries over a cut ---------


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
class _Turn:
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


def _turns(gait, ground):
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
            yield _Turn(
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


def _let_go(gait, touching):
    """Nothing touches at the samples on either side of a cut, nobody who jumps there: a sole presses all the way
    between two samples if it touches at either."""
    owner = gait.limb_walker[gait.part_limb]
    for w in range(len(gait.mass)):
        cut = gait.cuts_of([w])
        for beside in (cut, cut - 1):
            tracks.put(touching, np.flatnonzero(owner == w), beside, 0)
    return touching


def _middle(clearance, points):
    """Clearance of each point (K,) over all pieces; 0 where none knows."""
    clearance = np.array(clearance).reshape(-1, points)
    known = np.isfinite(clearance).any(axis=0)
    clearance[:, ~known] = 0.0
    return np.nanmedian(clearance, axis=0)


def _side_by_side(turns, find, ground):
    """(turn, what find() tells of it) in their order; a ground that has to be asked is asked by one at a time."""
    turns = list(turns)
    if callable(ground) or len(turns) == 1:
        yield from ((turn, find(turn)) for turn in turns)
        return
    yield from zip(turns, side_by_side(find, turns))


def _standing(gait, turns):
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


def _together(gait, turns):
    """FootForce of the whole recording from those of its turns, or why there is none."""
    touching, held = tracks.blank(gait.pose, (), "u1", 0), tracks.blank(gait.pose, (), bool, False)
    force, point = tracks.blank(gait.pose, (3,), float, 0.0), tracks.blank(gait.pose, (3,), float, np.nan)
    clearance, told, sunk = [], [], []
    weighed, span = np.zeros(len(gait.mass)), np.zeros(len(gait.mass))

    def known():
        for turn, found in turns:
            if isinstance(found, _Sunk):
                sunk.append(found)
            else:
                yield turn, found.touching, found.clearance, found

    for turn, *_, found in _standing(gait, known()):
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
    _let_go(gait, touching)
    for on, push, centre in zip(*map(tracks.values, (touching, force, point))):
        push[on == 0], centre[on == 0] = 0.0, np.nan
    return FootForce(
        gait.time,
        touching,
        force,
        point,
        _middle(clearance, len(gait.point)),
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


def _at(want, have, touching, force, point):
    """Loads at other times: the nearest contact, forces between their neighbours.

    At an edge of contact a force jumps: beside one it is that of the nearest sample, as its contact is.
    """
    near = _nearest(have, want)
    on = np.ascontiguousarray(touching[:, near])
    after = np.clip(np.searchsorted(have, want), 1, len(have) - 1)
    edge = touching[:, after] != touching[:, after - 1]
    new_force, new_point = np.zeros(on.shape + (3,)), point[:, near].copy()
    for p in range(len(on)):
        for c in range(3):
            new_force[p, :, c] = np.where(edge[p], force[p, near, c], np.interp(want, have, force[p, :, c]))
            known = np.isfinite(point[p, :, c])
            if known.any():
                new_point[p, :, c] = np.interp(want, have[known], point[p, known, c])
    new_force[on == 0] = 0.0
    new_point[on == 0] = np.nan
    return on, new_force, new_point


class _Sunk(DesirePathError):
    """A walker is under the ground all the time."""


def _sinks(gait, below):
    """Refuse a walker that is under the ground all the time."""
    ground = np.nanmedian(below) if np.isfinite(below).any() else -np.inf
    for w in range(len(gait.mass)):
        if gait.com[w, :, 2].max() < ground:
            raise _Sunk(
                f"{gait.walker_name[w]} is below the ground all the time, whose highest "
                "faces count: move the ground down or the walker up, or take roofs "
                "out of the ground."
            )
    return []


def _hovers(gait, touching, clearance, size):
    """A sentence for each walker whose feet stand far from the ground."""
    warnings = []
    part = gait.point_part
    for w, name in enumerate(gait.walker_name):
        mine = (gait.limb_walker[gait.part_limb[part]] == w) & touching[part].any(axis=1)
        height = float(np.median(clearance[mine])) if mine.any() else 0.0
        if height > HOVER * size:
            warnings.append(f"{name} walks {height:.2f} m above the ground: lower it or raise the ground.")
        elif height < -HOVER * size:
            warnings.append(f"{name} walks {-height:.2f} m deep in the ground: raise it or lower the ground.")
    return warnings


def _slides(gait, places, touching, size):
    """A sentence for each walker whose feet slide while they carry: it walks in place."""
    warnings = []
    if len(gait.time) < 3:
        return warnings
    rush = np.linalg.norm(np.gradient(places[..., :2], gait.time, axis=1), axis=2)
    on, pace = touching[gait.point_part] != 0, np.sqrt(size)
    for w, name in enumerate(gait.walker_name):
        own = gait.limb_walker[gait.part_limb[gait.point_part]] == w
        mine = own[:, None] & on
        still = (rush[own] < STILL * pace).all(axis=0)  # all of it stands: no step is taken
        mine = mine & ~still if (mine & ~still).any() else mine
        speed = float(np.median(rush[mine])) if mine.any() else 0.0
        if speed > SLIDE * pace:
            warnings.append(
                f"The feet of {name} slide at {speed:.1f} m/s while they stand, as in a clip "
                "that walks in place: move the character forward at that speed."
            )
    return warnings


def _cycle(on, count):
    """First and last sample of whole strides of one walker's limbs (L, T); the whole clip if none."""
    best = (0, count - 1)
    longest = 0
    for row in on:
        down = np.flatnonzero((row[1:] != 0) & (row[:-1] == 0)) + 1
        if len(down) > 1 and down[-1] - down[0] > longest:
            longest, best = down[-1] - down[0], (down[0], down[-1])
    return best


def _weigh(gait, touching, force):
    """Mean vertical force in body weights over whole strides, and a sentence where it is odd."""
    mean, warnings = np.ones(len(gait.mass)), []
    count = len(gait.time)
    for w, mass in enumerate(gait.mass):
        limbs = np.flatnonzero(gait.limb_walker == w)
        parts = np.flatnonzero(np.isin(gait.part_limb, limbs))
        on = np.array([touching[gait.part_limb == limb].any(axis=0) for limb in limbs])
        if not on.any():
            warnings.append(
                f"{gait.walker_name[w]} never touches the ground: check its feet, its scale and the frame range."
            )
            mean[w] = 0.0
            continue
        if count < 5:
            continue
        first, last = _cycle(on, count)
        total = -force[parts, first : last + 1, 2].sum(axis=0) / (mass * GRAVITY)
        # over whole strides the body neither gains nor loses speed; elsewhere it may
        z, reach = gait.com[w, :, 2], max(1, int(round(0.05 / (gait.time[1] - gait.time[0]))))
        slope = [
            (z[min(k + reach, count - 1)] - z[max(k - reach, 0)])
            / (gait.time[min(k + reach, count - 1)] - gait.time[max(k - reach, 0)])
            for k in (first, last)
        ]
        gain = (slope[1] - slope[0]) / ((gait.time[last] - gait.time[first]) * GRAVITY)
        mean[w] = np.mean(total) - gain
        if not MEAN_FORCE[0] <= mean[w] <= MEAN_FORCE[1]:
            warnings.append(
                f"The feet of {gait.walker_name[w]} carry {mean[w]:.2f} of its weight on "
                "average: check the mass centre, the scale and whether feet float."
            )
    return mean, warnings


def write_loads(path, gait, loads):
    """The table `time,walker,limb,part,touching,fx,fy,fz,px,py,pz`, a row a part and sample."""
    number = lambda x: f"{x + 0.0:.9g}" if np.isfinite(x) else ""
    with atomic_file.file(path, "The table of loads", "w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(["time", "walker", "limb", "part", "touching", "fx", "fy", "fz", "px", "py", "pz"])
        names = [
            (gait.walker_name[gait.limb_walker[limb]], gait.limb_name[limb], part)
            for limb, part in zip(gait.part_limb, gait.part_name)
        ]
        for t, time in enumerate(loads.time):
            for p, name in enumerate(names):
                table.writerow(
                    [
                        number(time),
                        *name,
                        int(loads.touching[p, t]),
                        *map(number, loads.force[p, t]),
                        *map(number, loads.point[p, t]),
                    ]
                )


@dataclass(frozen=True)
class Walker:
    """How a recorded body meets the ground: the load model and its numbers, to be used on any Gait.

    load_model: "inertia" or "impulse"; settle_time: tau of "impulse", TRAIL (3) [s] > 0, or a function of places;
    half_sine: its landing as a half-sine; limits, options: numbers of LIMITS and OPTIONS to change, by name;
    cell: of the ground's grid [m].
    """

    load_model: str = "inertia"
    settle_time: float = 0.2
    half_sine: bool = False
    limits: dict = field(default_factory=dict)
    options: dict = field(default_factory=dict)
    cell: float = 0.0

    def contacts(self, gait, ground=None):
        """Which part touches when, and each point's resting clearance: see contacts()."""
        return contacts(gait, ground, limits=self.limits)

    def loads(self, gait, ground=None):
        """FootForce of a recording on this ground: see loads()."""
        return loads(
            gait,
            self.load_model,
            ground,
            settle_time=self.settle_time,
            half_sine=self.half_sine,
            limits=self.limits,
            options=self.options,
            cell=self.cell,
        )
