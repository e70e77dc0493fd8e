"""native/soil against tests/reference/soil.py, on small random patches."""

import math

import numpy as np
import pytest

from desire_path import _native
from tests.reference import soil as twin
from tests.reference import soil_heaps as heaps

SOLE, UNIFORM = 0, 1
REST, PAPER = 0, 1
GRIDS = ("rest", "compression", "heap", "pressure_time", "modulus", "rest_slope", "kind", "soils")
SOILS = np.array(
    [
        [0.30, 0.4e6, 0.35, 0.10, 0.35, 0.0, 0.0],
        [0.20, 1.1e6, 0.20, 0.05, 0.5, 0.0, 0.0],
        [0.25, 0.2e6, 0.45, 0.20, 0.2, 0.0, 0.0],
    ],
    np.float32,
)


NAMES = [number[0] for number in _native.soil_numbers()]


class Both:
    """The same random patch twice: float32 for the kernel, float64 for its twin."""

    def __init__(self, seed, nx=21, ny=17, cell=0.02, loose=0.01, holes=True):
        random = np.random.default_rng(seed)
        kind = random.integers(0, 3, (ny, nx)).astype(np.uint8)
        self.native = {
            "rest": (0.02 * random.random((ny, nx))).astype(np.float32),
            "compression": (0.02 * random.random((ny, nx)) * (random.random((ny, nx)) < 0.3)).astype(np.float32),
            "heap": (loose * random.random((ny, nx)) * (random.random((ny, nx)) < 0.4)).astype(np.float32),
            "pressure_time": np.zeros((ny, nx), np.float32),
            "modulus": SOILS[kind, 1] * (1 + random.random((ny, nx), np.float32)),
            "rest_slope": np.tan(SOILS[kind, 4]),
            "kind": kind,
            "soils": [dict(zip(NAMES, map(float, row))) for row in SOILS],
        }
        if holes:
            self.native["rest"][random.random((ny, nx)) < 0.03] = np.nan
        self.cell, self.x0, self.y0 = cell, -0.5 * nx * cell, -0.45 * ny * cell
        self.twin = {k: self.native[k].astype(float) for k in GRIDS[:6]}
        self.twin |= {
            "depth": SOILS[kind, 0].astype(float),
            "tau": SOILS[kind, 3].astype(float),
            "nu": SOILS[kind, 2].astype(float),
            "cell": cell,
            "x0": self.x0,
            "y0": self.y0,
        }
        self.random = random
        self.shape = (ny, nx)

    def patch(self):
        return (self.cell, self.x0, self.y0, *(self.native[k] for k in GRIDS))

    def sole(self):
        """A tilted, uneven sole with soft edges."""
        ny, nx = self.shape
        j, i = np.mgrid[:ny, :nx]
        far = np.maximum(np.abs(i - 0.5 * nx) / (0.30 * nx), np.abs(j - 0.5 * ny) / (0.28 * ny))
        cover = np.clip(4 * (1.05 - far), 0, 1).astype(np.float32)
        bottom = (0.03 + 0.001 * self.random.random(self.shape) + 0.002 * (i - 9)).astype(np.float32)
        bottom[cover == 0] = np.inf
        return bottom, cover

    def same(self, name, slack):
        np.testing.assert_allclose(self.native[name], self.twin[name], rtol=0, atol=slack)


def foot_of(load, push=(0.0, 0.0), point=(0.01, -0.005), normal=(0.0, 0.0, 1.0)):
    force = np.array([push[0], push[1], -load])
    return np.array([force, [*point, 0.0], normal], float)


# ---- the equations as printed -------------------------------------------------------------------


