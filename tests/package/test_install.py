"""The zip in every Blender, the wheel in a Python without Blender.

scripts/test package runs this, in about a minute. DESIRE_PATH_PY313 names a Python with bpy 5.2.
"""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PY313 = os.environ.get("DESIRE_PATH_PY313", "")
COMING = Path(__file__).with_name("coming.py")
OWN = os.environ.get("DESIRE_PATH_BLENDER") or "blender"  # of this machine


def own_version():
    """3.4 on Debian 12."""
    told = subprocess.run([OWN, "--version"], env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True).stdout
    return re.match(r"Blender (\d+\.\d+)", told)[1]


BLENDERS = {own_version(): None, "4.5": sys.executable, "5.2": PY313}


@pytest.fixture(scope="module")
def zipped(tmp_path_factory):
    out = tmp_path_factory.mktemp("dist")
    subprocess.run([sys.executable, str(ROOT / "scripts" / "package"), "--no-build", "--out", str(out)], check=True)
    return next(out.glob("*.zip"))


def blender_command(version, script, *words):
    if BLENDERS[version] is None:
        return [OWN, "-b", "--factory-startup", "--python-exit-code", "1", "-P", str(script), "--", *words]
    assert BLENDERS[version], "DESIRE_PATH_PY313 names no Python with bpy 5.2"
    return [BLENDERS[version], str(script), *words]


def clean(home):
    """The environment of somebody who never started Blender."""
    return {
        "PATH": "/usr/bin:/bin",
        "HOME": str(home),
        "XDG_CONFIG_HOME": str(home / "config"),
        "XDG_CACHE_HOME": str(home / "cache"),
        "LANG": "C.UTF-8",
    }


def folder_of(python, package):
    """Where this Python keeps a package."""
    code = f"import importlib.util as u; print(u.find_spec({package!r}).origin)"
    told = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True)
    return Path(told.stdout.strip()).parent


@pytest.mark.parametrize("version", BLENDERS)
def test_the_zip_comes_bakes_and_goes(zipped, tmp_path, version):
    told = subprocess.run(
        blender_command(version, COMING, str(zipped), version, str(tmp_path / "bake")),
        env=clean(tmp_path),
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert "INSTALLED" in told.stdout and told.returncode == 0, told.stdout + told.stderr
    assert "Traceback" not in told.stdout + told.stderr


def test_the_zip_of_before_makes_room(zipped):
    """Blender 3.4 empties a folder that the zip names; else it writes into the module that it runs, and ends by it."""
    with zipfile.ZipFile(zipped) as files:
        assert files.namelist()[0] == "desire_path/"


@pytest.mark.parametrize("version", ["4.5", "5.2"])
def test_blender_calls_the_zip_valid(zipped, version):
    python = BLENDERS[version]
    assert python, "DESIRE_PATH_PY313 names no Python with bpy 5.2"
    tool = next(folder_of(python, "bpy").glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    told = subprocess.run([python, str(tool), "validate", str(zipped)], capture_output=True, text=True)
    assert told.returncode == 0 and "Success" in told.stdout, told.stdout + told.stderr


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    out = tmp_path_factory.mktemp("wheel")
    tree = tmp_path_factory.mktemp("tree")
    subprocess.run(["git", "clone", "-q", "--no-hardlinks", str(ROOT), str(tree / "clone")], check=True)
    told = subprocess.run(
        [
            sys.executable,
            "-m",
            "pip",
            "wheel",
            "-q",
            "--disable-pip-version-check",
            "--no-deps",
            "-w",
            str(out),
            str(tree / "clone"),
        ],
        capture_output=True,
        text=True,
    )
    assert told.returncode == 0, told.stdout + told.stderr
    return next(out.glob("*.whl"))


def test_the_wheel_serves_every_python_from_3_11(wheel):
    assert "-cp311-abi3-linux_" in wheel.name
    with zipfile.ZipFile(wheel) as files:
        names = files.namelist()
        meta = files.read(next(n for n in names if n.endswith("METADATA"))).decode()
    assert "desire_path/_native.abi3.so" in names and "desire_path/blender/__init__.py" in names
    assert not [n for n in names if "test" in n or n.endswith((".pyc", ".c", ".h"))]
    needs = [line for line in meta.splitlines() if line.startswith("Requires-Dist")]
    assert [line for line in needs if "extra ==" not in line] == ["Requires-Dist: numpy>=1.23"]
    assert sorted(line for line in needs if "extra ==" in line) == [
        'Requires-Dist: matplotlib>=3.6; extra == "plot"',
        'Requires-Dist: rasterio>=1.3; extra == "geotiff"',
        'Requires-Dist: scipy>=1.9; extra == "fit"',
        'Requires-Dist: usd-core>=23.11; extra == "usd"',
    ]
    data = ("walks/walk.npz", "walks/README.md", "py.typed", "_native.pyi", "_native_types.pyi")
    assert {f"desire_path/{each}" for each in data} <= set(names)


@pytest.mark.parametrize("python", [sys.executable, PY313], ids=["3.11", "3.13"])
def test_the_wheel_runs_without_blender(wheel, tmp_path, python):
    assert python, "DESIRE_PATH_PY313 names no Python 3.13"
    subprocess.run([python, "-m", "venv", str(tmp_path / "env")], check=True)
    inside = str(tmp_path / "env" / "bin" / "python")
    subprocess.run(
        [inside, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--no-deps", str(wheel)], check=True
    )
    code = """
import sys
sys.modules["bpy"] = None   # importing it would fail
import numpy as np
import desire_path
from desire_path.ground import maps
maps.write("a.exr", {"heap": np.eye(3)})
assert (maps.read("a.exr").planes["heap"] == np.eye(3)).all()
print(desire_path.__file__)
"""
    # NumPy is that of the environment around; bpy, which is there too, must not be asked for
    env = {**clean(tmp_path), "PYTHONPATH": str(folder_of(python, "numpy").parent)}
    told = subprocess.run([inside, "-c", code], capture_output=True, text=True, cwd=tmp_path, env=env)
    assert told.returncode == 0 and str(tmp_path) in told.stdout, told.stdout + told.stderr
    told = subprocess.run(
        [inside, "-m", "desire_path", "--version"], capture_output=True, text=True, cwd=tmp_path, env=env
    )
    assert told.returncode == 0 and told.stdout.strip()[:1].isdigit(), told.stdout + told.stderr
