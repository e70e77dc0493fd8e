"""moves.py - what moves an object, and from which scene frame to which.

    the object, its parents and their data --keys, strips--> from the first to the last of them
    what constraints and drivers tie them to, modifiers of curves, simulations --> the scene's range besides

Keys and strips say themselves when they begin and end. Anything else may go on for ever.
"""

import builtins
import math
import re

import bpy
import numpy as np

from . import auto, clock, compat, playback, playback_tree, private, seams

# modifiers that change a mesh with time, and nodes that do
BY_TIME = {
    "BUILD",
    "CLOTH",
    "DYNAMIC_PAINT",
    "EXPLODE",
    "FLUID",
    "MESH_CACHE",
    "MESH_SEQUENCE_CACHE",
    "OCEAN",
    "PARTICLE_INSTANCE",
    "PARTICLE_SYSTEM",
    "SOFT_BODY",
    "WAVE",
}
NODES_BY_TIME = {"GeometryNodeInputSceneTime", "GeometryNodeSimulationInput"}
# words of a driver's expression that know no time
TIMELESS = {
    *dir(math),
    *dir(builtins),
    "and",
    "or",
    "not",
    "if",
    "else",
    "in",
    "is",
    "self",
    "lerp",
    "clamp",
    "smoothstep",
}


def frame_range(scene, obj):
    """First and last scene frame of what moves an object; the scene's range where nothing does."""
    found = _Movers(obj)
    spans = [(first * clock.stretch(scene), last * clock.stretch(scene)) for first, last in found.spans]
    if found.goes_on:
        spans.append((scene.frame_start, scene.frame_end))
    if spans:
        first = math.floor(min(span[0] for span in spans) + 1e-3)  # the frames that hold all of it
        last = math.ceil(max(span[1] for span in spans) - 1e-3)
        if last > first:
            return first, last
    return scene.frame_start, scene.frame_end


def besides(scene, walkers, first=None, last=None):
    """Where walkers are looked at besides whole frames, from one to another, else those of the scene: keys lie between
    two, or another take begins."""
    ends, found, keys, alone = set(), list[float](), [], len(walkers) == 1
    slow = clock.stretch(scene)
    first = scene.frame_start if first is None else first
    last = scene.frame_end if last is None else last
    for each in walkers:
        movers = _Movers(each, (first / slow, last / slow))
        spans = [(first * slow, last * slow) for first, last in movers.spans]
        if spans and not movers.goes_on:
            ends |= {min(span[0] for span in spans), max(span[1] for span in spans)}
        found += [seam * slow for seam in movers.seams]
        keys += movers.keys
        ground = each.desire_path.ground
        alone = alone and not movers.unkeyed and (ground is None or not moves(ground))
    keys = seams.together(keys, slow, first, last)
    # where no key is looked at nobody asks what else moves: such a recording is what it is without any besides
    return seams.Besides(
        tuple(sorted(ends)), tuple(seams.spread(found, clock.frame_rate(scene))), keys, alone and bool(keys)
    )


def moves(obj):
    """Whether an object may move at all."""
    found = _Movers(obj)
    return bool(found.spans or found.goes_on)


def scene_of(scene, obj):
    """Where an object is seen to move as it does, on its ground: a scene of its own, or `scene` itself where that leads
    either."""
    if asks_scene(obj, obj.desire_path.ground) and obj.name in scene.view_layers[0].objects:
        return private.shown_scene(scene)
    return private.private_scene(scene, obj)


def asks_scene(*objects):
    """Whether properties of a scene move any of some objects; None is none."""
    return any(_Movers(each).asks_scene for each in objects if each is not None)


def keys(scene, obj, first, last):
    """Scene frames, between two, at which what moves or shapes an object is keyed; rising."""
    slow = clock.stretch(scene)
    found = np.concatenate([np.empty(0), *_Movers(obj, (first / slow, last / slow)).keys]) * slow
    return np.unique(found[(first < found) & (found < last)]).tolist()


def movers(obj):
    """All datablocks that have a part in how an object moves, itself among them."""
    return _Movers(obj).seen


def still(walkers):
    """Sentences about walkers that nothing moves: what is off, and how it comes on."""
    return [
        f"Nothing moves '{each.name}': {why_still(each)}. It is baked as it stands."
        for each in walkers
        if not moves(each)
    ]


