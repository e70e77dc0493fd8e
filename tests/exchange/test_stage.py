"""A USD stage as another library reads it, outside Blender: where ground is, what its maps say, how plants stand."""

import struct
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdShade

from desire_path.bake.bake import Bake
from desire_path.bake.options import BakeOutput
from desire_path.commands import main
from desire_path.errors import DesirePathError
from desire_path.ground import maps, stage
from desire_path.ground.planting import Planting
from desire_path.ground.sim import Ground
from desire_path.motion.gait import Gait

WALK = Path(__file__).parents[2] / "addon/desire_path/walks/walk.npz"
CELL = 0.04


@pytest.fixture(scope="module")
def bake(tmp_path_factory):
    """A walk over ground with plants of two kinds."""
    folder = tmp_path_factory.mktemp("bake") / "trail"
    gait = Gait.load(WALK)
    plants = [Planting("carex", 12.0), Planting("lycopodium", 6.0)]
    bake = Bake(gait, Ground.flat(), "mud", folder, cell_size=CELL, plants=plants, output=BakeOutput(plant_mesh=True))
    for _ in bake.run():
        pass
    return folder


def placed(found, name):
    """Points of a mesh in the world, float64."""
    mesh = UsdGeom.Mesh(found.GetPrimAtPath(name))
    points = np.array(mesh.GetPointsAttr().Get(), float)
    to_world = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(mesh.GetPrim()))
    return points @ to_world[:3, :3] + to_world[3, :3]


@pytest.mark.parametrize("name", ["a.usdc", "a.usda", "a.usd"])
def test_points_are_those_of_the_maps(bake, tmp_path, name, capsys):
    assert main(["export", str(bake), "--format", "usd", "--out", str(tmp_path / name)]) == 0
    assert "written to" in capsys.readouterr().out
    found = Usd.Stage.Open(str(tmp_path / name))
    assert UsdGeom.GetStageUpAxis(found) == "Z" and UsdGeom.GetStageMetersPerUnit(found) == 1.0
    picture = maps.read(bake / "maps_final.exr")
    planes, notes = picture.planes, picture.notes
    now = planes["rest"].astype(float) - planes["compression"] + planes["heap"]
    ny, nx = now.shape
    x = notes["originX"] + CELL * (np.arange(nx) + 0.5)
    y = notes["originY"] + CELL * (np.arange(ny) + 0.5)
    wanted = np.stack([*np.meshgrid(x, y), now], -1).reshape(-1, 3)
    got = placed(found, "/Trail/Ground")
    assert np.abs(got - wanted).max() < 2e-6 and np.ptp(now) > 0.01
    mesh = UsdGeom.Mesh(found.GetPrimAtPath("/Trail/Ground"))
    api = UsdGeom.PrimvarsAPI(mesh)
    for each in ("compression", "heap", "pressure_time", "plant_strength", "lean_x"):
        values = np.array(api.GetPrimvar(each).Get())
        assert np.array_equal(values, planes[each].ravel(), equal_nan=True) and np.ptp(values) > 0.0, each
    assert UsdGeom.Mesh.ValidateTopology(
        mesh.GetFaceVertexIndicesAttr().Get(), mesh.GetFaceVertexCountsAttr().Get(), len(got)
    )[0]
    corner = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 4)
    a, b, c, d = (got[corner[:, each]] for each in range(4))
    assert len(corner) == (nx - 1) * (ny - 1)
    assert all((np.cross(u - a, v - a)[:, 2] > 0.0).all() for u, v in ((b, c), (c, d)))
    normals = np.array(mesh.GetNormalsAttr().Get())
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-5) and normals[:, 2].min() < 0.999


def test_displaced_ground_is_the_same(bake, tmp_path):
    stage.write(bake, tmp_path / "a.usdc")
    found = Usd.Stage.Open(str(tmp_path / "a.usdc"))
    pressed = placed(found, "/Trail/Ground")
    prim = found.GetPrimAtPath("/Trail/Ground")
    assert prim.GetVariantSet("relief").GetVariantSelection() == "points"
    assert not UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    prim.GetVariantSet("relief").SetVariantSelection("displacement")
    before = placed(found, "/Trail/Ground")
    material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    surface = UsdShade.Shader(material.ComputeDisplacementSource()[0])
    texture = UsdShade.Shader(surface.GetInput("displacement").GetConnectedSource()[0])
    picture = maps.read(texture.GetInput("file").Get().resolvedPath)
    assert np.abs(before[:, 2] + picture.planes["R"].ravel() - pressed[:, 2]).max() < 2e-6
    place = np.array(UsdGeom.PrimvarsAPI(prim).GetPrimvar("st").Get())
    ny, nx = picture.shape
    assert np.array_equal(np.floor(place * (nx, ny)).astype(int) @ (1, nx), np.arange(nx * ny))


