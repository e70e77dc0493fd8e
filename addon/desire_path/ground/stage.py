"""The ground after a walk as a USD stage, for other programs of pictures: a mesh with its maps, and its plants.

    /Trail           Z is up, units are metres; lies where the bake lies
    /Trail/Ground    a mesh, one point for each cell with ground, at the cell's middle; every map of the bake is a
                     primvar of its points (compression [m], heap [m] ..), and `st` goes 0..1 over the rectangle
    /Trail/Plants    where plants were baked as a mesh: their stems, a point instancer of a few of every kind

The variant set `relief` says how the prints are shown: `points` have them; with `displacement` the ground is as it was
before the walk, and a material displaces it by the picture beside the stage, <name>_change.exr (R: height change [m]).

Needs `pxr`: Blender 4.5 and later have it, else the package usd-core.
"""

from __future__ import annotations

import os
import shutil
import struct
import tempfile
from typing import Any

import numpy as np

from .. import lazy
from ..errors import DesirePathError
from ..files import atomic_file, npz
from . import geotiff, height16, maps

KINDS = (".usdc", ".usda", ".usd")
PROTOTYPES = 8  # stems of every kind that all others are like
WIDTH = 0.0035  # of a stem at its foot [m]

Gf = lazy.module("pxr.Gf")  # a machine may lack them
Sdf = lazy.module("pxr.Sdf")
Usd = lazy.module("pxr.Usd")
UsdGeom = lazy.module("pxr.UsdGeom")
UsdShade = lazy.module("pxr.UsdShade")
Vt = lazy.module("pxr.Vt")


def check(path: str | os.PathLike[str]) -> str:
    """The name of the picture beside `path`; DesirePathError where either cannot be written, or pxr is not there."""
    start, kind = os.path.splitext(os.fspath(path))
    if kind.lower() not in KINDS:
        raise DesirePathError(
            f"{path} is of no kind that is written: give it a name that ends with {', '.join(KINDS)}."
        )
    try:
        lazy.load(Usd)
    except ImportError:
        raise DesirePathError(
            "USD is written by the module pxr, which is not there: pip install desire-path[usd], or pip install "
            "usd-core, or export from Blender 4.5 or later."
        ) from None
    beside = f"{start}_change.exr"
    for each in (path, beside):
        atomic_file.check(each, "The stage")
    return beside


def write(source: str | os.PathLike[str], path: str | os.PathLike[str], spacing: float | None = None) -> dict[str, Any]:
    """Write a stage of a bake's folder, its maps or any image of heights; returns how much is in it, by name.

    path: .usdc (binary), .usda (text) or .usd; beside it <name>_change.exr where `source` is a trail
    spacing: as for height16.heights()
    """
    beside = check(path)
    grid, step, x, y = height16.heights(source, spacing)
    there = np.isfinite(grid)
    if not there.any():
        raise DesirePathError("There is no ground in these heights: give a map of some.")
    planes = _planes(source, grid.shape)
    before = planes.pop("rest", None)
    base = float(np.floor(grid[there].min()))  # float32 keeps what is told from here
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, "/Trail")
    root.AddTranslateOp().Set(Gf.Vec3d(x, y, base))
    stage.SetDefaultPrim(root.GetPrim())
    mesh = UsdGeom.Mesh.Define(stage, "/Trail/Ground")
    corners = _faces(mesh, there)
    _primvars(mesh, there, planes)
    if before is None:
        _shape(mesh, grid - base, there, step)
    else:
        material = _material(stage, os.path.basename(beside))
        relief = mesh.GetPrim().GetVariantSets().AddVariantSet("relief")
        for name, heights in (("displacement", before.astype(np.float64)), ("points", grid)):
            relief.AddVariant(name)
            relief.SetVariantSelection(name)
            with relief.GetVariantEditContext():
                _shape(mesh, heights - base, there, step)
                if name == "displacement":
                    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    stems = _plants(stage, source, (x, y, base))
    if before is not None:
        notes = [("cell", step), ("originX", x - step / 2), ("originY", y - step / 2)]
        maps.write(beside, {"R": np.where(there, grid - before, 0.0)}, notes)
    _save(stage, path)
    return {
        "points": int(there.sum()),
        "faces": corners,
        "stems": stems,
        "primvars": sorted(planes),
        "beside": None if before is None else beside,
    }


