"""Terrain out of a GeoTIFF, as surveys and makers of terrain give it, by the package rasterio.

Its samples have to be square, and to lie along x and y of a map in metres, feet or another length; its heights are
metres. Where it says that a value is none, there is no ground.
"""

from __future__ import annotations

import os
import warnings

import numpy as np

from .. import lazy
from ..bounds import CELLS
from ..errors import DesirePathError

KINDS = (".tif", ".tiff")
METRES = ("", "m", "metre", "meter", "metres", "meters")
MOST = 1 << 28  # samples
SAME = 1e-6  # sides that differ by less are the same [side]

rasterio = lazy.module("rasterio")  # a machine may lack it


def is_one(path: str | os.PathLike[str]) -> bool:
    """Whether a file is one, by its name."""
    return os.fspath(path).lower().endswith(KINDS)


def read(path: str | os.PathLike[str], spacing: float | None = None) -> tuple[np.ndarray, float, float, float]:
    """(heights, spacing, x0, y0) as Ground.heights takes them: float32 (ny, nx) [m], row 0 at the lowest y, NaN = none.

    spacing: distance of the samples [m], if the file does not say; x0, y0: of the first sample, as on its map [m]
    """
    path = os.fspath(path)
    try:
        opens = rasterio.open
    except ImportError:
        raise DesirePathError(
            "GeoTIFF is read by the package rasterio, which is not there: pip install desire-path[geotiff], or pip "
            "install rasterio."
        ) from None
    if not os.path.isfile(path):
        raise DesirePathError(f"{path} cannot be opened: check that the file is there and may be read.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of files that do not say where they lie
            with opens(path, driver="GTiff") as file:
                if file.width * file.height > MOST:
                    raise DesirePathError(f"{path} has more than 2^28 samples: cut out what is walked on.")
                turn = file.transform
                side = _side(path, file.crs)
                unit = (file.units[0] or "").strip().lower()
                grid = file.read(1, out_dtype="float64", masked=True)
                grid = grid * file.scales[0] + file.offsets[0]
    except (OSError, rasterio.errors.RasterioError) as problem:
        raise DesirePathError(
            f"{path} is damaged or no GeoTIFF ({problem}): write it again, or choose another file."
        ) from None
    if unit not in METRES:
        raise DesirePathError(f"The heights of {path} are in {unit}: write them in metres.")
    heights = np.ma.filled(grid, np.nan).astype(np.float32)
    if turn.is_identity:
        if spacing is None:
            raise DesirePathError(f"{path} does not say how far its samples are apart: add --spacing METRES.")
        return np.ascontiguousarray(heights[::-1]), spacing, spacing / 2, spacing / 2
    if turn.b or turn.d or abs(abs(turn.e) - turn.a) > SAME * turn.a or turn.a <= 0.0:
        raise DesirePathError(f"The samples of {path} are not square or not along x and y: warp it, north up.")
    step = float(turn.a) * side
    if not CELLS[0] <= step:
        raise DesirePathError(f"The samples of {path} are {step:g} m apart: give a map whose unit is a length.")
    low = turn.f + (turn.e * file.height if turn.e < 0.0 else 0.0)
    rows = heights[::-1] if turn.e < 0.0 else heights
    return np.ascontiguousarray(rows), step, turn.c * side + step / 2, low * side + step / 2


def _side(path: str, crs: object) -> float:
    """Metres in a unit of a map."""
    if crs is None:
        return 1.0
    if getattr(crs, "is_geographic", False):
        raise DesirePathError(f"{path} lies on a map in degrees: warp it to one in metres, as UTM (gdalwarp -t_srs).")
    return float(crs.linear_units_factor[1])  # type: ignore[attr-defined]
