"""Feet of a rig whose names say nothing: the lowest chains that come in mirrored pairs.

bones --low_chains--> chain ends --mirrored--> pairs, from one end of the body to the other --> [Found]
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .rig_bones import Bones, Found, legs_by_structure
from .rig_names import NEVER_WORDS

TOES = 0.15  # toes begin within this share of the body's height from where they come together
STEEP = 0.15  # legs go down by this share of their length at least, however far out they stand


def by_structure(bones: Bones) -> list[Found]:
    """The lowest chains that come in mirrored pairs: their last bones are feet and toes."""
    useful = [b for b, each in enumerate(bones.read) if not NEVER_WORDS & set(each.words)]
    for deepest in (0, 2, 3):  # bones that deform alone, before a control rig's other copies of them
        kept = [b for b in useful if bones.read[b].layer <= deepest]
        best: _Guess | None = None
        for up in (2, 1):
            chains = _low_chains(bones, kept, up)
            for across in (0, 3 - up):  # armatures face along Y or Z, so that left and right are x; or along X
                pairs = _mirrored(bones, kept, chains, across, up)
                legs = len({_thigh_down(bones, a, up) for a, b in pairs if _thigh_down(bones, b, up) >= 0} - {-1})
                order = (legs, len(pairs) if up == 2 else 0)
                if pairs and (best is None or order > (best.legs, len(best.pairs))):
                    best = _Guess(legs, pairs, chains, up, across)
        if best is not None:
            return _found(bones, best)
    return []


@dataclass(frozen=True)
class _Guess:
    """Which axis may be up and which across, and the feet there would be."""

    legs: int  # thighs that go down to feet
    pairs: list[tuple[int, int]]
    chains: Mapping[int, int]
    up: int
    across: int


def _found(bones: Bones, guess: _Guess) -> list[Found]:
    """The feet of a guess, left before right, from one end of the body to the other."""
    left = _left(bones, guess.chains, guess.pairs, guess.up, guess.across)
    several = len(guess.pairs) > 1
    return [
        Found(word + (f" {k + 1}" if several else ""), b, guess.chains[b], -1)
        for k, pair in enumerate(guess.pairs)
        for word, b in zip(("left", "right"), sorted(pair, key=lambda b: -left * bones.head[b, guess.across]))
    ]


def _thigh_down(bones: Bones, foot: int, up: int) -> int:
    """The thigh of the leg that goes down to a foot, -1 where none does."""
    thigh = legs_by_structure(bones, foot)[0]
    axis = bones.tail[foot] - bones.head[thigh]
    return thigh if thigh >= 0 and -axis[up] > STEEP * np.linalg.norm(axis) else -1


def _low_chains(bones: Bones, kept: Sequence[int], up: int) -> dict[int, int]:
    """Foot -> toe or -1 of each chain of these bones that ends low."""
    if not kept:
        return {}
    inside = set(kept)
    parent = {b: next((above for above in bones.chain(b)[1:] if above in inside), -1) for b in kept}
    low, high = bones.tail[kept, up].min(), bones.head[kept, up].max()
    height = max(high - low, 1e-9)
    feet: dict[int, int] = {}
    for leaf in set(kept) - set(parent.values()):
        if parent[leaf] < 0 or min(bones.tail[leaf, up], bones.head[leaf, up]) >= low + 0.12 * height:
            continue
        toe, foot = leaf, parent[leaf]
        run = bones.head[toe] - bones.head[foot]
        drop, size = -run[up], np.linalg.norm(run)
        if parent[foot] < 0 or drop > 0.85 * size or size > 0.25 * height:
            toe, foot = -1, leaf  # what lies above is a shank: the leaf is the whole foot
        feet.setdefault(foot, toe)
    return _one_foot(bones, feet, height)


def _one_foot(bones: Bones, feet: Mapping[int, int], height: float) -> dict[int, int]:
    """Chains that hang on one shank are toes of one foot, where they come together below it."""
    shanks: dict[int, list[int]] = {}
    for foot in feet:
        shanks.setdefault(legs_by_structure(bones, foot)[1], []).append(foot)
    out: dict[int, int] = {}
    for shank, group in shanks.items():
        shared = [b for b in bones.chain(group[0]) if all(b in bones.chain(other) for other in group)]
        far = max((bones.apart(b, shared[0]) for b in group), default=0.0) if shared else np.inf
        if shank < 0 or len(group) == 1 or not bones.under(shared[0], shank) and far > TOES * height:
            out.update({foot: feet[foot] for foot in group})
        elif shared[0] not in out:
            toes = [foot for foot in group if foot != shared[0]] or [feet[shared[0]]]
            out[shared[0]] = max(toes, key=lambda b: bones.apart(b, shared[0]))
    return out


def _mirrored(
    bones: Bones, kept: Sequence[int], chains: Mapping[int, int], across: int, up: int
) -> list[tuple[int, int]]:
    """Pairs of feet that are mirror images across an axis, from one end of the body to the other."""
    if not chains:
        return []
    height = max(bones.head[kept, up].max() - bones.tail[kept, up].min(), 1e-9)
    middle = np.median(bones.head[kept, across])

    def off(a: int, b: int) -> float:
        return float(np.linalg.norm((bones.head[a] - bones.head[b])[[k for k in range(3) if k != across]]))

    left, pairs = sorted(chains, key=lambda b: bones.names[b]), list[tuple[int, int]]()
    along = 3 - up - across
    while left:
        a = left.pop(0)
        if abs(bones.head[a, across] - middle) <= 0.01 * height:
            continue
        twins = [
            b
            for b in left
            if off(a, b) < 0.1 * height
            and abs(bones.head[a, across] + bones.head[b, across] - 2 * middle) < 0.05 * height
        ]
        if twins:
            twin = min(twins, key=lambda b: off(a, b))
            left.remove(twin)
            pairs.append((a, twin))
    return sorted(pairs, key=lambda pair: bones.head[list(pair), along].mean())


def _left(bones: Bones, chains: Mapping[int, int], pairs: Sequence[tuple[int, int]], up: int, across: int) -> float:
    """The sign of what is left along an axis: as the toes point, else as if facing -Y or, with Y up, Z."""
    along = 3 - up - across
    ahead = sum(bones.head[chains[b], along] - bones.head[b, along] for pair in pairs for b in pair if chains[b] >= 0)
    default = {(2, 1): -1.0, (1, 2): 1.0}.get((up, along), 1.0)
    facing = np.zeros(3)
    facing[along] = np.sign(ahead) or default
    return float(np.sign(np.cross(np.eye(3)[up], facing)[across]))
