"""live.py - Auto Update: a ground that was changed is baked again by itself, and plays on until that is done.

    a change --state.changes()--> REST without another --Job, in slices of a timer--> the same: nothing is to be done
                     ^                                   |                      \\--> outdated: bake, play
                     '------- another change ------------'
A bake that takes long is shown in larger cells first, see coarse.py, until it is made or dropped.
The timer takes SLICE of each turn of Blender's main loop and no key or mouse button. It waits while something is
dragged, edited or rendered, and while a bake runs that the user has started; whatever goes before undo, redo,
save and load stops it, and what it was at begins anew. There is a handler and a timer only while a ground wants it.
"""

import atexit
import time
from contextlib import closing

import bpy
from bpy.app.handlers import persistent

from ..errors import DesirePathError
from . import bake_job, coarse, messages, ops, physics, state, timeline, undo_step
from .chosen import grounds, walkers

REST = 0.2  # without a change before anything is done [s]
SLICE = 0.03  # of work in one turn of Blender's main loop [s]
SEEN = 0.25  # of baking tell how long it will take [s]
LONG = 1.0  # what takes longer from then on is shown coarse first [s] ..
COARSER, COARSEST = 2.0, 4.0  # .. in cells so many times larger
DRAWN = 0.3  # between two pictures of how far it is [s]
FAILED = (DesirePathError, OSError, MemoryError, ReferenceError)

_work = None  # the Job on its way, its steps, and after which change of the scene it began
_done = {}  # name of a ground -> the change of the scene after which it was as wanted, or could not be baked
_drawn = 0.0
_calm = False  # whether all is as wanted as it is now


class _Work:
    """One Job on its way. previews: one that takes long is shown coarse first"""

    def __init__(self, scene, obj, *, previews=False):
        self.name, self.scene_name = obj.name_full, scene.name
        self.job = bake_job.Job(scene, obj, unless_fresh=True)
        self.coarse = None
        self.steps = self._coarse_first() if previews else self.job.run()
        self.changes = state.changes()

    def _coarse_first(self):
        """The steps of the job, and once it is seen that they will take long those of a coarse one in between."""
        steps, spent = self.job.run(), 0.0
        with closing(steps):
            while True:
                begun = time.perf_counter()
                try:
                    next(steps)
                except StopIteration:
                    return
                if self.job.bake is not None and self.coarse is None and self.job.fraction > 0.0:
                    spent += time.perf_counter() - begun
                    left = spent * (1.0 / self.job.fraction - 1.0)
                    if spent > SEEN and left > LONG:
                        yield from self._preview(COARSEST if left > COARSEST * LONG else COARSER)
                yield

    def _preview(self, times):
        self.coarse = False  # it is tried once
        try:
            self.coarse = coarse.Coarse(self.job, times)
            yield from self.coarse.run(bpy.data.scenes[self.scene_name])
        except FAILED:  # as feet that are lost between such cells: what is wanted will be shown, or say why not
            self.clear()

    def clear(self):
        """Nothing coarse is shown any more."""
        if self.coarse:
            self.coarse.remove()
        self.coarse = False

    def progress(self):
        """How far it is, in words."""
        if self.job.bake is None:
            return ""
        text = f"{self.job.text} ({100 * self.job.fraction:.0f} %)"
        if self.coarse and self.coarse.shown:
            text += f". Until then shown in cells of {1000 * self.coarse.cell:.3g} mm"
        return text


# ---- for others ---------------------------------------------------------------------------------------------


def wants(obj):
    """Whether a ground is to be baked again by itself."""
    settings = obj.desire_path
    return obj.type == "MESH" and settings.is_ground and settings.auto_update and obj.library is None


def switched(obj):
    """Auto Update of a ground was switched on or off."""
    _done.pop(obj.name_full, None)
    if wants(obj):
        begin()
    elif _work is not None and _work.name == obj.name_full:
        drop()


def drop():
    """Stop what is on its way, without a trace; it begins anew when Blender rests, if it is still to be done."""
    global _work
    if _work is not None:
        work, _work = _work, None
        bake_job.again(None)
        work.steps.close()
        work.clear()
        state.baking.pop(work.name, None)


def pause():
    """All is as the user wants it, now: nothing is done before another change."""
    global _calm
    drop()
    _calm = True
    _wake()


def update(scene):
    """Bake all grounds of a scene that want it and are outdated, at once; returns sentences about what went wrong.
    Where no window is, nobody else does."""
    wrong = []
    for obj in [each for each in grounds(scene) if wants(each)]:
        drop()
        try:
            work = _Work(scene, obj)
            with state.unseen():
                for _ in work.steps:
                    pass
                _show(work)
        except FAILED as problem:
            wrong.append(ops.sentence(problem))
    return wrong


# ---- the timer ----------------------------------------------------------------------------------------------


