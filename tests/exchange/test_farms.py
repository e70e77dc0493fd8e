"""A job as farms run it: OpenJD's own command line does all of it, Flamenco's job type makes its tasks under Node."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import desire_path
from desire_path.commands import main
from desire_path.farm import send
from tests.core.test_farm import WALK, files

HOME = Path(desire_path.__file__).parent
SCRIPT = HOME / "farm" / "flamenco" / "desire_path.js"
CHOSEN = [str(WALK), "--soil", "mud", "--cell", "0.04", "--frame-end", "8"]


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    folder = tmp_path_factory.mktemp("farms") / "job"
    assert main(["farm", "plan", *CHOSEN, "--tiles", "2x2", "--windows", "2", "--out", str(folder)]) == 0
    return folder


@pytest.mark.parametrize("limit", ["", "4G"])
def test_the_command_line_of_openjd_bakes_it(tmp_path, limit):
    job = tmp_path / "job"
    assert main(["farm", "plan", *CHOSEN, "--tiles", "2x2", "--windows", "2", "--out", str(job)]) == 0
    openjd = [sys.executable, "-m", "openjd.cli"] if not shutil.which("openjd") else ["openjd"]
    beside = Path(sys.executable).parent / "openjd"
    openjd = [str(beside)] if beside.exists() else openjd
    template = str(job / send.TEMPLATE)
    checked = subprocess.run([*openjd, "check", template], capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    path = os.pathsep.join([str(HOME.parent), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [
            *openjd,
            "run",
            template,
            "--run-dependencies",
            "--step",
            "Merge",
            "-p",
            f"Python={sys.executable}",
            "-p",
            f"Memory={limit}",
        ],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": path},
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    assert main(["bake", *CHOSEN, "--out", str(tmp_path / "bake")]) == 0
    assert files(tmp_path / "bake") == files(job / "bake")


STUBS = """
const made = [];
const author = {
    Task: (name, type) => ({ name, type, commands: [], after: [],
        addCommand(command) { this.commands.push(command); }, addDependency(other) { this.after.push(other.name); } }),
    Command: (name, parameters) => ({ name, parameters }),
};
SCRIPT
compileJob({ settings: SETTINGS, addTask: (task) => made.push(task) });
console.log(JSON.stringify({ type: JOB_TYPE, made }));
"""


def compiled(settings, tmp_path):
    node = shutil.which("node") or str(Path(sys.executable).parent / "node")
    script = tmp_path / "run.js"
    text = STUBS.replace("SCRIPT", SCRIPT.read_text(encoding="utf-8"), 1)
    script.write_text(text.replace("SETTINGS", json.dumps(settings), 1), encoding="utf-8")
    return subprocess.run([node, str(script)], capture_output=True, text=True, check=False)


def test_the_job_type_of_flamenco_makes_its_tasks(job, tmp_path):
    settings = {"python": "python3", **json.loads((job / send.SETTINGS).read_text())}
    done = compiled(settings, tmp_path)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert {"memory", *settings} == {each["key"] for each in found["type"]["settings"]}
    names = [each["name"] for each in found["made"]]
    assert names[-1] == "merge" and names[0].startswith("window-0-tile-") and len(set(names)) == len(names)
    last = [name for name in names if name.startswith("window-1-")]
    assert found["made"][-1]["after"] == last and last
    for each in found["made"]:
        ((command),) = each["commands"]
        assert command["name"] == "exec" and command["parameters"]["exe"] == "python3"
        assert command["parameters"]["args"][:4] == [
            "-m",
            "desire_path",
            "farm",
            each["name"].split("-")[0].replace("window", "tile"),
        ]
    limited = json.loads(compiled({**settings, "memory": "4G"}, tmp_path).stdout)["made"]
    for each, other in zip(found["made"], limited):
        words = each["commands"][0]["parameters"]["args"]
        assert other["commands"][0]["parameters"]["args"] == [*words, "--memory", "4G"] and "--memory" not in words
    first = [name for name in names if name.startswith("window-0-")]
    assert all(each["after"] == first for each in found["made"] if each["name"] in last)
    gap = json.loads(compiled({**settings, "tasks": "0,1;;2"}, tmp_path).stdout)["made"]
    assert [each["after"] for each in gap] == [[], [], ["window-0-tile-0", "window-0-tile-1"], ["window-2-tile-2"]]
    assert "copy them from flamenco.json" in compiled({**settings, "tasks": "0;rm"}, tmp_path).stderr


def test_too_many_windows_have_no_template():
    assert send.openjd("x", [[0]] * 99) and send.openjd("x", [[0]] * 100) is None
    assert len(send.openjd("x", [[0], [], [2, 3]])["steps"]) == 3
