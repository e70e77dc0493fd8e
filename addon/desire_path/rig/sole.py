"""What presses the ground: a built-in shoe sole, or the underside of the character's own skin.

A foot's frame while it is flat: x forward, y left, z up, the origin on the ground under the ankle.
The heel part reaches from the heel to the ball, the toe part from the ball to the tip.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TypeAlias

import numpy as np

from ..bounds import CELLS
from ..motion.gait import Gait, Sole
from ..motion.rotation import turned
from . import tread as treads
from .skeleton import Skin

# Half widths of a left shoe in shares of its length, seen from above: (from heel 0 to tip 1, inner, outer).
# The widest place, at the ball, is 0.36 wide; last-makers' proportions.
OUTLINE = np.array(
    [
        (0.000, 0.022, 0.022),
        (0.008, 0.052, 0.052),
        (0.025, 0.082, 0.082),
        (0.055, 0.104, 0.106),
        (0.10, 0.119, 0.121),
        (0.17, 0.122, 0.127),
        (0.26, 0.107, 0.127),
        (0.36, 0.090, 0.129),
        (0.46, 0.091, 0.139),
        (0.56, 0.121, 0.157),
        (0.65, 0.157, 0.174),
        (0.72, 0.177, 0.183),
        (0.80, 0.178, 0.165),
        (0.87, 0.164, 0.130),
        (0.925, 0.141, 0.088),
        (0.965, 0.110, 0.046),
        (0.990, 0.080, 0.010),
        (1.000, 0.058, -0.014),
    ]
)

PERSONS = (0.20, 0.32)  # feet of people are so long; lengths that follow are theirs, in share those of others [m]
ROUND = 0.008  # the edge rises over this much [m]
ARCH = 0.004  # the inner waist stands this high [m]
INSETS = (0.0, 0.15, 0.45, 1.0)  # columns near the edge, in shares of ROUND
FEW = 12  # faces under a foot that give its print a shape, at least
COARSE = 8.0  # cells of the print under each of them that are too many for so few
NARROW = 3.0  # cells that a sole is to be wide, at least
SHAPED = 8.0  # .. and cells that show its shape
UNDERSIDE = 0.15  # faces lower than this share of a foot's length are under it, if they look more down than aside
OVERLAP = 0.012  # the toe part reaches back under the heel part, so that a bent foot has no gap [m]

MAX_FACES = 4000  # under a foot: heavier meshes are thinned to the underside
Faces: TypeAlias = tuple[np.ndarray, np.ndarray]  # vertices (V, 3) [m], triangles (F, 3)


def size_of(length: float) -> float:
    """How large a foot of this length [m] is beside those of people."""
    return float(length / np.clip(length, *PERSONS)) if length > 0.0 else 1.0


def _half_widths(u: float) -> tuple[np.ndarray, np.ndarray]:
    """Inner and outer half width at a share of the length, in shares of it."""
    return (np.interp(u, OUTLINE[:, 0], OUTLINE[:, 1]), np.interp(u, OUTLINE[:, 0], OUTLINE[:, 2]))


def _edge_rise(inset: np.ndarray | float, radius: float) -> np.ndarray:
    """Height of a rounded edge at a distance from the outline."""
    s = np.clip(inset / max(radius, 1e-9), 0.0, 1.0)
    return np.asarray(radius * (1.0 - np.sqrt(np.maximum(1.0 - (1.0 - s) ** 2, 0.0))))


def built_in(heel: float, ball: float, tip: float, left: bool, tread: str = "plain") -> tuple[Sole, Sole]:
    """Soles of the heel part and the toe part from x positions [m] in the foot's frame; tread: one of TREADS."""
    length = tip - heel
    split = (ball - heel) / length
    u_heel = np.unique(np.r_[OUTLINE[OUTLINE[:, 0] < split - 0.02, 0], split])
    back = max(split - OVERLAP * size_of(length) / length, 0.05)
    u_toe = np.unique(np.r_[back, back + 0.3 * (split - back), split, OUTLINE[OUTLINE[:, 0] > split + 0.02, 0]])
    if tread != "plain":
        fine = np.arange(0.5 * treads.STEP, 1.0, treads.STEP)
        u_heel = np.unique(np.r_[u_heel, fine[fine < split]])
        u_toe = np.unique(np.r_[u_toe, fine[fine > back]])
    heel_part = _strip(u_heel, heel, length, left, 0.0, None, tread)
    toe_part = _strip(u_toe, heel, length, left, ball, back, tread)
    return heel_part, toe_part