def _planes(source: str | os.PathLike[str], shape: tuple[int, ...]) -> dict[str, np.ndarray]:
    """The maps of a trail by name, `rest` among them; none of an image of heights."""
    path = os.fspath(source)
    if geotiff.is_one(path):
        return {}
    picture = maps.read(os.path.join(path, "maps_final.exr") if os.path.isdir(path) else path)
    if "rest" not in picture.planes or picture.shape != shape:
        return {}
    return {name: plane for name, plane in picture.planes.items() if len(name) > 1}  # letters repeat others


def _array(values: np.ndarray, kind: Any) -> Any:
    """An array of USD's, of numbers or rows of them."""
    return kind.FromNumpy(np.ascontiguousarray(values))


def _faces(mesh: Any, there: np.ndarray) -> int:
    """Faces between four neighbouring points that are there, and where they lie on a picture; returns how many."""
    number = np.full(there.shape, -1, np.int32)
    number[there] = np.arange(there.sum(), dtype=np.int32)
    corner = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], -1).reshape(-1, 4)
    corner = corner[(corner >= 0).all(axis=1)]
    mesh.CreateFaceVertexCountsAttr(_array(np.full(len(corner), 4, np.int32), Vt.IntArray))
    mesh.CreateFaceVertexIndicesAttr(_array(corner.ravel(), Vt.IntArray))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    j, i = np.nonzero(there)
    ny, nx = there.shape
    place = np.column_stack([(i + 0.5) / nx, (j + 0.5) / ny]).astype(np.float32)
    type_ = Sdf.ValueTypeNames.TexCoord2fArray
    UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("st", type_, UsdGeom.Tokens.vertex).Set(_array(place, Vt.Vec2fArray))
    return len(corner)


def _primvars(mesh: Any, there: np.ndarray, planes: dict[str, np.ndarray]) -> None:
    api = UsdGeom.PrimvarsAPI(mesh)
    for name, plane in planes.items():
        values = _array(plane[there].astype(np.float32), Vt.FloatArray)
        api.CreatePrimvar(name, Sdf.ValueTypeNames.FloatArray, UsdGeom.Tokens.vertex).Set(values)


def _shape(mesh: Any, heights: np.ndarray, there: np.ndarray, step: float) -> None:
    """Points and normals of a grid of heights [m], whose samples lie `step` apart [m]."""
    j, i = np.nonzero(there)
    points = np.column_stack([step * i, step * j, heights[there]]).astype(np.float32)
    normals = np.column_stack([-_slope(heights, 1, step)[there], -_slope(heights, 0, step)[there], np.ones(len(i))])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    mesh.CreatePointsAttr(_array(points, Vt.Vec3fArray))
    mesh.CreateNormalsAttr(_array(normals.astype(np.float32), Vt.Vec3fArray))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    mesh.CreateExtentAttr(_array(np.stack([points.min(axis=0), points.max(axis=0)]), Vt.Vec3fArray))


def _slope(heights: np.ndarray, axis: int, step: float) -> np.ndarray:
    """How a grid rises along an axis [-], from those of both neighbours that are there; 0 where neither is."""
    rises = np.diff(heights, axis=axis) / step
    none = np.full_like(np.take(heights, [0], axis=axis), np.nan)
    both = np.stack([np.concatenate([none, rises], axis=axis), np.concatenate([rises, none], axis=axis)])
    known = np.isfinite(both)
    return np.where(known, both, 0.0).sum(axis=0) / np.maximum(known.sum(axis=0), 1)


