"""The picture of the forces, and the sentence where nothing can draw it."""

import subprocess
import sys

import numpy as np
import pytest

from desire_path.loads import plot, walker
from desire_path.motion.gait import Gait
from tests.core.test_bake import standing
from tests.core.test_body import gait, person, walk
from tests.core.test_cli import REPO, run


@pytest.fixture
def person_walks():
    bones = person()
    return gait(bones, walk(bones))


def test_a_foot_carries_what_its_parts_carry(person_walks):
    loads = walker.loads(person_walks)
    force, touching = plot.foot_loads(person_walks, loads)
    assert force.shape == touching.shape == (2, len(loads.time))
    np.testing.assert_allclose(force.sum(axis=0), -loads.force[..., 2].sum(axis=0) / (70 * 9.81))
    assert 0.8 < force.max() < 2.0 and (force[~touching] == 0.0).all()


def test_contacts_are_spans():
    time = np.arange(6) / 10.0
    found = plot.spans(np.array([1, 1, 0, 0, 1, 0], bool), time)
    np.testing.assert_allclose(found, [(-0.05, 0.15), (0.35, 0.45)])
    assert plot.spans(np.zeros(6, bool), time) == []


def test_the_figure_shows_feet_contacts_and_the_weight(person_walks):
    both = Gait.join([person_walks, person_walks])
    made = plot.figure(both, walker.loads(both))
    assert len(made.axes) == 2
    force, touching = plot.foot_loads(both, walker.loads(both))
    for w, graph in enumerate(made.axes):
        lines = {line.get_label(): line for line in graph.get_lines()}
        assert set(lines) == {"foot.L", "foot.R", "all feet", "body weight"}
        np.testing.assert_array_equal(lines["foot.R"].get_ydata(), force[2 * w + 1])
        assert set(lines["body weight"].get_ydata()) == {1.0}
        stances = sum(len(plot.spans(row, both.time)) for row in touching[2 * w : 2 * w + 2])
        assert len(graph.patches) == stances > 3


@pytest.mark.parametrize("kind, begin", [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_plot_writes_a_picture(tmp_path, kind, begin):
    standing().save(tmp_path / "walk.npz")
    done = run("plot", tmp_path / "walk.npz", "--out", tmp_path / f"forces.{kind}", "--model", "impulse")
    assert done.returncode == 0, done.stderr
    assert f"forces.{kind}" in done.stdout
    assert (tmp_path / f"forces.{kind}").read_bytes().startswith(begin)
    assert {path.name for path in tmp_path.iterdir()} == {"walk.npz", f"forces.{kind}"}


def test_without_matplotlib_a_sentence_says_how_to_get_it(tmp_path):
    standing().save(tmp_path / "walk.npz")
    code = (
        "import sys; sys.modules['matplotlib'] = None; sys.path.insert(0, sys.argv[1]); "
        "from desire_path.__main__ import main; sys.exit(main(sys.argv[2:]))"
    )
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            code,
            str(REPO / "addon"),
            "plot",
            str(tmp_path / "walk.npz"),
            "--out",
            str(tmp_path / "forces.png"),
        ],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1 and done.stderr.count("\n") == 1, done.stderr
    assert "desire-path[plot]" in done.stderr and not (tmp_path / "forces.png").exists()
    assert run("loads", tmp_path / "walk.npz", "--out", tmp_path / "loads.csv").returncode == 0