def _strip(
    stations: np.ndarray, heel: float, length: float, left: bool, origin: float, back: float | None, tread: str
) -> Sole:
    """A band of the sole as quads cut in two, nine columns wide, or more for a tread. `origin` becomes x = 0."""
    size = size_of(length)
    radius = min(ROUND * size, 0.04 * length)
    sign = 1.0 if left else -1.0
    between = 1 if tread == "plain" else int(np.ceil(2.0 * OUTLINE[:, 1:].max() / treads.STEP))
    shares = np.arange(1, between + 1) / (between + 1.0)
    rows = []
    for u in stations:
        inner, outer = _half_widths(u)
        width = inner + outer
        inset = np.minimum(np.array(INSETS) * radius / length, np.array(INSETS) * 0.4 * width)
        middle = inset[-1] - inner + shares * (width - 2.0 * inset[-1]) if between > 1 else (outer - inner) / 2
        across = np.r_[-inner + inset, middle, (outer - inset)[::-1]]
        from_end = min(u, 1.0 - u) * length
        from_side = np.minimum(across + inner, outer - across) * length
        rise = _edge_rise(np.minimum(from_side, from_end), radius)
        if back is not None:  # the lap behind the ball rises too, out of the way of a raised toe
            rise = np.maximum(rise, _edge_rise((u - back) * length, radius))
        waist = np.clip(1.0 - abs(u - 0.40) / 0.20, 0.0, 1.0)
        side = np.clip(-across / max(inner, 1e-9), 0.0, 1.0)  # the inner side only
        rise = np.maximum(rise, ARCH * size * (waist * waist * (3 - 2 * waist)) * side)
        if tread != "plain":
            rise = rise + length * treads.grooves(tread, u, across, np.minimum(from_side, from_end) / length)
        rows.append(np.stack([np.full(len(across), heel + u * length - origin), sign * across * length, rise], axis=1))
    columns = len(rows[0])
    vertices = np.concatenate(rows)
    triangles = []
    for i in range(len(rows) - 1):
        for k in range(columns - 1):
            a = i * columns + k
            b, c, d = a + 1, a + columns, a + columns + 1
            # seen from below counter-clockwise, so that normals point at the ground
            quad = [(a, b, c), (b, d, c)] if left else [(a, c, b), (b, c, d)]
            triangles += quad
    return Sole(vertices, np.array(triangles, "i4"))


# ---- the character's own underside -------------------------------------------------------------------


def from_skin(
    skin: Skin, foot_bones: Collection[str], toe_bones: Collection[str], to_frame: np.ndarray, ankle_height: float
) -> tuple[Faces | None, Faces | None]:
    """Faces of the heel part and of the toe part in the foot's frame, None each where no face is its.

    A face belongs to the bone that moves most of it; those just behind the toes belong to both, so that a
    bent foot has no gap. to_frame (4, 4) takes the skin's rest space to
    the foot's frame but for the height, which is the caller's to set; ankle_height [m] is the
    ankle's z there, and nothing above it counts.
    """
    names = list(skin.weights)
    if not names or not len(skin.triangles):
        return None, None
    weights = np.stack([np.asarray(skin.weights[n], float) for n in names])
    owner = weights.argmax(axis=0)
    owner[weights.max(axis=0) <= 0] = -1
    kind_of = np.array([1 if n in foot_bones else 2 if n in toe_bones else 0 for n in names] + [0])
    kind = kind_of[owner]
    triangles = np.asarray(skin.triangles, "i8")
    vertices = np.asarray(skin.vertices, float) @ to_frame[:3, :3].T + to_frame[:3, 3]
    votes = kind[triangles]
    height = vertices[triangles, 2].max(axis=1)
    soles: list[Faces | None] = []
    for part in (1, 2):
        mine = (votes == part).sum(axis=1)
        # a face on the seam goes to the toe part if it has no majority, so that none is lost
        chosen = (mine >= 2) | ((part == 2) & (mine == 1) & ((votes == 1).sum(axis=1) == 1))
        chosen &= height < ankle_height
        soles.append(cut(vertices, triangles[chosen]))
    heel, toe = soles
    return heel, toe if heel is None or toe is None else _lapped(heel, toe)


