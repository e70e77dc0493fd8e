"""A release that cannot be made is told of in one sentence, and what was there stays as it was."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
REFUSED = """#!/bin/sh
cat >&2 << 'END'
-- The C compiler identification is Clang 20.1.2
CMake Error at openexr.cmake:66 (message):
  openexr.tar.gz is not the archive that was expected:
  delete it and try again

Call Stack (most recent call first):
  CMakeLists.txt:96 (include)
END
exit 1
"""
FAILED = """#!/bin/sh
[ "$1" = -S ] && exit 0
echo "[ 10%] Building C object"
echo "native/base/os_posix.c:7:3: error: unknown type name 'nothing'"
echo "gmake: *** [all] Error 2" >&2
exit 2
"""


@pytest.fixture
def machine(tmp_path):
    """The environment of a machine with a shell alone, and a release that was made before."""
    (tmp_path / "bin").mkdir()
    for name in ("sh", "cat"):
        (tmp_path / "bin" / name).symlink_to(shutil.which(name))
    (tmp_path / "dist").mkdir()
    (tmp_path / "dist" / "SHA256SUMS").write_text("of before\n")
    return tmp_path


def tool(machine, name, text="#!/bin/sh\n"):
    path = machine / "bin" / name
    path.write_text(text)
    path.chmod(0o755)


def told(machine):
    """What packaging says where it fails."""
    done = subprocess.run(
        [sys.executable, str(ROOT / "scripts" / "package"), "--all", "linux-x64", "--out", str(machine / "dist")],
        env={"DESIRE_PATH_PACKAGE": "1", "PATH": str(machine / "bin"), "HOME": str(machine)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1 and not done.stdout and len(done.stderr.splitlines()) == 1, done
    assert sorted(path.name for path in machine.iterdir()) == ["bin", "dist"]
    assert [path.name for path in (machine / "dist").iterdir()] == ["SHA256SUMS"]
    assert (machine / "dist" / "SHA256SUMS").read_text() == "of before\n"
    return done.stderr


def test_a_tool_that_is_missing(machine):
    assert told(machine) == "cmake is missing: run scripts/install packages.\n"
    tool(machine, "cmake")
    assert told(machine) == "make is missing: run scripts/install packages.\n"


def test_what_stops_the_build(machine):
    tool(machine, "make")
    tool(machine, "cmake", REFUSED)
    said = "openexr.tar.gz is not the archive that was expected: delete it and try again."
    assert f"_native for linux-x64 could not be built: {said} " in told(machine)
    tool(machine, "cmake", FAILED)
    said = "native/base/os_posix.c:7:3: error: unknown type name 'nothing'."
    assert f"_native for linux-x64 could not be built: {said} " in told(machine)
