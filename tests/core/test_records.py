"""Records that hold arrays: compared by value, shown short, and not to be written, nor are their copies."""

import ast
import copy
import inspect
import pickle
from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from scenes import gaits
from scenes.modules import modules

import desire_path
from desire_path import Ground
from desire_path.arrays import Record
from desire_path.ground.layers import Layer
from desire_path.ground.plants import Planting
from desire_path.ground.pressing import PressBody
from desire_path.ground.spray import Grains
from desire_path.ground.trail import Trail
from desire_path.loads import walker
from desire_path.motion import tracks
from desire_path.motion.recording import Recording
from desire_path.rig.skeleton import Skin


@pytest.fixture(scope="module")
def gait():
    return gaits.strides(3.0)[0]


def records(gait):
    """One maker for each kind of record with arrays, and how it differs from another."""
    heights = np.array([[0.0, np.nan], [0.1, 0.2]])
    vertices = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], float)
    nothing = np.zeros((2, 3), np.float32)
    return {
        "Gait": (lambda: gait.piece(0, 20), lambda: gait.piece(1, 21)),
        "Sole": (lambda: gaits.box(0.2, 0.1), lambda: gaits.box(0.2, 0.11)),
        "FootForce": (lambda: walker.loads(gait), lambda: walker.loads(gait, ground=0.01)),
        "Ground": (lambda: Ground.heights(heights, 0.5), lambda: Ground.heights(heights, 0.6)),
        "Ground ": (lambda: Ground.mesh(vertices, [(0, 1, 2)]), lambda: Ground.mesh(2 * vertices, [(0, 1, 2)])),
        "Trail": (
            lambda: Trail("a.exr", 0.01, 0.0, 0.0, nothing, nothing, nothing, nothing, True, False),
            lambda: Trail("a.exr", 0.01, 0.0, 0.0, nothing + 1, nothing, nothing, nothing, True, False),
        ),
    }


KNOWN = ("Gait", "Sole", "FootForce", "Ground", "Ground ", "Trail")


@pytest.mark.parametrize("kind", KNOWN)
def test_records_with_arrays_compare_by_value(kind, gait):
    make, other = records(gait)[kind]
    assert make() == make() and hash(make()) == hash(make())
    assert make() != other()
    assert make() != "else" and make() is not None and make() != 1


def test_a_recording_in_tracks_is_one_in_arrays(gait):
    in_tracks = lambda pose: tracks.TrackArray(2, len(gait.time), [(np.arange(2), 0, pose)])
    assert replace(gait, pose=in_tracks(gait.pose)) == gait
    assert replace(gait, pose=in_tracks(gait.pose + np.array([1e-9] + 6 * [0.0]))) != gait


@pytest.mark.parametrize("kind", KNOWN)
def test_records_are_shown_on_one_short_line(kind, gait):
    told = repr(records(gait)[kind][0]())
    assert "\n" not in told and len(told) < 120 and told.startswith(kind.strip() + "(")


def test_a_recording_says_who_when_and_how_fast(gait):
    assert repr(gait) == f"Gait(1 walker, 2 limbs, {len(gait.time)} samples, {gait.time[-1]:.6g} s, 60 a second)"
    broken = replace(gait, time=[], cut=[5])
    assert repr(broken).startswith("Gait(1 walker, 2 limbs, 0 samples")
    uneven = replace(gait, time=gait.time**2 + gait.time)
    assert repr(uneven).endswith("no even rate)")


