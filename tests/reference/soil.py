"""Slow twins of native/soil: one cell, one neighbour, one step at a time, in float64.

First the papers' equations as printed, each by itself; test_soil_twins.py holds the kernels against them where
both speak of the same, and names where the kernels leave them. Then what is ours (a rigid sole on springs, heaps
in their resting shape, a sweep that keeps volume), written down again from the design and without its ways.

Patches are dicts of float64 arrays (ny, nx): rest, compression, heap, pressure_time, modulus, rest_slope,
depth (L0), tau, nu; and `cell`. Functions change them in place, as the kernels do.
"""

import math

import numpy as np

# ---- as printed ---------------------------------------------------------------------------------


def stress(force, normal, hits, cell):
    """TRAIL (10), SOFT22 (9): sigma = (F.n)/A_contact, A_contact = hits cell^2; F.n of the ground's answer."""
    return -np.dot(force, normal) / (hits * cell**2)


def depth(sigma, layer, modulus):
    """TRAIL (10), SOFT22 (10): dL = sigma L_0/E."""
    return sigma * layer / modulus


def frame(accumulated, whole, layer, dt, tau):
    """SOFT22 (11): c_frame = dt/tau dL if c_acc < dL <= L_0, else 0."""
    return dt / tau * whole if accumulated < whole <= layer else 0.0


def pushed_aside(pressed, nu):
    """SOFT22 (12), its sign mended: of V_0 dL/L_0 that is pressed the share 1 - 2 nu is lost, the rest is displaced."""
    return pressed - (1.0 - 2.0 * nu) * pressed


def modulus(soil, plants):
    """TRAIL (9): E(p) = E_g(p) + E_v(p)."""
    return soil + plants


def raised(displaced, cell, neighbours):
    """SOFT22 (13): dL_inc = dV/(cell_area * neighbours), by which each cell around the sole is to rise."""
    return displaced / (cell**2 * neighbours)


def raised_in_frame(accumulated, whole, dt, tau):
    """SOFT22 (14): h_frame = dt/tau dL_inc if h_acc < dL_inc, else 0."""
    return dt / tau * whole if accumulated < whole else 0.0


def accumulated(stresses, dt):
    """TRAIL (17): the integral of sigma over the time that was walked."""
    return sum(sigma * dt for sigma in stresses)


def border_shares(cells, point, force, normal, threshold):
    """TRAIL (11)-(13): w_i/sum_k w_k of border cells at positions (n, 3)."""
    parallel = force - np.dot(force, normal) * normal
    size = math.sqrt(np.dot(parallel, parallel))
    beta = min(size / threshold, 1.0)  # TRAIL (13)
    w = []
    for at in cells:
        u = (at - point) / math.sqrt(np.dot(at - point, at - point))
        w_cos = max(np.dot(parallel, u), 0.0) / size if size else 0.0  # TRAIL (11)
        w.append(beta * w_cos + (1.0 - beta))  # TRAIL (12)
    return np.array(w) / sum(w)


def slide(h, cell, rest_angle, step, passes):
    """TRAIL (14)-(16) on loose ground, but h_step leaves a cell once, not for each neighbour: no volume is lost."""
    ny, nx = h.shape
    for _ in range(passes):
        moved = False
        for j in range(ny):
            for i in range(nx):
                near = [
                    (j + dj, i + di)
                    for dj in (-1, 0, 1)
                    for di in (-1, 0, 1)
                    if (dj or di) and 0 <= j + dj < ny and 0 <= i + di < nx
                ]
                lower = {q: h[j, i] - h[q] for q in near if h[q] < h[j, i]}
                steep = [
                    q
                    for q, fall in lower.items()
                    if math.atan(fall / (cell * math.hypot(q[0] - j, q[1] - i))) >= rest_angle
                ]  # TRAIL (14)
                if not steep:
                    continue
                moved = True
                down = min(step, h[j, i])
                whole = sum(lower[q] for q in steep)
                h[j, i] -= down  # TRAIL (16)
                for q in steep:
                    h[q] += lower[q] / whole * down  # TRAIL (15)
        if not moved:
            return


# ---- ours: how a sole is carried, MODEL 6.2 -----------------------------------------------------

RIGID = 0.95  # share of L0 that can be pressed
STIFFER = 100.0  # how much harder the ground is below it


def spring(t, depth):
    """Length by which a column is pressed when its target lies t below h0."""
    rigid = RIGID * depth
    x = t if t <= rigid else rigid + STIFFER * (t - rigid)
    return max(x, 0.0)


