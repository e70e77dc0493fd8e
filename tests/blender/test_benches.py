"""The benches of Blender start: who renames what they call hears of it. What they tell is for people."""

import bpy
import windowed
from bench import starts

WORDS = {  # of each, as little as it does
    "dynamic_paint": ("--sizes", "64,80", "--runs", "1", "--frame-rate", "24"),
    "landscape": (),
    "playback": ("64",),
    "press": ("--steps", "2"),
    "sampling": ("6", "1"),
}
WINDOWS = {"panels"}


def test_every_bench_is_started():
    assert set(starts.python(with_blender=True)) == set(WORDS) | WINDOWS


def test_they_start():
    for name, words in WORDS.items():
        assert starts.run(starts.python(with_blender=True)[name], *words, blender=bpy.app.binary_path).strip(), name


def test_panels_are_timed_in_a_window(folder):
    said = windowed.story(starts.python(with_blender=True)["panels"], folder, width=1920, height=1080, words=("2",))
    assert "DESIRE_PATH_PT_" in said or "median" in said
