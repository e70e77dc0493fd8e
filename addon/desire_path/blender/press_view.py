"""press_view.py - ground shows what is pressed into it, as it is pressed.

    LivePress.picture --pixels--> an image in memory --the tree that plays bakes--> the ground, or a copy that is fine
                                                                                    around the hand
All of it is gone when remove() has been called: the ground's mesh is never touched, and what it played plays on.
"""

from types import SimpleNamespace

import bpy
import numpy as np

from ..ground import refine
from ..ground.pressing import AROUND
from ..ground.sim import TILE
from . import axes, compat, cover, playback, playback_tree, refined, show

MAX_CELLS = 1 << 20  # cells of the image; larger ground is shown around what was pressed
MARGIN = 4  # tiles around that
NEAR = 0.12  # the copy has to be fine so far around a body [m]
WIDER = 0.1  # it is made so that much farther [m] ..
FAN = 0.35  # .. and where a body goes to, wider by this share of the path
AHEAD = (16_000, 30_000)  # cells that are made fine there at once: at first, and when many were before
SHARE = 0.5  # of those that are fine: so many are made fine at once between the two
MOST_FINE = 60_000  # cells that stay fine though nobody pressed them
SOON = (4, 0.25)  # the copy is cut before a body can come to where it is coarse in so many moves, and no sooner [m]
TURNS = 0.5  # share by which one move changes where a body is taken to go to
HIDES, SHOWS = 2, 1  # whether something plays behind what is shown for a while
EDGE = 3  # cells around what is to be seen that are looked at, too
SHADES = 1e-7  # where less was pressed or heaped nothing is to be seen [m]


