"""The bones of a skeleton with their names read, and the legs above feet.

names --rig_names.read--> words, side, place --find--> the best bone for a slot
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .rig_names import FORE_SHANK, FORE_THIGH, NEVER_WORDS, SHANK, THIGH, rank_of, read
from .skeleton import Skeleton


class Bones:
    """A skeleton with its names read."""

    def __init__(self, skeleton: Skeleton) -> None:
        self.names = tuple(skeleton.names)
        self.parents = [int(p) for p in skeleton.parents]
        rt = any(re.search(r"(^|[^A-Za-z])rt([^A-Za-z]|$)", n.lower()) for n in self.names)
        self.read = [read(n, lf_is_left=rt) for n in self.names]
        rest = np.asarray(skeleton.rest, float)
        self.head = rest[:, :3, 3]
        self.tail = self.head + rest[:, :3, 1] * np.asarray(skeleton.length, float)[:, None]
        self.size = float(np.ptp(self.head, axis=0).max()) if len(self.head) else 0.0

    def chain(self, bone: int) -> list[int]:
        """The bone and its ancestors, upward."""
        seen: list[int] = []
        while bone >= 0 and bone not in seen:
            seen.append(bone)
            bone = self.parents[bone]
        return seen

    def under(self, bone: int, ancestor: int) -> bool:
        """Does a bone hang on another, however far below it?"""
        return bone != ancestor and ancestor in self.chain(bone)

    def apart(self, a: int, b: int) -> float:
        """How far two bones' heads are apart [m]."""
        return float(np.linalg.norm(self.head[a] - self.head[b]))

    def beside(self, bone: int, point: np.ndarray) -> float:
        """How far a point is from a bone, anywhere along it."""
        axis = self.tail[bone] - self.head[bone]
        along = np.clip((point - self.head[bone]) @ axis / max(axis @ axis, 1e-18), 0.0, 1.0)
        return float(np.linalg.norm(self.head[bone] + along * axis - point))

    def find(
        self, table: Sequence[str], side: str = "", place: str | None = None, where: Callable[[int], bool] | None = None
    ) -> int:
        """The best bone for a slot: layer first, then pattern; -1 if none."""
        best: tuple[int, int, int, int] | None = None
        found = -1
        for b, name in enumerate(self.read):
            if name.side != side or NEVER_WORDS & set(name.words):
                continue
            rank = rank_of(name.words, table)
            if rank is None or (place is not None and name.place != place):
                continue
            if where is not None and not where(b):
                continue
            order = (name.layer, rank, name.size, len(self.chain(b)))
            if best is None or order < best:
                best, found = order, b
        return found


@dataclass(frozen=True)
class Found:
    """Bones of one foot, -1 for none."""

    limb: str
    foot: int
    toe: int
    heel: int
    place: str = ""


# ---- thighs and shanks ---------------------------------------------------------------------------------


def find_legs(bones: Bones, foot: int, place: str | None = None) -> tuple[int, int]:
    """(thigh, shank) above a foot bone, -1 each where there are none."""
    side = bones.read[foot].side
    place = bones.read[foot].place if place is None else place
    thigh, shank = _legs_by_name(bones, side, place, foot) if side else (-1, -1)
    if thigh < 0 or shank < 0:
        guess = legs_by_structure(bones, foot)
        thigh, shank = guess if guess[0] >= 0 else (thigh, shank)
    return thigh, shank


def _legs_by_name(bones: Bones, side: str, place: str, foot: int) -> tuple[int, int]:
    """Thigh and shank of a foot: on its own chain where it has one, else by name alone."""
    on_chain = set(bones.chain(foot)[1:])
    shank = bones.find(("knee",), side, where=on_chain.__contains__)
    thigh = bones.find(THIGH[:-2], side, where=on_chain.__contains__)
    if shank < 0:
        shank = bones.find(SHANK, side, where=lambda b: b in on_chain and b != thigh)
    if thigh < 0:
        thigh = bones.find(THIGH + ("leg",), side, where=lambda b: b in on_chain and b != shank)
    if thigh < 0 or shank < 0:
        arm = (
            bones.find(FORE_THIGH, side, where=on_chain.__contains__),
            bones.find(FORE_SHANK, side, where=on_chain.__contains__),
        )
        if min(arm) >= 0 and bones.under(arm[1], arm[0]):
            thigh, shank = arm
    if thigh < 0 and shank < 0:
        thigh = bones.find(THIGH[:-2], side, place)
        shank = bones.find(SHANK, side, place, where=lambda b: b != thigh)
    if thigh >= 0 and shank >= 0 and bones.under(thigh, shank):
        thigh, shank = -1, -1
    return thigh, shank


def legs_by_structure(bones: Bones, foot: int) -> tuple[int, int]:
    """Thigh and shank from the two bones above a foot, where they are long enough for legs."""
    above = list(bones.chain(foot)[1:])
    shank = thigh = -1
    for b in above:
        if bones.apart(b, foot) > 0.12 * bones.size:
            shank = b
            break
    if shank >= 0:
        for b in above[above.index(shank) + 1 :]:
            if bones.apart(b, shank) > 0.12 * bones.size and bones.parents[b] >= 0:
                thigh = b
                break
    return (thigh, shank) if thigh >= 0 else (-1, -1)
