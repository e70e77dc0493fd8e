"""plants.py - the plants of a ground: kinds, roots where they are painted, grass one can see.

Object.desire_path.plants --kind, density, group, image, seed--> roots --> grass (grass.py)
                                                                     \\--> Planting, for the bake
"""

import os
from dataclasses import dataclass

import bpy
import numpy as np

from ..errors import DesirePathError
from ..ground import tuft
from ..ground.plants import KINDS, Kind, Planting
from ..ground.sim import Ground, Simulation
from . import axes, compat, grass, ground, picture, playback, sample, stack

MAX_SHOWN = 1_000_000  # plants of one planting that are shown
FINEST = 0.02  # the density is looked up at places this far apart, or farther on wide ground [m]
MAX_PLACES = 1024  # along one side
SLOPE_OVER = 0.04  # the ground's slope at a root is taken over this [m]


def kind(name):
    """A kind by its name, or from the JSON file a user saved one in."""
    if name in KINDS:
        return KINDS[name]
    if not name:
        raise DesirePathError(f"A kind of plant is missing: choose one of {', '.join(KINDS)}, or a file.")
    path = bpy.path.abspath(name)
    if not name.lower().endswith(".json") and not os.path.exists(path):
        raise DesirePathError(
            f"There is no plant kind '{name}': choose one of {', '.join(KINDS)}, or a file that Kind.save() wrote."
        )
    return Kind.load(path)


def mark(each):
    """What a planting asks for, in a word, to tell whether its roots are still the right ones."""
    image = f" {each.density_image.name_full}" if each.density_image is not None else ""
    return f"{each.kind} {each.density!r} {each.density_group} {each.seed}{image}"


@dataclass(frozen=True, eq=False)
class Spread:
    """A number 0..1 for every place of a rectangle of the world."""

    weight: np.ndarray  # (ny, nx), row 0 at the lowest y
    low: np.ndarray  # corner (x, y) [m]
    size: np.ndarray  # sides [m]

    def at(self, place):
        """Its number at places (n, 2) [m], the nearest one off the rectangle."""
        shape = np.array(self.weight.shape[::-1])
        i, j = np.clip((place - self.low) / self.size * shape, 0, shape - 1).astype(np.int64).T
        return self.weight[j, i]


class Bed:
    """A ground as it lies before any bake, read once to put plants on it."""

    def __init__(self, scene, obj, chosen, frame):
        """chosen: the plantings it is read for"""
        self.scale = axes.unit_scale(scene)
        groups = [name for name in dict.fromkeys(each.density_group for each in chosen) if name]
        self.light = {
            each.density_image: picture.brightness(each.density_image)
            for each in chosen
            if each.density_image is not None
        }
        place = stack.find(scene, obj, frame)
        trees = [stack.realised()] if place.realise else []
        trees += [ground.weights_tree(groups)] if groups else []
        with stack.shaped(scene, obj, place.before, trees) as (own, copy):
            stack.let_led(scene, own, copy, obj, frame)
            found = sample.evaluated(own, copy, frame)
            world = axes.matrix(found.matrix_world, obj.name)
            vertices = axes.points(world, compat.positions(found.data), self.scale)
            triangles = compat.triangles(found.data)
            if self.light and len(triangles):
                self.lay = picture.Lay(obj, found.data, vertices, triangles)
            painted = {}
            for k, name in enumerate(groups):
                value = compat.float_attribute(found.data, ground.WEIGHT.format(k))
                if value is None or name not in obj.vertex_groups and name not in found.data.attributes:
                    raise DesirePathError(
                        f"'{obj.name}' has no vertex group or attribute '{name}' for "
                        "the density of its plants: choose another one."
                    )
                odd = np.flatnonzero(~np.isfinite(value))
                if len(odd):
                    raise DesirePathError(
                        f"'{name}' of '{obj.name}' is no number at point {odd[0]}: give it one from 0 to 1."
                    )
                painted[name] = value
        if not len(triangles):
            raise DesirePathError(f"'{obj.name}' has no faces: give it some for plants to grow on.")

        def heights(z):
            """The height of a mesh of the same plan at places: also tells what is painted there."""
            points = np.concatenate([vertices[:, :2], np.asarray(z, np.float64)[:, None]], axis=1)
            return Simulation(Ground.mesh(points, triangles), cell_size=max(FINEST, 0.01)).rest_height

        self.height = heights(vertices[:, 2])
        self.weight = {name: heights(value) for name, value in painted.items()}
        self.low, self.high = vertices[:, :2].min(axis=0), vertices[:, :2].max(axis=0)

    def spread(self, each):
        """How dense a planting is over the rectangle around the ground: 1 = as asked for, 0 = off the ground."""
        size = self.high - self.low
        step = max(FINEST, float(size.max()) / MAX_PLACES)
        nx, ny = (max(1, int(np.ceil(side / step))) for side in size)
        x = self.low[0] + (np.arange(nx) + 0.5) * size[0] / nx
        y = self.low[1] + (np.arange(ny) + 0.5) * size[1] / ny
        at = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        height, weight = self.height(at), np.ones(len(at))
        if each.density_group:
            weight = np.clip(self.weight[each.density_group](at), 0.0, 1.0)
        if each.density_image is not None:
            weight = weight * picture.sampled(self.light[each.density_image], self.lay(at, height))
        weight = np.where(np.isfinite(height) & np.isfinite(weight), weight, 0.0)
        return Spread(weight.reshape(ny, nx), self.low, size)

    def planting(self, each, its, most=np.inf):
        """The core's Planting of these plants, and how many it means on the whole ground.

        Plants are placed as dense as a power of two times the kind's own density and thinned from
        there, so that another density takes plants away or adds some and leaves the others alone.
        """
        weight = self.spread(each).weight
        size = self.high - self.low
        density = axes.typed(each.density)
        wanted = density * float(weight.mean()) * size[0] * size[1]
        density *= min(1.0, most / max(wanted, 1.0))
        base = its.density * 2.0 ** np.ceil(np.log2(density / its.density) - 1e-9)
        if not each.density_group and each.density_image is None and abs(base - density) < 1e-6 * base:
            return Planting(its, base, each.seed), wanted
        return Planting(its, base, each.seed, weight * (density / base), (*self.low, *self.high)), wanted

    def roots(self, planting):
        """Where its plants stand on the ground, float32 (n, 3) [m]."""
        root = planting.within(*self.low, *self.high)
        height = self.height(root)
        there = np.isfinite(height)
        return np.column_stack([root[there], height[there]]).astype(np.float32)

    def slope(self, root):
        """How the ground rises along x and y at roots, (n, 2)."""
        at = root[:, :2].astype(np.float64)
        out = np.zeros((len(root), 2))
        for axis in (0, 1):
            step = np.zeros(2)
            step[axis] = 0.5 * SLOPE_OVER
            rise = (self.height(at + step) - self.height(at - step)) / SLOPE_OVER
            out[:, axis] = np.where(np.isfinite(rise), np.clip(rise, -3.0, 3.0), 0.0)
        return out


