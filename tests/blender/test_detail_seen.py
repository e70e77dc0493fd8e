"""What is finer than a cell is shown where feet went, by soil, on a fine copy: crumbs, veins, rough walls, water."""

import bpy
import numpy as np
from scenes import meshes
from test_refined import baked, copy_of, plane, seen, shortest

from desire_path.blender import compat, materials, playback_tree


def test_details_are_shown_where_feet_went_and_nowhere_else(folder):
    ground = baked(folder, plane(), cell=0.01, refine_size=0.005)
    ground.desire_path.refine_size, ground.desire_path.detail_size = 0.0, 0.005
    fine, copy = seen(ground), copy_of(ground).data
    assert len(ground.data.polygons) == 1 and len(copy.vertices) == len(fine.vertices)
    bare, shown = compat.positions(copy).astype(float), compat.positions(fine).astype(float)
    assert np.array_equal(bare[:, :2], shown[:, :2])
    baked_there = compat.colour_attribute(fine, playback_tree.ATTRIBUTE)
    detail = shown[:, 2] - bare[:, 2] - baked_there[:, 0]
    disturbed = np.maximum(baked_there[:, 2], baked_there[:, 0] + baked_there[:, 2]) > playback_tree.DISTURBED[1]
    untouched = ~baked_there.any(axis=1)
    assert not detail[untouched].any() and not shown[untouched, 2].any() and disturbed.sum() > 1000
    assert abs(detail[disturbed].mean()) < 1e-4 < 2e-4 < detail[disturbed].std()
    heights = compat.positions(fine)[:, 2].copy()
    # what lies as it lay is shown as it was
    bpy.context.scene.frame_set(20)
    before = seen(ground)
    same = (compat.colour_attribute(before, playback_tree.ATTRIBUTE) == baked_there).all(axis=1)
    assert np.array_equal(compat.positions(before)[same, 2], heights[same]) and (same & disturbed).sum() > 0
    bpy.context.scene.frame_set(0)
    assert np.array_equal(compat.positions(seen(ground)), compat.positions(copy))
    # and without them all is as if they had never been
    ground.desire_path.detail_size = 0.0
    assert playback_tree.DETAIL not in copy_of(ground).data.attributes


def test_details_are_those_of_the_soils(folder):
    ground = plane()
    group = ground.vertex_groups.new(name="drift")
    group.add([each.index for each in ground.data.vertices], 1.0, "REPLACE")
    each = ground.desire_path.painted.add()
    each.vertex_group, each.soil = "drift", "mud"
    baked(folder, ground, detail_size=0.01)
    mud = compat.vectors(copy_of(ground).data, playback_tree.DETAIL)
    assert np.ptp(mud[:, 0]) > 0.0015 and not mud[:, 1].any()  # veins, no crumbs
    each.soil = "soil"
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    earth = compat.vectors(copy_of(ground).data, playback_tree.DETAIL)
    assert not earth[:, 0].any() and np.ptp(earth[:, 1]) > 0.003
    each.soil_numbers.clods = 0.06  # where usual crumbs are 14 mm wide
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    clods = compat.vectors(copy_of(ground).data, playback_tree.DETAIL)
    assert np.ptp(clods[:, 1]) > 3.0 * np.ptp(earth[:, 1])


def test_walls_of_deep_prints_are_rough_and_cut_finer(folder):
    ground = baked(folder, plane(), cell=0.01, soil="deep-snow", detail_size=0.008)
    fine, copy = seen(ground), copy_of(ground).data
    bare, shown = compat.positions(copy).astype(float), compat.positions(fine).astype(float)
    depth = compat.colour_attribute(fine, playback_tree.ATTRIBUTE)[:, 2]
    aside = np.linalg.norm((shown - bare)[:, :2], axis=1)
    low, high = playback_tree.CUT
    rough = compat.float_attribute(copy, playback_tree.WALL)[0]
    assert not aside[depth < low].any() and (depth > high).sum() > 1000
    assert 0.5 * rough < aside[depth > high].mean() < 3.0 * rough
    up = np.zeros(3 * len(depth), np.float32)
    fine.vertices.foreach_get("normal", up)
    level = (depth > high) & (up[2::3] > 0.97)  # nothing is moved along the surface, where it would fold
    assert level.sum() > 100 and aside[level].mean() < 0.4 * rough
    finer = shortest(copy)
    bpy.context.scene.frame_set(0)
    assert np.array_equal(compat.positions(seen(ground)), compat.positions(copy))
    # and no wall of sand is
    ground.desire_path.soil = "dry-sand"
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    sand = copy_of(ground).data
    assert not compat.float_attribute(sand, playback_tree.WALL).any() and finer < 0.6 * shortest(sand)


