"""The fuzzer of the parsers finds what it is there to find; scripts/test gives it many more files."""

import itertools
import random
import signal

import pytest

from desire_path.errors import DesirePathError
from desire_path.study import trampling
from tests.fuzz import mutate, parsers


@pytest.mark.parametrize("name", parsers.PARSERS)
def test_damaged_files_are_read_or_told(name, tmp_path):
    (tmp_path / "place").mkdir()
    assert parsers.fuzz(name, 150, 2, tmp_path / "place", tmp_path) == ([], 150)


def raises(path):
    raise ValueError("nobody caught this")


def takes_long(path):
    while True:
        sum(range(1000))


def waits(path):
    signal.pause()


def mumbles(path):
    raise DesirePathError("line 4711")


@pytest.mark.parametrize(
    "fault, words",
    [
        (raises, "nobody caught this"),
        (takes_long, "computed for longer than 0.5 s"),
        (waits, "was stuck for 2 s"),
        (mumbles, "says 'line 4711'"),
    ],
)
def test_faults_are_found_and_their_files_kept(fault, words, tmp_path, monkeypatch):
    good = trampling.read
    if fault in (takes_long, waits):
        monkeypatch.setattr(parsers, "LONG", 0.5)
        monkeypatch.setattr(parsers, "STUCK", 2 if fault is waits else parsers.STUCK)
    monkeypatch.setattr(
        trampling, "read", lambda path: fault(path) if b"25,86.3" not in path.read_bytes() else good(path)
    )
    (tmp_path / "place").mkdir()
    (found,), _ = parsers.fuzz("cover", 500, 1, tmp_path / "place", tmp_path, most=1)
    assert words in found
    (kept,) = tmp_path.glob("fuzz_cover_*")
    assert b"25,86.3" not in kept.read_bytes()


@pytest.mark.parametrize("change", [mutate.any_bytes, mutate.text, mutate.tree, mutate.archive])
def test_the_same_seed_damages_alike(change):
    good = b'{"a": [1, 2.5], "b": {"c": "x"}}\n1,2,3\n'

    def damaged(seed):
        chance = random.Random(seed)
        return [change(chance, good, good) for _ in range(200)]

    assert damaged(3) == damaged(3) != damaged(4)
    assert sum(a != b for a, b in itertools.pairwise(damaged(3))) > 190
