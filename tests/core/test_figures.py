"""The papers' experiments hold here, and would be seen not to. TRAIL Fig. 12, SOFT22 Fig. 4 and 7."""

import csv

import numpy as np
import pytest

from desire_path.ground.plants import Planting
from desire_path.study import figure_page, figures, figures_soil, figures_walk, rigs
from tests.core.test_cli import run

QUICK = [name for name in figures.FIGURES if name != "cover"]  # lanes are held against Cole's in test_lane


@pytest.fixture(scope="module")
def made():
    return {name: figures.FIGURES[name]() for name in QUICK}


@pytest.mark.parametrize("name", QUICK)
def test_what_the_papers_state_is_seen(made, name):
    figure = made[name]
    assert figure.name == name and figure.claims and figure.curves
    for claim in figure.claims:
        assert claim.holds, f"{claim.source}: {claim.states} Here {claim.seen}"
    for curve in figure.curves:
        assert curve.x.shape == curve.y.shape and np.isfinite(curve.y).all()


def test_a_ground_that_does_not_do_so_is_told(monkeypatch):
    """Each experiment on a ground that breaks its law."""
    held = {}

    def of(figure):
        held.update({claim.states: claim.holds for claim in figure.claims})

    monkeypatch.setattr(rigs, "GRAVITY", 9.0)  # the Hooke depth of another weight
    of(figures_soil.sinking())
    monkeypatch.setattr(figures_soil, "firm", lambda **numbers: rigs.firm(**{**numbers, "rest_angle": 0.5}))
    of(figures_soil.repose())
    monkeypatch.setattr(figures_walk, "HILL", 0.02)
    of(figures_walk.hill())
    monkeypatch.setattr(figures_walk, "Planting", lambda kind, density, **more: Planting(kind, 20.0, **more))
    of(figures_walk.roots())
    assert not any(held[states] for states in held if not states.startswith("It takes"))


def test_one_page_and_tables(tmp_path, made):
    figure_page.write(tmp_path / "page", [made["walkers"], made["push"]])
    assert (tmp_path / "page" / "figures.png").read_bytes().startswith(b"\x89PNG")
    with open(tmp_path / "page" / "claims.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(made["walkers"].claims) + len(made["push"].claims) and {row["holds"] for row in rows} == {
        "yes"
    }
    with open(tmp_path / "page" / "push.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["F_par/F_threshold"]) for row in rows] == list(made["push"].curves[0].x)


def test_the_command_makes_those_that_are_asked_for(tmp_path):
    done = run("study", "figures", "--only", "push,repose", "--out", tmp_path / "page")
    assert done.returncode == 0 and "3 of 3 claims hold" in done.stdout, done.stderr
    assert {each.name for each in (tmp_path / "page").iterdir()} == {
        "figures.png",
        "claims.csv",
        "push.csv",
        "repose.csv",
    }
    done = run("study", "figures", "--only", "pusch", "--out", tmp_path / "other")
    assert done.returncode == 1 and "There is no figure 'pusch': choose of forces, " in done.stderr
    (tmp_path / "taken").write_text("mine")
    done = run("study", "figures", "--only", "push", "--out", tmp_path / "taken")
    assert done.returncode == 1 and "cannot be made a folder" in done.stderr
    assert (tmp_path / "taken").read_text() == "mine" and not (tmp_path / "other").exists()