class View:
    """Ground that shows a LivePress. warnings: sentences about what cannot be shown."""

    def __init__(self, scene, obj, surface, press):
        self.scene, self.name, self.surface, self.press = scene, obj.name, surface, press
        self.warnings, self.copy, self.fine, self.tiles, self.pixels = [], None, None, None, None
        self.at, self.going = None, np.zeros(2)  # where bodies were shown last, and how they go on from there [m]
        self.modifier_name, self.mesh, self.cutting = "", None, None
        why = refined.held(scene, obj, surface.place)
        self.refines = obj.desire_path.refine and not why
        if obj.desire_path.refine and why:
            self.warnings.append(f"'{obj.name}' shows prints on its own points alone, since {why}.")

    def object(self):
        return bpy.data.objects.get(self.name)

    # ---- what is shown ---------------------------------------------------------------------------

    def show(self, boxes=()):
        """Show the ground as it is now. boxes: rectangles of the world (x0, y0, x1, y1) in which bodies are about to
        press [m]"""
        press = self.press
        if press.window is None and not boxes:
            return
        tiles = self._tiles(boxes)
        if tiles != self.tiles:
            self._open(tiles)
        self._follow(boxes)
        if self.refines:
            self._refine(boxes)
        self._look(boxes)
        self.image.pixels.foreach_set(self.pixels.ravel())
        self.image.update()
        obj = self.object()
        self.tree.update_tag()
        obj.update_tag(refresh={"DATA"})

    def _look(self, boxes):
        """What the image shows, as far as bodies that press in `boxes` have changed it; else all."""
        i0, j0, nx, ny = (TILE * each for each in self.tiles)
        if self.pixels is None or not boxes:
            self.pixels = self.press.picture(i0, j0, nx, ny)
            return
        for x0, y0, x1, y1 in boxes:
            a0, a1, b0, b1 = self.press.sim.cells((x0 - AROUND, y0 - AROUND, x1 + AROUND, y1 + AROUND))
            a0, a1, b0, b1 = max(a0, i0), min(a1, i0 + nx), max(b0, j0), min(b1, j0 + ny)
            if a0 < a1 and b0 < b1:
                self.pixels[b0 - j0 : b1 - j0, a0 - i0 : a1 - i0] = self.press.picture(a0, b0, a1 - a0, b1 - b0)

    def _tiles(self, boxes):
        """Tiles (x, y, nx, ny) that are shown: all of the ground, or what was pressed of a large one."""
        press = self.press
        if self.tiles is not None and self._holds(self.tiles, boxes):
            return self.tiles
        bounds = press.sim.bounds()
        if np.isfinite(bounds).all():
            tiles = _around(press.sim.cells(bounds), 0)
            if tiles[2] * tiles[3] * TILE * TILE <= MAX_CELLS:
                return tiles
        there = [press.sim.cells(each) for each in boxes] + ([press.window] if press.window is not None else [])
        low, high = np.array(there)[:, 0::2].min(axis=0), np.array(there)[:, 1::2].max(axis=0)
        return _around((low[0], high[0], low[1], high[1]), MARGIN)

    def _holds(self, tiles, boxes):
        x, y, nx, ny = tiles
        inside = [self.press.sim.cells(each) for each in boxes]
        if self.press.window is not None:
            inside.append(self.press.window)
        bounds = self.press.sim.bounds()
        if np.isfinite(bounds).all():
            a0, a1, b0, b1 = self.press.sim.cells(bounds)
            inside = [(max(i0, a0), min(i1, a1), max(j0, b0), min(j1, b1)) for i0, i1, j0, j1 in inside]
        return all(
            i0 >= i1
            or j0 >= j1
            or TILE * x <= i0
            and i1 <= TILE * (x + nx)
            and TILE * y <= j0
            and j1 <= TILE * (y + ny)
            for i0, i1, j0, j1 in inside
        )

    def _index(self):
        """Where the image lies, as a bake's index says it."""
        x, y, nx, ny = self.tiles
        (ox, oy), side = self.press.options.origin, TILE * self.press.cell_size
        return SimpleNamespace(
            cell=self.press.cell_size,
            x0=ox + x * side,
            y0=oy + y * side,
            nx=nx * TILE,
            ny=ny * TILE,
            frame_start=1,
            frames=1,
        )

    def _open(self, tiles):
        """An image over other tiles, and the tree that shows it."""
        self.tiles, self.pixels, self.fine, self.cutting = tiles, None, None, None
        index = self._index()
        image = bpy.data.images.new("desire_path press", index.nx, index.ny, alpha=True, float_buffer=True)
        image.colorspace_settings.name = "Non-Color"
        image.alpha_mode = "CHANNEL_PACKED"
        image[playback_tree.TAG] = "trail"
        self.image = image
        self._tree()

    def _tree(self):
        """Show the image by a new tree, in place of the one before."""
        obj, surface = self.object(), self.surface
        tree = playback_tree.create(obj, {"trail": self.image}, show.as_read(surface, self._index(), self.copy))
        modifier = obj.modifiers.get(self.modifier_name) if self.modifier_name else None
        if modifier is None:
            self.modifier_name = put(obj, tree, surface.place).name
        else:
            old, modifier.node_group = modifier.node_group, tree
            tree[playback.BY_HAND] = old[playback.BY_HAND]
            playback.discard(old)
        self.tree = tree

    # ---- a copy that is fine around the hand -------------------------------------------------------

    def _follow(self, boxes):
        """Note where bodies go."""
        if not boxes:
            self.at = None
            return
        at = np.array(boxes).reshape(-1, 2, 2).mean(axis=(0, 1))
        moved = np.zeros(2) if self.at is None else at - self.at
        self.going = moved if self.at is None else TURNS * moved + (1.0 - TURNS) * self.going
        self.at = at

    def _cells(self, box, wider):
        """What of the image lies within a rectangle and so far around it, as its part [rows, columns]."""
        x0, y0, x1, y1 = box
        i0, j0, nx, ny = (TILE * each for each in self.tiles)
        a0, a1, b0, b1 = self.press.sim.cells((x0 - wider, y0 - wider, x1 + wider, y1 + wider))
        return np.s_[max(b0 - j0, 0) : max(min(b1 - j0, ny), 0), max(a0 - i0, 0) : max(min(a1 - i0, nx), 0)]

    def _is_fine(self, boxes, soon=False):
        """Whether the copy shows every cell near bodies; soon: where they will be then."""
        moves, far = SOON if soon else (0, 0.0)
        step = np.linalg.norm(self.going)
        shift = np.tile(self.going * (min(moves * step, far) / max(step, 1e-9)), 2)
        return self.fine is not None and all(self.fine[self._cells(np.array(b) + shift, NEAR)].all() for b in boxes)

    def _refine(self, boxes):
        """Keep the copy fine around bodies. Where it is to be cut is found out while they are on their way there."""
        if self.cutting is not None and (self.cutting[-1].done() or not self._is_fine(boxes)):
            self._take()
        if not self._is_fine(boxes):
            self._cut(boxes)
            self._take()
        elif self.cutting is None and not self._is_fine(boxes, soon=True):
            self._cut(boxes)

    def _ahead(self, boxes):
        """Cells around bodies and ahead of them that the copy is to show, bool (ny, nx)."""
        out = np.zeros(self.pixels.shape[:2], bool)
        for each in boxes:
            out[self._cells(each, NEAR + WIDER)] = True
        most = np.clip(0 if self.fine is None else SHARE * np.count_nonzero(self.fine), *AHEAD)
        step = np.linalg.norm(self.going)
        toward = self.going / step if step > 0.0 else self.going
        gone = 0.0
        while boxes and np.count_nonzero(out) < most and gone < max(self.pixels.shape) * self.press.cell_size:
            gone += WIDER
            shift = np.tile(gone * toward, 2)
            wider = NEAR + WIDER + (FAN * gone if step > 0.0 else gone)
            for each in boxes:
                out[self._cells(np.array(each) + shift, wider)] = True
        return out

    def _cut(self, boxes):
        """Begin to cut a copy that is fine around bodies, and as fine as what was pressed asks for elsewhere."""
        obj, press, index = self.object(), self.press, self._index()
        self._look(())
        seen = self.pixels
        changed = (seen[..., 2] > SHADES) | (np.abs(seen[..., 0]) > SHADES)
        square = self._ahead(boxes)
        if self.fine is not None and np.count_nonzero(self.fine | square) < MOST_FINE:
            square |= self.fine
        j, i = (np.flatnonzero((changed | square).any(axis=axis)) for axis in (1, 0))
        printed = {"compression": (changed | square).astype(np.float32)}
        if not len(i) or cover.spacing(self.surface, index, printed) < refined.FINE:
            self.fine = square
            return
        size = axes.typed(obj.desire_path.refine_size)
        finest = max(size, press.cell_size)
        near = np.s_[max(j[0] - EDGE, 0) : j[-1] + EDGE, max(i[0] - EDGE, 0) : i[-1] + EDGE]
        corner = (index.x0 + near[1].start * index.cell, index.y0 + near[0].start * index.cell)
        wanted = refine.wishes(seen[near][..., 0], changed[near], index.cell, corner, size, (square[near], finest))
        if self.mesh is None:
            self.mesh = refined.triangles(self.scene, obj, self.surface, self.scene.frame_current)
        self.cutting = square, wanted, refine.begin(self.mesh, wanted)

    def _take(self):
        """Show the copy that was begun."""
        if self.cutting is None:
            return
        (self.fine, wanted, cut), self.cutting = self.cutting, None
        found = refined.cut(
            self.scene, self.object(), self.surface, self.scene.frame_current, wanted, self.copy, cut.result()
        )
        if found is not None and self.copy is None:
            self.copy = found.carrier
            self._tree()

    # ---- and nothing of it -----------------------------------------------------------------------

    def remove(self):
        """Take all of it away; what the ground played plays on."""
        obj = self.object()
        if obj is not None:
            clear(obj)
        self.tiles = self.fine = self.copy = self.at = self.mesh = self.cutting = None
        self.modifier_name = ""


