"""Slow literal twins of the walker: TRAIL (3) (4), SOFT22 (1), (3)-(8), MODEL 4.2 and 4.3.

For limbs of one part with one contact point each; everything is spelled out over plain arrays.
"""

import math

import numpy as np

G = 9.81


def share_right(com, left, right):
    across = right - left
    return min(max((com - left) @ across / (across @ across), 0.0), 1.0)  # SOFT22 (5), denominator mended


def tilt(target, com, along, turning, alpha, beta):
    """SOFT22 (1): T = alpha (p_target - p_com).u + beta dtheta/dt; the sign of beta mended, or a swing would grow."""
    return alpha * np.dot(np.subtract(target, com), along) - beta * turning


def smoothstep(x):
    t = min(max(x, 0.0), 1.0)
    return t * t * (3 - 2 * t)


# ---- filters ---------------------------------------------------------------------------------------


def low_pass(values, rate, cutoff):
    """2nd-order Butterworth forward and backward on a signal turned about its end points."""
    values = np.asarray(values, float)
    if len(values) < 3 or not 0 < cutoff < 0.45 * rate:
        return values.copy()
    pad = min(int(3 * rate / cutoff), len(values) - 1)
    before = [2 * values[0] - values[k] for k in range(pad, 0, -1)]
    after = [2 * values[-1] - values[-1 - k] for k in range(1, pad + 1)]
    signal = np.array(before + list(values) + after)
    k = math.tan(math.pi * cutoff / rate)
    norm = 1 + math.sqrt(2) * k + k * k

    def once(x):
        y = np.empty_like(x)
        x1 = x2 = y1 = y2 = x[0]
        for n in range(len(x)):
            y[n] = (k * k * (x[n] + 2 * x1 + x2) - 2 * (k * k - 1) * y1 - (1 - math.sqrt(2) * k + k * k) * y2) / norm
            x1, x2, y1, y2 = x[n], x1, y[n], y1
        return y

    return once(once(signal)[::-1])[::-1][pad : pad + len(values)]


def acceleration(values, rate, cutoff):
    smooth = low_pass(values, rate, cutoff)
    inside = (smooth[2:] - 2 * smooth[1:-1] + smooth[:-2]) * rate * rate
    return np.concatenate([inside[:1], inside, inside[-1:]])


def fly(values, air, rate, cutoff, fall):
    """The x nearest to values that is smooth in its third difference and falls freely in the air."""
    count = len(values)
    second, third = np.diff(np.eye(count), 2, axis=0), np.diff(np.eye(count), 3, axis=0)
    second = second[np.asarray(air, bool)[1:-1]]
    a, b = (rate / (2 * math.pi * cutoff)) ** 6, (rate / (2 * math.pi * 0.3)) ** 4
    matrix = np.eye(count) + a * third.T @ third + b * second.T @ second
    return np.linalg.solve(matrix, values + b * second.T @ np.full(len(second), fall / rate**2))


def flown_acceleration(values, air, rate, cutoff, fall):
    smooth = fly(values, air, rate, cutoff, fall)
    inside = (smooth[2:] - 2 * smooth[1:-1] + smooth[:-2]) * rate * rate
    return np.concatenate([inside[:1], inside, inside[-1:]])


def speed(places, rate, cutoff):
    smooth = np.stack([low_pass(places[:, c], rate, cutoff) for c in range(3)], axis=1)
    return np.linalg.norm(np.gradient(smooth, 1 / rate, axis=0), axis=1)


def drops(places, rate, cutoff):
    """Does a point come down steeper than 45 degrees?"""
    v = np.gradient(np.stack([low_pass(places[:, c], rate, cutoff) for c in range(3)], axis=1), 1 / rate, axis=0)
    return -v[:, 2] > np.hypot(v[:, 0], v[:, 1])


# ---- contact ---------------------------------------------------------------------------------------