def arrays_of(value):
    """Every array in a record, and in the records and tuples that it holds."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, (tuple, list)):
        for each in value:
            yield from arrays_of(each)
    elif isinstance(value, Mapping):
        yield from arrays_of(tuple(value.values()))
    elif is_dataclass(value):
        for each in fields(value):
            yield from arrays_of(getattr(value, each.name))


AGAIN = {
    "itself": lambda record: record,
    "its copy": copy.deepcopy,
    "its pickle": lambda record: pickle.loads(pickle.dumps(record)),
}


@pytest.mark.parametrize("kind", KNOWN)
@pytest.mark.parametrize("again", AGAIN)
def test_arrays_of_a_record_are_read_only(kind, again, gait):
    record = AGAIN[again](records(gait)[kind][0]())
    held = list(arrays_of(record))
    assert held and not any(array.flags.writeable for array in held)
    with pytest.raises(ValueError, match="read-only"):
        held[0].fill(0)


def classes():
    """Every dataclass of the package without Blender that has arrays."""
    for module in modules():
        for name, each in vars(module).items():
            own = inspect.isclass(each) and each.__module__ == module.__name__ and is_dataclass(each)
            if own and not name.startswith("_") and (issubclass(each, Record) or holds_arrays(fields(each))):
                yield each


def holds_arrays(held):
    return any("ndarray" in str(field.type) for field in held)


def test_every_frozen_class_with_arrays_is_a_record():
    """So == compares values; no other class with arrays compares them, which would raise."""
    for each in classes():
        assert not each.__dataclass_params__.eq, each
        assert issubclass(each, Record) or not each.__dataclass_params__.frozen, each


def test_no_class_of_the_blender_half_compares_arrays():
    half = Path(desire_path.__file__).parent / "blender"
    found = 0
    for path in sorted(half.glob("*.py")):
        for each in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            marks = [ast.unparse(mark) for mark in getattr(each, "decorator_list", ())]
            if any("dataclass" in mark for mark in marks) and "np.ndarray" in ast.unparse(each):
                assert "eq=False" in marks[0], f"{path.name}: {each.name}"
                found += 1
    assert found > 5


def filled(each):
    """A record with an array wherever one may be, in tuples and mappings, too."""
    kinds = {"ndarray": np.ones(3), "Mapping": {"a": np.ones(3)}, "tuple": (np.ones(3), (np.ones(2),))}
    return each(*(next((v for word, v in kinds.items() if word in str(f.type)), None) for f in fields(each)))


OWN = {  # records that make something of what they are given
    "Gait": lambda gait: gait.piece(0, 20),
    "Recording": lambda gait: Recording(**{f.name: getattr(gait, f.name) for f in fields(Recording)}),
    "Sole": lambda gait: gaits.box(0.2, 0.1),
    "Ground": lambda gait: Ground.heights(np.zeros((2, 2)), 0.5),
    "Grains": lambda gait: Grains(np.zeros((3, 3)), np.ones((3, 3)), np.zeros(3, int), np.arange(3)),
    "Layer": lambda gait: Layer("mud", 0.03, np.full(4, 0.5)),
    "Planting": lambda gait: Planting("lawn", roots=[(0, 0), (1, 1)], vigour=[0, 1]),
    "PressBody": lambda gait: PressBody([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]),
}


def test_no_array_of_any_record_may_be_written(gait):
    """Nor of its copies; what it was given stays its giver's."""
    seen = set()
    for each in filter(lambda each: issubclass(each, Record), classes()):
        makes_its_own = each.__post_init__ is not Record.__post_init__ or "__init__" in vars(each) and each is Layer
        record = OWN[each.__name__](gait) if makes_its_own else filled(each)
        for again in AGAIN.values():
            held = list(arrays_of(again(record)))
            assert held and not any(array.flags.writeable for array in held), each
        seen.add(each.__name__)
    assert seen > set(OWN) and len(seen) > 25


def test_a_record_has_mappings_of_its_own():
    given = {"Foot": np.ones(3, np.float32)}
    skin = Skin(np.zeros((3, 3)), np.zeros((1, 3), int), given)
    for again in AGAIN.values():
        assert again(skin) == skin and not again(skin).weights["Foot"].flags.writeable
    given["Foot"][0] = 2.0  # its giver may still write
    del given["Foot"]
    assert list(skin.weights) == ["Foot"]


def test_arrays_in_tracks_are_read_only(gait):
    pose = tracks.TrackArray(2, len(gait.time), [(np.arange(2), 0, np.array(gait.pose))])
    record = replace(gait, pose=pose)
    pose.put([0], [0], np.ones((1, 1, 7)))  # its giver may still write
    assert (record.pose[0, 0] == 1.0).all()
    with pytest.raises(ValueError, match="read-only"):
        record.pose.put([0], [0], np.zeros((1, 1, 7)))


def test_layers_differ_by_how_much_of_them_there_is():
    make = lambda share: Layer("mud", 0.03, np.full(4, share))
    assert make(0.5) == make(0.5) and make(0.5) != make(0.25) and make(1.0) != Layer("mud", 0.03)
    assert not make(0.5).share.flags.writeable and "\n" not in repr(make(0.5))


def test_a_record_of_no_words_of_its_own_is_shown_short():
    make = lambda x: Grains(*(np.full((3, 3), x, float), np.ones((3, 3)), np.zeros(3, int), np.arange(3)))
    assert repr(make(1)) == "Grains(position (3, 3), velocity (3, 3), soil (3,), name (3,))"
    assert make(1) == make(1) and make(1) != make(2) and hash(make(1)) == hash(make(1))
    with pytest.raises(ValueError, match="read-only"):
        make(1).position[0] = 2.0


def test_a_record_takes_arrays_without_a_copy_and_leaves_their_giver_free(gait):
    pose = np.array(gait.pose)
    record = replace(gait, pose=pose)
    assert np.shares_memory(record.pose, pose) and pose.flags.writeable


def test_arrays_of_a_planting_are_read_only():
    held = list(arrays_of(Planting("lawn", roots=[(0, 0), (1, 1)], vigour=[0, 1])))
    held += arrays_of(Planting("lawn", weight=np.ones((2, 2)), rectangle=(0, 0, 1, 1)))
    assert len(held) == 3 and not any(array.flags.writeable for array in held)
