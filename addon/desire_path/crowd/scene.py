"""What a crowd is told: places it goes between, its walkers, and the ground as it lies. Experimental.

    {
      "size": [100, 100], "cell": 0.5, "ground": "meadow",
      "places": [{"name": "gate", "at": [4, 4]}, {"name": "mill", "at": [96, 60], "rate": 0.5, "radius": 2}],
      "obstacles": [{"circle": [50, 50, 10]}],
      "passages": 10000, "per_day": 30, "seed": 1
    }

All else has a usual value; see Scene.
"""

from __future__ import annotations

import functools
import json
import math
import os
from collections.abc import Sequence
from dataclasses import MISSING, asdict, dataclass, field, fields, replace
from typing import Any, TypeVar

import numpy as np

from ..errors import DesirePathError
from ..files import record
from ..ground import maps
from ..ground.options import SimulationOptions
from ..ground.sim import Ground, Simulation
from .covers import Cover, as_cover, steep
from .numbers import number, pair, whole_number
from .prints import prints
from .shapes import mask
from .spans import Calendar, Span

MAX_TEXT = 1 << 24  # bytes of a scene
MAX_SIDE = 20_000  # cells
MAX_CELL = 0.5  # how wide cells may be: wider ones merge ways that walkers keep apart [m]
MAX_PASSAGES = 10_000_000
MAX_PLACES = 1000
MAX_PRESSED = maps.MAX_CELLS  # cells
PRINTS = "prints"  # ground that the core tells of
MAX_SLOPE = 1.0  # steeper ground is an obstacle [-]
Record = TypeVar("Record")


@dataclass(frozen=True)
class Place:
    """Where walkers come from and go to."""

    name: str
    at: tuple[float, float]  # [m]
    rate: float = 1.0  # how many walkers come here, against other places          [-] 0..1e6
    radius: float = 1.25  # who is as near is there, and starts as near              [m] 0.1..100
    linger: float = 0.0  # how long walkers stay here, on the average               [s] 0..86400
    visit: float = 0.0  # share of the others that come by here on their way        [-] 0..1

    def check(self) -> Place:
        if not isinstance(self.name, str) or not 0 < len(self.name) <= 60 or set(self.name) & set(',"\r\n'):
            raise DesirePathError(f"A place cannot be called {str(self.name)[:40]!r}: give it a name without commas.")
        pair(self.at, f"The place '{self.name}'")
        number(self.rate, f"The rate of '{self.name}'", 0.0, 1e6)
        number(self.radius, f"The radius of '{self.name}'", 0.1, 100.0)
        number(self.linger, f"The time for which walkers linger at '{self.name}'", 0.0, 86400.0)
        number(self.visit, f"The share of walkers that visit '{self.name}'", 0.0, 1.0)
        return self


@dataclass(frozen=True)
class Kind:
    """One kind of walkers among others."""

    mass: float = 75.0  # of each [kg] 1..1000
    share: float = 1.0  # how many are of this kind, against the others [-] 0..1e6
    walk: str = ""  # a recording (.npz) they walk by; empty = the walk that comes with Desire Path
    stray: float = 8.0  # how far headings err [degrees] 0..45

    def check(self) -> Kind:
        number(self.mass, "The mass of walkers", 1.0, 1000.0)
        number(self.share, "The share of a kind of walkers", 0.0, 1e6)
        number(self.stray, "The angle by which walkers stray", 0.0, 45.0)
        if not isinstance(self.walk, str):
            raise DesirePathError("The walk of walkers is no name of a file: give that of a recording (.npz).")
        return self


@dataclass(frozen=True)
class Press:
    """Where the feet of a crowd press the ground, and which."""

    box: tuple[float, float, float, float]  # rectangle x0, y0, x1, y1 [m]
    cell: float = 0.02  # side of a cell [m] 0.001..0.2
    soil: str = "soil"  # a name in SOILS or a soil's file
    plants: tuple[str, ...] = ()  # KIND or KIND:DENSITY each

    def check(self) -> Press:
        cell = number(self.cell, "The side of a cell that feet press", 0.001, 0.2)
        if not isinstance(self.box, tuple) or len(self.box) != 4:
            raise DesirePathError("Feet press in a rectangle: write its box as [x0, y0, x1, y1] in metres.")
        x0, y0, x1, y1 = (number(each, "The box in which feet press", -1e6, 1e6) for each in self.box)
        if not (cell <= x1 - x0 and cell <= y1 - y0 and (x1 - x0) * (y1 - y0) <= MAX_PRESSED * cell**2):
            raise DesirePathError(
                f"Feet cannot press {x1 - x0:g} x {y1 - y0:g} m in cells of {cell:g} m: give x0, y0 below x1, y1, and "
                f"up to {MAX_PRESSED:g} cells."
            )
        if not isinstance(self.plants, tuple) or not all(isinstance(each, str) for each in self.plants):
            raise DesirePathError('Plants that feet press stand in a list: write ["carex:40"].')
        if not isinstance(self.soil, str):
            raise DesirePathError("The soil that feet press is no name: give that of a soil, or of its file.")
        return self