def resting_height(height, speeds):
    """Median of the lowest 3 cm of the heights at which a point is slower than 0.25 m/s."""
    slow = sorted(h for h, v in zip(height, speeds) if v < 0.25)
    lowest = slow[len(slow) // 20]
    band = [h for h in slow[len(slow) // 20 :] if h <= lowest + 0.03]
    upto = len(slow) // 20 + len(band)
    return slow[upto // 2]


def touches(height, speeds, com_speed, clearance, heel, dropping):
    """One point's contact by hysteresis. TRAIL (4), MODEL 4.2"""
    on, state, rested = [], False, False
    for h, v, v_com, drop in zip(height, speeds, com_speed, dropping):
        d = h - clearance
        if not state:
            state, rested = d < 0.03 and (v < 0.4 * v_com + 0.3 or drop), False
        rested = rested or v <= 1.2
        if state and (d > (0.03 if heel else 0.05) or (rested and v > 1.2)):
            state = False
        on.append(state)
    return np.array(on)


def arrives(on, height, clearance, rise, rate):
    """A point that touches while it comes down does so when its fall is fastest; above 1.2 m/s, at 1 cm."""
    on, t = list(on), 1
    while t < len(on):
        if on[t] and not on[t - 1]:
            run = [t]
            while run[-1] < len(on) and on[run[-1]] and rise[run[-1]] < 0 and run[-1] - t < 0.1 * rate:
                run.append(run[-1] + 1)
            moment = min(run[:-1] or [t], key=lambda k: rise[k])
            while moment + 1 < len(on) and on[moment + 1] and rise[moment] < -1.2 and height[moment] > clearance + 0.01:
                moment += 1
            on[t:moment] = [False] * (moment - t)
            t = moment
        t += 1
    return np.array(on)


def leaves(on, lift, rate):
    """A point that lets go did so when it was lifted and sped up hardest (lift), 0.1 s before to half that after."""
    on, t, reach = list(on), 1, int(0.1 * rate)
    while t < len(on):
        if on[t - 1] and not on[t]:
            first, last = t, t
            while first > 1 and t - first < reach - 1 and on[first - 2]:
                first -= 1
            while last + 1 < len(on) and last + 1 - t < reach // 2 and not on[last + 1]:
                last += 1
            moment = max(list(range(t, first - 1, -1)) + list(range(t, last + 1)), key=lambda k: lift[k])
            moment = moment if lift[moment] > 0 else t
            on[moment:t] = [False] * (t - moment)
            on[t:moment] = [True] * (moment - t)
            t = max(t, moment)
        t += 1
    return np.array(on)


def without_runs(on, value, most):
    """Inner runs of `value` shorter than `most` samples are turned over."""
    on, start = list(on), 0
    while start < len(on):
        end = start
        while end < len(on) and on[end] == on[start]:
            end += 1
        if on[start] == value and start > 0 and end < len(on) and end - start < most:
            on[start:end] = [not value] * (end - start)
        start = end
    return np.array(on)


# ---- loads -----------------------------------------------------------------------------------------


def stances(on):
    edges = np.flatnonzero(np.diff(np.concatenate([[0], on.astype(int), [0]])))
    return list(zip(edges[::2], edges[1::2]))  # [begin, end)


def ramps_of_two(on, rate):
    """W_i of two limbs. MODEL 4.3, step 1"""
    count = on.shape[1]
    weight = np.zeros(on.shape)
    for i in (0, 1):
        mine, other = stances(on[i]), stances(on[1 - i])
        for a, b in mine:
            up = down = None
            # alone; or nearly together with the other
            near = lambda edges, edge: min([0.1] + [abs(e - edge) / rate for e in edges])
            if a > 0:
                up = 0.1 - 0.07 * near([c for c, d in other if c > a], a) / 0.1
                for c, d in other:
                    if c <= a < d:
                        overlap = (d - a) / rate if c < a and d < b else math.inf
                        up = overlap if overlap < 0.3 else 0.1
            if b < count:
                down = 0.1 - 0.07 * near([d for c, d in other if d < b], b) / 0.1
                for c, d in other:
                    if c <= b - 1 < d:
                        overlap = (b - c) / rate if c > a and d > b else math.inf
                        down = overlap if overlap < 0.3 else 0.1
            for t in range(a, b):
                rise = min((t - a + 0.5) / rate / up, 1.0) if up else 1.0
                fall = min((b - t - 0.5) / rate / down, 1.0) if down else 1.0
                weight[i, t] = min(rise, fall)
    return weight


def share_of_two(s, a_star, length, mu, reach=0.3):
    """The first limb's share. MODEL 4.3, step 2, closed form"""
    q, lam = s * (1 - s), length**2 / (length**2 + reach**2)
    return min(max((mu * s + 2 * lam * q * a_star) / (mu + 2 * lam * q), 0.0), 1.0)


def inertia_of_two(com, mass, feet, on, rate, cutoff):
    """Forces (2, T, 3) of two one-point limbs at feet (2, T, 3) on the ground."""
    level = cutoff * 2 / 3  # of what goes on over the ground
    accel = np.stack([acceleration(com[:, c], rate, level if c < 2 else cutoff) for c in range(3)], axis=1)
    way = np.gradient(np.stack([low_pass(com[:, c], rate, level) for c in (0, 1)], axis=1), 1 / rate, axis=0)
    weight = ramps_of_two(on, rate)
    force = np.zeros((2,) + com.shape)
    for t in range(len(com)):
        total = mass * np.array([-accel[t, 0], -accel[t, 1], -(G + accel[t, 2])])  # m (g - a)
        total = total if total[2] < 0 else np.zeros(3)
        if on[0, t] and on[1, t]:
            s = weight[0, t] / (weight[0, t] + weight[1, t])
            lever = (com[t, 2] - (feet[0, t, 2] + feet[1, t, 2]) / 2) / max(accel[t, 2] + G, 0.2 * G)
            zmp = com[t, :2] - lever * accel[t, :2]
            d = feet[0, t, :2] - feet[1, t, :2]
            a_star = (zmp - feet[1, t, :2]) @ d / (d @ d)
            lean = accel[t, :2] @ d / np.linalg.norm(d) / max(accel[t, 2] + G, 0.2 * G)  # along their line
            still = smoothstep(np.hypot(lean / 0.1, accel[t, 2] / G / 2.0))
            mu = 0.25 * max(still, 1 - weight[0, t], 1 - weight[1, t])
            a = share_of_two(s, a_star, np.linalg.norm(d), mu)
            # the foot ahead brakes, the one behind drives, both along their lines to the mass centre
            fast = np.linalg.norm(way[t])
            ahead = way[t] / max(fast, 1e-12)
            height = com[t, 2] - (feet[0, t, 2] + feet[1, t, 2]) / 2
            lever = min(max(d @ ahead / height, -0.6), 0.6)
            drive = smoothstep(fast / 0.5) * -total[2] * a * (1 - a) * lever
            force[0, t], force[1, t] = a * total, (1 - a) * total
            force[0, t, :2] += drive * ahead
            force[1, t, :2] -= drive * ahead
        elif on[0, t] or on[1, t]:
            force[0 if on[0, t] else 1, t] = total
    return force


def impulse_of_two(com, mass, feet, on, rate, tau):
    """TRAIL (3) (4), SOFT22 (3)-(8): forces (2, T, 3) of feet of one point each, which are where they land; v0 by the
    caller's exact parabola of the feet."""
    force = np.zeros((2,) + com.shape)
    for t in range(len(com)):
        if not (on[0, t] or on[1, t]):
            continue
        right = share_right(com[t, :2], feet[0, t, :2], feet[1, t, :2]) if on[0, t] and on[1, t] else float(on[1, t])
        for i, alpha in ((0, 1 - right), (1, right)):  # SOFT22 (4)
            if not on[i, t]:
                continue
            push = np.array([0, 0, -G])  # SOFT22 (3)
            for a, b in stances(on[i]):
                if a > 0 and a <= t < b and (t - a + 0.5) / rate < tau:
                    h, k = rate / 60, a - 1
                    x0, x1, x2 = (feet[i, int(round(k - n * h))] for n in (0, 1, 2))
                    v0 = (3 * x0 - 4 * x1 + x2) * rate / (2 * h)  # the last airborne sample
                    push = push + v0 / tau  # TRAIL (3), SOFT22 (7) (8)
            force[i, t] = mass * alpha * push if push[2] < 0 else 0.0  # SOFT22 (6)
    return force