def why_still(obj):
    """What silences an object's keys, and the cure."""
    for each in _chain(obj):
        animation = getattr(each, "animation_data", None)
        if animation is None:
            continue
        if animation.action is not None:
            played = compat.curves_played(animation)
            if any(curve.mute for curve in played):
                return f"the curves of its action '{animation.action.name}' are muted; unmute them in the Graph Editor"
            if not played:
                return f"its action '{animation.action.name}' has no keys for it; choose another action or slot"
        if animation.use_nla and any(len(track.strips) for track in animation.nla_tracks):
            return "its tracks or strips are muted; unmute them in the NLA Editor"
        if len(animation.nla_tracks):
            return "its NLA tracks are off or hold no strip; switch them on in the NLA Editor or give it an action"
    return "it has no keys; give it an action"


def has_motion(obj):
    """Whether anything moves an object from a frame to another one: a pose that is keyed once does not."""
    found = _Movers(obj)
    return found.goes_on or any(first < last for first, last in found.spans)


def by_time(modifier):
    """Whether a modifier makes another mesh as time goes on, by itself."""
    tree = modifier.node_group if modifier.type == "NODES" else None
    nodes = tree.nodes if tree is not None else ()
    return modifier.type in BY_TIME or any(node.bl_idname in NODES_BY_TIME for node in nodes)


def shapes_by_time(modifier):
    """Whether it does, or takes after an object that moves."""
    others = (
        getattr(modifier, name, None) for name in ("object", "target", "mirror_object", "offset_object", "origin")
    )
    return by_time(modifier) or any(isinstance(each, bpy.types.Object) and moves(each) for each in others)


def frames(scene, ground, walkers):
    """First and last frame a ground is baked over: those of all its walkers, until they are set by hand."""
    settings = ground.desire_path
    if not settings.frames_auto or not walkers:
        return settings.frame_start, settings.frame_end
    ranges = [frame_range(scene, each) for each in walkers]
    return min(each[0] for each in ranges), max(each[1] for each in ranges)


def follow(scene, ground, walkers):
    """The same, shown in the panel from now on."""
    first, last = frames(scene, ground, walkers)
    if ground.desire_path.frames_auto:
        auto.set_auto(ground.desire_path, frame_start=first, frame_end=last)
    return first, last


