"""Modules go on being found by the names they had when all of them lay in one folder."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import desire_path
from desire_path import old_names

HOME = Path(desire_path.__file__).parent


def run(folder, *lines, words=("-W", "error")):
    told = subprocess.run(
        [sys.executable, *words, "-c", "\n".join(lines)],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": ""},
    )
    return told.returncode, told.stdout + told.stderr


def test_every_old_name_is_the_module_itself():
    lines = ["import warnings; warnings.simplefilter('ignore')", "from importlib import import_module as load"]
    for old, new in old_names.MODULES.items():
        assert (HOME / (new.replace(".", "/") + ".py")).exists(), new
        lines += [
            f"new, old = load('desire_path.{new}'), load('desire_path.{old}')",
            f"assert old is new and new.__spec__.name == new.__name__ == 'desire_path.{new}', new.__spec__",
        ]
    assert run(HOME.parent, *lines) == (0, "")


@pytest.mark.parametrize(
    "line",
    [
        "from desire_path import walker",
        "import desire_path.walker",
        "import desire_path.walker as walks",
        "from desire_path.walker import Walker",
        "import desire_path; desire_path.walker",
    ],
)
def test_an_old_name_warns_where_it_is_written(line, tmp_path):
    (tmp_path / "script.py").write_text(f"\n\n{line}\n{line}\n")
    told = subprocess.run(
        [sys.executable, "script.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(HOME.parent)},
    )
    assert told.returncode == 0, told.stderr
    assert told.stderr.count("DeprecationWarning") == 1 and "script.py:3" in told.stderr, told.stderr
    assert "desire_path.walker is an old name of desire_path.loads.walker" in told.stderr


def test_new_names_are_quiet():
    assert run(
        HOME.parent,
        "from desire_path import Bake, Gait, Simulation, Walker",
        "from desire_path.loads import walker",
        "from desire_path.bake import Bake, free, read_index",
        "import desire_path.placement.passes",
    ) == (0, "")


def test_the_package_may_have_any_name(tmp_path):
    (tmp_path / "outer").mkdir()
    (tmp_path / "outer" / "inner").symlink_to(HOME)
    told = run(
        tmp_path,
        "from outer.inner import walker",
        "print(walker.__name__)",
        "from outer.inner.gait import Gait",
        "assert Gait is __import__('outer.inner').inner.Gait",
        "import sys; assert 'desire_path' not in sys.modules",
        words=("-W", "ignore"),
    )
    assert told == (0, "outer.inner.loads.walker\n")


def test_a_package_that_is_loaded_anew_has_one_finder():
    told = run(
        HOME.parent,
        "import importlib, sys, desire_path",
        "importlib.reload(desire_path)",
        "print(sum(type(each).__name__ == 'Finder' for each in sys.meta_path))",
    )
    assert told == (0, "1\n")


def test_what_never_was_is_not_found():
    code, told = run(HOME.parent, "import desire_path.runner")
    assert code == 1 and "No module named 'desire_path.runner'" in told
    with pytest.raises(AttributeError, match="runner"):
        desire_path.runner  # noqa: B018
