"""Grounds side by side are one ground to the walk that crosses them; grounds over each other are not."""

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.ground import parcels
from desire_path.ground.parcels import Parcel
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import SOILS
from tests.scenes import gaits

CELL = 0.02


def hill(x, y):
    return 0.05 * np.sin(3.0 * x) + 0.08 * np.sin(2.0 * y + 0.5) + 0.1 * x


def tile(x0, y0, x1, y1, step=0.1, height=hill, turn=0.0, shift=0.0):
    """A grid of triangles over a rectangle; its numbers carry the rounding of an object turned by `turn`."""
    nx, ny = round((x1 - x0) / step), round((y1 - y0) / step)
    x, y = np.meshgrid(np.linspace(x0, x1, nx + 1), np.linspace(y0, y1, ny + 1))
    points = np.stack([x.ravel(), y.ravel(), (height(x, y) + shift).ravel()], axis=1)
    if turn:
        c, s = np.cos(turn), np.sin(turn)
        there = np.array([[c, -s], [s, c]])
        local = (points[:, :2] @ there).astype(np.float32)  # as an object keeps it
        points[:, :2] = local.astype(float) @ there.T
    corner = np.arange((nx + 1) * (ny + 1)).reshape(ny + 1, nx + 1)
    a, b, c, d = corner[:-1, :-1].ravel(), corner[:-1, 1:].ravel(), corner[1:, 1:].ravel(), corner[1:, :-1].ravel()
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def mesh(*where, weights=None, **more):
    return Ground.mesh(*tile(*where, **more), weights)


def seam(n=4000):
    rng = np.random.default_rng(5)
    x = rng.uniform(-0.95, 0.95, n)
    y = np.concatenate([np.zeros(n // 2), rng.normal(0.0, 1e-7, n // 2)])
    return np.stack([x, y], 1)


@pytest.mark.parametrize("turn", [0.0, 0.4, 2.0])
def test_no_place_is_lost_between_two_that_meet(turn):
    two = [Parcel(mesh(-1, -1, 1, 0), name="south"), Parcel(mesh(-1, 0, 1, 1, step=0.08, turn=turn), name="north")]
    ground, soils = parcels.sewn(two, CELL)
    assert list(soils) == [SOILS["dry-sand"]]
    at = seam()
    alone = np.isfinite(parcels.heights(two, at)).any(axis=0)
    height = Simulation(ground, cell_size=CELL).rest_height(at)
    assert np.isfinite(height).all()
    assert turn == 0.0 or not alone.all()  # the rounding of a turned object loses some
    assert np.abs(height - hill(*at.T)).max() < 0.004  # chords of the hill


def test_sewn_tiles_are_the_ground_of_one_piece():
    whole, triangles = tile(-1, -1, 1, 1)
    parts = [Parcel(mesh(x, y, x + 1, y + 1)) for x in (-1, 0) for y in (-1, 0)]
    ground, _ = parcels.sewn(parts, CELL)
    one, several = Simulation(Ground.mesh(whole, triangles), cell_size=CELL), Simulation(ground, cell_size=CELL)
    a, b = (sim.read("rest", -50, -50, 100, 100) for sim in (one, several))
    assert np.abs(a - b).max() < 1e-6 and np.isfinite(a).all()
    assert np.allclose(several.bounds(), one.bounds(), atol=1e-4)


def test_soils_keep_their_places():
    left = Parcel(mesh(-1, -1, 0, 1, height=lambda x, y: 0 * x), "mud")
    points, triangles = tile(0, -1, 1, 1, height=lambda x, y: 0 * x)
    share = (points[:, 1] > 0).astype(np.float32)
    right = Parcel(Ground.mesh(points, triangles, np.stack([1 - share, share])), ["dry-sand", "mud"])
    ground, soils = parcels.sewn([left, right], CELL)
    assert soils == [SOILS["mud"], SOILS["dry-sand"]]
    kind = Simulation(ground, soils, CELL).read("soil", -50, -50, 100, 100)
    assert (kind[:, :49] == 0).all() and (kind[:44, 51:] == 1).all() and (kind[56:, 51:] == 0).all()


def test_what_lies_over_another_is_another_storey():
    gait, _ = gaits.strides(3.0)
    level = lambda x, y: 0 * x
    near, far = Parcel(mesh(-1, -1, 1, 1, height=level)), Parcel(mesh(1, -1, 4, 1, height=level))
    bridge = Parcel(mesh(0.5, -0.5, 2.5, 0.5, height=level, shift=2.0))
    bed = Parcel(mesh(0.5, -0.5, 2.5, 0.5, height=level, shift=-0.8))
    lying = Parcel(mesh(0.9, -1, 4, 1, height=level, shift=0.001))  # tiles overlap a little
    assert parcels.storeys([near, far], gait) == [[0, 1]]
    assert parcels.storeys([near, lying], gait) == [[0, 1]]
    assert parcels.storeys([bridge, near, bed, far], gait) == [[1, 3], [0], [2]]


def test_feet_tread_the_ground_that_is_nearest_to_them():
    gait, _ = gaits.strides(3.0)
    level = lambda x, y: 0 * x
    ground, bridge = mesh(-1, -1, 4, 1, height=level), mesh(0.5, -0.5, 2.5, 0.5, height=level, shift=2.0)
    lands = [Parcel(each).land.rest_height for each in (ground, bridge)]
    over, height = parcels.treads(gait, lands)
    assert (over == 0).all() and (height[np.isfinite(height)] == 0).all()
    raised = gait.pose.copy()
    raised[..., 2] += 2.0
    up = gait.__class__(**{**gait.__dict__, "pose": raised})
    over, height = parcels.treads(up, lands)
    there = (gait.pose[..., 0] > 0.5) & (gait.pose[..., 0] < 2.5)
    assert (over[there] == 1).all() and (over[~there] == 0).all()


def test_only_meshes_lie_side_by_side():
    with pytest.raises(DesirePathError, match="'lawn' is no mesh"):
        parcels.sewn([Parcel(mesh(0, 0, 1, 1)), Parcel(Ground.flat(), name="lawn")], CELL)


def test_plants_stand_on_their_own_parcel():
    gait, loads = gaits.strides(1.5)
    two = [
        Parcel(mesh(-1, -1, 0.5, 1, height=lambda x, y: 0 * x)),
        Parcel(mesh(0.5, -1, 3, 1, height=lambda x, y: 0 * x)),
    ]
    ground, soils = parcels.sewn(two, CELL)
    sim = Simulation(ground, soils, CELL, plants=["carex"], areas=[two[0].has])
    sim.load(gait, loads)
    roots = np.concatenate([sim.plants_positions(stand)[:, 0] for stand, _, _ in sim.stands])
    assert len(roots) > 20 and roots[:, 0].max() < 0.5 + 0.05
