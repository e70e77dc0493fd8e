"""Names of bones: how they are cut into words, and which words mean feet, toes, hips ..

The tables are data: a slot lists word patterns, best first. A bone's name is cut into words
(`mixamorig9:LeftToeBase` -> toe base, side L), and a pattern matches the last words of a name, so
that a character's own name in front (`Bob L Foot`) does no harm, nor does the number that Blender
puts behind a copy (`foot.L.001`).
"""

import re
from dataclasses import dataclass

# ---- the tables ----------------------------------------------------------------------------------

FOOT = ("foot", "ankle", "paw", "hoof", "feet", "足首")
TOE = ("toe base", "toebase", "toes", "toe", "ball", "toe 0", "toes 01", "toe 01", "toes 1", "toe 1",
       "big toe", "bigtoe", "bigtoe 1", "big toe 1", "toe 1 1", "toe 2 1", "toe 3 1", "toes 001",
       "つま先", "足先 ex", "足先")
HEEL = ("heel 02", "heel", "heel 01", "heel ref", "calcaneus", "かかと")
THIGH = ("up leg", "upleg", "upper leg", "upperleg", "thigh", "femur", "leg upper", "thigh stretch",
         "hip", "足")
SHANK = ("low leg", "lowleg", "lower leg", "lowerleg", "shin", "calf", "tibia", "knee", "leg lower",
         "leg stretch", "leg", "ひざ")
HIPS = ("hips", "pelvis", "下半身", "hip", "spine", "root", "center", "センター", "torso")
NECK = ("neck", "neck 01", "neck 1", "neck twist 01", "lower neck", "lowerneck", "neck lower", "neck x", "首",
        "spine 004", "spine 005")
HEAD = ("head", "head x", "頭", "spine 006")
CHEST = ("upper chest", "chest", "spine 03", "spine 3", "spine 2", "spine 02", "thorax", "spine 1",
         "上半身2", "上半身")

LAYERS = {"def": 0, "org": 1}  # then plain names (2), then controls (3)
CONTROL_WORDS = {
    "ik", "fk", "ctrl", "control", "controller", "ctl", "roll", "rock", "pole", "target", "pivot",
    "spin", "tweak", "mch", "vis", "gizmo", "handle", "socket", "snap", "wgt", "widget", "goal",
    "dummy", "helper", "ref", "parent", "effector", "twist", "share", "bend", "pin", "ｉｋ", "親"}
NEVER_WORDS = {"end", "nub", "site", "effector", "tweak", "mch", "wgt"}
SIDE_WORDS = {"l": "L", "left": "L", "lft": "L", "r": "R", "right": "R", "rgt": "R", "左": "L",
              "右": "R"}
PLACE_WORDS = {"front": "front", "fore": "front", "hind": "", "rear": "", "back": "",
               "mid": "mid", "middle": "mid"}  # of a foot among many


# ---- names ------------------------------------------------------------------------------------------

_WORD = re.compile(r"[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+|\d+|[^\x00-\x7f]+")
_FUSED = {w for table in (FOOT, TOE, HEEL, THIGH, SHANK) for w in table if w.isascii() and w.isalpha()}


@dataclass(frozen=True)
class Name:
    words: tuple  # without side and layer
    side: str  # "L", "R" or ""
    layer: int


def read(name):
    """Words, side and layer of a bone's name."""
    bare = name.rsplit(":", 1)[-1]
    words, side, layer = [], "", 2
    for raw in _WORD.findall(bare):
        word = raw.lower()
        if word in SIDE_WORDS and not side:
            side = SIDE_WORDS[word]
            continue
        if not side and word[0] in "左右" and len(word) > 1:
            side, word = SIDE_WORDS[word[0]], word[1:]
        elif not side:
            for mark in ("left", "right", "l", "r"):
                if word.startswith(mark) and word[len(mark):] in _FUSED and word not in _FUSED:
                    side, word = SIDE_WORDS[mark], word[len(mark):]
                    break
        words.append(word)
    if words and words[0] in LAYERS and len(words) > 1:
        layer = LAYERS[words.pop(0)]
    if CONTROL_WORDS & set(words) or bare.startswith("c_"):
        layer = 3
        words = [w for w in words if w not in CONTROL_WORDS] if bare.startswith("c_") else words
    return Name(tuple(words), side, layer)


def rank_of(words, table):
    """Index of the first pattern that ends the name, or None; a copy's number is passed over last."""
    text = " ".join(words)
    for rank, pattern in enumerate(table):
        if text == pattern or text.endswith(" " + pattern):
            return rank
    if len(words) > 1 and len(words[-1]) == 3 and words[-1].isdigit():
        rank = rank_of(words[:-1], table)
        return None if rank is None else rank + len(table)
    return None


def is_toe(name):
    """Is a bone named like a toe?"""
    words = read(name).words
    return rank_of(words, TOE) is not None or any("toe" in w for w in words)