def flat_stand(cell=0.02, kind=0):
    """Even ground under a sole of whole cells: what all papers speak of. 7 x 4 cells of 21 x 17."""
    both = Both(3, holes=False)
    both.native["kind"][:] = kind
    both.native["modulus"][:] = SOILS[kind, 1]
    both.native["rest_slope"][:] = np.tan(SOILS[kind, 4])
    for name in ("rest", "compression", "heap"):
        both.native[name][:] = 0
    cover, bottom = np.zeros(both.shape, np.float32), np.full(both.shape, np.inf, np.float32)
    cover[6:10, 7:14], bottom[6:10, 7:14] = 1, 0
    return both, bottom, cover


@pytest.mark.parametrize("kind", range(3))
@pytest.mark.parametrize("law", (SOLE, UNIFORM))
def test_pressed_frame_by_frame_as_printed_trail_10_soft22_9_to_12(law, kind):
    both, bottom, cover = flat_stand(kind=kind)
    layer, modulus, nu, tau = (float(v) for v in SOILS[kind, :4])
    foot = foot_of(500.0, (80.0, -20.0), normal=np.array([0.1, -0.05, 1.0]) / math.hypot(0.1, 0.05, 1.0))
    whole = twin.depth(twin.stress(foot[0], foot[2], 28, both.cell), layer, modulus)
    ring, dt, printed, displaced = np.zeros(both.shape, np.int32), tau / 23.5, 0.0, 0.0
    for _ in range(40):
        pressed = _native.soil_compress(both.patch(), (bottom, cover, ring), foot, law, dt)
        printed += twin.frame(printed, whole, layer, dt, tau)
        displaced += pressed["displaced"]
        assert pressed["displaced"] == pytest.approx(twin.pushed_aside(pressed["firm"], nu), rel=1e-6)
        # as printed the last frame goes past dL: ours is cut to what is left
        assert both.native["compression"][8, 10] == pytest.approx(min(printed, whole), rel=1e-5)
    assert printed > whole
    assert displaced == pytest.approx(2 * nu * whole * 28 * both.cell**2, rel=1e-5)
    assert np.ptp(both.native["compression"][cover > 0]) < 1e-7 and not both.native["compression"][cover == 0].any()


@pytest.mark.parametrize("kind", range(3))
def test_soil_rises_around_a_sole_as_printed_soft22_13_14(kind):
    """All round alike, where nothing pushes; as printed it rises at its own rate, ours by what each frame displaces."""
    both, bottom, cover = flat_stand(kind=kind)
    layer, stiff, nu, tau = (float(v) for v in SOILS[kind, :4])
    ring, foot, dt = heaps.rings(cover > 0, 1).astype(np.int32), foot_of(500.0), tau / 23.5
    beside = [(j, i) for j, i in np.argwhere(ring == 1) if 6 <= j < 10 or 7 <= i < 14]  # corners are farther off
    pressed = twin.depth(twin.stress(foot[0], foot[2], 28, both.cell), layer, stiff)
    displaced = twin.pushed_aside(pressed, nu) * 28 * both.cell**2
    whole, printed = twin.raised(displaced, both.cell, (ring == 1).sum()), 0.0
    for _ in range(40):
        under = (bottom, cover, np.zeros(both.shape, np.int32))
        found = _native.soil_compress(both.patch(), under, foot, SOLE, dt)
        _native.soil_accumulate(
            both.patch(), (bottom, cover, ring), foot, found["displaced"], PAPER, both.cell, 300.0, 0.0
        )
        printed += twin.raised_in_frame(printed, whole, dt, tau)
        heap = np.array([both.native["heap"][c] for c in beside], float)
        assert np.ptp(heap) < 1e-6 * whole
        assert heap[0] * len(beside) <= (1 + 1e-5) * displaced / both.cell**2
    assert whole <= printed < (1 + dt / tau) * whole
    assert both.native["heap"].sum(dtype=float) * both.cell**2 == pytest.approx(displaced, rel=1e-5)
    assert both.native["heap"].sum(dtype=float) == pytest.approx(whole * (ring == 1).sum(), rel=1e-5)


