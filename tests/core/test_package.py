"""The package: one version, a binary that stands alone, a manifest Blender takes."""

import ast
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

import desire_path
from desire_path import _native, version

ROOT = Path(__file__).resolve().parents[2]
HOME = ROOT / "addon" / "desire_path"


def bl_info():
    """As Blender finds it: without running the file."""
    for node in ast.parse((HOME / "__init__.py").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and node.targets[0].id == "bl_info":
            return ast.literal_eval(node.value)
    raise AssertionError("__init__.py has no literal bl_info")


def manifest():
    return tomllib.loads((HOME / "blender_manifest.toml").read_text(encoding="utf-8"))


def test_one_version():
    assert re.fullmatch(r"\d+\.\d+\.\d+", version.VERSION)
    assert ".".join(map(str, bl_info()["version"])) == version.VERSION
    assert manifest()["version"] == version.VERSION
    assert desire_path.__version__ == version.VERSION


def test_one_name():
    assert manifest()["name"] == bl_info()["name"] == "Desire Path"
    assert manifest()["id"] == HOME.name
    assert bl_info()["blender"] == (3, 4, 0)


def test_the_manifest_keeps_blenders_rules():
    found = manifest()
    assert found["schema_version"] == "1.0.0" and found["type"] == "add-on"
    assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*[A-Za-z0-9]", found["id"])
    assert "__" not in found["id"]
    assert len(found["tagline"]) <= 64 and re.search(r"[\w)\]}]$", found["tagline"])
    assert tuple(map(int, found["blender_version_min"].split("."))) >= (4, 2, 0)
    assert found["license"] == ["SPDX:GPL-3.0-or-later"]
    assert all(re.match(r"\d{4}(-\d{4})? \S", line) for line in found["copyright"])
    assert set(found["tags"]) <= {"Physics", "Animation", "Bake", "Tracking", "Sculpt", "Mesh"}
    assert found["platforms"] == ["linux-x64"]
    for name, reason in found["permissions"].items():
        assert name in {"files", "network", "clipboard", "camera", "microphone"}
        assert 0 < len(reason) <= 64 and not reason.endswith(".")
    assert all(value not in ("", [], {}) for value in found.values())


def test_the_binary_stands_alone():
    path = Path(_native.__file__)
    assert path.name == "_native.abi3.so"
    told = subprocess.run(["nm", "-D", "--defined-only", str(path)], capture_output=True, text=True)
    assert [line.split()[-1] for line in told.stdout.splitlines()] == ["PyInit__native"]
    told = subprocess.run(["readelf", "-d", str(path)], capture_output=True, text=True)
    needed = set(re.findall(r"NEEDED.*\[(.+)\]", told.stdout))
    system = {"libc.so.6", "libm.so.6", "libpthread.so.0"}  # and the loader itself, for threads
    assert "libc.so.6" in needed and {n for n in needed if not n.startswith("ld-linux")} <= system
    assert "RPATH" not in told.stdout and "RUNPATH" not in told.stdout
    # nothing of ours is left to be found elsewhere
    told = subprocess.run(["nm", "-D", "--undefined-only", str(path)], capture_output=True, text=True)
    names = [line.split()[-1].split("@")[0] for line in told.stdout.splitlines()]
    ours = [name for name in names if name.startswith(("dp_", "exr_", "libdeflate", "imath"))]
    assert not ours


def test_the_zip_holds_what_users_need_and_nothing_else(tmp_path):
    for folder in ("a", "b"):
        subprocess.run(
            [sys.executable, str(ROOT / "scripts" / "package"), "--no-build", "--out", str(tmp_path / folder)],
            check=True,
            capture_output=True,
        )
    name = f"desire_path-{version.VERSION}.zip"
    first = tmp_path / "a" / name
    assert first.read_bytes() == (tmp_path / "b" / name).read_bytes()
    with zipfile.ZipFile(first) as zipped:
        names = zipped.namelist()
        assert zipped.testzip() is None
    assert all(entry.startswith("desire_path/") for entry in names)
    modules = {path.relative_to(HOME.parent).as_posix() for path in HOME.rglob("*.py")}
    assert {entry for entry in names if entry.endswith(".py")} == modules
    for wanted in (
        "__init__.py",
        "_native.abi3.so",
        "blender_manifest.toml",
        "LICENSE",
        "CHANGELOG.md",
        "THIRD-PARTY.md",
        "py.typed",
        "_native.pyi",
        "_native_types.pyi",
        "blender/__init__.py",
        "README.md",
        *(f"blender/pictures/{kind}.png" for kind in desire_path.KINDS),
    ):
        assert f"desire_path/{wanted}" in names
    assert not [entry for entry in names if re.search(r"test|__pycache__|\.pyc|\.orig|/\.|CMake|\.[ch]$", entry)]
    assert first.stat().st_size < 5_000_000


def test_importing_asks_for_nothing(tmp_path):
    """The package itself needs neither NumPy nor Blender until something is asked for."""
    code = "import sys; import desire_path; assert not {'numpy', 'bpy'} & set(sys.modules), sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=HOME.parent)


def test_the_licence_is_there_whole():
    text = (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert "GNU GENERAL PUBLIC LICENSE" in text and "Version 3, 29 June 2007" in text
    assert "END OF TERMS AND CONDITIONS" in text
    others = (ROOT / "addon" / "desire_path" / "THIRD-PARTY.md").read_text(encoding="utf-8")
    assert "OpenEXR" in others and "libdeflate" in others


def test_what_is_fetched_is_named_with_its_licence():
    """Packages of PyPI that scripts/install, CMake and pip get."""
    fetch = (ROOT / "scripts" / "install").read_text(encoding="utf-8")
    names = set(re.findall(r"\b([A-Za-z][\w-]+)==", fetch))
    for listed in re.findall(r'environment \S+ 3\.\d+ "([^"]+)"', fetch):
        names |= {re.split("[=$]", word)[0] for word in listed.split()}
    building = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    names |= set(re.findall(r'"([a-z-]+)>=[\d.]+"', building)) | {"pip", "uv"}
    names |= {name.lower() for name in re.findall(r"DP_([A-Z]+)_ARCHIVE", (ROOT / "native/openexr.cmake").read_text())}
    assert len(names) > 25 and {"bpy", "ziglang", "openexr", "setuptools", "pdoc"} <= names
    others = (ROOT / "addon" / "desire_path" / "THIRD-PARTY.md").read_text(encoding="utf-8").lower().replace("_", "-")
    said = set(re.findall(r"[a-z][a-z0-9-]+", others))
    assert {name.lower().replace("_", "-") for name in names} <= said


@pytest.mark.parametrize("name", ["maps_read", "maps_write", "Simulation"])
def test_the_native_door_says_what_it_does(name):
    assert getattr(_native, name).__doc__