def _lapped(heel: Faces, toe: Faces) -> Faces:
    """The toe part with a lap under the heel part, as the built-in sole has it."""
    back = toe[0][:, 0].min() - OVERLAP * size_of(float(toe[0][:, 0].max() - heel[0][:, 0].min()))
    corners = [piece for corner in heel[0][heel[1]] for piece in _ahead(corner, back)]
    if not corners:
        return toe
    lap = np.array(corners)
    faces = np.arange(3 * len(lap), dtype="i4").reshape(-1, 3) + len(toe[0])
    return np.concatenate((toe[0], lap.reshape(-1, 3))), np.concatenate((toe[1], faces))


def _ahead(corner: np.ndarray, back: float) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """The part of a triangle (3, 3) that lies ahead of x = back, as triangles that face the same way."""
    kept = []
    for a, b in zip(corner, np.roll(corner, -1, axis=0)):
        if a[0] >= back:
            kept.append(a)
        if (a[0] >= back) != (b[0] >= back):
            kept.append(a + (b - a) * ((back - a[0]) / (b[0] - a[0])))
    return [(kept[0], kept[k], kept[k + 1]) for k in range(1, len(kept) - 1)]


def cut(vertices: np.ndarray, triangles: np.ndarray, max_faces: int = MAX_FACES) -> Faces | None:
    """The faces alone, heavy meshes thinned to the underside."""
    if not len(triangles):
        return None
    corner = vertices[triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    size = np.linalg.norm(normal, axis=1)
    proper = size > 1e-14
    triangles, corner, normal = triangles[proper], corner[proper], normal[proper] / size[proper, None]
    if len(triangles) > max_faces:
        low = vertices[np.unique(triangles), 2].min()
        under = (normal[:, 2] < -0.2) & (corner[:, :, 2].min(axis=1) < low + 0.04)
        if under.sum() > 50:
            triangles = triangles[under]
    if not len(triangles):
        return None
    used, packed = np.unique(triangles, return_inverse=True)
    return vertices[used], packed.reshape(-1, 3).astype("i4")


def coarse_cells(gait: Gait, cell: float) -> list[str]:
    """Sentences about walkers whose every foot is but a few cells [m] wide, with the cells that would show it."""
    if not (np.isfinite(cell) and cell > 0.0):
        return []  # the bake refuses it
    warnings, reported, carving = [], set[int](), gait.carving()
    for walker, name in enumerate(gait.walker_name):
        wide, parts = 0.0, np.flatnonzero(np.asarray(gait.limb_walker)[gait.part_limb] == walker).tolist()
        if carving[walker] and any(id(gait.soles[part]) in reported for part in parts):
            continue  # legs of one who wades
        reported.update(id(gait.soles[part]) for part in parts)
        for part in parts:
            lowest = gait.pose[part, gait.pose[part, :, 2].argmin(), 3:]
            lies = turned(lowest, np.asarray(gait.soles[part].vertices, float))
            wide = max(wide, float(np.ptp(lies[:, :2], axis=0).min()))
        if 0.0 < wide < NARROW * cell:
            warnings.append(
                f"The soles of {name} are {wide / cell:.1f} cells of {cell:g} m wide, too few for a print to have "
                f"their shape: choose a cell size of {max(wide / SHAPED, CELLS[0]):.1g} m or so."
            )
    return warnings


def few_faces(gait: Gait, cell: float) -> list[str]:
    """Sentences about feet whose soles have too few faces for prints in cells of this size [m] to have a shape."""
    found: dict[tuple[int, int], list[str]] = {}
    for limb, name in enumerate(gait.limb_name):
        soles = [
            gait.soles[part]
            for part in np.flatnonzero(np.asarray(gait.part_limb) == limb)
            if gait.part_name[part] in ("heel", "toe")
        ]
        corners = [np.asarray(each.vertices, float)[each.triangles] for each in soles]
        if not corners:
            continue
        length = np.ptp(np.concatenate([each.reshape(-1, 3)[:, 0] for each in corners]))
        corner = np.concatenate(corners)
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        under = 2.0 * abs(normal[:, 2]) > np.linalg.norm(normal, axis=1)
        under &= corner[:, :, 2].max(axis=1) < corner[:, :, 2].min() + UNDERSIDE * length
        faces, cells = int(under.sum()), abs(normal[under, 2]).sum() / 2.0 / cell**2
        if faces < FEW and cells > COARSE * max(faces, 1):
            found.setdefault((faces, round(cells)), []).append(name)
    return [
        f"{' and '.join(names)} press with {faces} triangles on {cells} cells, too few for the shape of a foot: "
        "give the shoes or skin a finer mesh there, or choose a mesh as the sole."
        for (faces, cells), names in found.items()
    ]