@pytest.mark.parametrize("law", (SOLE, UNIFORM))
def test_stress_adds_up_over_a_stance_as_printed_trail_17(law):
    both, bottom, cover = flat_stand()
    ring, dt, loads = np.zeros(both.shape, np.int32), 0.01, (300.0, 500.0, 700.0, 450.0)
    for load in loads:
        _native.soil_compress(both.patch(), (bottom, cover, ring), foot_of(load), law, dt)
    up = np.array([0.0, 0.0, 1.0])
    printed = twin.accumulated([twin.stress(foot_of(load)[0], up, 28, both.cell) for load in loads], dt)
    np.testing.assert_allclose(both.native["pressure_time"][cover > 0], printed, rtol=1e-5)
    assert not both.native["pressure_time"][cover == 0].any()


@pytest.mark.parametrize("push, threshold", (((0, 0), 300.0), ((60, -25), 200.0), ((60, -25), 20.0), ((-9, 4), 90.0)))
def test_border_cells_share_as_printed_trail_11_12_13(push, threshold):
    both, bottom, cover = flat_stand()
    ring = heaps.rings(cover > 0, 1).astype(np.int32)
    foot = foot_of(700.0, push, point=(-0.01, 0.015))
    volume = 3e-5
    _native.soil_accumulate(both.patch(), (bottom, cover, ring), foot, volume, PAPER, both.cell, threshold, 0.0)
    beside = [(j, i) for j, i in np.argwhere(ring == 1) if 6 <= j < 10 or 7 <= i < 14]  # corners are farther off
    at = np.array([[both.x0 + i * both.cell, both.y0 + j * both.cell, 0.0] for j, i in beside])
    share = twin.border_shares(at, foot[1], foot[0], foot[2], threshold)
    laid = np.array([both.native["heap"][c] for c in beside], float)
    np.testing.assert_allclose(laid / laid.sum(), share, atol=1e-6)
    assert not both.native["heap"][ring > 1].any()
    assert both.native["heap"].sum(dtype=float) * both.cell**2 == pytest.approx(volume, rel=1e-5)


@pytest.mark.parametrize("kind", range(3))
def test_a_pile_slides_to_what_the_printed_steps_leave_trail_14_15_16(kind):
    both, _, _ = flat_stand(kind=kind)
    angle = float(SOILS[kind, 4])
    both.native["heap"][8, 10] = 0.30
    printed = both.native["heap"].astype(float)
    twin.slide(printed, both.cell, angle, 2e-4, 4000)
    _native.soil_stabilize(both.patch(), None, None, math.radians(0.1), 100000)
    heap = both.native["heap"].astype(float)
    assert heap.sum() == pytest.approx(printed.sum(), rel=1e-5)
    assert heap.max() == pytest.approx(printed.max(), rel=0.15)
    np.testing.assert_allclose(heap, printed, atol=0.15 * heap.max())


# ---- what is ours, against slow twins -----------------------------------------------------------


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("law", (SOLE, UNIFORM))
def test_compress_trail_10_soft22_11(seed, law):
    both = Both(seed)
    bottom, cover = both.sole()
    ring = np.zeros(both.shape, np.int32)
    for step, load in enumerate((5.0, 300.0, 900.0, 700.0, 250.0, 1200.0)):
        dt = 0.02 if step % 2 else 0.3
        pressed = _native.soil_compress(both.patch(), (bottom, cover, ring), foot_of(load), law, dt)
        touched, firm, loose, displaced, sink = twin.compress(
            both.twin, bottom.astype(float), cover.astype(float), load, dt, ("sole", "uniform")[law]
        )
        assert np.array_equal(ring == 0, touched)
        assert pressed["sink"] == pytest.approx(sink, abs=1e-7)
        assert pressed["firm"] == pytest.approx(firm, rel=1e-5, abs=1e-11)
        assert pressed["loose"] == pytest.approx(loose, rel=1e-5, abs=1e-11)
        assert pressed["displaced"] == pytest.approx(displaced, rel=1e-5, abs=1e-11)
        both.same("compression", 2e-7)
        both.same("heap", 2e-7)
        np.testing.assert_allclose(both.native["pressure_time"], both.twin["pressure_time"], rtol=2e-4, atol=1.0)
    assert firm > 0


