"""From a recording to the forces its feet put on the ground. TRAIL (3) (4), MODEL 4.2 and 4.3."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from warnings import warn

import numpy as np

from ..core import _native
from ..errors import DesirePathError
from ..motion import jumps, mass_keys
from ..motion import size as sizes
from ..motion.gait import Gait
from ..motion.points import point_places
from ..tables import Number, check_some, table
from .below import GivenHeights, GroundHeights, Heights, carried_on, ground_below, heights_of, off_ground, on_even
from .carving import carved
from .checks import HOVER, MEAN_FORCE, SLIDE, STILL, Sunk, elsewhere, falls, hovers, off, pushes, sinks, slides, weigh
from .force import ELSEWHERE, GRAVITY, PRESSES, FootForce, native_gait, write_loads
from .times import RATE, at_times, even_rate, frame_rate_of, nearest
from .turns import Turn, each_found, let_go, middle, standing, together, turns_of

__all__ = [
    "ELSEWHERE",
    "GRAVITY",
    "HOVER",
    "LIMITS",
    "MEAN_FORCE",
    "MODELS",
    "OPTIONS",
    "PRESSES",
    "RATE",
    "SLIDE",
    "STILL",
    "FootForce",
    "Walker",
    "contacts",
    "ground_below",
    "loads",
    "native_gait",
    "write_loads",
]

OFF_GROUND = 0.06  # what is farther over the ground stands on something else [leg lengths]
MODELS = {"inertia": 0, "impulse": 1}

# Those of a grown person: lengths go with a walker's leg, times and speeds with its root (see size).
_LIMITS, _OPTIONS = table(_native.contact_numbers()), table(_native.load_numbers())
LIMITS = MappingProxyType({name: of.usual for name, of in _LIMITS.items()})  # to be read: give others by name
OPTIONS = MappingProxyType({name: of.usual for name, of in _OPTIONS.items()})
_RENAMED = {"overlap_most": "max_overlap", "reach": "support_span"}  # old names of options


def _numbers(known: Mapping[str, Number], chosen: Mapping[str, float] | None, whose: str) -> dict[str, float]:
    """Chosen numbers, by the core's names."""
    given = {}
    for name, value in (chosen or {}).items():
        if name not in known and _RENAMED.get(name) in known:
            warn(f"{name} is an old name: call it {_RENAMED[name]}.", DeprecationWarning, stacklevel=4)
            name = _RENAMED[name]
        given[name] = value
    unknown = sorted(set(given) - set(known))
    if unknown:
        raise DesirePathError(f"There is no setting {unknown[0]}: use one of " + ", ".join(known) + ".")
    check_some(given, known, whose)
    return {name: float(value) for name, value in given.items()}


def _find_contacts(
    gait: Gait, below: np.ndarray, limits: Mapping[str, float] | None, frame_rate: float
) -> tuple[np.ndarray, np.ndarray]:
    touching = np.zeros((len(gait.part_limb), len(gait.time)), "u1")
    clearance = np.zeros(len(gait.point))
    limits = {"frame_time": 1.0 / frame_rate, **(limits or {})}
    _native.foot_contact(native_gait(gait), below, touching, clearance, _numbers(_LIMITS, limits, "A limit's"))
    return touching, clearance


def contacts(
    gait: Gait,
    ground: GroundHeights = None,
    *,
    limits: Mapping[str, float] | None = None,
    ground_height: GroundHeights = None,
) -> tuple[np.ndarray, np.ndarray]:
    """(touching (P, T) u1, clearance (K,)) at the recording's samples. TRAIL (4)

    ground: see ground_below; ground_height is an old name of it.
    """
    if ground_height is not None:
        warn("ground_height is an old name: give contacts() ground.", DeprecationWarning, stacklevel=2)
        ground = ground_height
    ground = heights_of(ground)
    gait = sizes.known(jumps.found(gait.check()))
    touching, clearance = np.zeros((len(gait.part_limb), len(gait.time)), "u1"), []
    known = ((turn, *_contacts_of(turn.gait, turn.ground, limits)) for turn in turns_of(gait, ground))
    for turn, on, lowest in standing(gait, known):
        touching[np.ix_(turn.parts, turn.samples)] = on
        clearance.append(turn.known(on, lowest))
        for first, last in turn.holds:
            touching[np.ix_(turn.parts, range(first + 1, last + 1))] = touching[turn.parts, first][:, None]
    let_go(gait, touching)
    return touching, middle(clearance, len(gait.point))


def _contacts_of(gait: Gait, ground: GivenHeights, limits: Mapping[str, float] | None) -> tuple[np.ndarray, np.ndarray]:
    """contacts() of walkers of one size, in one turn."""
    size = gait.leg[0] / sizes.LEG
    even, every = even_rate(gait, size)
    below = on_even(gait, even, ground)
    person = sizes.as_person(even, size)
    touching, clearance = _find_contacts(
        person, carried_on(even, below) / size, limits, frame_rate_of(gait) * np.sqrt(size)
    )
    touching[off_ground(even, below)] = 0
    pick = slice(None, None, every) if every else nearest(even.time, gait.time)
    return touching[:, pick], clearance * size


