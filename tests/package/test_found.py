"""The Blender that somebody has installed is found where each installer leaves it, and started as it wants to be.

The wrappers are written here as flatpak and snap write them; neither program is needed.
"""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FLATPAK = """#!/bin/sh
exec {flatpak} run --branch=stable --arch=x86_64 --command=blender org.blender.Blender "$@"
"""
RUN = """#!/bin/sh
[ "$1 $4 $5" = "run --command=blender org.blender.Blender" ] || exit 64
[ -e "$FLATPAK_USER_DIR" ] || exit 65
shift 5
echo "Blender by flatpak: $*"
"""
SNAP = """#!/bin/sh
# snap is one program that looks at the name it is called by
case $(basename "$0") in
    blender) echo "Blender by snap: $*" ;;
    *) echo "error: unknown command" >&2; exit 64 ;;
esac
"""


def program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)
    return path


@pytest.fixture
def bare(tmp_path):
    """The environment of a machine without a Blender."""
    bin_ = tmp_path / "bin"
    bin_.mkdir()
    for name in ("bash", "sh", "env", "dirname", "basename", "cat", "sed"):
        (bin_ / name).symlink_to(shutil.which(name))
    home = tmp_path / "home"
    home.mkdir()
    return {"PATH": str(bin_), "HOME": str(home), "FLATPAK_SYSTEM_DIR": str(tmp_path / "flatpak")}


def found(env):
    done = subprocess.run([ROOT / "scripts" / "install", "blender"], env=env, capture_output=True, text=True)
    return done.returncode, done.stdout.strip(), done.stderr


def started(path, env):
    done = subprocess.run([path, "-b"], env=env, capture_output=True, text=True)
    assert done.returncode == 0, done
    return done.stdout.strip()


def test_without_a_blender_it_is_told_how_to_name_one(bare):
    if os.path.exists("/snap/bin/blender") or os.path.exists("/var/lib/snapd/snap/bin/blender"):
        pytest.skip("this machine has a Blender by snap")
    code, path, told = found(bare)
    assert code == 3 and not path and "BLENDER=/path/to/blender" in told


def test_the_one_that_is_named_comes_first(bare, tmp_path):
    program(tmp_path / "bin" / "blender", "#!/bin/sh\necho Blender on PATH\n")
    named = program(tmp_path / "my blender" / "blender", '#!/bin/sh\necho "Blender named: $*"\n')
    code, path, _ = found({**bare, "BLENDER": str(named)})
    assert code == 0 and started(path, bare) == "Blender named: -b"
    code, path, told = found({**bare, "BLENDER": str(tmp_path / "none")})
    assert code == 3 and not path and f"BLENDER names {tmp_path / 'none'}, which is no program" in told


def test_one_of_snap_is_started_by_its_own_name(bare, tmp_path):
    snap = program(tmp_path / "usr" / "snap", SNAP)
    (tmp_path / "snap" / "bin").mkdir(parents=True)
    (tmp_path / "snap" / "bin" / "blender").symlink_to(snap)
    code, path, _ = found({**bare, "PATH": f"{bare['PATH']}:{tmp_path}/snap/bin"})
    assert code == 0 and started(path, bare) == "Blender by snap: -b"


@pytest.mark.parametrize("whose", ["the user's", "the user's, elsewhere", "the system's"])
def test_one_of_flatpak_is_started_by_flatpak(bare, tmp_path, whose):
    home = tmp_path / "home" / ".local" / "share" / "flatpak"
    if whose == "the user's, elsewhere":
        home = tmp_path / "data" / "flatpak"
        bare["XDG_DATA_HOME"] = str(home.parent)
    place = tmp_path / "flatpak" if whose == "the system's" else home
    home.mkdir(parents=True)
    run = program(tmp_path / "usr" / "flatpak", RUN)
    # exports are links to what belongs to the version that is active
    wrapper = program(place / "app/org.blender.Blender/current/active/export/bin/org.blender.Blender", "")
    wrapper.write_text(FLATPAK.format(flatpak=run))
    (place / "exports" / "bin").mkdir(parents=True)
    (place / "exports" / "bin" / wrapper.name).symlink_to(wrapper)
    code, path, _ = found(bare)
    assert code == 0 and path.startswith(str(place / "exports"))
    assert started(path, {**bare, "FLATPAK_USER_DIR": str(home)}) == "Blender by flatpak: -b"


def test_tests_leave_flatpak_its_home(bare):
    """scripts/test gives Blender a home of its own, in which flatpak would look for what the user has installed."""
    text = (ROOT / "scripts" / "test").read_text(encoding="utf-8")
    start = text.index("at_home() {")
    script = text[start : text.index("\n}\n", start) + 3] + '\nat_home env | grep -E "^(HOME|FLATPAK_USER_DIR)="'
    done = subprocess.run(
        ["bash", "-c", script], env={**bare, "PATH": os.environ["PATH"]}, capture_output=True, text=True
    )
    seen = dict(line.split("=", 1) for line in done.stdout.splitlines())
    assert seen["FLATPAK_USER_DIR"] == f"{bare['HOME']}/.local/share/flatpak" and seen["HOME"] != bare["HOME"]
