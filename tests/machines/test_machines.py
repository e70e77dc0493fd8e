"""What is built for other systems, as far as it runs here: Windows under Wine, Linux on ARM under QEMU.

scripts/test machines runs this, in some ten minutes; it is no part of scripts/test without words.
DESIRE_PATH_MACHINES names the folder that `scripts/install machines` makes: a Python with NumPy for each system.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
MACHINES = Path(os.environ.get("DESIRE_PATH_MACHINES", ""))
PACKAGE = [sys.executable, str(ROOT / "scripts" / "package")]
PLATFORMS = ("linux-x64", "linux-arm64", "windows-x64", "macos-x64", "macos-arm64")
RUNNERS = {
    "linux-x64": [],
    "windows-x64": ["wine"],
    "linux-arm64": ["qemu-aarch64", "-cpu", "cortex-a72", "-L", str(MACHINES / "arm64" / "system")],
}
LONGEST = 2400  # [s] of one program


def run(words, **more):
    """Wine asks for an input, and writes only into pipes."""
    told = subprocess.run(
        [str(word) for word in words],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        timeout=LONGEST,
        **more,
    )
    return told.returncode, told.stdout


@pytest.fixture(scope="session", autouse=True)
def at_home(tmp_path_factory):
    """A Windows of its own, which ends with the tests."""
    os.environ["WINEPREFIX"] = str(tmp_path_factory.mktemp("wine"))
    os.environ["WINEDEBUG"] = "-all"
    yield
    subprocess.run(["wineserver", "-k"], check=False)


@pytest.fixture(scope="session")
def dist(tmp_path_factory):
    out = tmp_path_factory.mktemp("dist")
    code, told = run([*PACKAGE, "--all", "--out", out])
    assert code == 0, told
    return out


class Machine:
    """A Python of another system with the add-on of its zip, and the golden worlds beside it."""

    def __init__(self, platform, dist, folder):
        self.platform, self.folder = platform, folder
        with zipfile.ZipFile(next(dist.glob(f"*[0-9]-{platform.replace('-', '_')}.zip"))) as zipped:
            zipped.extractall(folder / "addon")
        for name in ("golden", "scenes"):
            shutil.copytree(ROOT / "tests" / name, folder / "tests" / name)
        if platform == "windows-x64":
            shutil.copytree(MACHINES / "windows", folder / "python")
            places = ["python313.zip", ".", "site", self.path(folder / "addon")]
            (folder / "python" / "python313._pth").write_text("\n".join(places) + "\n")

    def path(self, path):
        return "Z:" + str(path).replace("/", "\\") if self.platform == "windows-x64" else str(path)

    def python(self, script):
        start = RUNNERS[self.platform]
        if self.platform == "windows-x64":
            return run([*start, self.folder / "python" / "python.exe", self.path(script)])
        if self.platform == "linux-x64":  # the module of the zip, not the one that scripts/build makes
            return run([sys.executable, script], env={**os.environ, "PYTHONPATH": f"{self.folder}/addon"})
        home = MACHINES / "arm64"
        places = {**os.environ, "PYTHONPATH": f"{self.folder}/addon:{home}/site", "PYTHONHOME": f"{home}/system/usr"}
        return run([*start, home / "system/usr/bin/python3.11", script], env=places)


@pytest.fixture(scope="session", params=RUNNERS)
def machine(request, dist, tmp_path_factory):
    return Machine(request.param, dist, tmp_path_factory.mktemp(request.param))


def test_every_system_has_a_zip_and_a_wheel(dist):
    zips = sorted(path.stem.rsplit("-", 1)[-1] for path in dist.glob("*.zip"))
    assert zips == sorted(["legacy_linux_x64", *(name.replace("-", "_") for name in PLATFORMS)])
    assert len(list(dist.glob("*-cp311-abi3-*.whl"))) == len(PLATFORMS)
    with zipfile.ZipFile(next(dist.glob("*-legacy_*.zip"))) as zipped:
        assert {"desire_path/__init__.py", "desire_path/_native.abi3.so"} < set(zipped.namelist())
        assert "desire_path/blender_manifest.toml" not in zipped.namelist()
    assert "## Install in Blender" in (dist / "NOTES.md").read_text(encoding="utf-8")
    for path in set(dist.glob("*.zip")) - set(dist.glob("*-legacy_*.zip")):
        with zipfile.ZipFile(path) as zipped:
            names = zipped.namelist()
            manifest = zipped.read("desire_path/blender_manifest.toml").decode()
        modules = [name for name in names if "_native" in name and not name.endswith(".pyi")]
        assert modules == ["desire_path/_native." + ("pyd" if "windows" in path.name else "abi3.so")]
        assert f'platforms = ["{path.stem.rsplit("-", 1)[-1].replace("_", "-")}"]' in manifest
    told = json.loads((dist / "index.json").read_text(encoding="utf-8"))
    assert sorted(each["platforms"][0] for each in told["data"]) == sorted(PLATFORMS)
    for line in (dist / "SHA256SUMS").read_text(encoding="utf-8").splitlines():
        digest, name = line.split()
        assert hashlib.sha256((dist / name).read_bytes()).hexdigest() == digest


@pytest.mark.parametrize("platform", ["windows-x64", "linux-arm64"])
def test_the_core_is_the_same_there(platform):
    code, told = run([*PACKAGE, "--tests", platform])
    assert code == 0, told
    folder, suffix = ROOT / "build" / platform, ".exe" if platform.startswith("windows") else ""
    wanted = {path.stem for path in (ROOT / "tests" / "native").glob("*/test_*.c")}
    assert len(wanted) > 50
    wrong = []
    for name in sorted(wanted):
        code, told = run([*RUNNERS[platform], folder / f"{name}{suffix}"], cwd=folder)
        if code or ", 0 failed" not in told:
            wrong.append(f"{name} ({code}):\n{told[-2000:]}")
    assert not wrong, "\n".join(wrong)


def test_bakes_are_the_same_there(machine):
    code, told = machine.python(machine.folder / "tests" / "golden" / "check.py")
    assert code == 0 and "all digests are as expected" in told, told


INSIDE = """
mount -t proc proc "$1/proc" && mount --rbind /sys "$1/sys" && mount --rbind /dev "$1/dev" || exit 1
cd / && exec chroot "$1" env -i PATH=/usr/bin:/bin HOME="$2" LANG=C.UTF-8 WINEDEBUG=-all WINEPREFIX="$2/prefix" "${@:3}"
"""


def test_blender_for_windows_bakes(dist):
    """Its own installer, a bake with plants, and the coming and going of tests/package, in Debian 13's Wine.

    The folder that is baked into has letters that no code page of Windows has together.
    """
    system = MACHINES / "wine"
    root = [] if os.geteuid() == 0 else ["sudo"]
    told = run([*root, "mktemp", "-d", system / "tmp" / "blender.XXXXXX"])
    work = Path(told[1].strip())
    assert told[0] == 0, told
    try:
        for source in (MACHINES / "windows_blender", ROOT / "tests", next(dist.glob("*-windows_x64.zip"))):
            links = ["-l"] if source.is_relative_to(MACHINES) else []
            code, told = run([*root, "cp", "-a", *links, source, work])
            assert code == 0, told
        here = work.relative_to(system)
        there = "Z:\\" + str(here).replace("/", "\\") + "\\"
        script = f"{there}tests\\package\\coming.py"
        code, told = run([*root, "mkdir", work / "Fährte 雪の跡"])
        assert code == 0, told
        words = [f"{there}{next(work.glob('*.zip')).name}", "5.2", f"{there}Fährte 雪の跡\\bake"]
        inside = [*root, "unshare", "--mount", "bash", "-c", INSIDE, "-", system, f"/{here}"]
        code, told = run([*inside, "wine", f"/{here}/windows_blender/python.exe", "-B", script, *words])
        assert code == 0 and "INSTALLED" in told and "Traceback" not in told, told
        assert len(list((work / "Fährte 雪の跡" / "bake" / "frames").glob("*.exr"))) >= 16
    finally:
        run([*root, "rm", "-rf", work])


OPEN = """
import os, sys, threading, time
from desire_path.files import disk
assert os.name == "nt"
folder = os.path.dirname(os.path.abspath(__file__))
for name, text in (("new", "new"), ("old", "old")):
    with open(os.path.join(folder, name), "w") as file:
        file.write(text)
reader = open(os.path.join(folder, "old"))
try:
    os.replace(os.path.join(folder, "new"), os.path.join(folder, "old"))
    sys.exit("an open file was replaced: this test tests nothing")
except PermissionError:
    pass
threading.Timer(0.3, reader.close).start()
disk.replace(os.path.join(folder, "new"), os.path.join(folder, "old"))
with open(os.path.join(folder, "old")) as file:
    print("REPLACED BY", file.read())
"""


@pytest.mark.parametrize("machine", ["windows-x64"], indirect=True)  # other systems replace what is open
def test_what_somebody_has_open_is_replaced_when_it_is_closed(machine):
    script = machine.folder / "held.py"
    script.write_text(OPEN)
    code, told = machine.python(script)
    assert code == 0 and "REPLACED BY new" in told, told
