"""Walkers whose forces are known because they were there first: the body moves as they move it.

    trial = trials.make("run", rate=120.0)
    gait = body.gait_from_bones(trial.skeleton, trial.motion, mass=trial.mass, frame_rate=trial.rate)
    trial.force, trial.point      # ground on foot (2, T, 3) [N], its centre of pressure [m]

Each foot's upward force is laid down over its stances; their sum lifts and drops the mass centre; over the
ground the force runs along the line from the centre of pressure to the mass centre, which gives the way
forward and sideways. Feet roll over heel, ball and tip while they carry, and swing between. The hips stand
where the segments' masses meet the mass centre, knees where the legs are long enough. The body faces +X.
"""

from dataclasses import dataclass

import numpy as np

from desire_path.motion import rotation
from desire_path.rig import rigs
from desire_path.rig.body import Motion, Skeleton

G = 9.81
FINE = 480.0  # samples a second at which a body is moved
FEET = ("L", "R")
# a person of 1.75 m: hip joints, knee, ankle, ball, tip and heel of a foot that is flat, its ankle at (0, 0)
HIP_WIDE, THIGH, SHANK, TRUNK, ANKLE = 0.09, 0.43, 0.43, 0.50, 0.09
HEEL, BALL, TIP = -0.05, 0.14, 0.21
NAMES = ("hips", "neck", "thigh.L", "shin.L", "foot.L", "toe.L", "thigh.R", "shin.R", "foot.R", "toe.R")
PARENTS = (-1, 0, 0, 2, 3, 4, 0, 6, 7, 8)


@dataclass(frozen=True)
class Trial:
    skeleton: Skeleton
    motion: Motion
    rate: float
    mass: float
    time: np.ndarray
    force: np.ndarray  # ground on foot (2, T, 3) [N]
    point: np.ndarray  # its centre of pressure (2, T, 3) [m]; meaningless in the air
    com: np.ndarray  # (T, 3) [m]
    window: tuple  # where truth is truth: away from the ends of the clip [s]


@dataclass(frozen=True)
class Stance:
    """One foot on the ground."""

    foot: int  # 0 left, 1 right
    begin: float  # [s]; may lie before the clip
    end: float
    at: tuple  # ankle over the ground while the foot is flat (x, y) [m]
    shape: object  # upward force over 0..1 of the stance [body weights]
    strike: float = -0.35  # pitch at touch-down, toes up below 0 [rad]
    flat: tuple = (0.12, 0.55)  # shares of the stance between which it is flat; (1, 0): it never is
    leave: float = 0.9  # pitch at toe-off [rad]
    arrive: tuple = (0.4, -0.35)  # speed of the ankle before touch-down, forward and up [m/s]
    part: tuple = (0.6, 0.5)  # and after toe-off
    height: float = 0.0  # of what it stands on [m]


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


def _feet(stances, time):
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


def _pressure(stances, time):
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


def _integrate(accel, step, v0, x0):
    v = v0 + np.concatenate([[0], np.cumsum((accel[1:] + accel[:-1]) / 2) * step])
    return x0 + np.concatenate([[0], np.cumsum((v[1:] + v[:-1]) / 2) * step]), v


def _level(stiff, pressure, step, first, last):
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


def _hips(com, ankle, pitch):
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


def _matrices(heads, tails):
    """World matrices with +Y along each bone (T, B, 4, 4)."""
    y = rotation.unit(tails - heads)
    x = np.cross(y, [0.0, 0.1, 0.03])
    x = rotation.unit(x)
    out = np.tile(np.eye(4), heads.shape[:2] + (1, 1))
    out[..., :3, :3] = np.stack([x, y, np.cross(x, y)], axis=-1)
    out[..., :3, 3] = heads
    return out


def _joints(hips, ankle, pitch, toe, ball_up, lower):
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


