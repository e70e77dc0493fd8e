"""Bodies of known forces: what a stance carries, feet that roll over heel, ball and tip, and legs over them."""

import numpy as np

from desire_path.motion import rotation
from desire_path.rig import rigs

G = 9.81
FINE = 480.0  # samples a second at which a body is moved
# a person of 1.75 m: hip joints, knee, ankle, ball, tip and heel of a foot that is flat, its ankle at (0, 0)
HIP_WIDE, THIGH, SHANK, TRUNK, ANKLE = 0.09, 0.43, 0.43, 0.50, 0.09
HEEL, BALL, TIP = -0.05, 0.14, 0.21
NAMES = ("hips", "neck", "thigh.L", "shin.L", "foot.L", "toe.L", "thigh.R", "shin.R", "foot.R", "toe.R")
PARENTS = (-1, 0, 0, 2, 3, 4, 0, 6, 7, 8)


def smooth(x):
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


# ---- forces of one stance over 0..1 [body weights, to be scaled] -----------------------------------------------


def double_hump(u):
    """A walk: weight taken over, a dip in mid-stance, push-off; the heel's knock on top."""
    main = 1.13 * np.sin(np.pi * u) + 0.35 * np.sin(3 * np.pi * u) + 0.09 * np.sin(5 * np.pi * u)
    return np.clip(main, 0, None) + 0.18 * np.exp(-0.5 * ((u - 0.035) / 0.012) ** 2)


def heel_run(u):
    """A run over the heel: one hump, and the knock of the heel before it."""
    return np.clip(np.sin(np.pi * u) * (1.0 + 0.15 * np.cos(np.pi * u)), 0, None) + 0.35 * np.exp(
        -0.5 * ((u - 0.12) / 0.045) ** 2
    )


def sprint(u):
    """A sprint over the ball of the foot: steep at first, long at its end."""
    return np.clip(np.sin(np.pi * np.clip(u, 0, 1) ** 0.75), 0, None)


# ---- kinematics of feet ----------------------------------------------------------------------------------


def _roll(pitch, about):
    """Ankle relative to a point of the flat sole about which the foot is pitched (n, 2): along, up."""
    c, s = np.cos(pitch), np.sin(pitch)
    along, up = -about, ANKLE
    return np.stack([about + c * along + s * up, -s * along + c * up], axis=-1)


def _foot_in_stance(stance, u):
    """(ankle along and up (n, 2), pitch (n,)) over shares u of a stance; heel up is pitch > 0."""
    first, last = stance.flat
    if first > last:  # on the ball all the time: the heel sinks and rises
        pitch = stance.strike + (stance.leave - stance.strike) * u**2
        pitch = pitch - 0.25 * stance.strike * np.sin(np.pi * u)
    else:
        down = 1.0 - smooth(u / first) if first > 0 else np.zeros_like(u)
        up = np.clip((u - last) / (1.0 - last), 0, 1) ** 2 if last < 1 else np.zeros_like(u)
        pitch = stance.strike * down + stance.leave * up
    return np.where((pitch < 0)[:, None], _roll(pitch, HEEL), _roll(pitch, BALL)), pitch


def _hermite(u, a, b, va, vb, span):
    h = ((1 + 2 * u) * (1 - u) ** 2, u * (1 - u) ** 2 * span, u * u * (3 - 2 * u), u * u * (u - 1) * span)
    return h[0] * a + h[1] * va + h[2] * b + h[3] * vb


def feet_of(stances, time):
    """Ankles (2, T, 3), pitches (2, T) and bends of the toes (2, T) of both feet."""
    ankle, pitch = np.zeros((2, len(time), 3)), np.zeros((2, len(time)))
    toe = np.zeros((2, len(time)))
    for foot in (0, 1):
        mine = sorted((s for s in stances if s.foot == foot), key=lambda s: s.begin)
        ends = []
        for s in mine:
            edge, tilt = _foot_in_stance(s, np.array([0.0, 1.0]))
            ends.append((edge + [s.at[0], s.height], tilt))
            on = (time >= s.begin) & (time < s.end)
            at, tilt = _foot_in_stance(s, (time[on] - s.begin) / (s.end - s.begin))
            ankle[foot, on, 0], ankle[foot, on, 2] = at[:, 0] + s.at[0], at[:, 1] + s.height
            ankle[foot, on, 1], pitch[foot, on] = s.at[1], tilt
            toe[foot, on] = -np.clip(tilt, 0, 0.9)  # toes stay level while the foot carries
        for k in range(len(mine) - 1):
            a, b = mine[k], mine[k + 1]
            span = b.begin - a.end
            if span <= 0:
                continue
            air = (time >= a.end) & (time < b.begin)
            u = (time[air] - a.end) / span
            (end, tilt_a), (begin, tilt_b) = ends[k], ends[k + 1]
            ankle[foot, air, 0] = _hermite(u, end[1, 0], begin[0, 0], a.part[0], b.arrive[0], span)
            lift = 0.04 if b.at[0] - a.at[0] < 2.0 else 0.15
            ankle[foot, air, 2] = _hermite(u, end[1, 1], begin[0, 1], a.part[1], b.arrive[1], span)
            ankle[foot, air, 2] += lift * (4 * u * (1 - u)) ** 2
            ankle[foot, air, 1] = a.at[1] + (b.at[1] - a.at[1]) * smooth(u)
            pitch[foot, air] = _hermite(u, tilt_a[1], tilt_b[0], 2.0, 0.0, span)
            toe[foot, air] = -np.clip(tilt_a[1], 0, 0.9) * (1 - smooth(u * 2)) - np.clip(tilt_b[0], 0, 0.9) * smooth(
                u * 2 - 1
            )
    return ankle, pitch, toe


