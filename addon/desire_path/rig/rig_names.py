"""Names of bones: how they are cut into words, and which words mean feet, toes, hips ..

The tables are data: a slot lists word patterns, best first. A bone's name is cut into words
(`mixamorig9:LeftToeBase` -> toe base, side L; `Paw_FL` -> paw, side L, place front), and a pattern
matches the last words of a name, so that a character's own name in front (`Bob L Foot`) does no
harm, nor does the number that Blender puts behind a copy (`foot.L.001`).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

# ---- the tables ----------------------------------------------------------------------------------

FOOT = ("foot", "ankle", "paw", "hoof", "feet", "足首")
TOE = (
    "toe base",
    "toebase",
    "toes",
    "toe",
    "ball",
    "toe 0",
    "toes 01",
    "toe 01",
    "toes 1",
    "toe 1",
    "big toe",
    "bigtoe",
    "bigtoe 1",
    "big toe 1",
    "toe 1 1",
    "toe 2 1",
    "toe 3 1",
    "toes 001",
    "つま先",
    "足先 ex",
    "足先",
)
FORE = ("hand", "wrist", "carpus", "manus")  # feet, where the body stands on them
HOOF = ("hoof",)  # stands on the ground below whatever is called the foot
FINGERS = (
    "fingers",
    "finger",
    "middle 1",
    "middle 01",
    "middle 001",
    "finger 1",
    "finger 01",
    "finger 0",
    "palm",
    "index 1",
    "index 01",
    "index 001",
)  # of a hand that is a foot, where it has no toe
HEEL = ("heel 02", "heel", "heel 01", "heel ref", "calcaneus", "かかと")
THIGH = ("up leg", "upleg", "upper leg", "upperleg", "thigh", "femur", "leg upper", "thigh stretch", "hip", "足")
SHANK = (
    "low leg",
    "lowleg",
    "lower leg",
    "lowerleg",
    "shin",
    "calf",
    "tibia",
    "knee",
    "leg lower",
    "leg stretch",
    "leg",
    "ひざ",
)
FORE_THIGH = ("upper arm", "upperarm", "up arm", "humerus", "arm upper", "arm stretch", "arm")
FORE_SHANK = ("forearm", "fore arm", "lower arm", "lowerarm", "radius", "elbow", "arm lower", "forearm stretch")
HIPS = ("hips", "pelvis", "下半身", "hip", "spine", "root", "center", "センター", "torso")
NECK = (
    "neck",
    "neck 01",
    "neck 1",
    "neck twist 01",
    "lower neck",
    "lowerneck",
    "neck lower",
    "neck x",
    "首",
    "spine 004",
    "spine 005",
)
HEAD = ("head", "head x", "頭", "spine 006")
CHEST = ("upper chest", "chest", "spine 03", "spine 3", "spine 2", "spine 02", "thorax", "spine 1", "上半身2", "上半身")

LAYERS = {"def": 0, "org": 1}  # then plain names (2), then controls (3)
CONTROL_WORDS = {
    "ik",
    "fk",
    "ctrl",
    "control",
    "controller",
    "ctl",
    "roll",
    "rock",
    "pole",
    "target",
    "pivot",
    "spin",
    "tweak",
    "mch",
    "vis",
    "gizmo",
    "handle",
    "socket",
    "snap",
    "wgt",
    "widget",
    "goal",
    "dummy",
    "helper",
    "ref",
    "parent",
    "effector",
    "twist",
    "share",
    "bend",
    "pin",
    "ｉｋ",
    "親",
}
NEVER_WORDS = {"end", "nub", "site", "effector", "tweak", "mch", "wgt"}
LAST_WORDS = {"jnt", "joint", "bone", "bn"}  # behind a name they say nothing: `foot_L_jnt`
SIDE_WORDS = {
    "l": "L",
    "left": "L",
    "lft": "L",
    "lt": "L",
    "r": "R",
    "right": "R",
    "rgt": "R",
    "rt": "R",
    "左": "L",
    "右": "R",
}
PLACE_WORDS = {
    "front": "front",
    "fore": "front",
    "hind": "",
    "rear": "",
    "back": "",
    "mid": "mid",
    "middle": "mid",
}  # of a foot among many
PLACE_LETTERS = {"f": "front", "r": "", "b": "", "h": "", "m": "mid"}  # beside a word for a foot or leg: `f_toe.L`
CORNERS = {  # place and side in one word: `Paw_FL`, and as horsemen say it, `LF` and `LH`
    "fl": ("front", "L"),
    "fr": ("front", "R"),
    "bl": ("", "L"),
    "br": ("", "R"),
    "rl": ("", "L"),
    "rr": ("", "R"),
    "hl": ("", "L"),
    "hr": ("", "R"),
    "ml": ("mid", "L"),
    "mr": ("mid", "R"),
    "lf": ("front", "L"),
    "rf": ("front", "R"),
    "lh": ("", "L"),
    "rh": ("", "R"),
    "lb": ("", "L"),
    "rb": ("", "R"),
}


# ---- names ------------------------------------------------------------------------------------------

_WORD = re.compile(r"[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+|\d+|[^\x00-\x7f]+")
_FUSED = {w for table in (FOOT, TOE, HEEL, THIGH, SHANK) for w in table if w.isascii() and w.isalpha()}
_LIMB = (_FUSED | {"upper", "lower"} | set(HOOF)) - {"hip"}  # beside these a word may say which limb it is
_HAND = set(FORE) | {"finger", "fingers"}


@dataclass(frozen=True)
class Name:
    words: tuple[str, ...]  # without side, layer and place
    side: str  # "L", "R" or ""
    layer: int
    place: str = ""  # of a limb among many: "front", "mid", or "" for the hind ones and those of people
    size: int = 0  # how many words there were besides side and layer


def read(name: str, lf_is_left: bool = False) -> Name:
    """Words, side, layer and place of a bone's name. lf_is_left: `lf` means left, as where `rt` is right."""
    bare = name.rsplit(":", 1)[-1]
    raw = _WORD.findall(bare)
    if lf_is_left:
        raw = ["left" if word.lower() == "lf" else word for word in raw]
    at = _side_at([word.lower() for word in raw])
    words, side, layer, place = list[str](), "" if at is None else SIDE_WORDS[raw[at].lower()], 2, ""
    for k, word in enumerate(raw):
        word = word.lower()
        if k == at:
            continue
        if not side and word[0] in "左右" and len(word) > 1:
            side, word = SIDE_WORDS[word[0]], word[1:]
        elif word.isascii() and word not in _FUSED:
            word, ahead, mark = _fused(word)
            side = side or mark
            if ahead:  # it is told from the limb's words below
                words.append(ahead)
        words.append(word)
    if len(words) > 1 and words[-1] in LAST_WORDS:
        words.pop()
    if words and words[0] in LAYERS and len(words) > 1:
        layer = LAYERS[words.pop(0)]
    if CONTROL_WORDS & set(words) or bare.startswith("c_"):
        layer = 3
        words = [w for w in words if w not in CONTROL_WORDS] if bare.startswith("c_") else words
    size = len(words)
    if (_LIMB | _HAND) & set(words):
        kept, place, side = _placed(words, side)
        return Name(kept, side, layer, place, size)
    return Name(tuple(words), side, layer, place, size)