def test_stems_stand_where_they_were_baked(bake, tmp_path):
    told = stage.write(bake, tmp_path / "a.usdc")
    found = Usd.Stage.Open(str(tmp_path / "a.usdc"))
    instancer = UsdGeom.PointInstancer(found.GetPrimAtPath("/Trail/Plants"))
    turned = instancer.ComputeInstanceTransformsAtTime(Usd.TimeCode.Default(), Usd.TimeCode.Default())
    targets = instancer.GetPrototypesRel().GetForwardedTargets()
    lines = [np.array(UsdGeom.BasisCurves(found.GetPrimAtPath(each)).GetPointsAttr().Get()) for each in targets]
    number = np.array(instancer.GetProtoIndicesAttr().Get())
    to_world = UsdGeom.XformCache().GetLocalToWorldTransform(instancer.GetPrim())
    ends = [
        [to_world.Transform(each.Transform(Gf.Vec3d(*map(float, lines[k][end])))) for end in (0, -1)]
        for each, k in zip(turned, number)
    ]
    feet, tips = np.array(ends).transpose(1, 0, 2)
    with np.load(bake / "plants.npz") as mesh:
        foot = np.flatnonzero(mesh["along"] == 0.0)
        tip = np.append(foot[1:], len(mesh["along"])) - 1
        kinds, kind, rest = [str(each) for each in mesh["kinds"]], mesh["kind"][foot], mesh["vertices"]
    data = (bake / "plants.pc2").read_bytes()
    count, frames = struct.unpack("<i", data[16:20])[0], struct.unpack("<i", data[28:32])[0]
    now = np.frombuffer(data, "<f4")[8 + 3 * count * (frames - 1) :].reshape(count, 3)
    assert told["stems"] == len(foot) == len(turned) > 1000
    assert np.abs(feet - now[foot]).max() < 1e-5
    wanted, got = now[tip] - now[foot], tips - feet
    cosine = (wanted * got).sum(1) / np.linalg.norm(wanted, axis=1) / np.linalg.norm(got, axis=1)
    assert cosine.min() > 0.9999  # turns are told in 16 bit
    long = np.linalg.norm(rest[tip] - rest[foot], axis=1)
    assert np.allclose(np.linalg.norm(got, axis=1), long, rtol=2e-3)
    assert np.linalg.norm(wanted - (rest[tip] - rest[foot]), axis=1).max() > 0.05  # some were trodden down
    own = np.array([kinds.index(str(each).rsplit("/", 1)[-1].rsplit("_", 1)[0]) for each in targets])
    assert np.array_equal(own[number], kind) and len(targets) == 2 * stage.PROTOTYPES


def test_holes_have_no_faces(tmp_path):
    grid = 900.0 + 0.01 * np.arange(60, dtype=np.float32).reshape(6, 10)
    grid[2:4, 3] = np.nan
    maps.write(tmp_path / "hill.exr", {"height": grid}, [("cell", 0.5), ("originX", 500000.0)])
    told = stage.write(tmp_path / "hill.exr", tmp_path / "a.usda")
    found = Usd.Stage.Open(str(tmp_path / "a.usda"))
    there = np.isfinite(grid)
    whole = there[:-1, :-1] & there[1:, :-1] & there[:-1, 1:] & there[1:, 1:]
    assert (told["points"], told["faces"], told["beside"]) == (58, whole.sum(), None) and told["stems"] == 0
    j, i = np.nonzero(there)
    wanted = np.column_stack([500000.25 + 0.5 * i, 0.25 + 0.5 * j, grid[there]])
    assert np.abs(placed(found, "/Trail/Ground") - wanted).max() < 1e-5
    assert np.isfinite(np.array(UsdGeom.Mesh(found.GetPrimAtPath("/Trail/Ground")).GetNormalsAttr().Get())).all()


def test_turns_take_one_way_to_another():
    random = np.random.default_rng(3)
    start, end = random.normal(size=(2, 50, 3))
    end[:10], end[10:20] = start[:10], -start[10:20]
    for turn, a, b in zip(stage._turns(start, end), start, end):
        got = Gf.Rotation(Gf.Quatd(*map(float, turn))).TransformDir(Gf.Vec3d(*map(float, a / np.linalg.norm(a))))
        assert np.allclose(got, b / np.linalg.norm(b), atol=1e-6)


@pytest.mark.parametrize(("out", "word"), [("a.obj", "ends with .usdc"), ("none/a.usd", "folder is not there")])
def test_what_cannot_be_is_said_in_a_sentence(bake, tmp_path, out, word):
    with pytest.raises(DesirePathError, match=word):
        stage.write(bake, tmp_path / out)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("size", [0, 20, 33, 5000])
def test_damaged_plants_are_told(bake, tmp_path, size):
    for name in ("maps_final.exr", "plants.npz"):
        (tmp_path / name).write_bytes((bake / name).read_bytes())
    (tmp_path / "plants.pc2").write_bytes((bake / "plants.pc2").read_bytes()[:size])
    with pytest.raises(DesirePathError, match="are damaged"):
        stage.write(tmp_path, tmp_path / "a.usd")
    assert len(list(tmp_path.iterdir())) == 3