def pressure_of(stances, time):
    """Centres of pressure (2, T, 3): from heel to ball and tip while the foot rolls."""
    point = np.zeros((2, len(time), 3))
    for s in stances:
        on = (time >= s.begin) & (time < s.end)
        u = (time[on] - s.begin) / (s.end - s.begin)
        first, last = s.flat
        if first > last:
            along = BALL - 0.01 + 0.05 * u**2
        elif s.end - s.begin > 3.0 or last >= 1.0:
            along = np.full_like(u, 0.05)
        else:
            along = HEEL + 0.02 + (BALL - HEEL - 0.03) * smooth(u / max(last, 0.3)) + 0.05 * smooth((u - 0.6) / 0.4)
        point[s.foot, on, 0], point[s.foot, on, 1], point[s.foot, on, 2] = s.at[0] + along, s.at[1], s.height
    return point


# ---- the body ----------------------------------------------------------------------------------------------


def integrate(accel, step, v0, x0):
    v = v0 + np.concatenate([[0], np.cumsum((accel[1:] + accel[:-1]) / 2) * step])
    return x0 + np.concatenate([[0], np.cumsum((v[1:] + v[:-1]) / 2) * step]), v


def level(stiff, pressure, step, first, last):
    """x with x'' = stiff (x - pressure) between two ends: forces that run through the mass centre."""
    count = len(stiff)
    low, mid, high = np.ones(count), -2.0 - stiff * step * step, np.ones(count)
    right = -stiff * step * step * pressure
    mid[0] = mid[-1] = 1.0
    high[0] = low[-1] = 0.0
    right[0], right[-1] = first, last
    for k in range(1, count):  # Thomas
        f = low[k] / mid[k - 1]
        mid[k] -= f * high[k - 1]
        right[k] -= f * right[k - 1]
    x = np.empty(count)
    x[-1] = right[-1] / mid[-1]
    for k in range(count - 2, -1, -1):
        x[k] = (right[k] - high[k] * x[k + 1]) / mid[k]
    return x


def hips_of(com, ankle, pitch):
    """Hips over the mass centre: the segments of Winter meet it."""
    trunk, upper, lower, sole = rigs.TRUNK, rigs.UPPER, rigs.LOWER, rigs.SOLE
    hips = com.copy()
    ball = np.stack([_bone(pitch[f], BALL, 0.03 - ANKLE) for f in (0, 1)])
    for _ in range(30):
        mean = trunk[0] * (hips + [0, 0, trunk[1] * TRUNK])
        for f, side in enumerate((1.0, -1.0)):
            top = hips + [0, side * HIP_WIDE, 0]
            knee = _knee(top, ankle[f])
            mean = (
                mean
                + upper[0] * (top + upper[1] * (knee - top))
                + lower[0] * (knee + lower[1] * (ankle[f] - knee))
                + sole[0] * (ankle[f] + sole[1] * ball[f])
            )
        hips = hips + com - mean
    return hips


def _knee(hip, ankle):
    down = ankle - hip
    reach = np.linalg.norm(down, axis=1, keepdims=True)
    down = down / reach
    ahead = np.array([1.0, 0, 0]) - down[:, :1] * down
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    bend = np.sqrt(np.maximum(THIGH**2 - np.minimum(reach, THIGH + SHANK) ** 2 / 4, 0.0))
    return (hip + ankle) / 2 + bend * ahead


def _bone(pitch, along, up):
    """A point of the flat foot, from the ankle, as the foot is pitched (T, 3)."""
    c, s = np.cos(pitch), np.sin(pitch)
    return np.stack([c * along + s * up, 0 * c, -s * along + c * up], axis=-1)


def matrices_of(heads, tails):
    """World matrices with +Y along each bone (T, B, 4, 4)."""
    y = rotation.unit(tails - heads)
    x = np.cross(y, [0.0, 0.1, 0.03])
    x = rotation.unit(x)
    out = np.tile(np.eye(4), heads.shape[:2] + (1, 1))
    out[..., :3, :3] = np.stack([x, y, np.cross(x, y)], axis=-1)
    out[..., :3, 3] = heads
    return out


def joints_of(hips, ankle, pitch, toe, ball_up, lower):
    heads, tails = [hips, hips + [0, 0, TRUNK]], [hips + [0, 0, 0.1], hips + [0, 0, TRUNK + 0.2]]
    for f, side in enumerate((1.0, -1.0)):
        top = hips + [0, side * HIP_WIDE, 0]
        knee = _knee(top, ankle[f])
        joint = ankle[f] + _bone(pitch[f], 0.0, lower - ANKLE)
        ball = ankle[f] + _bone(pitch[f], BALL, ball_up - ANKLE)
        tip = ball + _bone(pitch[f] + toe[f], TIP - BALL, 0.0)
        heads += [top, knee, joint, ball]
        tails += [knee, joint, ball, tip]
    return np.stack(heads, axis=1), np.stack(tails, axis=1)


def at_rest(ball_up, lower):
    stand = np.array([[0.0, 0.0, ANKLE + THIGH + SHANK]])
    feet = np.array([[[0, HIP_WIDE, ANKLE]], [[0, -HIP_WIDE, ANKLE]]])
    none = np.zeros((2, 1))
    heads, tails = joints_of(stand, feet, none, none, ball_up, lower)
    return heads[0], tails[0]