def plant(scene, obj, chosen=None):
    """Put plants on a ground anew: those chosen, or all. Returns sentences about what is odd."""
    settings = obj.desire_path
    chosen = list(settings.plants) if chosen is None else chosen
    if not chosen:
        return []
    kinds = [kind(each.kind) for each in chosen]
    bed = Bed(scene, obj, chosen, settings.frame_start)
    sentences = []
    for each, its in zip(chosen, kinds):
        planting, wanted = bed.planting(each, its, MAX_SHOWN)
        root = bed.roots(planting)
        each.count = len(root)
        each.mark = mark(each)
        if wanted > MAX_SHOWN:
            sentences.append(
                f"'{obj.name}' would carry {wanted / 1e6:.1f} million plants of {each.kind} and shows "
                f"{MAX_SHOWN / 1e6:.0f} million: paint a density group or image where they are seen."
            )
        elif not len(root):
            sentences.append(
                f"No {each.kind} grows on '{obj.name}': check its density, and the group and the image "
                "that thin it out."
            )
        if shown(each) is not None:
            look = tuft.look_of(each.kind, its)
            grass.fill(each.grass, obj, root, bed.slope(root), look.sizes, look.tufts, bed.scale)
            if grass.stale(each.grass, each.kind, its):
                grass.show(each.grass, each.kind, its)
    return sentences


def stale(obj):
    """Plantings whose roots are not what is asked for any more."""
    return [each for each in obj.desire_path.plants if each.mark != mark(each)]


def show(obj, index=None, anew=True):
    """Let the grass of a ground follow what its playback modifier plays, or stand. anew: see grass.show"""
    ours = playback.modifier(obj)
    images = playback.images(ours.node_group) if ours is not None and index is not None else None
    for each in obj.desire_path.plants:
        if shown(each) is not None:
            try:
                its = kind(each.kind)
            except DesirePathError:
                if index is not None:
                    raise
                its = None  # its file is gone: what was baked is let go all the same
            grass.show(each.grass, each.kind, its, index, images, index.frames if index is not None else 0, anew)


def standing(obj):
    """(density group, strength where it is 1) of each planting: cover before anybody walks. A Spread in place of
    the group tells of all that are thinned by images."""
    full = {each: min(1.0, each.density / kind(each.kind).full_density) for each in obj.desire_path.plants}
    plain = tuple((each.density_group, full[each]) for each in full if each.density_image is None)
    drawn = [each for each in full if each.density_image is not None]
    if not drawn:
        return plain
    scene = bpy.context.scene if obj.name in bpy.context.scene.objects else obj.users_scene[0]
    bed = Bed(scene, obj, drawn, obj.desire_path.frame_start)
    spreads = [bed.spread(each) for each in drawn]
    cover = sum(full[each] * spread.weight for each, spread in zip(drawn, spreads))
    return (*plain, (Spread(np.minimum(cover, 1.0), bed.low, spreads[0].size), 1.0))


def plantings(scene, obj):
    """What grows on a ground, for the core: the very plants that are shown."""
    chosen = list(obj.desire_path.plants)
    if not chosen:
        return []
    bed = Bed(scene, obj, chosen, obj.desire_path.frame_start)
    return [bed.planting(each, kind(each.kind))[0] for each in chosen]


def shown(each):
    """The object that shows a planting, or None: one the user deleted is only held by us."""
    found = grass.of(each.grass, each.id_data)
    return found if found is not None and found.users_collection else None


def forget(each):
    """Take away what was made for a planting."""
    grass.remove(grass.of(each.grass, each.id_data))
