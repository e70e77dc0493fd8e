"""A crowd that was stopped goes on, to the same bits. MODEL 12.7"""

import filecmp
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from scenes.crowds import Stopped, pressed, small, stop_after
from scenes.kills import die_after

from desire_path.crowd import crowd as crowds
from desire_path.crowd import feet as feet_of_crowds
from desire_path.crowd import scene as scenes
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.feet import Feet

REPO = Path(__file__).resolve().parents[2]


def same(a, b):
    names = ["paths.csv", "cover_final.exr", "crowd.json", *(f"frames/{name}" for name in os.listdir(a / "frames"))]
    assert len(names) > 5 and sorted(os.listdir(a / "frames")) == sorted(os.listdir(b / "frames"))
    return filecmp.cmpfiles(a, b, names, shallow=False)[0] == names


def test_a_crowd_that_was_stopped_goes_on_to_the_same_bits(tmp_path, monkeypatch):
    scene = scenes.of(small(film_every=40))
    Crowd(scene, tmp_path / "whole").run()
    for every in (0.0, 1e9):  # with a state after each renewal, and with none
        monkeypatch.setattr(crowds, "EVERY", every)
        folder = tmp_path / f"stopped {every:g}"
        for count in (1, 3, 2):
            with pytest.raises(Stopped):
                Crowd(scene, folder).run(stop_after(count))
            with open(folder / "paths.csv", "ab") as file:
                file.write(b"17,0,half a li")
        begun = []
        Crowd(scene, folder).run(begun.append)
        assert same(tmp_path / "whole", folder)
        assert (begun[0] > 0.2) == (every == 0.0)
        assert not os.path.exists(folder / "crowd.lock")


def test_a_folder_of_another_crowd_begins_anew(tmp_path, monkeypatch):
    monkeypatch.setattr(crowds, "EVERY", 0.0)
    Crowd(scenes.of(small(film_every=40)), tmp_path / "whole").run()
    with pytest.raises(Stopped):
        Crowd(scenes.of({**small(film_every=20), "seed": 7}), tmp_path / "other").run(stop_after(12))
    Crowd(scenes.of(small(film_every=40)), tmp_path / "other").run()
    assert same(tmp_path / "whole", tmp_path / "other")
    state = (tmp_path / "other" / "crowd.state").read_bytes()
    (tmp_path / "other" / "crowd.state").write_bytes(state[:-9] + b"x" + state[-8:])  # damaged: it begins anew
    Crowd(scenes.of(small(film_every=40)), tmp_path / "other").run()
    assert same(tmp_path / "whole", tmp_path / "other")


def child(folder, steps):
    """Let a crowd walk and press, with a state after everybody; die at a number of steps in the folder."""
    crowds.EVERY = feet_of_crowds.EVERY = 0.0
    steps_taken = die_after(folder, steps)
    scene = scenes.of({**pressed(plants=["carex:20"]), "passages": 8, "renewals": 8, "film_every": 2})
    Crowd(scene, folder).run()
    Feet(scene, folder).press()
    print(steps_taken())


def walked(folder, steps):
    """How many steps it took, -1 if it was killed before its end."""
    paths = [str(REPO / "addon"), str(REPO / "tests"), str(REPO / "tests" / "core")]
    script = (
        f"import sys; sys.path[:0] = {paths!r}\nfrom test_crowd_resume import child; child({str(folder)!r}, {steps})"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode in (0, -signal.SIGKILL), done.stderr
    return int(done.stdout) if done.returncode == 0 else -1


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="nothing is killed so here")
def test_a_crowd_that_was_killed_goes_on_to_the_same_bits(tmp_path):
    """Whatever was being written: it is killed again and again, a little later each time."""
    every = walked(tmp_path / "whole", 0)
    assert every > 40
    killed = sum(walked(tmp_path / "killed", every * share // 20) < 0 for share in (3, 6, 5, 7))
    assert killed == 4
    assert walked(tmp_path / "killed", 0) > 0
    names = sorted(os.listdir(tmp_path / "whole"))
    assert sorted(os.listdir(tmp_path / "killed")) == names
    assert same(tmp_path / "whole", tmp_path / "killed")
    for name in ("trodden_final.exr", "feet.json"):
        assert (tmp_path / "whole" / name).read_bytes() == (tmp_path / "killed" / name).read_bytes()
