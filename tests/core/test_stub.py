"""What _native.pyi and _native_types.pyi say is what the core has: every name, and how many arguments each takes."""

import ast
import re
from pathlib import Path

import pytest

from desire_path import _native

ADDON = Path(__file__).resolve().parents[2] / "addon" / "desire_path"
TREE = ast.parse((ADDON / "_native.pyi").read_text(encoding="utf-8"))
TYPED = ast.parse((ADDON / "_native_types.pyi").read_text(encoding="utf-8"))
TYPES = {node.name: node for node in TYPED.body if isinstance(node, ast.ClassDef) and not node.name.startswith("_")}
TOLD = {each.asname for node in TREE.body if isinstance(node, ast.ImportFrom) for each in node.names if each.asname}
SIZES = {node.target.id for node in TREE.body if isinstance(node, ast.AnnAssign) and not node.target.id.startswith("_")}
WORDS = {"no": 0, "one": 1}


def told(node):
    """Functions that a module or a class of the stub declares, by name."""
    return {each.name: each for each in node.body if isinstance(each, ast.FunctionDef)}


def public(owner):
    return {name for name in vars(owner) if not name.startswith("_")}


def counts(function):
    """(least, most) arguments, without self."""
    args = function.args.posonlyargs + function.args.args
    most = len([arg for arg in args if arg.arg != "self"])
    return most - len(function.args.defaults), most


def taken(function, first=()):
    """(least, most) arguments of a function of the core, by what it says of too few and of too many."""
    out = []
    for more in ((), (None,) * 50):
        with pytest.raises(TypeError) as refused:
            function(*first, *more)
        found = re.search(r"takes (?:exactly |at least |at most )?(\w+) (?:positional )?argument", str(refused.value))
        assert found, refused.value
        out.append(int(WORDS.get(found[1], found[1])))
    return tuple(out)


def test_every_name_of_the_core_is_told_and_no_other():
    assert {*told(TREE), *TOLD, *SIZES} == public(_native)
    assert {*TYPES} == TOLD
    assert all(type(getattr(_native, name)) is int for name in SIZES) and len(SIZES) > 2


@pytest.mark.parametrize("name", TYPES)
def test_every_method_is_told_and_no_other(name):
    assert {each for each in told(TYPES[name]) if not each.startswith("_")} == public(getattr(_native, name))


@pytest.mark.parametrize("name", told(TREE))
def test_functions_take_as_many_arguments_as_told(name):
    least, most = counts(told(TREE)[name])
    if most == 0:
        with pytest.raises(TypeError, match="takes no arguments"):
            getattr(_native, name)(None)
    else:
        assert taken(getattr(_native, name)) == (least, most)


def test_methods_take_as_many_arguments_as_told():
    soils = [{}]
    simulation = _native.Simulation(("flat", 0.0), soils, 0.01)
    film = simulation.open_frames(0, 0, 1, 1, "a test")
    for owner in (simulation, film):
        for name, method in told(TYPES[type(owner).__name__]).items():
            if name.startswith("_"):
                continue
            least, most = counts(method)
            if most == 0:
                with pytest.raises(TypeError, match="takes no arguments"):
                    getattr(owner, name)(None)
            else:
                assert taken(getattr(owner, name)) == (least, most), name


def test_words_of_a_simulation_are_as_told():
    words = [arg.arg for arg in told(TYPES["Simulation"])["__new__"].args.args[1:]]
    given = {"ground": ("flat", 0.0), "soils": [{}], "cell": 0.01}
    given |= {"origin": (0.0, 0.0), "law": 0, "heap": 0, "rim_width": 0.05, "max_sweeps": 10, "normal_radius": 0.1}
    given |= {"workers": 1, "times": None, "layers": None}
    assert words == list(given)
    _native.Simulation(**given)