def _material(stage: Any, picture: str) -> Any:
    """A material that raises the ground by a picture beside the stage, R in metres."""
    UsdGeom.Scope.Define(stage, "/Trail/Looks")
    material = UsdShade.Material.Define(stage, "/Trail/Looks/Change")
    surface, texture, reader = (
        UsdShade.Shader.Define(stage, f"/Trail/Looks/Change/{name}") for name in ("Surface", "Picture", "Place")
    )
    surface.CreateIdAttr("UsdPreviewSurface")
    texture.CreateIdAttr("UsdUVTexture")
    reader.CreateIdAttr("UsdPrimvarReader_float2")
    types = Sdf.ValueTypeNames
    for name, type_, value in (
        ("file", types.Asset, f"./{picture}"),
        ("sourceColorSpace", types.Token, "raw"),
        ("wrapS", types.Token, "clamp"),
        ("wrapT", types.Token, "clamp"),
    ):
        texture.CreateInput(name, type_).Set(value)
    reader.CreateInput("varname", types.String).Set("st")
    texture.CreateInput("st", types.Float2).ConnectToSource(reader.CreateOutput("result", types.Float2))
    surface.CreateInput("displacement", types.Float).ConnectToSource(texture.CreateOutput("r", types.Float))
    for leave, name in (
        (material.CreateSurfaceOutput(), "surface"),
        (material.CreateDisplacementOutput(), "displacement"),
    ):
        leave.ConnectToSource(surface.CreateOutput(name, types.Token))
    return material


# ---- plants ----------------------------------------------------------------------------------------------------