def build(
    stances,
    seconds,
    *,
    rate,
    mass=75.0,
    scale=True,
    height=0.98,
    ball_up=0.03,
    lower=ANKLE,
    window=None,
    shake=0.0,
    seed=3,
    share=None,
):
    """A Trial of stances.

    scale: their forces are scaled to carry the body over the clip; share(time, lift): says them instead.
    ball_up, lower: height of ball and ankle over the sole [m], as this rig has its joints; shake: wobble
    of the trunk that no force makes [m].
    """
    count = int(round(seconds * FINE)) + 1
    time = np.arange(count) / FINE
    step = 1.0 / FINE
    lift = np.zeros((2, count))
    for s in stances:
        on = (time >= s.begin) & (time < s.end)
        lift[s.foot, on] += s.shape((time[on] - s.begin) / (s.end - s.begin))
    if share is not None:
        lift = share(time, lift)
    if scale:
        lift /= lift.sum(axis=0).mean()
    total = lift.sum(axis=0)
    accel = (total - 1.0) * G
    z, v = _integrate(accel, step, 0.0, 0.0)
    if scale:  # no drift: the mean speed is none
        z, v = _integrate(accel, step, -np.polyfit(time, z, 1)[0], 0.0)
        z = z - np.polyval(np.polyfit(time, z, 1), time)
        z = z - z.mean() + height
    else:
        z = z + height
    point = _pressure(stances, time)
    pressed = (lift[..., None] * point).sum(axis=0) / np.maximum(total, 1e-9)[:, None]
    stiff = total * G / (z - pressed[:, 2])
    com = np.stack([z, z, z], axis=1)
    for c in (0, 1):
        goal = np.polyval(np.polyfit(time[total > 0.05], pressed[total > 0.05, c], 1), time[[0, -1]])
        com[:, c] = _level(stiff, pressed[:, c], step, *goal)
    force = lift[..., None] * mass * G * (com - point) / np.maximum(com[:, 2:] - point[..., 2:], 0.2)
    ankle, pitch, toe = _feet(stances, time)
    hips = _hips(com, ankle, pitch)
    if shake:  # skin, cloth and breath: slow wobbles of the trunk that no force makes
        random = np.random.default_rng(seed)
        for f in (1.3, 2.1, 3.4, 4.7):
            hips = hips + shake / f * random.normal(size=3) * np.sin(2 * np.pi * (f * time + random.uniform())[:, None])
    heads, tails = _joints(hips, ankle, pitch, toe, ball_up, lower)
    pick = np.round(np.arange(0, seconds * rate + 1e-9) * FINE / rate).astype(int)
    pick = pick[pick < count]
    rest_heads, rest_tails = _rest(ball_up, lower)
    parents = np.array(PARENTS, "i4")
    skeleton = Skeleton(
        NAMES,
        parents,
        _matrices(rest_heads[None], rest_tails[None])[0],
        np.linalg.norm(rest_tails - rest_heads, axis=1),
    )
    motion = Motion(time[pick], NAMES, _matrices(heads[pick], tails[pick]))
    return Trial(
        skeleton,
        motion,
        rate,
        mass,
        time[pick],
        force[:, pick],
        point[:, pick],
        com[pick],
        window or (0.4, seconds - 0.4),
    )


def _rest(ball_up, lower):
    stand = np.array([[0.0, 0.0, ANKLE + THIGH + SHANK]])
    feet = np.array([[[0, HIP_WIDE, ANKLE]], [[0, -HIP_WIDE, ANKLE]]])
    none = np.zeros((2, 1))
    heads, tails = _joints(stand, feet, none, none, ball_up, lower)
    return heads[0], tails[0]


# ---- the trials --------------------------------------------------------------------------------------------


def steps(speed, step, contact, shape, *, seconds=3.0, wide=0.09, **more):
    """Stances of a walk or run: a touch-down every `step` [s], each `contact` [s] long."""
    out = []
    for k in range(-2, int(seconds / step) + 3):
        begin = k * step + 0.1
        side = 1.0 if k % 2 == 0 else -1.0
        ahead = speed * (begin + contact / 2) - 0.05
        out.append(Stance(k % 2, begin, begin + contact, (ahead, side * wide), shape, **more))
    return out


def walk(rate, speed=1.25, step=0.55, **more):
    contact = 2 * step * 0.62
    return build(steps(speed, step, contact, double_hump), 3.0, rate=rate, height=0.95, **more)


def run(rate, speed=3.8, **more):
    return build(
        steps(
            speed,
            0.355,
            0.22,
            heel_run,
            wide=0.05,
            strike=-0.25,
            flat=(0.18, 0.45),
            leave=1.0,
            arrive=(1.2, -0.9),
            part=(1.5, 1.6),
        ),
        3.0,
        rate=rate,
        height=0.94,
        **more,
    )


def dash(rate, **more):
    return build(
        steps(
            9.0,
            0.225,
            0.105,
            sprint,
            wide=0.03,
            strike=0.35,
            flat=(1.0, 0.0),
            leave=1.1,
            arrive=(1.5, -1.8),
            part=(3.0, 2.5),
        ),
        3.0,
        rate=rate,
        height=0.95,
        **more,
    )