@dataclass(frozen=True)
class Scene:
    """A crowd and its ground; see the module."""

    places: tuple[Place, ...] = ()
    size: tuple[float, float] = (100.0, 100.0)  # of the ground along x and y [m]
    origin: tuple[float, float] = (0.0, 0.0)  # its lowest corner [m]
    cell: float = 0.5  # side of a cell [m] 0.05..0.5
    ground: Cover = field(default_factory=lambda: as_cover("meadow"))
    heights: str = ""  # an EXR of heights, as bakes take it; empty = level
    obstacles: tuple[Any, ...] = ()  # shapes that nobody walks through
    paved: tuple[Any, ...] = ()  # shapes that cost 1 and do not wear
    walkers: tuple[Kind, ...] = (Kind(),)
    passages: int = 10_000  # from place to place, all together
    per_day: float = 30.0  # of them [1/day]
    spans: tuple[Span, ...] = ()  # in the place of per_day: days, weeks, seasons, again and again; see spans
    renewals: int = 100  # how often ways are chosen anew
    rest_days: float = 0.0  # without walkers, after all passages
    film_every: int = 0  # passages from picture to picture; 0 = none but the last
    seed: int = 0
    press: Press | None = None  # where feet press in the end; None = nowhere

    def check(self) -> Scene:
        """Itself, if a crowd can walk there; else a sentence."""
        wide, high = pair(self.size, "The size of the ground")
        pair(self.origin, "The origin of the ground")
        cell = number(self.cell, "The side of a cell", 0.05, MAX_CELL)
        if not (cell <= wide <= MAX_SIDE * cell and cell <= high <= MAX_SIDE * cell):
            raise DesirePathError(
                f"Ground of {wide:g} x {high:g} m cannot be walked in cells of {cell:g} m: let each side have 1 to "
                f"{MAX_SIDE} cells."
            )
        whole_number(self.passages, "The number of passages", 1, MAX_PASSAGES)
        number(self.per_day, "The number of passages a day", 1e-3, 1e6)
        self.calendar.until(0)
        whole_number(self.renewals, "The number of renewals", 1, 100_000)
        number(self.rest_days, "The number of days at rest", 0.0, 1e6)
        whole_number(self.film_every, "The number of passages from picture to picture", 0, MAX_PASSAGES)
        whole_number(self.seed, "The seed", 0, 2**63)
        self.ground.check()
        if self.press is not None:
            self.press.check()
        self._check_places()
        if not self.walkers or sum(kind.check().share for kind in self.walkers) <= 0.0:
            raise DesirePathError("Nobody walks here: give at least one kind of walkers a share above 0.")
        return self

    def _check_places(self) -> None:
        if len(self.places) > MAX_PLACES:
            raise DesirePathError(f"There are {len(self.places)} places: give up to {MAX_PLACES}.")
        names = [place.check().name for place in self.places]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise DesirePathError(f"Two places are called '{twice}': give each a name of its own.")
        visits = sum(place.visit for place in self.places)
        if visits > 1.0:
            raise DesirePathError(f"Shares of walkers that visit places add up to {visits:g}: give at most 1 in all.")

    @functools.cached_property
    def calendar(self) -> Calendar:
        """When each passage goes."""
        return Calendar(self.spans or (Span(1.0, self.per_day),))

    # ---- the ground in cells ---------------------------------------------------------------------------

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return max(round(self.size[1] / self.cell), 1), max(round(self.size[0] / self.cell), 1)

    def middles(self) -> tuple[np.ndarray, np.ndarray]:
        """x (1, nx) and y (ny, 1) of the middles of cells in the world [m]."""
        ny, nx = self.shape
        x = self.origin[0] + (np.arange(nx) + 0.5) * self.cell
        y = self.origin[1] + (np.arange(ny) + 0.5) * self.cell
        return x[None, :], y[:, None]

    def inside(self, place: Place) -> tuple[float, float]:
        """x and y of a place from the ground's corner [m]."""
        return place.at[0] - self.origin[0], place.at[1] - self.origin[1]

    def over(self, heights: np.ndarray) -> Scene:
        """The same over heights that are given, in place of a file's: float64 (ny, nx) [m], NaN where there is none."""
        if heights.shape != self.shape:
            raise DesirePathError(f"Heights of shape {heights.shape} do not fit: they have to be {self.shape}.")
        other = replace(self, heights="")
        other.__dict__["relief"] = heights
        return other

    @functools.cached_property
    def relief(self) -> np.ndarray:
        """Heights of the middles of cells [m] (ny, nx); NaN where there is no ground."""
        if not self.heights:
            return np.zeros(self.shape)
        x, y = np.broadcast_arrays(*self.middles())
        below = Simulation(Ground.read(self.heights, None), cell_size=self.cell, options=SimulationOptions())
        return below.rest_height(np.stack([x.ravel(), y.ravel()], axis=1)).reshape(self.shape)

    def lie(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(what is an obstacle, what is paved, by which factor slopes cost) of each cell (ny, nx)."""
        x, y = self.middles()
        blocked, paved = mask(self.obstacles, x, y, "An obstacle"), mask(self.paved, x, y, "A paved way")
        heights = self.relief
        missing = np.isnan(heights)
        level = steep(np.where(missing, np.nanmean(heights) if not missing.all() else 0.0, heights), self.cell)
        return blocked | missing | (level > _steepest()), paved, level


def _steepest() -> float:
    """By which factor the steepest ground costs that is walked."""
    return float(steep(np.array([[0.0, MAX_SLOPE, 2.0 * MAX_SLOPE]]), 1.0)[0, 1])


# ---- scenes in files -----------------------------------------------------------------------------------


def _record(kind: type[Record], given: Any, what: str) -> Record:
    """A dataclass of a dict; a sentence for what is none, or says what it does not know."""
    if not isinstance(given, dict):
        raise DesirePathError(f'{what} cannot be {str(given)[:40]}: write its numbers by name, as {{"name": ..}}.')
    known = {each.name: each for each in fields(kind)}  # type: ignore[arg-type]
    unknown = sorted(set(given) - set(known))
    if unknown:
        raise DesirePathError(f"{what} knows nothing of '{unknown[0][:40]}': remove it, or mend its name.")
    lacking = [
        name
        for name, each in known.items()
        if each.default is MISSING and each.default_factory is MISSING and name not in given
    ]
    if lacking:
        raise DesirePathError(f"{what} does not say its {lacking[0]}: add it.")
    return kind(**{name: tuple(value) if isinstance(value, list) else value for name, value in given.items()})


def _listed(given: Any, what: str) -> list[Any]:
    if not isinstance(given, (list, tuple)):
        raise DesirePathError(f"{what} of a scene stand in a list: write [..].")
    return list(given)


def of(given: Any, folder: str = "") -> Scene:
    """A checked Scene of what a file says; names of files in it are those in `folder`."""
    scene = _record(
        Scene, {**given, "places": given.get("places", [])} if isinstance(given, dict) else given, "A scene"
    )
    words = dict(scene.__dict__)
    words["places"] = tuple(_record(Place, each, "A place") for each in _listed(given.get("places", []), "Places"))
    if "walkers" in given:
        words["walkers"] = tuple(
            _record(Kind, each, "A kind of walkers") for each in _listed(given["walkers"], "Walkers")
        )
    if given.get("press") is not None:
        words["press"] = _record(Press, given["press"], "The press of a scene")
    words["spans"] = tuple(_record(Span, each, "A span") for each in _listed(given.get("spans", []), "Spans"))
    words["ground"] = _ground(given.get("ground", "meadow"), words["walkers"], folder)
    for name, what in (("obstacles", "Obstacles"), ("paved", "Paved ways")):
        words[name] = tuple(_listed(given.get(name, []), what))
    if not isinstance(words["heights"], str):
        raise DesirePathError("The heights of a scene are no name of a file: give that of an EXR.")
    if words["heights"]:
        words["heights"] = os.path.join(folder, words["heights"])
    return Scene(**words).check()


def _ground(given: Any, walkers: Sequence[Kind], folder: str) -> Cover:
    """A Cover by its name or its numbers, or by the prints of those walkers of which there are most."""
    if not isinstance(given, dict) or given.get("kind") != PRINTS:
        return as_cover(given)
    numbers = {name: value for name, value in given.items() if name != "kind"}
    soil = numbers.pop("soil", None)
    if not isinstance(soil, str) or not soil:
        raise DesirePathError('Ground that prints tell of has a soil: write {"kind": "prints", "soil": "deep-snow"}.')
    if soil.endswith(".json"):
        soil = os.path.join(folder, soil)
    most = max((kind.check() for kind in walkers), key=lambda kind: kind.share, default=Kind())
    return as_cover({**asdict(prints(soil, most.walk, most.mass)), **numbers})


def read(path: str | os.PathLike[str]) -> Scene:
    """A checked Scene of a JSON file."""
    path = os.fspath(path)
    text = record.text_of(path, "scene", MAX_TEXT)
    try:
        given = json.loads(text.decode("utf-8-sig")) if len(text) <= MAX_TEXT else None
    except (ValueError, RecursionError, MemoryError) as error:
        where = f", line {error.lineno}" if isinstance(error, json.JSONDecodeError) else ""
        raise DesirePathError(f"{path} is no scene in JSON{where}: mend it.") from None
    return of(given, os.path.dirname(os.path.abspath(path)))


def schedule(scene: Scene, done: int) -> int:
    """How many walkers go by the same fields after so many passages. MODEL 12.7"""
    even = max(math.ceil(scene.passages / scene.renewals), 1)
    if scene.ground.renewal:
        even = min(max(int(scene.ground.renewal * done), 1), even)
    pause = scene.calendar.pause(done)
    return min(even, scene.passages - done, *(() if pause is None else (pause - done,)))
