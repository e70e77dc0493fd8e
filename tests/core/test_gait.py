"""The recording: saved and loaded to the bit, refused with a sentence, joined, resampled."""

import os
from dataclasses import replace

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.motion.gait import Gait, Sole


def gait(count=10, rate=24.0, shift=0.0):
    random = np.random.default_rng(3)
    turn = random.normal(size=(2, count, 4))
    turn /= np.linalg.norm(turn, axis=-1, keepdims=True)
    pose = np.concatenate([random.normal(size=(2, count, 3)) + shift, turn], axis=-1)
    sole = Sole([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    other = Sole([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [1, 3, 2]])
    return Gait(
        time=np.arange(count) / rate,
        com=random.normal(size=(1, count, 3)),
        mass=[70],
        pose=pose,
        limb_walker=[0],
        part_limb=[0, 0],
        soles=(sole, other),
        point=random.normal(size=(3, 3)),
        point_part=[0, 1, 1],
        point_role=[0, 1, 2],
        limb_name=("fóot.L",),
        part_name=("heel", "toe"),
        walker_name=("Wanderer",),
        frame_rate=rate,
        frame_start=7,
        warnings=("Watch out.",),
    )


def same(a, b):
    for name in ("time", "com", "mass", "pose", "limb_walker", "part_limb", "point", "point_part", "point_role", "cut"):
        assert np.array_equal(getattr(a, name), getattr(b, name))
        assert getattr(a, name).dtype == getattr(b, name).dtype
    for name in ("limb_name", "part_name", "walker_name", "frame_rate", "frame_start", "warnings"):
        assert getattr(a, name) == getattr(b, name)
    for x, y in zip(a.soles, b.soles, strict=True):
        assert np.array_equal(x.vertices, y.vertices) and np.array_equal(x.triangles, y.triangles)


def test_comes_back_to_the_bit(tmp_path):
    path = tmp_path / "walk.npz"
    gait().save(path)
    same(Gait.load(path), gait())
    gait(5).save(path)  # over an older one
    assert len(Gait.load(path).time) == 5
    assert os.listdir(tmp_path) == ["walk.npz"]


def test_a_file_that_may_not_be_read_is_not_called_damaged(tmp_path, monkeypatch):
    def locked(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "open", locked)
    with pytest.raises(DesirePathError, match="cannot be read .Permission denied."):
        Gait.load(tmp_path / "walk.npz")


def test_damaged_files_get_a_sentence(tmp_path):
    path = tmp_path / "walk.npz"
    gait().save(path)
    whole = path.read_bytes()
    cases = [b"", b"PK", b"not a recording", whole[:200], whole[:-50], whole[: len(whole) // 2]]
    for k in range(0, len(whole), 97):
        cases.append(whole[:k] + bytes([whole[k] ^ 255]) + whole[k + 1 :])
    refused = 0
    for data in cases:
        path.write_bytes(data)
        try:
            Gait.load(path)
        except DesirePathError as error:
            refused += 1
            assert str(error).endswith(".") and "again" in str(error)
    assert refused > len(cases) / 2
    with pytest.raises(DesirePathError, match="no recording at"):
        Gait.load(tmp_path / "nothing.npz")
    np.savez(path, version=np.array(1), time=np.array([object()], dtype=object), allow_pickle=True)
    with pytest.raises(DesirePathError, match="damaged"):
        Gait.load(path)
    np.savez(path, version=np.array(99))
    with pytest.raises(DesirePathError, match="another version"):
        Gait.load(path)


def test_folder_that_is_not_there(tmp_path):
    with pytest.raises(DesirePathError, match="cannot be written"):
        gait().save(tmp_path / "no" / "walk.npz")


def nan(array, *at):
    array = array.copy()
    array[at] = np.nan
    return array


@pytest.mark.parametrize(
    "change,words",
    [
        (lambda g: dict(pose=nan(g.pose, 0, 4, 1)), "fóot.L has no finite position at frame 11"),
        (lambda g: dict(pose=nan(g.pose, 1, 0, 5)), "at frame 7"),
        (lambda g: dict(com=nan(g.com, 0, 3, 2)), "mass centre of Wanderer .* at frame 10"),
        (lambda g: dict(pose=g.pose * 2), "broken rotation"),
        (lambda g: dict(mass=[0]), "mass of 0 kg"),
        (lambda g: dict(mass=[-3]), "mass of -3 kg"),
        (lambda g: dict(time=g.time[::-1]), "times do not increase"),
        (lambda g: dict(time=g.time[:0], com=g.com[:, :0], pose=g.pose[:, :0]), "no frames"),
        (lambda g: dict(pose=g.pose[:1]), "shape"),
        (lambda g: dict(part_limb=[0, 3]), "part_limb says 3 at 1, where 0 to "),
        (lambda g: dict(point_role=[0, 1, 5]), "point_role says 5 at 2, where 0 to 2 "),
        (lambda g: dict(point_part=[0, 0, 0]), "Part 1 of the recording, of bone .* has no contact point"),
        (lambda g: dict(point=nan(g.point, 1, 0)), "contact point 1 has no finite"),
        (lambda g: dict(soles=g.soles[:1]), "1 soles for 2 parts"),
        (lambda g: dict(soles=(Sole(np.zeros((0, 3)), np.zeros((0, 3))),) * 2), "no faces"),
        (lambda g: dict(soles=(Sole(np.zeros((2, 3)), [[0, 1, 2]]),) * 2), "without its vertices"),
        (lambda g: dict(frame_rate=0), "frame rate"),
        (lambda g: dict(cut=[0]), "cuts do not rise"),
        (lambda g: dict(cut=[10]), "cuts do not rise"),
        (lambda g: dict(cut=[5, 5]), "cuts do not rise"),
    ],
)
def test_bad_recordings_name_bone_and_frame(change, words):
    good = gait()
    with pytest.raises(DesirePathError, match=words):
        replace(good, **change(good)).check()
    assert good.check() is good


def test_joined_walkers_keep_their_own():
    a, b = gait(), replace(gait(shift=5.0), walker_name=("Other",))
    both = Gait.join([a, b]).check()
    assert both.com.shape == (2, 10, 3) and both.pose.shape == (4, 10, 7)
    assert both.limb_walker.tolist() == [0, 1] and both.part_limb.tolist() == [0, 0, 1, 1]
    assert both.point_part.tolist() == [0, 1, 1, 2, 3, 3]
    assert both.walker_name == ("Wanderer", "Other") and both.warnings == ("Watch out.",)
    same(Gait.join([a]), a)
    with pytest.raises(DesirePathError, match="different times"):
        Gait.join([a, gait(9)])
    for walkers in ([2], [-1], [1, 0], [0, 0], [0.5]):
        with pytest.raises(DesirePathError, match="of 2: give their numbers"):
            Gait.join([gait(), gait()]).only(walkers)
    with pytest.raises(DesirePathError, match="no walker"):
        Gait.join([])


def test_resampling_keeps_samples_and_names():
    g = gait()
    fine = g.resample(240.0).check()
    assert len(fine.time) == 91 and fine.rate() == pytest.approx(240.0)
    assert fine.com[:, ::10] == pytest.approx(g.com, abs=1e-9)
    assert abs((fine.pose[:, ::10, 3:] * g.pose[..., 3:]).sum(axis=-1)) == pytest.approx(np.ones((2, 10)), abs=1e-9)
    assert fine.limb_name == g.limb_name and fine.frame_start == 7
    assert fine.frame(90) == pytest.approx(g.frame(9))
    again = g.resample(240.0)
    assert fine.pose.tobytes() == again.pose.tobytes()
    assert len(gait(1).resample(120.0).time) == 1
    with pytest.raises(DesirePathError, match="rate"):
        g.resample(0)
    with pytest.raises(DesirePathError, match="rate"):
        g.resample(float("nan"))


def test_thinned_motion_comes_back():
    time = np.arange(0, 2.0001, 1 / 240)
    path = lambda t: np.stack([1.2 * t + 0.02 * np.sin(12 * t), 0.03 * np.sin(6 * t), np.cos(12 * t) * 0.03], axis=-1)
    g = gait(len(time), 240.0)
    g = replace(g, com=path(time)[None])
    for every in (4, 8, 10):
        thin = replace(g, time=time[::every], com=g.com[:, ::every], pose=g.pose[:, ::every])
        back = thin.resample(120.0)
        assert abs(back.com[0] - path(back.time)).max() < 1e-3 * (every / 8) ** 3


# ---- pieces ------------------------------------------------------------------------------------------------


def test_cuts_are_kept(tmp_path):
    path = tmp_path / "walk.npz"
    cut = replace(gait(), cut=[4, 7]).check()
    cut.save(path)
    same(Gait.load(path), cut)
    assert Gait.join([cut, replace(gait(), cut=[2])]).cut.tolist() == [2, 4, 7]
    assert cut.pieces() == [(0, 4), (4, 7), (7, 10)]
    piece = cut.piece(4, 7).check()
    assert np.array_equal(piece.pose, cut.pose[:, 4:7]) and not len(piece.cut) and piece.frame_start == 11
    gait().save(path)  # one that knows no cuts, as earlier versions wrote it
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files if name != "cut"}
    np.savez(path, **arrays)
    same(Gait.load(path), gait())


def test_resampling_keeps_to_the_pieces():
    cut = replace(gait(), cut=[4])
    fine = cut.resample(240.0).check()
    whole = [cut.piece(*ends).resample(240.0) for ends in cut.pieces()]
    assert fine.cut.tolist() == [31] and fine.rate() == pytest.approx(240.0)
    assert np.array_equal(fine.pose, np.concatenate([piece.pose for piece in whole], axis=1))
    assert fine.time[31] == pytest.approx(cut.time[4])
    paused = replace(cut, time=cut.time + np.where(np.arange(10) < 4, 0.0, 5.0))
    assert paused.rate() == pytest.approx(24.0) and paused.resample(24.0) is paused
    assert replace(paused, cut=()).rate() is None
