"""track.py - curves that are tracks: where their marks will lie, and how they are pressed into a ground.

curve, settings --marks.lay, track.rolled--> Laid, Gait --preview--> a wire object
                                                        --TrackPress, press.stay--> a bake of its own, which plays
"""

from contextlib import suppress

import bpy
import numpy as np

from ..bake.stamping import TrackPress
from ..errors import DesirePathError
from ..ground import mesh
from ..ground.options import SimulationOptions
from ..placement import stamps, vehicle
from ..placement.marks import Drive, Marks, lay
from ..placement.pace import land_of, slope_of
from ..placement.track import Wheel, rolled
from . import axes, clock, ground, paths, picture, press, pressed
from .chosen import grounds

APART = {"rna_type", "name", "image", "sole", "marks", "weight"}  # of a track's settings: no numbers, or told twice
RUT_STEP = 0.5  # ruts are shown by lines with a place so often [m]
ABOVE = 0.005  # marks are shown so high over the ground [m]


def tracks(scene, land):
    """Curves whose tracks lie on a ground, by their names."""
    found = [obj for obj in scene.objects if obj.type == "CURVE" and obj.desire_path.track.is_track]
    return sorted((obj for obj in found if obj.desire_path.ground == land), key=lambda each: each.name)


def choose_ground(scene, obj):
    """The ground a curve's track lies on: its own, or the only one; DesirePathError where there is none."""
    known = obj.desire_path.ground
    if known is not None and known.desire_path.is_ground:
        return known
    there = grounds(scene)
    if len(there) != 1:
        raise DesirePathError(
            f"The track '{obj.name}' has no ground: press Add Ground on a mesh first."
            if not there
            else f"There are several grounds: choose the one of the track '{obj.name}'."
        )
    return there[0]


# ---- what leaves a track ---------------------------------------------------------------------------


def stamp_of(obj):
    """The Stamp of a curve's settings."""
    settings = obj.desire_path.track
    if settings.kind == "SOLE":
        return _sole(obj, settings.sole)
    if settings.stamp != "image":
        return stamps.find(settings.stamp)
    if settings.image is None:
        raise DesirePathError(f"The track '{obj.name}' has no image: choose the picture of its stamp.")
    light = picture.brightness(settings.image, "stamp's image")[::-1]
    return stamps.Stamp.picture(light, axes.typed(settings.image_length), axes.typed(settings.image_height))


def _sole(obj, sole):
    if sole is None:
        raise DesirePathError(f"The track '{obj.name}' has no sole: choose a mesh whose underside leaves the marks.")
    scale, depsgraph = axes.unit_scale(bpy.context.scene), bpy.context.evaluated_depsgraph_get()
    shape = press.taken(sole, depsgraph, scale, None).shape
    return stamps.Stamp.mesh(shape.vertices, shape.triangles)


def _numbers(obj, scene):
    settings = obj.desire_path.track
    given = {name: axes.typed(getattr(settings, name)) or None for name in ("spacing", "width", "depth", "mass")}
    if given["depth"]:
        given["mass"] = None  # which its button does not show then
    marks = Marks(
        given["spacing"],
        width=given["width"],
        first=settings.first,
        size=axes.typed(settings.size),
        scatter=axes.typed(settings.scatter),
        seed=settings.seed,
    )
    speeds = (axes.typed(each) or None for each in (settings.speed, settings.end_speed))
    return marks, Drive(given["mass"], given["depth"], *speeds, frame_rate=clock.frame_rate(scene), name=obj.name)


def _wheel(obj):
    settings = obj.desire_path.track
    if settings.vehicle != "none":
        return vehicle.find(settings.vehicle)
    radius, width, gauge = (axes.typed(getattr(settings, name)) for name in ("radius", "tyre_width", "gauge"))
    return Wheel(radius, width, settings.tread, gauge)


def created(scene, obj, below):
    """What presses along a curve, Laid or a Gait of wheels. below: heights of the ground"""
    line = paths.waypoints(scene, obj)
    marks, drive = _numbers(obj, scene)
    if obj.desire_path.track.kind == "WHEEL":
        return rolled(line, _wheel(obj), drive, below)
    return lay(line, stamp_of(obj), marks, drive, below)


def surface_of(scene, land):
    return ground.read(scene, land, axes.typed(land.desire_path.cell_size), scene.frame_current)


def heights(surface, land):
    return ground.land(surface, axes.typed(land.desire_path.cell_size))


# ---- the preview -----------------------------------------------------------------------------------


def preview(scene, obj, below):
    """Show where a curve's marks will lie: outlines that point ahead, and lines where wheels roll."""
    line = paths.waypoints(scene, obj)
    if obj.desire_path.track.kind == "WHEEL":
        points, edges = _ruts(obj, line, below)
    else:
        marks, drive = _numbers(obj, scene)
        points, edges = _outlines(lay(line, stamp_of(obj), marks, drive, below))
    mesh = bpy.data.meshes.new(f"{obj.name} Marks")
    mesh.from_pydata(((points + (0.0, 0.0, ABOVE)) / axes.unit_scale(scene)).tolist(), edges, [])
    shown = obj.desire_path.track.marks
    if shown is None or shown.type != "MESH":
        shown = bpy.data.objects.new(mesh.name, mesh)
        scene.collection.objects.link(shown)
        shown.display_type, shown.hide_render, shown.hide_select = "WIRE", True, True
        obj.desire_path.track.marks = shown
    else:
        old, shown.data = shown.data, mesh
        if not old.users:
            bpy.data.meshes.remove(old)
    return shown


