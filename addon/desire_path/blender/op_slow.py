"""op_slow.py - an armature walks as slowly as the prints it leaves let it, at equal effort. SOFT22 3.2, MODEL 4.6

bake --depth of its own prints--> effort.time_curve --> a strip of the NLA editor that plays its action by that curve

No key is touched: the strip's time is a curve to work on, and what was played before comes back when it is taken off.
"""

import math

import bpy
from bpy.props import BoolProperty, EnumProperty

from ..errors import DesirePathError
from .late import baking, clock, compat, effort, home, np, playback, settle_feet, state, walker
from .op_place import frames_of, recorded
from .ops import TakenOff

TRACK = "Desire Path Slow Down"  # name of the track and the strip that are ours
LEAST = 1.02  # who takes less than so many times as long is not slowed
OFF = 0.05  # keys of the curve leave its frames off by so much at most [frame]


def track_of(animation):
    """Our track of the NLA editor, or None."""
    tracks = animation.nla_tracks if animation is not None else ()
    return next((each for each in tracks if each.name == TRACK and len(each.strips) == 1), None)


def curve_of(scene, armature, land, surface):
    """(scene frames, when the pose of each comes at equal effort [frame], the effort at each, warnings) by a bake."""
    status = state.ask(land)
    if status.state != state.FRESH:
        why = status.text or "There is no bake yet: press Bake Trail."
        raise DesirePathError(f"How deep '{armature.name}' sinks is not known. {why}")
    frames = frames_of(scene, armature, land)
    gait, below, beside, warnings = recorded(scene, armature, land, frames)
    film = settle_feet.Films(
        [
            settle_feet.Film(baking.read_index(home.folder(each)))
            for each in (land, *beside)
            if playback.modifier(each) is not None
        ]
    )
    loads = walker.loads(gait, armature.desire_path.load_model, ground=below.rest_height)
    depth = effort.depth_of(gait, effort.print_depths(gait, loads.touching, film))
    eta = effort.effort(depth, surface.lower())
    comes = effort.time_curve(gait.time, eta)
    frames = np.asarray(frames, float)
    return frames, frames[0] + (comes - comes[0]) * clock.frame_rate(scene), eta, warnings


def slow_down(scene, armature, land, surface="FIRM"):
    """Let an armature take its time; (times as long as it takes, scene frame of its end, mean effort, warnings)."""
    animation = armature.animation_data
    if track_of(animation) is not None:
        raise DesirePathError(
            f"'{armature.name}' is slowed down already: take that off, bake, and press Slow Down again."
        )
    action = animation.action if animation is not None else None
    strips = animation is not None and any(track.strips for track in animation.nla_tracks)
    if action is None or strips:
        raise DesirePathError(
            f"'{armature.name}' plays {'strips of the NLA editor' if strips else 'no action'}: Slow Down "
            "sets the time of one action. Give it that, by Object > Animation > Bake Action with Visual Keying."
        )
    frames, comes, eta, warnings = curve_of(scene, armature, land, surface)
    longer = (comes[-1] - comes[0]) / max(frames[-1] - frames[0], 1.0)
    if longer < LEAST:
        raise DesirePathError(
            f"'{armature.name}' hardly sinks: at equal effort it walks as fast as on firm ground. Nothing was changed."
        )
    _play_by(animation, frames / clock.stretch(scene), comes / clock.stretch(scene))
    return longer, comes[-1], float(eta.mean()), warnings


def _play_by(animation, times, comes):
    """Let the action in use be played by a strip, in which each of its times comes at another one."""
    action, slot = animation.action, getattr(animation, "action_slot", None)
    track = animation.nla_tracks.new()
    track.name = TRACK
    strip = track.strips.new(TRACK, math.floor(comes[0]), action)
    strip.name = TRACK
    if slot is not None:
        strip.action_slot = slot
    strip.scale = max(math.ceil(comes[-1]) - strip.frame_start, 1.0) / (
        strip.action_frame_end - strip.action_frame_start
    )
    strip.use_animated_time = True
    points = strip.fcurves.find("strip_time").keyframe_points
    kept = thinned(comes, times)
    points.add(len(kept) - len(points))
    for point, k in zip(points, kept):
        point.co, point.interpolation = (comes[k], times[k]), "LINEAR"
    strip.fcurves.find("strip_time").update()
    animation.action = None


def thinned(x, y, off=OFF):
    """Which points of a curve to keep, first and last among them, for straight lines between to be off by so little."""
    kept, begin = [0], 0
    for end in range(2, len(x)):
        between = slice(begin + 1, end)
        line = np.interp(x[between], (x[begin], x[end]), (y[begin], y[end]))
        if np.abs(line - y[between]).max() > off:
            begin = end - 1
            kept.append(begin)
    return [*kept, len(x) - 1]


def take_off(armature):
    """Let an armature play its action as it did; the action's name."""
    animation = armature.animation_data
    track = track_of(animation)
    if track is None:
        raise DesirePathError(f"'{armature.name}' is not slowed down: there is nothing to take off.")
    action, slot = track.strips[0].action, getattr(track.strips[0], "action_slot", None)
    animation.nla_tracks.remove(track)
    compat.use_action(animation, action, slot)
    return action.name


class OBJECT_OT_desire_path_slow_down(TakenOff, bpy.types.Operator):
    """Let the active armature walk as slowly as its prints are deep, at the effort of firm ground. Its keys stay: a \
strip of the NLA editor plays them, by a curve of time to work on"""

    bl_idname = "object.desire_path_slow_down"
    bl_label = "Slow Down"
    bl_options = {"REGISTER", "UNDO"}

    surface: EnumProperty(
        name="Surface",
        items=(
            ("FIRM", "Firm", "Only the depth of prints costs effort"),
            ("SAND", "Loose Sand", "Loose sand, which costs 2.1 times the effort however shallow prints are"),
        ),
        description="What walking costs where prints are shallow",
    )
    remove: BoolProperty(name="Take Off", description="Play the action again at its own time")

    take_off = staticmethod(take_off)

    def change(self, scene, obj, land):
        longer, end, eta, warnings = slow_down(scene, obj, land, self.surface)
        return warnings, (
            f"Walking costs '{obj.name}' {eta:.1f} times as much as on firm ground: at equal effort it takes "
            f"{longer:.2f} times as long, up to frame {math.ceil(end - 1e-3)}."
        )


CLASSES = (OBJECT_OT_desire_path_slow_down,)