def _side_at(words: Sequence[str]) -> int | None:
    """Which word says left or right: one in full before a letter, the last letter before others (`r_toe.L`)."""
    full = [k for k, word in enumerate(words) if word in SIDE_WORDS and word not in ("l", "r")]
    letters = [k for k, word in enumerate(words) if word in ("l", "r")]
    return full[0] if full else letters[-1] if letters else None


def _fused(word: str) -> tuple[str, str, str]:
    """(word, place word or "", side or "") of words written as one: `lfoot`, `forefoot`, `frontleftpaw`."""
    for place in ("", *PLACE_WORDS):
        for mark in ("", "left", "right", "l", "r"):
            for start in {place + mark, mark + place}:
                if start and word.startswith(start) and word[len(start) :] in _FUSED:
                    return word[len(start) :], place, SIDE_WORDS.get(mark, "")
    return word, "", ""


def _placed(words: Sequence[str], side: str) -> tuple[tuple[str, ...], str, str]:
    """(words without those that say which limb, the place they say, the side)."""
    kept, place, hand = [], "", _HAND & set(words)
    for k, word in enumerate(words):
        beside = [words[n] for n in (k - 1, k + 1) if 0 <= n < len(words)]
        if word in PLACE_WORDS and not (hand and PLACE_WORDS[word] == "mid"):  # a hand has a middle finger
            place = PLACE_WORDS[word]
        elif not side and word in CORNERS:
            place, side = CORNERS[word]
        elif side and word in PLACE_LETTERS and not _LIMB.isdisjoint(beside):
            place = PLACE_LETTERS[word]
        else:
            kept.append(word)
    return tuple(kept or words), place, side


def rank_of(words: Sequence[str], table: Sequence[str]) -> int | None:
    """Index of the first pattern that ends the name, or None; a copy's number is passed over last."""
    text = " ".join(words)
    for rank, pattern in enumerate(table):
        if text == pattern or text.endswith(" " + pattern):
            return rank
    if len(words) > 1 and len(words[-1]) == 3 and words[-1].isdigit():
        copied = rank_of(words[:-1], table)
        return None if copied is None else copied + len(table)
    return None


def is_toe(name: str) -> bool:
    """Is a bone named like a toe?"""
    words = read(name).words
    return rank_of(words, TOE) is not None or any("toe" in w for w in words)
