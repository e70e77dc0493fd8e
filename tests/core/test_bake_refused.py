"""What cannot be baked is a sentence, said before anything is written."""

import json
import os

import numpy as np
import pytest

from desire_path.bake.bake import Bake, read_index
from desire_path.errors import DesirePathError
from desire_path.ground.options import SimulationOptions
from desire_path.ground.sim import Ground, Simulation
from tests.core.test_bake import baked, sentence, standing


@pytest.mark.parametrize(
    "words, wrong",
    [
        ("cell size", {"cell_size": 0.0}),
        ("cell size", {"cell_size": float("nan")}),
        ("frame range", {"frame_start": 5, "frame_end": 5}),
        ("frame range", {"frame_start": 9, "frame_end": 2}),
        ("law", {"law": "magic"}),
        ("heap", {"heap": "magic"}),
        ("load model", {"load_model": "magic"}),
        ("threads", {"threads": -1}),
    ],
)
def test_bad_parameters_are_a_sentence(tmp_path, words, wrong):
    with pytest.raises(DesirePathError, match=words) as error:
        baked(tmp_path, **wrong)
    sentence(error)


def test_bad_ground_is_a_sentence():
    upright = [[0, 0, 0], [1, 0, 0], [0, 0, 1]]
    with pytest.raises(DesirePathError, match="no faces"):
        Ground.mesh(upright, [])
    with pytest.raises(DesirePathError, match="Vertex 1"):
        Ground.mesh([[0, 0, 0], [np.nan, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    with pytest.raises(DesirePathError, match="upright"):
        for _ in Bake(standing(), Ground.mesh(upright, [[0, 1, 2]]), "mud", "unused").run():
            pass
    assert not os.path.exists("unused")


@pytest.mark.parametrize(
    "words, make",
    [
        ("positions", lambda: Ground.mesh([0, 0, 0], [[0, 0, 0]])),
        ("not there", lambda: Ground.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 3]])),
        ("weights", lambda: Ground.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], [[1, 1]])),
        ("weights", lambda: Ground.heights(np.zeros((3, 3)), 0.5, kind_weight=np.ones((2, 3)))),
        ("rim width", lambda: Simulation(Ground.flat(), options=SimulationOptions(rim_width=0.0))),
        ("origin", lambda: Simulation(Ground.flat(), options=SimulationOptions(origin=(0.0, float("inf"))))),
        ("soil", lambda: Simulation(Ground.flat(), [])),
        ("at least one", lambda: Simulation(Ground.flat()).read("heap", 0, 0, 0, 4)),
        ("no field", lambda: Simulation(Ground.flat()).read("gold", 0, 0, 4, 4)),
    ],
)
def test_bad_numbers_are_a_sentence(words, make):
    with pytest.raises(DesirePathError, match=words) as error:
        make()
    sentence(error)


def test_a_walk_beside_the_ground_is_a_sentence(tmp_path):
    far = Ground.heights(np.zeros((3, 3)), 0.5, 50.0, 50.0)
    bake = Bake(standing(), far, "mud", tmp_path / "bake")
    with pytest.raises(DesirePathError) as error:
        for _ in bake.run():
            pass
    assert "ground" in sentence(error)
    assert not (tmp_path / "bake").exists()


def test_a_folder_that_cannot_be_made_is_a_sentence(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(DesirePathError, match="folder") as error:
        baked(tmp_path / "file" / "bake")
    sentence(error)
    assert (tmp_path / "file").read_text() == "in the way"


def test_a_cache_of_another_version_is_a_sentence(tmp_path):
    baked(tmp_path)
    path = tmp_path / "frames" / "index.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "format": 99, "version": "9.0"}))
    with pytest.raises(DesirePathError, match="9.0.*bake again"):
        read_index(tmp_path)
    path.write_text("{ damaged")
    with pytest.raises(DesirePathError, match="damaged"):
        read_index(tmp_path)
