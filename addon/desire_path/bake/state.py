"""What the grounds of a bake have become, kept from time to time, so that a bake that was stopped goes on from there.

    folder/frames/bake_0120.state     a line about it, and Simulation.state() after playback frame 120

Grounds that lie beside each other are one Simulation, whose state lies in the folder of the first of them. A bake can
go on after a frame whose states are all there and whole, if every file that was written up to it is: frames, maps and
plants, each held against its digest. The newest KEPT of them stay until a bake is whole.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import time
from collections.abc import Sequence
from typing import Any

from .. import bounds, memory
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file
from ..ground.sim import Simulation
from .share import Share

KEPT = bounds.STATES
SHARE = 0.02  # of a bake's time may go into keeping states, about
FIRST = 1.0  # no sooner after its begin or the state before [s]
MAGIC = b"desire_path state 1 "
LONGEST = 1 << 20  # bytes of a line about a state
NAME = re.compile(r"bake_(\d{4,})\.state")


class Damaged(ValueError):
    """A file is no state of this bake."""


def name_of(frame: int) -> str:
    """bake_0120.state"""
    return f"bake_{frame:04d}.state"


def frames_in(folder: str) -> list[int]:
    """After which frames a folder has states, newest first."""
    try:
        found = [NAME.fullmatch(name) for name in os.listdir(folder)]
    except OSError:
        return []
    return sorted((int(each[1]) for each in found if each), reverse=True)


def write(path: str, about: dict[str, Any], state: memoryview) -> None:
    """One state, whole or not at all. about: what read() asks for, and what to remember with it."""
    line = json.dumps({**about, "size": state.nbytes, "digest": _native.digest(state).hex()}).encode()
    with atomic_file.file(path, "The state of the bake", sync=False) as stream:
        stream.write(MAGIC + _native.digest(line).hex().encode() + b" " + line + b"\n")
        memory.write(stream, state)


def read(path: str, about: dict[str, Any]) -> tuple[dict[str, Any], memoryview]:
    """(line, state) of a file that write() made; Damaged if it is another one's, or not whole."""
    try:
        with atomic_file.reader(path) as stream:
            top = stream.readline(LONGEST)
            digest, _, line = top[len(MAGIC) : -1].partition(b" ")
            if top[: len(MAGIC)] != MAGIC or _native.digest(line).hex().encode() != digest:
                raise Damaged
            found = json.loads(line)
            if any(found.get(name) != value for name, value in about.items()):
                raise Damaged
            state = memory.contents(stream)
    except (OSError, ValueError, KeyError):
        raise Damaged from None
    if len(state) != found["size"] or _native.digest(state).hex() != found["digest"]:
        raise Damaged
    return found, state


class States:
    """Those of one bake.

    shares: its Shares, which have found what the same bake left; signature: the bake's, see Bake.
    refused: frames whose states cannot be used, with a sentence about each.
    frame: after which one it stands, 0 = at its begin; warnings: sentences about states.
    """

    def __init__(self, shares: Sequence[Share], signature: str, refused: dict[int, str]) -> None:
        self.shares, self.signature, self.refused = shares, signature, refused
        self.storeys: list[tuple[Simulation, list[Share]]] = []
        for share in shares:
            for sim, there in self.storeys:
                if sim is share.sim:
                    there.append(share)
                    break
            else:
                self.storeys.append((share.sim, [share]))
        self.frame = 0
        self.kept: list[int] = []
        self._failed = ""
        self._cost, self._last = 0.0, time.perf_counter()

    def _about(self, frame: int, storey: int) -> dict[str, Any]:
        return {"signature": self.signature, "frame": frame, "storey": storey, "of": len(self.storeys)}

    # ---- going on ---------------------------------------------------------------------------------

    @property
    def warnings(self) -> list[str]:
        return [*self.refused.values(), *([self._failed] if self._failed else [])]

    def restore(self) -> bool:
        """Go on after the newest frame that can be; else from the begin.

        False: a state was refused when another storey had gone on from its own. Make the simulations anew.
        """
        there = frames_in(self._folder(0))
        low = min(share.sound_to for share in self.shares)
        usable = [frame for frame in there if 0 < frame <= low and frame not in self.refused]
        for number, frame in enumerate(usable):
            try:
                states = self._read(frame)
            except Damaged:
                self._refuse(frame)
                continue
            if states is None:
                continue
            for storey, ((sim, _), state) in enumerate(zip(self.storeys, states)):
                try:
                    sim.restore(state)
                except DesirePathError:
                    self._refuse(frame)
                    if storey:
                        return False
                    break
            else:
                self.frame, self.kept = frame, sorted(usable[number : number + KEPT])
                return True
        return True

    def _refuse(self, frame: int) -> None:
        self.refused[frame] = (
            f"The state after frame {frame} in {self._folder(0)} is damaged, or of another bake, and was not used: "
            "what came since the one before was simulated again."
        )

    def _folder(self, storey: int) -> str:
        """Where the states of a storey lie that are there already."""
        return os.path.join(self.storeys[storey][1][0].place or os.devnull, "frames")

    def _read(self, frame: int) -> list[memoryview] | None:
        """The state of each storey; None where plants that were written up to this frame are not what they were."""
        found = []
        for storey, (_, shares) in enumerate(self.storeys):
            about, state = read(os.path.join(self._folder(storey), name_of(frame)), self._about(frame, storey))
            if about.get("plants") != [share.plants_known(frame) for share in shares]:
                return None
            found.append(state)
        return found

    def names(self, share: Share) -> list[str]:
        """Of the states in a share's folder that stay."""
        first = any(share is shares[0] for _, shares in self.storeys)
        return [name_of(frame) for frame in self.kept] if first else []

    # ---- keeping ----------------------------------------------------------------------------------

    def after(self, frame: int) -> None:
        """A frame is written: keep a state, if it is time to."""
        if time.perf_counter() - self._last >= max(FIRST, self._cost / SHARE):
            self.keep(frame)

    def keep(self, frame: int) -> None:
        """Keep a state after this frame, unless there is one, in place of the oldest. OSError: a frame before could not
        be written."""
        if frame == self.frame or frame in self.kept:
            return
        begun = time.perf_counter()
        for sim, _ in self.storeys:
            sim.flush()  # what was written up to it is there
        try:
            for storey, (sim, shares) in reversed([*enumerate(self.storeys)]):  # the first says all are there
                about = {**self._about(frame, storey), "plants": [share.plants_digest() for share in shares]}
                write(shares[0].out.path("frames", name_of(frame)), about, sim.state())
        except (DesirePathError, OSError, MemoryError) as problem:
            self._failed = f"No state could be kept after frame {frame}, to go on from ({str(problem).rstrip('.')})."
            self._cost = float("inf")
            return
        self.kept.append(frame)
        while len(self.kept) > KEPT:
            self._drop(self.kept.pop(0))
        self._last = time.perf_counter()
        self._cost = self._last - begun

    def drop(self) -> None:
        """The bake is whole: none is needed any more."""
        while self.kept:
            self._drop(self.kept.pop())

    def _drop(self, frame: int) -> None:
        for _, shares in self.storeys:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(shares[0].out.path("frames", name_of(frame)))