def _wake():
    if begun() and not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=REST)


def _wanted():
    """Scenes that windows show, and their grounds to look after."""
    scenes = dict.fromkeys(window.scene for window in bpy.context.window_manager.windows)
    return [(scene, obj) for scene in scenes for obj in grounds(scene) if wants(obj)]


def _tick():
    """One turn; whatever goes wrong in it, nothing is left on its way."""
    try:
        return _turn()
    except BaseException:
        drop()
        state.held = False
        raise


def _turn():
    """Wait, look for a ground that may be outdated, or go on with one; returns when it is called again [s]."""
    global _calm, _work
    wanted = _wanted()
    if not wanted and _work is None:
        state.held = False
        return None
    state.held = True
    quiet = state.quiet_for()
    if _work is not None and _work.changes != state.changes():
        drop()
    if (
        bake_job.running() is not None
        or bpy.app.is_job_running("RENDER")
        or state.busy(played=not _held_by_playback(wanted))
    ):
        return REST
    if quiet < REST:
        return REST - quiet
    if _calm:
        _calm = False
        _done.update((obj.name_full, state.changes()) for _, obj in wanted)
    if _work is None:
        late = [each for each in wanted if _done.get(each[1].name_full) != state.changes()]
        if not late:
            state.held = False
            return None
        _begin(*late[0])
    if _work is not None:
        _go_on()
    _redraw()
    return 0.0


def _held_by_playback(wanted):
    """Whether somebody is moved by physics, which only a scene that does not play can be asked for."""
    return any(physics.simulated(each) for scene, obj in wanted for each in walkers(scene, obj))


def _begin(scene, obj):
    global _work
    try:
        with state.unseen():
            _work = _Work(scene, obj, previews=True)
        bake_job.again(_work.job)
        timeline.show()
        state.baking[obj.name_full] = ""
    except FAILED as problem:
        _fail(obj.name_full, problem)


def _go_on():
    """Work for a while."""
    global _work
    work, until = _work, time.perf_counter() + SLICE
    try:
        with state.unseen():
            while time.perf_counter() < until:
                try:
                    next(work.steps)
                except StopIteration:
                    _work = None
                    _show(work)
                    break
        if _work is not None:
            state.baking[work.name] = work.progress()
    except FAILED as problem:
        drop()
        _fail(work.name, problem)


def _show(work):
    """Play what was baked, and remember that it is as wanted."""
    bake_job.again(None)
    state.baking.pop(work.name, None)
    work.clear()
    if not work.job.fresh:
        with undo_step.where_needed("Auto Update"):
            report = work.job.finish()
        for each in work.job.warnings:
            messages.add("WARNING", each)
        messages.add("INFO", report)
    obj = bpy.data.objects.get(work.job.name)
    if obj is not None:
        _done[obj.name_full] = work.changes
        state.note(obj, state.Status(state.FRESH))


def _fail(name, problem):
    """Remember that a ground cannot be baked as it is, and why."""
    _done[name] = state.changes()
    state.baking.pop(name, None)
    obj = bpy.data.objects.get(name)
    if obj is not None:
        messages.add("ERROR", ops.sentence(problem))
        state.refused[name] = state.changes(), ops.sentence(problem)
        state.ask(obj)


def _redraw():
    """Show how far it is, now and then: drawing takes time, too."""
    global _drawn
    now = time.monotonic()
    if _work is not None and now < _drawn + DRAWN:
        return
    _drawn = now
    timeline.redraw()


# ---- handlers -----------------------------------------------------------------------------------------------


@persistent
def _before(*_):
    """Something goes through all data: nothing of ours is on its way then."""
    drop()


@persistent
def _after(*_):
    _wake()


HANDLERS = (
    ("undo_pre", _before),
    ("redo_pre", _before),
    ("save_pre", _before),
    ("load_pre", _before),
    ("undo_post", _after),
    ("redo_post", _after),
    ("save_post", _after),
)


def begun():
    """Whether changes are listened to."""
    return _before in bpy.app.handlers.load_pre


def begin():
    """Listen to changes, if a window is there for them."""
    if bpy.app.background:
        return
    if not begun():
        for name, handler in HANDLERS:
            getattr(bpy.app.handlers, name).append(handler)
        ops.before.append(drop)
        atexit.register(drop)
        state.listen(_wake)
    _wake()


def loaded():
    """Another file was read, whose grounds stay as they are until something is changed."""
    _done.clear()
    if any(wants(obj) for scene in bpy.data.scenes for obj in scene.objects):
        begin()
        if begun():
            pause()
    else:
        end()


def end():
    """Listen no more."""
    drop()
    _done.clear()
    state.held = False
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)
    if begun():
        state.listen(None)
        ops.before.remove(drop)
        atexit.unregister(drop)
        for name, handler in HANDLERS:
            getattr(bpy.app.handlers, name).remove(handler)