def landing(rate, late=0.0, share=0.5, drop=0.4, **more):
    """Off a box of `drop` [m]: both feet down, the right one `late` [s] after the left, `share` on the left."""
    leave, fall = 0.6, np.sqrt(2 * drop / G)
    touch = leave + fall
    speed = G * fall
    wide, long = 0.12, 1.6

    def carry(time, lift):
        t = time - touch
        # what stops the fall: a knock, then the knees; then the weight
        knock = np.exp(-0.5 * ((t - 0.055) / 0.018) ** 2) * (t > 0)
        knees = np.sin(np.pi * np.clip(t / 0.45, 0, 1)) ** 1.5 * (t > 0)
        area = lambda f: f.sum() / FINE
        knock, knees = knock / area(knock) * 0.35 * speed / G, knees / area(knees) * 0.65 * speed / G
        stand = smooth(t / 0.05)
        missing = (1.0 - stand)[t > 0].sum() / FINE
        knees = knees * (1.0 + missing / (0.65 * speed / G))
        total = np.where(t > 0, stand + knock + knees, 0.0)
        right = (1.0 - share) * smooth((t - late) / 0.06 if late else t / 1e-3) * (t > late)
        total_before = np.where(time < leave, 1.0, 0.0)
        left = total * (1.0 - right) + 0.5 * total_before
        return np.stack([left, total * right + 0.5 * total_before])

    flat = lambda u: np.ones_like(u)
    stances = []
    for foot, side in ((0, 1.0), (1, -1.0)):
        stances.append(
            Stance(
                foot,
                -9.0,
                leave,
                (0.0, side * wide),
                flat,
                strike=0.0,
                flat=(0.0, 1.0),
                leave=0.0,
                part=(0.8, 0.2),
                height=drop,
            )
        )
        begin = touch + (late if foot else 0.0)
        stances.append(
            Stance(
                foot,
                begin,
                begin + long,
                (0.45, side * wide),
                flat,
                strike=0.45,
                flat=(0.05, 1.0),
                leave=0.0,
                arrive=(0.2, -0.9 * speed),
            )
        )
    return build(
        stances,
        touch + 1.4,
        rate=rate,
        scale=False,
        height=drop + 0.98,
        share=carry,
        window=(leave + 0.05, touch + 1.2),
        **more,
    )


def squat(rate, uneven=0.0, **more):
    """Three squats of 25 cm; `uneven` shifts the mass centre towards the left by that share of the stance."""
    flat = lambda u: np.ones_like(u)
    stances = [
        Stance(foot, -9.0, 99.0, (0.0, side * 0.18), flat, strike=0.0, flat=(0.0, 1.0), leave=0.0)
        for foot, side in ((0, 1.0), (1, -1.0))
    ]

    def carry(time, lift):
        w = 2 * np.pi / 2.0
        ease = smooth(time / 1.0) * smooth((7.0 - time) / 1.0)
        z = -0.125 * (1 - np.cos(w * time)) * ease
        total = 1.0 + np.gradient(np.gradient(z, 1 / FINE), 1 / FINE) / G
        left = 0.5 + 0.5 * uneven + 0.04 * np.sin(0.7 * w * time)
        return np.stack([total * left, total * (1 - left)])

    return build(stances, 7.0, rate=rate, scale=False, height=0.98, share=carry, window=(0.3, 6.7), **more)


TRIALS = {  # name, maker, limit on the RMSE of a foot [body weights], as for measured trials
    "walk 1.25 m/s": (walk, 0.10),
    "walk 0.8 m/s": (lambda rate, **m: walk(rate, 0.8, 0.68, **m), 0.10),
    "walk 1.9 m/s": (lambda rate, **m: walk(rate, 1.9, 0.45, **m), 0.10),
    "run 3.8 m/s": (run, 0.11),
    "run 2.6 m/s": (lambda rate, **m: run(rate, 2.6, **m), 0.11),
    "sprint 9 m/s": (dash, 0.22),
    "landing": (landing, 0.15),
    "landing, uneven": (lambda rate, **m: landing(rate, 0.04, 0.6, **m), 0.15),
    "squats": (squat, 0.10),
    "squats, uneven": (lambda rate, **m: squat(rate, 0.2, **m), 0.10),
}


def make(name, rate=120.0, **more):
    return TRIALS[name][0](rate, **more)


# ---- how near ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Errors:
    rmse: np.ndarray  # vertical force of each foot (2,) [body weights]
    drive: np.ndarray  # and forward (2,)
    mean: float  # mean vertical force over the true one
    late: np.ndarray  # found minus true contact times [s]


def compare(trial, gait, loads):
    from scenes import plates

    force, on, _ = plates.by_foot(gait, loads)
    true = trial.force / (trial.mass * G)
    inside = (loads.time >= trial.window[0]) & (loads.time <= trial.window[1])
    rms = np.sqrt(((force - true)[:, inside] ** 2).mean(axis=1))
    return Errors(
        rms[:, 2],
        rms[:, 0],
        float(force[:, inside, 2].sum() / true[:, inside, 2].sum()),
        plates.late(loads.time, on, trial.force[..., 2] > plates.CARRIES, inside),
    )


def errors(name, rate=120.0, **more):
    from desire_path.loads import walker
    from desire_path.rig import body

    trial = make(name, rate, **more)
    gait = body.gait_from_bones(trial.skeleton, trial.motion, mass=trial.mass, frame_rate=rate)
    return compare(trial, gait, walker.loads(gait))
