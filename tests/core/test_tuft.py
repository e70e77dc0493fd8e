"""What plants look like: every kind has a shape, and stems keep their length however they bend."""

import numpy as np
import pytest

from desire_path.ground import tuft
from desire_path.ground.plants import KINDS, Kind


def literal(root, at, tilt, arch, steps=4000):
    """tuft.bent() of one vertex by walking along the stem in small steps."""
    place = np.array((root[0], root[1], 0.0))
    turn = np.eye(3)
    for k in range(steps + 1):
        share = at[2] / root[2] * (k + 0.5) / steps if k < steps else at[2] / root[2]
        vector = (tilt + arch * share)[:2]
        angle = np.linalg.norm(vector)
        way = vector / max(angle, 1e-300)
        axis = np.array((-way[1], way[0], 0.0))  # upright turns towards `way` about it
        cross = np.array(((0, -axis[2], axis[1]), (axis[2], 0, -axis[0]), (-axis[1], axis[0], 0)))
        turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        if k < steps:
            place = place + turn @ (0, 0, at[2] / steps)
    return place + turn @ (at[0], at[1], 0.0)


def test_bends_as_its_twin():
    random = np.random.default_rng(3)
    count = 12
    root = np.column_stack([random.normal(0, 0.02, (count, 2)), random.uniform(0.05, 0.8, count)])
    at = np.column_stack([random.normal(0, 0.01, (count, 2)), root[:, 2] * random.uniform(-0.05, 1, count)])
    tilt, arch = (np.column_stack([random.normal(0, size, (count, 2)), np.zeros(count)]) for size in (0.5, 0.9))
    wanted = [literal(*rows) for rows in zip(root, at, tilt, arch, strict=True)]
    np.testing.assert_allclose(tuft.bent(root, at, tilt, arch), wanted, atol=2e-4 * root[:, 2].max())


@pytest.mark.parametrize("angle", (0.0, 0.4, 1.2, 1.7))
def test_stems_keep_their_length(angle):
    s = np.linspace(0.0, 0.3, 200)[:, None]
    root, at = s * 0 + (0.0, 0.0, 0.3), np.concatenate([0 * s, 0 * s, s], axis=1)
    line = tuft.bent(root, at, root * 0 + (0.2, 0.0, 0.0), root * 0 + (0.0, angle, 0.0))
    assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() == pytest.approx(0.3, rel=1e-3)


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_has_a_look_of_its_own(name):
    kind, look = KINDS[name], tuft.look_of(name, KINDS[name])
    assert look is tuft.LOOKS[name]
    one, same, other = (tuft.tuft(kind, look, seed) for seed in (0, 0, 1))
    assert one.vertices.tobytes() == same.vertices.tobytes() != other.vertices.tobytes()
    assert 100 < len(one.vertices) < 8000 and np.isfinite(one.vertices).all()
    assert max(max(face) for face in one.faces) < len(one.vertices) and min(map(len, one.faces)) >= 3
    # as high as its kind says, about, and rooted in the ground
    high = one.vertices[:, 2].max()
    assert 0.7 * kind.height < high < 1.7 * kind.height, high
    assert -1.5 * tuft.BURIED < one.vertices[:, 2].min() < 0
    # at rest is where its stems bend to
    np.testing.assert_allclose(one.vertices, tuft.bent(one.root, one.at, one.tilt, one.arch), atol=1e-6)
    assert one.look.min() >= 0.0 and one.look.max() <= 1.0


def test_kinds_of_users_look_by_their_names_and_sizes():
    fern = Kind(height=0.8)
    assert tuft.look_of("/home/me/kinds/Fern-tall.json", fern) is tuft.LOOKS["fern"]
    plain = tuft.look_of("//heath.json", Kind(height=0.2))
    assert tuft.tuft(Kind(height=0.2), plain, 0).vertices[:, 2].max() < 0.35
    assert np.isfinite(tuft.tuft(Kind(height=0.0, width=0.0), plain, 0).vertices).all()


def test_moss_is_leafy_shoots():
    """Seen from above its leaves would cover more than half of the ground, if none lay over another."""
    kind, look = KINDS["moss"], tuft.LOOKS["moss"]
    made = tuft.tuft(kind, look, 0)
    corners = (made.vertices[list(face), :2].astype(float).T for face in made.faces)
    seen = sum(0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) for x, y in corners)
    assert seen * kind.density > 0.5, seen * kind.density
