"""What ground is like below a cell: by place alone, of mean 0, and as its slow twin has it. MODEL 8.3"""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.ground.detail import DETAILS, Detail, details, with_clods
from tests.reference import detail as slow

ALL = Detail(0.001, 0.006, 0.3, 0.002, 0.007, 0.007, 0.026, 0.002, 0.02)


def places(count, side, seed=1):
    return np.c_[np.random.default_rng(seed).uniform(-side, side, (count, 2)), np.zeros(count)]


@pytest.mark.parametrize("name", [*DETAILS, "all"])
def test_it_is_as_its_twin_has_it(name):
    its = DETAILS.get(name, ALL)
    at = places(300, 40.0)
    want = [slow.detail(x, y, its, 5) for x, y, _ in at]
    assert np.allclose(details(at, its, 5), want, rtol=1e-5, atol=1e-9)


def test_heights_and_shifts_are_of_mean_0_and_as_high_as_said():
    shown = details(places(400_000, 3.0), ALL, 2).astype(float)
    vein, crumb, grit, x, y, _ = shown.T
    for each in (vein, crumb, grit, x, y):
        assert abs(each.mean()) < 0.02 * each.std()
    assert grit.std() == pytest.approx(0.001, rel=0.02)
    assert x.std() == pytest.approx(0.002, rel=0.04) and y.std() == pytest.approx(0.002, rel=0.04)
    assert vein.max() == pytest.approx(0.007 * (1 - slow.VEIN_MEAN), rel=0.02)
    assert abs(np.corrcoef(shown[:, :5].T) - np.eye(5)).max() < 0.02


@pytest.mark.parametrize("name", ["sand", "mud", "earth"])
def test_clods_are_as_wide_as_the_soil_says(name):
    usual = DETAILS[name]
    assert with_clods(usual, 0.0) is usual
    its = with_clods(usual, 0.03)
    crumb = details(places(200_000, 2.0), its)[:, 1]
    under = crumb > crumb.min() + 1e-6
    assert its.max_crumb == 0.015 and 0.09 < under.mean() < 0.26
    assert its.min_crumb / its.max_crumb == pytest.approx(usual.min_crumb / usual.max_crumb)
    assert with_clods(usual, 1e-5).max_crumb == 1e-4  # as fine as powder, and none finer


def test_crumbs_cover_their_share_and_are_as_large_as_said():
    shown = details(places(400_000, 3.0), replace(ALL, crumb_share=0.1), 3)
    crumb, threshold = shown[:, 1], shown[:, 5]
    under = threshold > 0.001 + 1e-6
    assert under.mean() == pytest.approx(0.1, abs=0.008)
    assert threshold.max() <= 0.5 * 0.007 and np.ptp(crumb[~under]) < 1e-6
    assert 0.0 < np.ptp(crumb) < 2.0 * 0.8 * 0.007


def test_a_place_is_always_like_this():
    at = places(20_000, 5.0)
    shown = details(at, ALL)
    assert np.array_equal(details(at[::-1], ALL)[::-1], shown)
    assert np.array_equal(details(at[7:8], ALL), shown[7:8])
    assert np.array_equal(details(at + (0.0, 0.0, 3.0), ALL), shown)  # heights do not count
    assert not np.array_equal(details(at, ALL, 1), shown)
    near = details(at + (1e-6, 0.0, 0.0), replace(ALL, crumb_share=0.0))
    assert np.abs(near - details(at, replace(ALL, crumb_share=0.0))).max() < 1e-5  # and it has no steps


def test_ground_without_detail_is_flat():
    assert not details(places(100, 5.0), Detail())[:, :5].any()
    assert details(np.zeros((0, 3)), ALL).shape == (0, 6)


def test_what_cannot_be_is_told():
    for wrong in ({"grit_height": -1.0}, {"crumb_share": 0.6}, {"fray_size": 0.0}, {"vein_size": float("nan")}):
        with pytest.raises(DesirePathError, match=next(iter(wrong))):
            Detail(**wrong)
    with pytest.raises(DesirePathError, match="min_crumb"):
        Detail(min_crumb=0.01)
    with pytest.raises(DesirePathError, match="NaN"):
        details([[np.nan, 0.0, 0.0]], ALL)