@pytest.mark.parametrize("descent", ((1e6, 0, 0, 0), (0.004, 0, 0, 0), (0.001, 0.02, -0.03, 0.1), (-0.1, 0, 0, 0)))
@pytest.mark.parametrize("seed", range(3))
def test_carve(seed, descent):
    both = Both(seed)
    bottom, cover = both.sole()
    ring = np.zeros(both.shape, np.int32)
    for lower in (0.0, 0.01, -0.01, 0.03):
        low = bottom - np.float32(lower)
        carved = _native.soil_carve(both.patch(), (low, cover, ring), descent, 0.01)
        touched, *volumes = twin.carve(both.twin, low.astype(float), cover.astype(float), descent)
        assert np.array_equal(ring == 0, touched)
        for name, volume in zip(("firm", "loose", "displaced", "cut_firm", "cut_loose"), volumes):
            assert carved[name] == pytest.approx(volume, rel=1e-4, abs=1e-9), name
        both.same("compression", 3e-7)
        both.same("heap", 3e-7)
    assert both.native["compression"].max() > 0.02


@pytest.mark.parametrize("seed", range(4))
def test_the_load_is_carried(seed):
    both = Both(seed, holes=False)
    bottom, cover = both.sole()
    ring = np.zeros(both.shape, np.int32)
    _native.soil_compress(both.patch(), (bottom, cover, ring), foot_of(800.0), SOLE, 0.01)
    assert both.native["pressure_time"].sum(dtype=float) * both.cell**2 == pytest.approx(8.0, rel=1e-5)


@pytest.mark.parametrize("push", ((0, 0), (60, -25), (-300, 200)))
@pytest.mark.parametrize("seed", range(3))
def test_accumulate_paper_trail_11_12_13(seed, push):
    both = Both(seed)
    bottom, cover = both.sole()
    ring = heaps.rings(cover > 0, 4).astype(np.int32)
    foot = foot_of(700.0, push)
    for volume in (1e-5, 3e-4):
        _native.soil_accumulate(both.patch(), (bottom, cover, ring), foot, volume, PAPER, 0.05, 200.0, 0.0)
        heaps.accumulate_paper(both.twin, ring, cover, foot, volume, 0.05, 200.0)
    both.same("heap", 1e-7)


@pytest.mark.parametrize("push", ((0, 0), (60, -25), (-300, 200)))
@pytest.mark.parametrize("seed", range(3))
def test_accumulate_rest_is_the_envelope_of_cones(seed, push):
    both = Both(seed, holes=seed == 2)
    bottom, cover = both.sole()
    ring = heaps.rings(cover > 0, 1).astype(np.int32)
    foot = foot_of(700.0, push)
    i, j = round((0.01 - both.x0) / both.cell), round((-0.005 - both.y0) / both.cell)
    slope = float(both.native["rest_slope"][j, i])
    height = 0.0
    for volume in (1e-4, 4e-4, 1e-4):
        before = both.native["heap"].sum(dtype=float)
        height = _native.soil_accumulate(both.patch(), (bottom, cover, ring), foot, volume, REST, 0.04, 200.0, height)
        expected = heaps.accumulate_rest(both.twin, ring, cover, foot, volume, 200.0, slope)
        assert (both.native["heap"].sum(dtype=float) - before) * both.cell**2 == pytest.approx(volume, rel=1e-5)
        # the kernel stops within 0.02 % of the volume and scales what it lays
        assert height == pytest.approx(expected, rel=0.001)
        both.same("heap", 5e-6)
    assert both.native["heap"].max() > 0.01


def test_anisotropy_trail_13():
    assert _native.soil_anisotropy((3.0, 4.0, 0.0), 10.0) == pytest.approx(0.5)
    assert _native.soil_anisotropy((30.0, 40.0, 0.0), 10.0) == 1.0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("standing", (False, True))
