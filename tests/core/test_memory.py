"""A limit of memory is kept to: what does not fit waits on the disk, and comes back to the bit."""

import json
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from desire_path import memory
from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions
from desire_path.core import _native
from desire_path.crowd import scene as scenes
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.sim import Ground
from desire_path.motion.gait import Gait
from desire_path.study.trampling import WALK
from tests.core.test_bake import sentence
from tests.scenes.crowds import pressed

REPO = Path(__file__).resolve().parents[2]
MB = 1e6
CHILD = """
import sys
sys.path[:0] = [{addon!r}, {repo!r}]
from tests.core import test_memory
test_memory.{call}
with open("/proc/self/status") as status:  # getrusage tells that of whoever began it, too
    print("peak", *(1024 * int(line.split()[1]) for line in status if line.startswith("VmHWM")))
"""


def bake(folder, limit=None, plants=()):
    """Two passes along a bent way in small cells, which take twice the memory that Python takes."""
    gait = Gait.load(WALK).along(np.array([[0, 0], [9, 6], [0, 6]]), 2)
    options = BakeOptions(memory=limit, threads=2)
    return Bake(gait, Ground.flat(), "dry-sand", folder, cell_size=0.004, plants=plants, options=options)


def run(folder, limit=None):
    for _ in bake(Path(folder), limit).run():
        pass


def grow(folder, limit=None):
    for _ in bake(Path(folder), limit, "carex").run():
        pass


def child(call, **more):
    """Python that does it, after it has come to its end."""
    code = CHILD.format(addon=str(REPO / "addon"), repo=str(REPO), call=call)
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, **more)


def peak(call):
    """The most memory of a Python that did it [bytes]."""
    done = child(call)
    assert done.returncode == 0, done.stderr
    return int(done.stdout.split()[-1])


def files(folder):
    """What a bake left, but for the seconds it took."""
    found = {str(path.relative_to(folder)): path.read_bytes() for path in Path(folder).rglob("*") if path.is_file()}
    report = json.loads(found.pop("report.json"))
    return found, {name: report[name] for name in report if name not in ("seconds", "stages")}


def least(work="run"):
    """The smallest limit [bytes] that a Python of its own says it keeps to."""
    told = child(f"{work}('/nowhere', 1e7)").stderr
    return int(memory.size_of(told.rsplit("at least ", 1)[1].split(",")[0]))


@pytest.mark.parametrize("work", ["run", "grow"])
def test_a_bake_keeps_to_its_limit_and_leaves_the_same_bits(tmp_path, work):
    free, limit = tmp_path / "free", least(work)
    assert peak(f"{work}({str(free)!r})") > 1.5 * limit  # so that something has to leave
    assert peak(f"{work}({str(tmp_path / 'held')!r}, {limit})") < 1.1 * limit
    assert files(free) == files(tmp_path / "held")


def test_a_killed_bake_leaves_its_state_alone_and_goes_on(tmp_path):
    held, limit = tmp_path / "held", least()
    code = CHILD.format(addon=str(REPO / "addon"), repo=str(REPO), call=f"run({str(held)!r}, {limit})")
    process = subprocess.Popen([sys.executable, "-c", code])
    while not list(held.glob("bake.new/frames/bake_*.state")):
        assert process.poll() is None
        time.sleep(0.05)
    assert not list(held.glob("memory*"))
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert peak(f"run({str(held)!r}, {limit})") < 1.1 * limit
    run(tmp_path / "free")
    assert files(held) == files(tmp_path / "free") and read_index(held).complete


def test_a_limit_below_what_is_needed_is_refused_before_anything_is_written(tmp_path):
    with pytest.raises(DesirePathError) as error:
        run(tmp_path / "bake", "40M")
    text = sentence(error)
    assert "cannot be done in 40 MB of memory: give at least" in text
    assert not (tmp_path / "bake").exists()


def test_a_full_disk_is_told(tmp_path):
    def small():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20 << 20, 20 << 20))

    done = child(f"run({str(tmp_path / 'bake')!r}, {least()})", preexec_fn=small)
    assert done.returncode != 0 and "the disk is full" in done.stderr and "make room" in done.stderr
    assert not list(tmp_path.rglob("memory*"))


def test_what_comes_over_the_limit_and_cannot_leave_is_told(tmp_path):
    limit = _native.memory_resident() + memory.LEAST
    with memory.held(limit, tmp_path):
        memory.check_kept()
        mine = np.ones(int(2 * memory.LEAST / 8))  # Python's own
        _native.memory_ease()
        with pytest.raises(DesirePathError, match="give at least"):
            memory.check_kept()
        del mine
    memory.check_kept()


@pytest.mark.parametrize(
    "text, size", [("4G", 4e9), ("800M", 8e8), (" 1.5 gb ", 1.5e9), ("2GiB", 2e9), ("5000000", 5e6), (7e8, 7e8)]
)
def test_limits_are_read(text, size):
    assert memory.size_of(text) == size and BakeOptions(memory=text).memory == size


@pytest.mark.parametrize("text", ["", "much", "-4G", "0", 0, -1.0, float("nan"), float("inf"), True, "4 4G", [4]])
def test_limits_that_are_none_are_told(text):
    with pytest.raises(DesirePathError, match="write one as 4G or 800M"):
        BakeOptions(memory=text)


def test_the_commands_keep_to_it(tmp_path):
    def command(*words):
        words = [sys.executable, "-m", "desire_path", *map(str, words)]
        return subprocess.run(words, cwd=REPO / "addon", capture_output=True, text=True, env={**os.environ})

    (tmp_path / "scene.json").write_text(json.dumps(pressed()))
    words = {"bake": [WALK, "--cell", 0.02], "crowd": [tmp_path / "scene.json"]}
    for name, more in words.items():
        refused = command(name, *more, "--out", tmp_path / name, "--memory", "30M")
        assert refused.returncode == 1 and "give at least" in refused.stderr, refused
        assert not (tmp_path / name).exists()
        done = command(name, *more, "--out", tmp_path / name, "--memory", "4G")
        assert done.returncode == 0, done.stderr
    assert not list(tmp_path.rglob("memory*"))
    assert maps.read(tmp_path / "crowd" / "trodden_final.exr").planes["compression"].max() > 0.001
    assert scenes.read(tmp_path / "scene.json").press
