"""In a window: the bake runs in slices, shows how far it is, and ESC or Cancel stops it; Auto Update takes no key; the
first print takes three clicks and no number; what is in hand presses, and is kept or dropped."""

import pathlib

import windowed

HERE = pathlib.Path(__file__).resolve().parent


def test_modal_bake(folder):
    windowed.story(HERE / "window.py", folder)


def test_auto_update(folder):
    windowed.story(HERE / "window_live.py", folder)


def test_first_print(folder):
    windowed.story(HERE / "window_walk_it.py", folder, width=1280, height=800)


def test_press(folder):
    windowed.story(HERE / "window_press.py", folder, width=1280, height=800)
