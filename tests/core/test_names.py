"""Words of many senses name nothing: the field's terms do, which say what is meant."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SENSES = {  # a word -> what to say instead
    "beast": "quadruped, multipod",
    "loan": "lease",
    "made": "created, or what it is",
    "reach": "root_radius, support_span, bounds",
    "told": "report, or what it is",
    "way": "velocity, displacement, path, direction, duration",
    "whole": "valid, complete",
}
KNOWN = {  # names that people use already, and of what files keep
    ("ground/sim.py", "reach"),
    ("placement/place.py", "reach"),
    ("placement/cycle.py", "way"),
    ("paths/arrival.py", "way"),
    ("rig/leg.py", "reach"),  # a leg reaches for its foot
}
HOME = ROOT / "addon" / "desire_path"
PAGES = {path.relative_to(HOME).as_posix(): path for path in sorted(HOME.rglob("*.py"))}
SOURCES = sorted((ROOT / "native").glob("*/*.[ch]"))


def named(text):
    """Names that a Python source gives to what is its own."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.arg):
            yield node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr


def named_in_c(text):
    """Names in a C source, without its comments and strings."""
    bare = re.sub(r'//[^\n]*|"(?:\\.|[^"\\\n])*"', " ", text)
    return set(re.findall(r"\b[A-Za-z_]\w*", bare))


@pytest.fixture(scope="module")
def names():
    """The names of each file, in lower case."""
    found = {file: {each.lower().strip("_") for each in named(path.read_text("utf-8"))} for file, path in PAGES.items()}
    return found | {path.name: {each.lower() for each in named_in_c(path.read_text("utf-8"))} for path in SOURCES}


@pytest.mark.parametrize("word", SENSES)
def test_names_say_what_is_meant(word, names):
    found = [file for file, own in names.items() if word in own and (file, word) not in KNOWN]
    assert not found, f"'{word}' says too little: say {SENSES[word]}"


def test_what_is_known_is_there(names):
    for file, word in KNOWN:
        assert word in names[file], (file, word)
