"""The benches that need no Blender start: who renames what they call hears of it. What they tell is for people."""

import pytest
from bench import starts

WORDS = {  # of each, as little as it does
    "crowd": ("2", "3", "10"),
    "lane": ("1",),
    "plates": ("squats", "gait_opensim_walk"),
}


def test_every_bench_is_started():
    assert set(starts.python(with_blender=False)) == set(WORDS)


@pytest.mark.parametrize("name", WORDS)
def test_it_starts(name):
    assert starts.run(starts.python(with_blender=False)[name], *WORDS[name]).strip()