def loads(
    gait: Gait,
    model: str = "inertia",
    ground: GroundHeights = None,
    *,
    settle_time: float | Heights = 0.2,
    half_sine: bool = False,
    limits: Mapping[str, float] | None = None,
    options: Mapping[str, float] | None = None,
    cell: float = 0.0,
) -> FootForce:
    """FootForce of a recording at its own samples. TRAIL (3), SOFT22 (3)-(8)

    model: "inertia" (Newton on the recorded mass centre) or "impulse" (the papers'; settle_time is its
    tau [s], of the soil that is landed on: a number, or a function of places (n, 2) [m] that tells it (n,);
    half_sine spreads the landing as a half-sine). ground: see ground_below. cell: of the ground's grid [m], by which
    nothing finer can be told apart.
    Walkers whose contact law is "carve" have no forces: they touch where they are near the ground.
    What stands on something that is not the ground (a box, a deck, stairs that were left out) is carried there: its
    force is told, and `touching` is ELSEWHERE.
    """
    ground, before = heights_of(ground), len(gait.warnings)
    gait = sizes.known(jumps.found(gait.check()))
    if model not in MODELS:
        raise DesirePathError(f"There is no load model {model}: use " + " or ".join(MODELS) + ".")
    if not callable(settle_time) and not (np.isfinite(settle_time) and settle_time > 0):
        raise DesirePathError(f"A settle time of {settle_time:g} s cannot be used: give one above 0.")

    def find(turn: Turn) -> FootForce | Sunk:
        try:
            return _loads_of(turn.gait, model, turn.ground, settle_time, half_sine, limits, options, cell)
        except Sunk as problem:
            if len(gait.cut):
                return problem
            raise

    found = together(gait, each_found(turns_of(gait, ground), find, ground))
    heavier = mass_keys.heavier(gait.mass_keys, gait.mass, gait.time)
    if heavier is not None:  # all forces of a walker are as its mass
        found = replace(found, force=found.force * heavier[gait.limb_walker[gait.part_limb]][..., None])
    found = carved(gait, ground, found)
    return replace(found, warnings=gait.warnings[before:] + found.warnings)


def _loads_of(
    gait: Gait,
    model: str,
    ground: GivenHeights,
    settle_time: float | Heights,
    half_sine: bool,
    limits: Mapping[str, float] | None,
    options: Mapping[str, float] | None,
    cell: float,
) -> FootForce:
    """loads() of walkers of one size, in one turn."""
    size = gait.leg[0] / sizes.LEG
    even, every = even_rate(gait, size)
    below = on_even(gait, even, ground)
    beside, below = off_ground(even, below), carried_on(even, below)
    person, floor = sizes.as_person(even, size), below / size
    touching, clearance = _find_contacts(person, floor, limits, frame_rate_of(gait) * np.sqrt(size))
    force = np.zeros(touching.shape + (3,))
    point = np.zeros(touching.shape + (3,))
    options = {"frame_time": 1.0 / (frame_rate_of(gait) * np.sqrt(size)), **(options or {})}
    tau, taus = 1.0, None
    if not callable(settle_time):
        tau = settle_time
    elif model == "impulse":  # no other asks for it
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
        _numbers(_OPTIONS, options, "An option's"),
        taus,
    )
    point, clearance = point * size, clearance * size
    mean, warnings = None, list[str]()
    if model == "inertia":  # forces of the other are no sums of what moves the body
        mean, odd = weigh(person, touching, force)
        warnings = odd + pushes(even, person, force)
    places = point_places(even)
    sinks(even, below)
    warnings = hovers(even, touching, clearance, size) + slides(even, places, touching, size) + warnings
    warnings += off(even, places, touching, beside)
    touching[beside], force[beside], point[beside] = 0, 0.0, np.nan
    over = places[..., 2] - below - clearance[:, None]
    warnings += elsewhere(even, over, touching, max(OFF_GROUND * gait.leg[0], 2.0 * cell), size)
    if every > 1:
        touching, force, point = (np.ascontiguousarray(each[:, ::every]) for each in (touching, force, point))
    elif not every:
        touching, force, point = at_times(gait.time, even.time, touching, force, point)
    warnings += falls(gait, touching, size)
    return FootForce(gait.time, touching, force, point, clearance, mean, tuple(warnings))


def _settles(gait: Gait, touching: np.ndarray, tau: Heights) -> np.ndarray:
    """tau of the soil under each point where its part touches (K, T), 1 elsewhere [s]."""
    on = (touching != 0)[gait.point_part]
    out = np.ones(on.shape)
    if on.any():
        out[on] = tau(np.ascontiguousarray(point_places(gait)[on][:, :2]))
        if not ((out > 0.0) & np.isfinite(out)).all():
            raise DesirePathError("The settle time of the soil is not above 0 everywhere: let it be, under every foot.")
    return out


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
    limits: Mapping[str, float] = field(default_factory=dict)
    options: Mapping[str, float] = field(default_factory=dict)
    cell: float = 0.0

    def contacts(self, gait: Gait, ground: GroundHeights = None) -> tuple[np.ndarray, np.ndarray]:
        """Which part touches when, and each point's resting clearance: see contacts()."""
        return contacts(gait, ground, limits=self.limits)

    def loads(self, gait: Gait, ground: GroundHeights = None) -> FootForce:
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