def preview_again(obj):
    """A setting of a curve was changed: its marks are shown anew, if they can be."""
    settings, scene = obj.desire_path, bpy.context.scene
    if not settings.track.is_track or settings.ground is None:
        return
    with suppress(DesirePathError):  # what is wrong is told where it is pressed
        preview(scene, obj, heights(surface_of(scene, settings.ground), settings.ground))


def _outlines(laid):
    corner = laid.outlines()
    tip = 0.5 * (corner[:, 1] + corner[:, 2]) + 0.15 * (corner[:, 1] - corner[:, 0])
    points = np.stack([corner[:, 0], corner[:, 1], tip, corner[:, 2], corner[:, 3]], axis=1)
    first = 5 * np.arange(len(points))[:, None]
    edges = np.stack([first + np.arange(5), first + (1, 2, 3, 4, 0)], axis=-1)
    return points.reshape(-1, 3), edges.reshape(-1, 2).tolist()


def _ruts(obj, line, below):
    wheel = _wheel(obj)
    gait = rolled(line, wheel.plain(), Drive(), below)
    points, edges = [], []
    for pose, sole in zip(np.asarray(gait.pose), gait.soles):
        along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(pose[:, :2], axis=0), axis=1))]
        at = np.interp(np.linspace(0.0, along[-1], max(int(along[-1] / RUT_STEP), 1) + 1), along, np.arange(len(along)))
        places = pose[at.astype(int), :2]
        ahead = np.gradient(places, axis=0) if len(places) > 1 else np.ones((1, 2))
        ahead /= np.maximum(np.linalg.norm(ahead, axis=1), 1e-9)[:, None]
        for side in (0.5, -0.5):
            beside = places + side * np.ptp(sole.vertices[:, 1]) * np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
            first = sum(map(len, points))
            points.append(np.column_stack([beside, slope_of(land_of(below), beside, 0.01)[0]]))
            edges += [(first + k, first + k + 1) for k in range(len(beside) - 1)]
    return np.concatenate(points), edges


def forget(obj):
    """A curve is no track any more, and shows no marks."""
    settings = obj.desire_path.track
    shown, settings.marks, settings.is_track = settings.marks, None, False
    if shown is not None:
        mesh = shown.data
        bpy.data.objects.remove(shown)
        if mesh is not None and not mesh.users:
            bpy.data.meshes.remove(mesh)


# ---- pressed ---------------------------------------------------------------------------------------


def press_all(scene, land, sentences):
    """Press all tracks of a ground into it, in the order of their names; returns a sentence. sentences: gets warnings

    Tracks alone are pressed into the ground as it is; what a hand has pressed is gone on from.
    """
    settings = land.desire_path
    if settings.plants:
        raise DesirePathError(f"Plants grow on '{land.name}', which tracks do not bend: press them before it is sown.")
    curves = tracks(scene, land)
    if not curves:
        raise DesirePathError(f"No track lies on '{land.name}': press Add Track on a curve first.")
    surface = surface_of(scene, land)
    sentences += surface.warnings
    below = heights(surface, land)
    laid = [created(scene, each, below) for each in curves]
    there = pressed.inputs(land)
    if pressed.MIXED in there:
        raise DesirePathError(
            f"The tracks of '{land.name}' are pressed already, together with what a hand has pressed, and would be "
            "pressed twice: undo that, or free the ground, first."
        )
    alone = pressed.TRACKS in there
    base = surface.ground if alone else pressed.start(land, surface.ground)
    live = TrackPress(
        base,
        laid,
        ground.soils(land),
        axes.typed(settings.cell_size),
        options=SimulationOptions(
            law=settings.law, heap=settings.heap, origin=surface.origin, threads=settings.threads
        ),
    )
    inputs = pressed.marks(land, surface) | {pressed.TRACKS: _mark(scene, curves)}
    if there and not alone:
        inputs[pressed.MIXED] = True
    try:
        live.press()
        sentences += live.warnings
        text = press.stay(scene, land, surface, live, sentences, inputs)
    finally:
        live.drop()
    return text


def changed(scene, land, index):
    """A sentence about what has changed since tracks were pressed, if any were; empty where nothing has."""
    if pressed.TRACKS not in index.inputs:
        return ""
    curves = tracks(scene, land)
    if not curves:
        return "The tracks that were pressed are gone: free the ground, or add others and press them."
    if _mark(scene, curves) != index.inputs[pressed.TRACKS]:
        return "The tracks have changed since they were pressed: press them again."
    return ""


def _mark(scene, curves):
    """A word for all that tracks are made from but their ground."""
    arrays, words = [], []
    for obj in curves:
        settings = obj.desire_path.track
        arrays.append(paths.waypoints(scene, obj))
        if settings.kind != "WHEEL":
            stamp = stamp_of(obj)
            arrays += map(np.asarray, stamp.draw(stamp.length))
        names = (each.identifier for each in settings.bl_rna.properties)
        numbers = {name: getattr(settings, name) for name in names if name not in APART}
        words.append((obj.name, numbers))
    return mesh.mark(arrays, words)


def settle(scene, obj, given):
    """Make a curve a track with some settings, and show its marks; returns (its ground, how many marks there are).

    Where it cannot be one, it stays as it was.
    """
    land = choose_ground(scene, obj)
    settings = obj.desire_path
    ground_before, before = settings.ground, {name: getattr(settings.track, name) for name in given}
    settings.ground = land
    _set(settings.track, given)
    try:
        shown = preview(scene, obj, heights(surface_of(scene, land), land))
    except DesirePathError:
        settings.ground = ground_before
        _set(settings.track, before)
        raise
    settings.track.is_track = True
    return land, 0 if settings.track.kind == "WHEEL" else len(shown.data.vertices) // 5


def _set(settings, given):
    for name, value in given.items():
        setattr(settings, name, value)