class _Movers:
    """Everything that moves an object.

    spans: first and last frame of keys and strips, in the animation's time; goes_on: is it moved beyond them, by keys
    that are cycled or go on straight, or, unkeyed, by anything else?
    asks_scene: do properties of a scene move it?
    seams: where it may go on elsewhere at once, of cycles those in `within`; keys: frames of
    all keys, likewise; neither is looked for where no `within` is given
    seen: all datablocks that take part in it
    """

    def __init__(self, obj, within=None):
        self.spans, self.tied, self.within = [], [], within
        self.cycled = self.unkeyed = False
        self.seams, self.keys = [], []
        self.asks_scene = False
        own = _chain(obj)
        for each in own:
            self._look(each)
        seen = self.seen = set(own)
        while self.tied:
            each = self.tied.pop()
            for other in _chain(each) if isinstance(each, bpy.types.Object) else [each]:
                if other not in seen:
                    seen.add(other)
                    before = len(self.spans)
                    self._look(other)
                    self.unkeyed |= len(self.spans) > before

    @property
    def goes_on(self):
        return self.cycled or self.unkeyed

    def _look(self, each):
        """How an ID moves by itself, and to what it is tied."""
        if isinstance(each, bpy.types.CacheFile):
            self.unkeyed = True
        animation = getattr(each, "animation_data", None)
        if animation is not None:
            self._animation(animation)
        if not isinstance(each, bpy.types.Object):
            keys = getattr(each, "shape_keys", None)
            self.tied += [keys] if keys is not None else []
            return
        body = each.rigid_body
        self.unkeyed |= body is not None and body.type == "ACTIVE" and not body.kinematic
        held = list(each.constraints)
        for bone in each.pose.bones if each.pose is not None else ():
            held += bone.constraints
        for constraint in held:
            if not constraint.mute or _is_keyed(animation, constraint):
                self.tied += _tied(constraint)
                for target in getattr(constraint, "targets", ()):
                    self.tied += _tied(target)
        for modifier in each.modifiers:
            self._modifier(modifier)

    def _modifier(self, modifier):
        tree = getattr(modifier, "node_group", None)
        if tree is not None and playback_tree.TAG in tree:
            return  # a bake of ours
        self.tied += _tied(modifier)
        self.unkeyed |= by_time(modifier)
        if tree is not None:
            self.tied.append(tree)

    def _animation(self, animation):
        tracks = list(animation.nla_tracks) if animation.use_nla else []
        solo = [track for track in tracks if track.is_solo]
        for track in solo or tracks:
            if not track.mute or solo:
                heard = [strip for strip in track.strips if not strip.mute]
                self.spans += [(strip.frame_start, strip.frame_end) for strip in heard]
                if self.within is not None:
                    self.seams += [seam for strip in heard for seam in seams.of_strip(strip)]
                    self.keys += [keys for strip in heard for keys in seams.keys_of_strip(strip)]
        if animation.use_tweak_mode:
            self.unkeyed = True  # a strip's action is edited, which may have outgrown its strip
        elif animation.action is not None and not solo:
            self._action(animation)
        for curve in animation.drivers:
            ours = curve.data_path.startswith("desire_path.")  # a soil's number, a mass
            if not (curve.mute or ours or playback.animates_ours(animation.id_data, curve.data_path)):
                self._driver(curve.driver)

    def _action(self, animation):
        curves = [
            curve
            for curve in compat.curves_played(animation)
            if not curve.mute
            and not playback.animates_ours(animation.id_data, curve.data_path)
            and (len(curve.keyframe_points) or len(curve.modifiers) or len(curve.sampled_points))
        ]
        if not curves:
            return
        action = animation.action
        if action.use_frame_range:  # set by hand
            self.spans.append((action.frame_start, action.frame_end))
        else:
            self.spans += [
                tuple(curve.range()) for curve in curves if len(curve.keyframe_points) or len(curve.sampled_points)
            ]
        self.cycled |= any(_goes_on(curve) for curve in curves)
        self.unkeyed |= any(not each.mute and each.type != "CYCLES" for curve in curves for each in curve.modifiers)
        self.unkeyed |= any(len(curve.sampled_points) for curve in curves)
        if self.within is not None:
            self.seams += [seam for curve in curves for seam in seams.of_curve(curve, *self.within)]
            self.keys += seams.keys_of_curves(curves, *self.within)

    def _driver(self, driver):
        names = {variable.name for variable in driver.variables}
        if driver.type == "SCRIPTED":
            words = re.findall(r"(?<![.\w])[A-Za-z_]\w*", driver.expression)
            self.unkeyed |= any(word not in names and word not in TIMELESS for word in words)
        asks = compat.asks_scene(driver)
        self.unkeyed, self.asks_scene = self.unkeyed or asks, self.asks_scene or asks
        for variable in driver.variables:
            for target in variable.targets if variable.type != "CONTEXT_PROP" else ():
                if target.id is not None and not isinstance(target.id, bpy.types.Scene):
                    self.tied.append(target.id)


def _chain(obj):
    """An object and its parents, with their data."""
    found = []
    while obj is not None:
        found += [obj] + ([obj.data] if obj.data is not None else [])
        obj = obj.parent
    return found


def _tied(thing):
    """Objects, files of motion and textures that a constraint, one of its targets or a modifier points at."""
    found = [getattr(thing, each.identifier) for each in thing.bl_rna.properties if each.type == "POINTER"]
    return [each for each in found if isinstance(each, (bpy.types.Object, bpy.types.CacheFile, bpy.types.Texture))]


def _is_keyed(animation, constraint):
    """Is a constraint switched on and off by keys or a driver?"""
    if animation is None:
        return False
    end = f'constraints["{bpy.utils.escape_identifier(constraint.name)}"].mute'
    curves = [*animation.drivers, *(compat.curves_played(animation) if animation.action is not None else ())]
    return any(curve.data_path.endswith(end) for curve in curves)


def _goes_on(curve):
    """Does a curve go on before or after its keys?"""
    if any(not each.mute for each in curve.modifiers):
        return True
    return curve.extrapolation == "LINEAR" and len(curve.keyframe_points) > 1
