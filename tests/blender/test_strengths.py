"""How strongly a bake is shown follows keys and drivers, in renders as in the viewport, and outlives another bake."""

import subprocess
import sys

import bpy
import numpy as np
from test_live import FRAMES, scene

from desire_path.blender import compat, live, moves, playback, playback_tree, strengths


def modifier():
    return playback.modifier(bpy.data.objects["Ground"])


def set_to(name, value):
    strengths.give(modifier(), {name: value})


def heights(frame=FRAMES):
    bpy.context.scene.frame_set(frame)
    bpy.context.view_layer.update()
    found = bpy.data.objects["Ground"].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return compat.positions(found)[:, 2].astype(np.float64)


def parts():
    """(depth of prints, height of rims) as they are shown, at each point."""
    found = bpy.data.objects["Ground"].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    colour = compat.colour_attribute(found, playback_tree.ATTRIBUTE).astype(np.float64)
    return colour[:, 2], np.maximum(colour[:, 0] + colour[:, 2], 0.0)


def test_prints_and_rims_each_have_their_strength(folder):
    scene(folder)
    whole = heights()
    pressed, heaped = parts()
    assert heaped.max() > 1e-4 < pressed.max()
    np.testing.assert_allclose(whole, heaped - pressed, atol=2e-7)
    for prints, rims in ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (2.0, 0.5)):
        strengths.give(modifier(), {"Prints": prints, "Rims": rims})
        np.testing.assert_allclose(heights(), rims * heaped - prints * pressed, atol=5e-7)
    strengths.give(modifier(), {"Prints": 1.0, "Rims": 1.0})
    np.testing.assert_array_equal(heights(), whole)


def test_keys_and_drivers_lead_them(folder):
    ground, _ = scene(folder)
    whole = heights()
    path = strengths.path(modifier(), "Prints")
    set_to("Rims", 0.0)
    pressed = heights()
    for frame, value in ((FRAMES, 0.0), (FRAMES + 10, 1.0)):
        set_to("Prints", value)
        assert ground.keyframe_insert(path, frame=frame)
    for curve in compat.curves(ground.animation_data, ground):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    for frame, share in ((FRAMES, 0.0), (FRAMES + 5, 0.5), (FRAMES + 10, 1.0)):
        np.testing.assert_allclose(heights(frame), share * pressed, atol=5e-7)
    assert not moves.moves(ground) and ground.desire_path.bake_state == "FRESH"
    driver = ground.driver_add(strengths.path(modifier(), "Rims")).driver
    driver.type = "SCRIPTED"
    driver.expression = "frame / 10"
    assert not moves.moves(ground) and ground.desire_path.bake_state == "FRESH"
    _, heaped = parts()
    np.testing.assert_allclose(heights(FRAMES), 0.1 * FRAMES * heaped, atol=1e-6)
    # another bake leaves them as they are, whether the tree is exchanged or not
    for change in (0.025, 0.018):
        ground.desire_path.cell_size = change
        assert live.update(bpy.context.scene) == []
        assert playback_tree.copy_of(modifier().node_group) is not None
        assert abs(strengths.values(modifier())["Rims"] - 0.1 * bpy.context.scene.frame_current) < 1e-6
    playback.modifier(ground).node_group.nodes.new("GeometryNodeInputIndex")  # no longer of the same form
    ground.desire_path.soil = "mud"
    assert live.update(bpy.context.scene) == []
    now = strengths.values(modifier())
    assert now["Rims"] != 1.0 and strengths.path(modifier(), "Prints") == path
    assert len(whole) > 1000


def test_what_was_pressed_takes_another_material(folder):
    ground, _ = scene(folder)
    for name in ("Dry", "Wet"):
        ground.data.materials.append(bpy.data.materials.new(name))
    bpy.context.view_layer.update()

    def used():
        heights()
        found = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        out = np.empty(len(found.polygons), np.int32)
        found.polygons.foreach_get("material_index", out)
        centres = np.empty((len(found.polygons), 3), np.float32)
        found.polygons.foreach_get("center", centres.ravel())
        return out, centres[:, 2]

    assert not used()[0].any()
    set_to("Material Index", 1)
    index, height = used()
    assert 0.01 < index.mean() < 0.9 and set(index) == {0, 1}
    assert index[height < -0.002].all() and not index[np.abs(height) < 1e-7].any()


def test_a_render_without_the_add_on_shows_them(folder):
    ground, _ = scene(folder / "bake")
    set_to("Prints", 0.0)
    ground.keyframe_insert(strengths.path(modifier(), "Prints"), frame=FRAMES)
    set_to("Prints", 3.0)
    ground.keyframe_insert(strengths.path(modifier(), "Prints"), frame=FRAMES + 1)
    wanted = [float(heights(frame).min()) for frame in (FRAMES, FRAMES + 1)]
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    ask = (
        "import bpy, numpy as np\n"
        f"bpy.ops.wm.open_mainfile(filepath={str(folder / 'a.blend')!r})\n"
        "assert not hasattr(bpy.types.Object, 'desire_path')\n"
        f"for frame in ({FRAMES}, {FRAMES + 1}):\n"
        "    bpy.context.scene.frame_set(frame)\n"
        "    mesh = bpy.data.objects['Ground'].evaluated_get(bpy.context.evaluated_depsgraph_get()).data\n"
        "    print('LOWEST', min(each.co.z for each in mesh.vertices))\n"
    )
    script = folder / "ask.py"
    script.write_text(ask, encoding="utf-8")
    if bpy.app.binary_path:
        command = [bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "1", "-P", str(script)]
    else:
        command = [sys.executable, str(script)]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    found = [float(line.split()[1]) for line in text.splitlines() if line.startswith("LOWEST")]
    np.testing.assert_allclose(found, wanted, atol=1e-6)
    assert found[0] > -1e-5 > -0.01 > found[1]