def _plants(stage: Any, source: str | os.PathLike[str], place: tuple[float, float, float]) -> int:
    """Stems as they stand at the end, each a turned and scaled one of a few of its kind; returns how many."""
    folder = os.fspath(source) if os.path.isdir(source) else os.path.dirname(os.path.abspath(source))
    if not all(os.path.isfile(os.path.join(folder, name)) for name in ("plants.npz", "plants.pc2")):
        return 0
    try:
        found = npz.read(os.path.join(folder, "plants.npz"), 16 << 30)
        rest = found["vertices"].astype(np.float64)
        now = _last(os.path.join(folder, "plants.pc2"), len(rest))
        foot = np.flatnonzero(found["along"] == 0.0)
        tip = np.append(foot[1:], len(rest)) - 1
        kind, kinds = found["kind"][foot], [str(name) for name in found["kinds"]]
        unbroken = found["unbroken"][tip]
    except (OSError, npz.Damaged, KeyError, IndexError, ValueError) as problem:
        raise DesirePathError(f"The plants in {folder} are damaged ({problem}): bake again.") from None
    instancer = UsdGeom.PointInstancer.Define(stage, "/Trail/Plants")
    likes = np.zeros(len(foot), np.int64)  # the stem each is like
    prototypes: list[Any] = []
    number = np.zeros(len(foot), np.int32)
    for each, name in enumerate(kinds):
        own = np.flatnonzero(kind == each)
        some = own[:: max(len(own) // PROTOTYPES, 1)][:PROTOTYPES]
        for turn, stem in enumerate(some):
            number[own[turn :: len(some)]] = len(prototypes)
            likes[own[turn :: len(some)]] = stem
            line = rest[foot[stem] : tip[stem] + 1] - rest[foot[stem]]
            prototypes.append(_stem(stage, f"/Trail/Plants/Kinds/{name.replace('-', '_')}_{turn}", line))
    was, leans = (rest[tip] - rest[foot])[likes], now[tip] - now[foot]
    long = np.linalg.norm(rest[tip] - rest[foot], axis=1) / np.maximum(np.linalg.norm(was, axis=1), 1e-9)
    instancer.CreatePrototypesRel().SetTargets([each.GetPath() for each in prototypes])
    instancer.CreateProtoIndicesAttr(_array(number, Vt.IntArray))
    instancer.CreatePositionsAttr(_array((now[foot] - place).astype(np.float32), Vt.Vec3fArray))
    instancer.CreateOrientationsAttr(Vt.QuathArray([Gf.Quath(*map(float, each)) for each in _turns(was, leans)]))
    instancer.CreateScalesAttr(_array(np.repeat(long[:, None], 3, 1).astype(np.float32), Vt.Vec3fArray))
    api = UsdGeom.PrimvarsAPI(instancer)
    type_ = Sdf.ValueTypeNames.FloatArray
    api.CreatePrimvar("unbroken", type_, UsdGeom.Tokens.vertex).Set(_array(unbroken.astype(np.float32), Vt.FloatArray))
    return len(foot)


def _last(path: str, count: int) -> np.ndarray:
    """Where vertices are in the last frame of a point cache, float64 (count, 3) [m]; ValueError if it holds others."""
    with atomic_file.reader(path) as file:
        head = file.read(32)
        if len(head) < 32 or head[:11] != b"POINTCACHE2" or struct.unpack("<i", head[16:20])[0] != count:
            raise ValueError("plants.pc2 is not of these plants")
        frames = struct.unpack("<i", head[28:32])[0]
        file.seek(32 + 12 * count * (frames - 1))
        data = file.read(12 * count)
    if frames < 1 or len(data) < 12 * count:
        raise ValueError("plants.pc2 is cut off")
    return np.frombuffer(data, "<f4").reshape(count, 3).astype(np.float64)


def _stem(stage: Any, path: str, line: np.ndarray) -> Any:
    """A curve through points (n, 3) [m] from the foot on, which tapers."""
    curve = UsdGeom.BasisCurves.Define(stage, path)
    curve.CreateTypeAttr(UsdGeom.Tokens.linear)
    curve.CreateCurveVertexCountsAttr(Vt.IntArray([len(line)]))
    curve.CreatePointsAttr(_array(line.astype(np.float32), Vt.Vec3fArray))
    thin = WIDTH * (1.02 - np.linspace(0.0, 1.0, len(line)) ** 2)
    curve.CreateWidthsAttr(_array(thin.astype(np.float32), Vt.FloatArray))
    curve.SetWidthsInterpolation(UsdGeom.Tokens.vertex)
    span = np.stack([line.min(axis=0) - WIDTH, line.max(axis=0) + WIDTH])
    curve.CreateExtentAttr(_array(span.astype(np.float32), Vt.Vec3fArray))
    return curve


def _turns(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """The shortest turns of vectors (n, 3) onto others: quaternions (n, 4), the real part first."""
    a, b = (each / np.maximum(np.linalg.norm(each, axis=1, keepdims=True), 1e-12) for each in (start, end))
    turn = np.column_stack([1.0 + (a * b).sum(axis=1), np.cross(a, b)])
    back = turn[:, 0] < 1e-6  # half a turn, about anything across
    across = np.cross(a, np.where(np.abs(a[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]]))
    turn[back] = np.column_stack([np.zeros(len(a)), across])[back]
    return turn / np.maximum(np.linalg.norm(turn, axis=1, keepdims=True), 1e-12)


def _save(stage: Any, path: str | os.PathLike[str]) -> None:
    """Whole or not at all: USD writes files by their names, so it writes into a folder that goes."""
    path = os.fspath(path)
    try:
        with tempfile.TemporaryDirectory(prefix=".stage-", dir=os.path.dirname(os.path.abspath(path))) as folder:
            exported = os.path.join(folder, "stage" + os.path.splitext(path)[1].lower())
            if not stage.GetRootLayer().Export(exported):
                raise OSError("USD could not write it")
            with atomic_file.file(path, "The stage") as file, open(exported, "rb") as source:
                shutil.copyfileobj(source, file, 1 << 22)
    except OSError as problem:
        why = problem.strerror or problem
        raise DesirePathError(
            f"The stage cannot be written to {path} ({why}): choose another folder or make room."
        ) from None
