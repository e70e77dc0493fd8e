"""Where what other programs' files need is not there, one sentence says what to install; nothing is written."""

import sys

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.ground import maps, stage, trail


def test_usd_without_its_library_is_said(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pxr", None)
    maps.write(tmp_path / "hill.exr", {"height": np.zeros((3, 3), np.float32)}, [("cell", 1.0)])
    with pytest.raises(DesirePathError, match="pip install desire-path.usd."):
        stage.write(tmp_path / "hill.exr", tmp_path / "a.usd")
    assert [each.name for each in tmp_path.iterdir()] == ["hill.exr"]


def test_geotiff_without_its_library_is_said(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rasterio", None)
    (tmp_path / "a.tif").write_bytes(b"II*\0")
    with pytest.raises(DesirePathError, match="pip install desire-path.geotiff."):
        trail.read(tmp_path / "a.tif")
