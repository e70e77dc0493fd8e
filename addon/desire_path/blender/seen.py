"""seen.py - what is only seen of a ground: what its copy is like below a cell, how walls differ, where water stands.

soils of the ground, shares of those that are painted --> attributes of the copy, which our tree reads (MODEL 8.3)
"""

import numpy as np

from ..ground import mesh as meshes
from ..ground.detail import SHOWN, details
from . import axes, compat, cover, materials, playback_tree, soils

STRAYS = slice(SHOWN.index("stray_x"), SHOWN.index("stray_y") + 1)
ROUND = 0.4 * playback_tree.LUMP  # how far around normals of walls are meant [m]
STEEP = 2.0  # slope of walls that are cut finer than the rest


def fine(settings, planes, cell):
    """Where something finer than a cell is to be seen, and how long edges are there [m]: half as long on walls."""
    size = axes.typed(settings.detail_size)
    sizes = np.full(planes["compression"].shape, size)
    if any(materials.wall_of(each) for each in (settings, *settings.painted)):
        high = np.pad(planes["heap"] - planes["compression"], 1, mode="edge")
        rise = np.maximum(np.abs(high[1:-1, 2:] - high[1:-1, :-2]), np.abs(high[2:, 1:-1] - high[:-2, 1:-1]))
        sizes[rise > 2.0 * STEEP * cell] = 0.5 * size
    return np.maximum(planes["compression"], planes["heap"]) > playback_tree.DISTURBED[0], sizes


def _shares(obj, cut, count):
    """How much of each soil lies at the points of a copy, the ground's own and those that are painted; sum 1."""
    painted = [cut.weights.get(each.vertex_group) for each in obj.desire_path.painted]
    painted = [np.zeros(count, np.float32) if each is None else cut.refined.on_points(each) for each in painted]
    shares = [np.maximum(1.0 - sum(painted, np.zeros(count, np.float32)), 0.0), *painted]
    total = np.maximum(sum(shares), 1e-6)
    return [each / total for each in shares]


def water(carrier, obj, cut):
    """Write where water stands: that of the soil there is most of. It is there for dry ground, too: a soil that
    changes changes no nodes."""
    its = (obj.desire_path, *obj.desire_path.painted)
    depths = np.array([soils.soil_of(each).water_depth for each in its])
    count = len(carrier.data.vertices)
    most = np.argmax(_shares(obj, cut, count), axis=0) if depths.any() else np.zeros(count, int)
    level = np.where(depths > 0.0, -depths, playback_tree.DRY)[most].astype(np.float32)
    carrier.data.attributes.new(playback_tree.LEVEL, "FLOAT", "POINT").data.foreach_set("value", level)


def write(carrier, surface, obj, cut, index, planes):
    """Write what a copy is like below a cell, by its soils. index, planes: as in refined.make"""
    its, mesh = (obj.desire_path, *obj.desire_path.painted), carrier.data
    at = axes.points(surface.world, compat.positions(mesh), surface.scale)
    shares, walls = _shares(obj, cut, len(at)), [materials.wall_of(each) for each in its]
    clean = _lumpy(carrier, surface, index, planes)  # an edge that strayed all the way down would be a row of flutes
    shown = np.zeros((len(at), len(SHOWN)), np.float32)
    for share, each, wall in zip(shares, its, walls):
        if share.any():
            found = details(at, materials.detail_of(each))
            found[:, STRAYS] *= 1.0 - clean[:, None] * (wall > 0.0)
            shown += share[:, None] * found
    for name, values in ((playback_tree.DETAIL, shown[:, :3]), (playback_tree.STRAY, shown[:, 3:])):
        values = np.ascontiguousarray(values, np.float32)
        mesh.attributes.new(name, "FLOAT_VECTOR", "POINT").data.foreach_set("vector", values.ravel())
    rough = sum(share * wall for share, wall in zip(shares, walls))
    mesh.attributes.new(playback_tree.WALL, "FLOAT", "POINT").data.foreach_set("value", rough.astype(np.float32))
    if rough.any():
        across = mesh.attributes.new(playback_tree.ACROSS, "FLOAT_VECTOR", "POINT")
        across.data.foreach_set("vector", _across(carrier, surface, index, planes).ravel())


def _across(carrier, surface, index, planes):
    """Normals of the prints at the points of a copy in the end, in the space of the object, as planes would have them
    that lean on the ground all around: those of two points side by side differ little."""
    rise, place = {"rise": planes["heap"] - planes["compression"]}, surface.world[:3] * surface.scale
    at = compat.positions(carrier.data)
    slopes = np.zeros((len(at), 3))
    for axis, (aside, ahead) in enumerate(((ROUND, 0.0), (0.0, ROUND))):
        for side in (-1.0, 1.0):
            corner = index.x0 - side * aside, index.y0 - side * ahead
            slopes[:, axis] -= side * meshes.at_points(rise, index.cell, corner, at, place)["rise"] / (2.0 * ROUND)
    slopes[:, 2] = 1.0
    normals = slopes @ surface.world[:3, :3]
    return (normals / np.linalg.norm(normals, axis=1)[:, None]).astype(np.float32)


def _lumpy(carrier, surface, index, planes):
    """How much of the roughness of walls shows at the points of a copy in the end, 0..1."""
    pressed = cover.values(carrier, surface, index, {"compression": planes["compression"]}, ())["compression"]
    low, high = playback_tree.CUT
    share = np.clip((pressed - low) / (high - low), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)