@pytest.mark.parametrize("tolerance", (1e-5, 0.02))
def test_sweeps_trail_14_15_16(seed, standing, tolerance):
    both = Both(seed, loose=0.05)
    bottom, cover = both.sole()
    ring = np.where(cover > 0.5, 0, 32767).astype(np.int32)
    imprint = (bottom, cover, ring) if standing else None
    for _ in range(8):
        # fresh heaps each time: a sweep leaves ties, slopes of gamma_r to the last bit, that count either way
        both.native["heap"] += (0.03 * both.random.random(both.shape) * (both.native["heap"] > 0)).astype(np.float32)
        both.twin["heap"] = both.native["heap"].astype(float)
        settled = _native.soil_stabilize(both.patch(), imprint, None, tolerance, 1)
        twin.sweep(both.twin, ring == 0 if standing else None, tolerance)
        both.same("heap", 1e-6)
        assert settled["sweeps"] == 1


def test_at_rest_means_at_rest():
    both = Both(9, nx=40, ny=40, loose=0.08, holes=False)
    before = both.native["heap"].sum(dtype=float)
    settled = _native.soil_stabilize(both.patch(), None, None, math.radians(0.1), 100000)
    assert settled["at_rest"]
    assert both.native["heap"].sum(dtype=float) == pytest.approx(before, rel=1e-6)
    both.twin["heap"] = both.native["heap"].astype(float)
    twin.sweep(both.twin)
    assert np.abs(both.twin["heap"] - both.native["heap"]).max() < 0.3 * math.tan(math.radians(0.1)) * both.cell * 8


def test_the_door_checks_what_comes_in():
    both = Both(1)
    bottom, cover = both.sole()
    ring = np.zeros(both.shape, np.int32)
    good = both.patch()
    with pytest.raises(TypeError, match="rest: expected"):
        _native.soil_compress((*good[:3], good[3].astype(float), *good[4:]), (bottom, cover, ring), foot_of(1), 0, 0.1)
    with pytest.raises(ValueError, match="heap: expected"):
        _native.soil_compress((*good[:5], good[5][:3], *good[6:]), (bottom, cover, ring), foot_of(1), 0, 0.1)
    with pytest.raises(ValueError, match="kind: element"):
        _native.soil_compress((*good[:9], good[9] + np.uint8(3), good[10]), (bottom, cover, ring), foot_of(1), 0, 0.1)
    for soils, words in (
        ([{"layer_depth": 0.0}], "out of its range"),
        ([{"rest_angle": float("nan")}], "out of its range"),
        ([{"layer_dept": 0.3}], "no number 'layer_dept'"),
        ([], "1 to 255"),
    ):
        with pytest.raises(ValueError, match="soils: .*" + words):
            _native.soil_compress((*good[:10], soils), (bottom, cover, ring), foot_of(1), 0, 0.1)
    with pytest.raises(TypeError, match="soils: soil 0"):
        _native.soil_compress((*good[:10], [0.3]), (bottom, cover, ring), foot_of(1), 0, 0.1)
    with pytest.raises(ValueError, match="foot"):
        _native.soil_compress(good, (bottom, cover, ring), foot_of(float("nan")), 0, 0.1)
    with pytest.raises(ValueError, match="law"):
        _native.soil_compress(good, (bottom, cover, ring), foot_of(1), 7, 0.1)
    with pytest.raises(ValueError, match="pressing soil"):
        _native.soil_compress(good, (bottom, cover, ring), foot_of(1), 0, 0.0)
    with pytest.raises(ValueError, match="laying soil"):
        _native.soil_accumulate(good, (bottom, cover, ring), foot_of(1), -1.0, 0, 0.04, 9.0, 0.0)
    with pytest.raises(TypeError, match="within"):
        _native.soil_stabilize(good, None, [1, 2, 3, 4], 0.001, 5)
    assert np.array_equal(good[5], Both(1).native["heap"])