def test_walls_of_deep_prints_do_not_fold(folder):
    ground = baked(folder, plane(), cell=0.005, soil="crust-snow", detail_size=0.002)
    fine = seen(ground)
    faces = len(fine.polygons)
    up, area = np.zeros(3 * faces, np.float32), np.zeros(faces, np.float32)
    fine.polygons.foreach_get("normal", up)
    fine.polygons.foreach_get("area", area)
    up, rough = up[2::3], compat.colour_attribute(fine, playback_tree.ATTRIBUTE)[:, 2] > playback_tree.CUT[1]
    assert rough.sum() > 10000 and area[up < -0.1].sum() > 1e-4  # lumps overhang
    assert area[up < -0.6].sum() < 2e-3 * area[up < 0.5].sum()  # and nothing is turned inside out


def test_edges_of_deep_prints_stray_at_their_rim_alone(folder):
    ground = baked(folder, plane(), cell=0.01, soil="deep-snow", detail_size=0.008)
    away, pressed = strays(ground)
    lumpy, fray = playback_tree.CUT[1], materials.detail_of(ground.desire_path).fray
    assert (pressed > 8.0 * lumpy).sum() > 1000 and not away[pressed > 8.0 * lumpy].any()  # or walls would be fluted
    assert 0.7 * fray < away[pressed == 0.0].std() < 1.3 * fray
    ground.desire_path.soil = "dry-sand"  # no wall of it is rough: its edges stray all the way down
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    away, pressed = strays(ground)
    assert away[pressed > 0.5 * lumpy].std() > 0.7 * materials.detail_of(ground.desire_path).fray


def strays(ground):
    """How far edges are seen aside, along x [m], and how deep the ground is pressed there [m]."""
    away = compat.vectors(copy_of(ground).data, playback_tree.STRAY)[:, 0]
    return away, compat.colour_attribute(seen(ground), playback_tree.ATTRIBUTE)[:, 2]


def test_water_fills_prints_up_to_its_level(folder):
    ground = plane()
    group = ground.vertex_groups.new(name="wet")
    group.add([0, 1, 2, 3], 1.0, "REPLACE")
    each = ground.desire_path.painted.add()
    each.vertex_group, each.soil = "wet", "mud"
    each.soil_numbers.water_depth = 0.012
    baked(folder, ground, cell=0.01, soil="deep-snow")  # all of it is painted over
    fine, level = seen(ground), -0.012
    shown, depth = compat.positions(fine)[:, 2], compat.colour_attribute(fine, playback_tree.ATTRIBUTE)[:, 0]
    water = compat.float_attribute(fine, playback_tree.WATER)
    assert depth.min() < 1.5 * level and np.isclose(shown.min(), level, atol=1e-6)
    assert np.allclose(water, np.maximum(level - depth, 0.0), atol=1e-6) and (water > 0.0).sum() > 100
    assert np.array_equal(shown[water == 0.0], depth[water == 0.0])
    bpy.context.scene.frame_set(0)
    assert not compat.float_attribute(seen(ground), playback_tree.WATER).any()
    ground.desire_path.painted[0].soil_numbers.water = 0.0
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    bpy.context.scene.frame_set(30)
    assert not compat.float_attribute(seen(ground), playback_tree.WATER).any()
    assert compat.positions(seen(ground))[:, 2].min() < 1.5 * level