class Columns:
    """The cells under a sole; where there is no ground it goes on level, as the ground there is on average."""

    def __init__(self, patch, bottom, cover):
        at = np.argwhere(cover > 0)
        self.j, self.i = at.T
        self.cover, self.area = cover[self.j, self.i], cover[self.j, self.i] * patch["cell"] ** 2

        def column(grid):
            value = grid[self.j, self.i].copy()
            value[~self.ground] = np.average(value[self.ground], weights=self.cover[self.ground])
            return value

        self.ground = ~np.isnan(patch["rest"][self.j, self.i])
        self.gap = column(patch["rest"]) - bottom[self.j, self.i]
        self.e = column(patch["compression"] - patch["heap"])
        self.depth = column(patch["depth"])
        self.stiffness = column(patch["modulus"] / patch["depth"])  # E/L0

    def answer(self, sink):
        """Force of the ground on the sole, and the area that carries."""
        x = np.array([spring(gap + sink, depth) for gap, depth in zip(self.gap, self.depth)])
        return (self.stiffness * x * self.area).sum(), self.area[x > 0].sum()

    def sink(self, load):
        """The s at which the columns carry the load: bisection."""
        low = -self.gap.max()
        high = low + 1e-3
        while self.answer(high)[0] < load:
            high = low + 2 * (high - low)
        for _ in range(200):
            middle = 0.5 * (low + high)
            if self.answer(middle)[0] < load:
                low = middle
            else:
                high = middle
        return 0.5 * (low + high)


def _yield(patch, j, i, a, t, sigma, dt):
    """Lower one cell for dt seconds; returns what came from firm ground, what from the heap."""
    t = min(t, RIGID * patch["depth"][j, i])
    e = patch["compression"][j, i] - patch["heap"][j, i]
    press = max(min(a * t * min(dt / patch["tau"][j, i], 1.0), a * t - e), 0.0)  # SOFT22 (11), cut at the end
    loose = min(press, patch["heap"][j, i])
    patch["heap"][j, i] -= loose
    patch["compression"][j, i] += press - loose
    patch["pressure_time"][j, i] += sigma * a * dt  # TRAIL (17)
    return press - loose, loose


def compress(patch, bottom, cover, load, dt, law="sole"):
    """One step of either law. Returns (touched, firm, loose, displaced, sink)."""
    cell2 = patch["cell"] ** 2
    columns = Columns(patch, bottom, cover)
    sole = columns.area.sum()
    least = min(max(4 * cell2, 0.05 * sole), sole)
    touched = np.zeros(cover.shape, bool)
    firm = loose = displaced = 0.0
    if law == "sole":
        sink = columns.sink(load)
        area = columns.answer(sink)[1]
        if 0 < area < least:
            sink = columns.sink(load * area / least)
        depths = columns.gap + sink
        stresses = [k * spring(t, d) for k, t, d in zip(columns.stiffness, depths, columns.depth)]
        carries = depths > 0
    else:
        e = columns.e
        overlap = columns.gap - np.where(e > 0, np.minimum(e / columns.cover, RIGID * columns.depth), e)
        sink = -overlap.max()
        carries = overlap >= overlap.max() - 0.01
        stresses = np.full(len(overlap), load / max(columns.area[carries].sum(), least))
        depths = stresses / columns.stiffness
    for k in np.flatnonzero(carries & columns.ground):
        j, i = columns.j[k], columns.i[k]
        touched[j, i] = True
        c, b = _yield(patch, j, i, columns.cover[k], depths[k], stresses[k], dt)
        firm += c * cell2
        loose += b * cell2
        displaced += pushed_aside((c + b) * cell2, patch["nu"][j, i])
    return touched, firm, loose, displaced, sink


def carve(patch, bottom, cover, descent):
    """One step of a body that goes where it is moved to, MODEL 6.11. descent: how far it came down at (x, y, z), as
    four numbers about the middle of the patch. Returns (touched, firm, loose, displaced, cut_firm, cut_loose)."""
    ny, nx = cover.shape
    touched = np.zeros(cover.shape, bool)
    firm = loose = displaced = cut_firm = cut_loose = 0.0
    for j in range(ny):
        for i in range(nx):
            a, rest = cover[j, i], patch["rest"][j, i]
            if not a or math.isnan(rest):
                continue
            below = rest - bottom[j, i]
            goal = a * below if below > 0 else below / a
            over = goal - (patch["compression"][j, i] - patch["heap"][j, i])
            touched[j, i] = over > -5e-4
            if over <= 0:
                continue
            x, y = (i - 0.5 * (nx - 1)) * patch["cell"], (j - 0.5 * (ny - 1)) * patch["cell"]
            came = descent[0] + descent[1] * x + descent[2] * y + descent[3] * bottom[j, i]
            pressed = min(a * max(came, 0.0), over)
            share = 1.0 - pressed / over if over - pressed > 1e-7 else 0.0  # that was cut
            b = min(over, patch["heap"][j, i])
            c = over - b
            patch["heap"][j, i] -= b
            patch["compression"][j, i] += c
            firm, loose = firm + (1 - share) * c, loose + (1 - share) * b
            displaced += pushed_aside((1 - share) * c, patch["nu"][j, i]) + (1 - share) * b
            cut_firm, cut_loose = cut_firm + share * c, cut_loose + share * b
    area = patch["cell"] ** 2
    return touched, firm * area, loose * area, displaced * area, cut_firm * area, cut_loose * area


