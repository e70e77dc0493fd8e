"""bench_panels.py - how long every panel of ours takes to draw, and the add-on to be enabled, in a window.

    xvfb-run -a -s "-screen 0 1920x1080x24" blender --factory-startup -noaudio --enable-event-simulate \\
        -p 0 0 1920 1080 --python-exit-code 1 -P tests/bench/bench_panels.py -- [TIMES]

Prints one line a panel: how often it was drawn, the median and the longest [ms]. A ground with three soils and two
kinds of plants, its bake shown, and its walker are drawn TIMES times each (100), all panels open.
"""

import statistics
import sys
import time
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]

BEGIN = time.perf_counter()
import desire_path  # noqa: E402

desire_path.register()
ENABLED = 1e3 * (time.perf_counter() - BEGIN)

from scenes import first_minute, panels  # noqa: E402
from scenes.hands import Hands, tell  # noqa: E402

TIMES = int(sys.argv[sys.argv.index("--") + 1]) if "--" in sys.argv[:-1] else 100
took = {}  # class of a panel -> [ms]


def timed(kind):
    """Measure a panel's draw from now on."""
    draw, found = kind.draw, took.setdefault(kind.__name__, [])

    def measured(self, context):
        begin = time.perf_counter()
        draw(self, context)
        found.append(1e3 * (time.perf_counter() - begin))

    kind.draw = measured


def story(hands):
    first_minute.setting(hands, plane=True)
    plane, rig = bpy.data.objects["Plane"], bpy.data.objects["Rig"]
    bpy.context.scene.frame_end = 40
    yield 0.5
    yield from first_minute.sidebar(hands)
    panels.chosen(hands, plane)
    with hands.within("VIEW_3D"):
        rig.select_set(True)
        bpy.ops.object.desire_path_walk_it("INVOKE_DEFAULT")
    yield from first_minute.pressed(hands)
    with hands.within("VIEW_3D"):
        bpy.ops.screen.animation_cancel(restore_frame=False)
        panels.chosen(hands, plane)
        for kind in ("carex", "fern"):
            bpy.ops.object.desire_path_plants_add(kind=kind, density=1.0, grass=False)
        for name in ("Wet", "Dry"):
            bpy.ops.object.desire_path_paint_add()
            plane.desire_path.painted[-1].vertex_group = plane.vertex_groups.new(name=name).name
    for each in took.values():
        each.clear()
    for obj in (plane, rig):
        panels.chosen(hands, obj)
        for _ in range(TIMES):
            for area in hands.window.screen.areas:
                if area.type in {"VIEW_3D", "PROPERTIES"}:
                    area.tag_redraw()
            yield 0.02
    print(f"enabled in {ENABLED:.1f} ms")
    for name, found in took.items():
        if found:
            print(f"{name:40} {len(found):5} times, median {statistics.median(found):.3f} ms, most {max(found):.3f} ms")


def main():
    bpy.context.preferences.view.show_splash = False
    desire_path.unregister()
    panels.opened(["all"])
    from desire_path.blender import _CLASSES

    for each in _CLASSES:
        if issubclass(each, bpy.types.Panel):
            timed(each)
    desire_path.register()
    tell(story(Hands(ROOT)))


if __name__ == "__main__":
    main()