def put(obj, tree, place):
    """A modifier that shows a tree for a while, where ours goes, in place of what ours plays; clear() takes it off."""
    ours = playback.modifier(obj)
    tree[playback.BY_HAND] = HIDES if ours is not None and ours.show_viewport else SHOWS
    if tree[playback.BY_HAND] == HIDES:
        ours.show_viewport = False
    modifier = compat.nodes_modifier(obj, "Desire Path Preview", tree)
    modifier.show_expanded = False
    compat.move_modifier(obj, modifier, place.before)
    return modifier


def clear(obj):
    """Take what shows ground for a while off an object, wherever it comes from: undo may have brought it back. What
    was hidden for it plays again."""
    for each in list(obj.modifiers):
        if playback.is_by_hand(each):
            tree = each.node_group
            hides = tree[playback.BY_HAND] == HIDES
            obj.modifiers.remove(each)
            playback.discard(tree)
            ours = playback.modifier(obj)
            if hides and ours is not None:
                ours.show_viewport = True


def _around(cells, margin):
    """Tiles (x, y, nx, ny) around cells (i0, i1, j0, j1)."""
    i0, i1, j0, j1 = (int(each) for each in cells)
    x, y = i0 // TILE - margin, j0 // TILE - margin
    return x, y, -(-i1 // TILE) + margin - x, -(-j1 // TILE) + margin - y