# ---- ours: how they come to rest, MODEL 6.4 -----------------------------------------------------


def around(j, i, stands, cell):
    """(cell, how far its middle is [m]) of each of the eight around that may take soil."""
    for dj in (-1, 0, 1):
        for di in (-1, 0, 1):
            q = (j + dj, i + di)
            if (dj or di) and 0 <= q[0] < stands.shape[0] and 0 <= q[1] < stands.shape[1] and not stands[q]:
                yield q, cell * math.hypot(dj, di)


def sweep(patch, touched=None, tolerance=1e-5):
    """One sweep with both stencils, by loops."""
    slack = math.tan(tolerance) * patch["cell"]
    ny, nx = patch["rest"].shape
    height = patch["rest"] - patch["compression"] + patch["heap"]
    stands = np.isnan(patch["rest"]) | (touched if touched is not None else False)
    moved = np.zeros((ny, nx))
    for j in range(ny):
        for i in range(nx):
            if stands[j, i]:
                continue
            excess = {}
            for q, far in around(j, i, stands, patch["cell"]):
                over = height[j, i] - height[q] - patch["rest_slope"][j, i] * far  # TRAIL (14)
                if over > 0:
                    excess[q] = over
            if not excess:
                continue
            steepest = max(over / math.hypot(q[0] - j, q[1] - i) for q, over in excess.items())
            hold = 0.25 * slack * (1 + patch["rest_slope"][j, i] ** 2)
            eager = min(max(steepest - hold, 0.0) / hold, 1.0) * min(patch["heap"][j, i] / (0.1 * slack), 1.0)
            n = sum(min(1.0, over / (0.1 * slack)) for over in excess.values())
            out = sum(excess.values()) / (n + 1)
            a = min(1.0, patch["heap"][j, i] / out) / (n + 1) * eager  # TRAIL (15)
            for q, over in excess.items():  # TRAIL (16)
                moved[q] += a * over
                moved[j, i] -= a * over
    patch["heap"] += moved


# ---- ours: walls that slide, MODEL 6.8 ----------------------------------------------------------


def walls(patch, touched=None, tolerance=1e-5):
    """What one sweep lets fall from firm walls: (off each cell, onto each cell) [m]; the patch stays."""
    ny, nx = patch["rest"].shape
    slack = math.tan(tolerance) * patch["cell"]
    firm = patch["rest"] - patch["compression"]
    height = firm + patch["heap"]
    stands = np.isnan(patch["rest"]) | (touched if touched is not None else False)
    off, onto = np.zeros((ny, nx)), np.zeros((ny, nx))
    for j in range(ny):
        for i in range(nx):
            if stands[j, i] or not np.isfinite(patch["wall_slope"][j, i]):
                continue
            excess = {}
            for q, far in around(j, i, stands, patch["cell"]):
                steep = patch["wall_slope"][j, i] * far
                over = firm[j, i] - height[q] - max(steep, patch["rest"][j, i] - patch["rest"][q])
                if over > 0:
                    excess[q] = over
            if not excess:
                continue
            steepest = max(over / math.hypot(q[0] - j, q[1] - i) for q, over in excess.items())
            hold = 0.25 * slack * (1 + patch["wall_slope"][j, i] ** 2)
            n = sum(min(1.0, over / (0.1 * slack)) for over in excess.values())
            a = 0.5 / (n + 1) * min(max(steepest - hold, 0.0) / hold, 1.0)
            a = min(a, 0.5 * patch["cell"] / sum(excess.values()))  # high walls do not jump
            for q, over in excess.items():
                off[j, i] += a * over
                onto[q] += a * over
    return off, onto


# ---- ours: what comes back, MODEL 6.9 -----------------------------------------------------------


class Springy:
    """One column: what a sole presses it to, and what is left when it lifts."""

    def __init__(self, share):
        self.share, self.deepest, self.now = share, 0.0, 0.0

    def press(self, to):
        """Returns (pressed anew, pressed again) [m]."""
        to = max(to, self.now)
        again = min(to, self.deepest) - self.now if self.deepest > self.now else 0.0
        anew = to - self.now - again
        self.now, self.deepest = to, max(self.deepest, to)
        return anew, again

    def lift(self):
        """Returns what comes back [m]."""
        stays = min(self.now, (1 - self.share) * self.deepest)
        back, self.now = self.now - stays, stays
        return back
