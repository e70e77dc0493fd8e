"""The simulated plants themselves, for close-ups: a mesh at rest and where its vertices are in every frame.

    folder/plants.npz   vertices (n, 3) at rest [m], edges (m, 2) along the stems, faces (k, 4) between neighbouring
                        stems, kind (n,) and kinds (names), plant (n,), along (n,) 0..1 from the foot to the tip,
                        unbroken (n,) at the end
    folder/plants.pc2   a point cache, sample 0 = the first frame: what Mesh Cache plays on that mesh

World frame, metres. The root, which is in the ground, is left out. Under and beside feet stems move as simulated; once
trodden they are shown down for as long as the grass around them lies (Simulation.plants_shown).
"""

from __future__ import annotations

import hashlib
import os
import struct
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..errors import DesirePathError
from ..files import atomic_file, disk
from .kinds import KINDS, Kind
from .planting import Planting
from .sim import Simulation
from .standing import Stand

_HELD = 1  # rows in the ground


def build(sim: Simulation, stands: Iterable[Stand] | None = None) -> dict[str, np.ndarray]:
    """The mesh of a Simulation's plants, of all `stands` or some, as they are: the arrays of plants.npz, as a dict."""
    parts: dict[str, list[np.ndarray]] = {
        name: [] for name in ("vertices", "edges", "faces", "kind", "plant", "along", "unbroken")
    }
    first = plants = 0
    kinds = list(dict.fromkeys(planting.kind for planting in sim.plantings))
    for stand, number, count in sim.stands if stands is None else stands:
        rows, stems, a_sheet, _, _ = sim.plants_shape(stand)
        high = rows - _HELD
        corner = first + np.arange(count * stems * high).reshape(count, stems, high)
        sheet = corner.reshape(count, stems // a_sheet, a_sheet, high)
        quads = [sheet[:, :, :-1, :-1], sheet[:, :, 1:, :-1], sheet[:, :, 1:, 1:], sheet[:, :, :-1, 1:]]
        parts["vertices"].append(_vertices(sim, stand))
        parts["edges"].append(np.stack([corner[..., :-1], corner[..., 1:]], -1).reshape(-1, 2))
        parts["faces"].append(np.stack(quads, -1).reshape(-1, 4))
        parts["kind"].append(np.full(corner.size, kinds.index(sim.plantings[number].kind)))
        parts["plant"].append(np.repeat(plants + np.arange(count), stems * high))
        parts["along"].append(np.tile(np.arange(high) / max(high - 1, 1), count * stems))
        parts["unbroken"].append(_unbroken(sim, stand, rows).ravel())
        first += corner.size
        plants += count
    if not first:
        raise DesirePathError("No plants stand where the walk goes: raise their density or widen their rectangle.")
    types = {"vertices": np.float32, "along": np.float32, "unbroken": bool}
    mesh = {name: np.concatenate(arrays).astype(types.get(name, np.int32)) for name, arrays in parts.items()}
    mesh["kinds"] = np.array([_name(kind) for kind in kinds])
    return mesh


def _name(kind: Kind) -> str:
    return next((name for name, known in KINDS.items() if known == kind), "own")


def _vertices(sim: Simulation, stand: int) -> np.ndarray:
    rows, stems, _, _, _ = sim.plants_shape(stand)
    at = sim.plants_shown(stand)
    return at.reshape(len(at), stems, rows, 3)[:, :, _HELD:].reshape(-1, 3)


def _unbroken(sim: Simulation, stand: int, rows: int) -> np.ndarray:
    """Which particles are held by all bends below them, (plants, stems, rows - 1)."""
    strength = sim.plants_strength(stand)
    held = np.logical_and.accumulate(strength.reshape(len(strength), -1, rows - 2) > 0.0, axis=2)
    return np.concatenate([np.ones_like(held[:, :, :1]), held], axis=2)


def _of(sim: Simulation, plantings: Sequence[Planting] | None) -> list[Stand]:
    return [stand for stand in sim.stands if plantings is None or sim.plantings[stand[1]] in plantings]


def size(sim: Simulation, frames: int, plantings: Sequence[Planting] | None = None) -> int:
    """Bytes of a point cache of the plants of a Simulation; plantings as for Writer."""
    shapes = ((sim.plants_shape(stand), count) for stand, _, count in _of(sim, plantings))
    return 12 * frames * sum(count * stems * (rows - _HELD) for (rows, stems, *_), count in shapes)


class Writer:
    """Writes both files while a bake runs: open() where the cache is to grow, add() once a frame, then finish();
    close() in any case. It begins with the plants as they are when it is made."""

    def __init__(
        self, sim: Simulation, frame_start: float, frames: int, plantings: Sequence[Planting] | None = None
    ) -> None:
        """plantings: the Plantings whose plants are written, default: all of the simulation"""
        self.stands = _of(sim, plantings)
        sim.lay_plants()
        self.mesh = build(sim, self.stands)
        count = len(self.mesh["vertices"])
        self._header = struct.pack("<12siiffi", b"POINTCACHE2\0", 1, count, float(frame_start), 1.0, frames)
        self._frame_size = 12 * count
        self._file: Any = None  # until open()

    def known(self, path: str | os.PathLike[str], frames: int) -> str:
        """Digest of the beginning of a cache that holds `frames` of these plants, as digest() told it; "" if it is too
        short or cannot be read."""
        digest, left = hashlib.blake2b(), len(self._header) + frames * self._frame_size
        try:
            with atomic_file.reader(path) as file:
                while left:
                    piece = file.read(min(left, 1 << 22))
                    if not piece:
                        return ""
                    digest.update(piece)
                    left -= len(piece)
        except OSError:
            return ""
        return digest.hexdigest()

    def open(self, path: str | os.PathLike[str], frames: int = 0) -> None:
        """Begin the cache, or go on in one that is there after so many of its `frames`."""
        self.path = path
        if frames == 0:
            self._file = open(path, "xb")  # noqa: SIM115  (open as long as the bake runs)
            self._digest = hashlib.blake2b()
            self._write(self._header)
            return
        self._digest = hashlib.blake2b()
        self._file = open(path, "r+b")  # noqa: SIM115
        for size in [len(self._header)] + frames * [self._frame_size]:
            self._digest.update(self._file.read(size))
        self._file.truncate()

    def _write(self, values: Any) -> None:
        self._file.write(values)
        self._digest.update(values)

    def add(self, sim: Simulation) -> None:
        """Where the plants are now, as the next frame."""
        for stand, _, _ in self.stands:
            self._write(np.ascontiguousarray(_vertices(sim, stand), "<f4").data)

    def digest(self) -> str:
        """Of all that was added so far, which is in the file from now on, whatever becomes of this process."""
        self._file.flush()
        return self._digest.hexdigest()

    def finish(self, sim: Simulation, cache: str | os.PathLike[str], mesh: str | os.PathLike[str]) -> None:
        """Both files are whole now, by the names `cache` and `mesh`."""
        self._file.close()
        disk.replace(self.path, cache)
        unbroken = [_unbroken(sim, stand, sim.plants_shape(stand)[0]).ravel() for stand, _, _ in self.stands]
        self.mesh["unbroken"] = np.concatenate(unbroken)
        with atomic_file.file(mesh, "The plants") as stream:
            np.savez_compressed(stream, **self.mesh)  # type: ignore[arg-type]

    def close(self) -> None:
        """No more is written."""
        if self._file:
            self._file.close()
