"""All grounds of a scene are baked in one go; files are found, and messages can be copied."""

import bpy
from scenes import meshes, people
from test_bake import refused

from desire_path.blender import bake_all, bake_job, live, messages

FRAMES = 16


def land(name, x, folder, y0=-1.7, rows=110):
    """A ground with somebody who walks over it, or over its edge."""
    ground = meshes.grid(60, rows, 0.02, x - 0.6, y0)
    ground.name = name
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.folder, ground.desire_path.cell_size = str(folder / name), 0.02
    walker = people.walk(people.biped(f"{name} Walker"), frames=FRAMES)
    walker.location.x, walker.desire_path.ground = x, ground
    meshes.activate(walker)
    bpy.ops.object.desire_path_walker_add()
    bpy.context.view_layer.update()
    return ground, walker


def test_all_grounds_are_baked(folder):
    there = [land(name, x, folder)[0] for name, x in (("Beach", 0.0), ("Field", 5.0), ("Road", 10.0))]
    empty = meshes.grid(3, 3, 1.0, 20.0, 0.0)
    empty.desire_path.is_ground = True
    assert bpy.ops.wm.desire_path_bake_all() == {"FINISHED"}
    for each in there:
        assert each.desire_path.bake_state == "FRESH" and (folder / each.name / "report.json").exists()
    assert empty.desire_path.bake_state == "NONE"


def test_the_progress_is_one(folder):
    for name, x in (("Beach", 0.0), ("Field", 5.0)):
        land(name, x, folder)
    jobs = bake_all.AllJobs(bpy.context.scene)
    seen = []
    for _ in jobs.run():
        seen.append(jobs.fraction)
        assert jobs.text
    assert seen == sorted(seen) and seen[0] == 0.0 and seen[-1] == 1.0
    assert any(0.0 < each < 0.5 for each in seen) and any(0.5 < each < 1.0 for each in seen), (seen, jobs.names)
    assert jobs.finish().startswith("2 bakes. ")


def test_what_a_walk_crosses_is_baked_once(folder):
    beach, _ = land("Beach", 0.0, folder, -0.4, 45)
    field, walker = land("Field", 0.0, folder, -1.7, 65)
    walker.delta_location.y = -0.5
    bpy.context.view_layer.update()
    jobs = bake_all.AllJobs(bpy.context.scene)
    for _ in jobs.run():
        pass
    assert jobs.names == ["Beach", "Field"] and jobs.done == jobs.names, (
        jobs.names,
        jobs.done,
        jobs.problems,
        jobs.reports,
    )
    assert len(jobs.reports) == 1, jobs.reports
    assert "on 'Beach' and 'Field'" in jobs.finish()
    assert {each.desire_path.bake_state for each in (beach, field)} == {"FRESH"}


def test_one_that_cannot_be_baked_does_not_hold_the_others_up(folder):
    beach, _ = land("Beach", 0.0, folder)
    field, walker = land("Field", 5.0, folder)
    walker.location.x = 500.0
    assert bpy.ops.wm.desire_path_bake_all() == {"FINISHED"}
    assert beach.desire_path.bake_state == "FRESH" and field.desire_path.bake_state == "NONE"
    assert "'Field' was not baked: The walk passes beside" in messages.text()
    beach.desire_path.is_ground = False
    assert "'Field' was not baked" in refused(bpy.ops.wm.desire_path_bake_all)


def test_a_stopped_one_leaves_the_whole_ones(folder):
    beach, _ = land("Beach", 0.0, folder)
    field, _ = land("Field", 5.0, folder)
    jobs = bake_all.AllJobs(bpy.context.scene)
    steps = jobs.run()
    while jobs.fraction < 0.8:
        next(steps)
    assert jobs.name == "Field" and jobs.grounds == ["Field"]
    steps.close()
    jobs.play()
    assert beach.desire_path.bake_state == "FRESH" and field.desire_path.bake_state == "PARTIAL"


def test_files_are_shown_and_messages_copied(folder):
    beach, _ = land("Beach", 0.0, folder)
    meshes.activate(beach)
    assert "bake it first" in refused(bpy.ops.object.desire_path_show_files)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert bpy.ops.object.desire_path_show_files() == {"FINISHED"}
    assert bpy.ops.wm.desire_path_messages_copy() == {"FINISHED"}
    found = bpy.data.texts[messages.NAME].as_string()
    assert "'Beach': FRESH." in found and "bake it first" in found and "Baked frames 1 to 16" in found
    assert bpy.ops.wm.desire_path_messages_copy() == {"FINISHED"}
    assert len(bpy.data.texts) == 1


def test_how_long_and_how_large_is_told(folder):
    beach, _ = land("Beach", 0.0, folder)
    job = bake_job.Job(bpy.context.scene, beach)
    for _ in job.run():
        pass
    assert job.text.startswith(f"Frame {FRAMES}, 0 s left, ") and job.text.endswith(" MB")
    assert [bake_job.duration(each) for each in (0.2, 61.0, 3700.0)] == ["0 s", "1 min 1 s", "1 h 1 min"]
    (folder / "some" / "more").mkdir(parents=True)
    (folder / "some" / "a").write_bytes(b"12345")
    (folder / "some" / "more" / "b").write_bytes(b"123")
    assert bake_job.disk_size(str(folder / "some")) == 8
    assert live.update(bpy.context.scene) == []


def test_documentation_is_shown():
    for page in ("README", "CHANGELOG"):
        assert bpy.ops.wm.desire_path_manual(page=page) == {"FINISHED"}
        assert len(bpy.data.texts[f"Desire Path {page}.md"].lines) > 50
