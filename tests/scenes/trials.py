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

from desire_path.rig.body import Motion, Skeleton

from .trial_body import (
    ANKLE,
    FINE,
    NAMES,
    PARENTS,
    G,
    at_rest,
    double_hump,
    feet_of,
    heel_run,
    hips_of,
    integrate,
    joints_of,
    level,
    matrices_of,
    pressure_of,
    smooth,
    sprint,
)

FEET = ("L", "R")


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


def _carried(lift, point, time, scale, height):
    """The mass centre (T, 3) [m] that forces from their centres of pressure move; scale: its mean speed is none."""
    step = 1.0 / FINE
    total = lift.sum(axis=0)
    accel = (total - 1.0) * G
    z, v = integrate(accel, step, 0.0, 0.0)
    if scale:  # no drift: the mean speed is none
        z, v = integrate(accel, step, -np.polyfit(time, z, 1)[0], 0.0)
        z = z - np.polyval(np.polyfit(time, z, 1), time)
        z = z - z.mean() + height
    else:
        z = z + height
    pressed = (lift[..., None] * point).sum(axis=0) / np.maximum(total, 1e-9)[:, None]
    stiff = total * G / (z - pressed[:, 2])
    com = np.stack([z, z, z], axis=1)
    for c in (0, 1):
        goal = np.polyval(np.polyfit(time[total > 0.05], pressed[total > 0.05, c], 1), time[[0, -1]])
        com[:, c] = level(stiff, pressed[:, c], step, *goal)
    return com


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
    lift = np.zeros((2, count))
    for s in stances:
        on = (time >= s.begin) & (time < s.end)
        lift[s.foot, on] += s.shape((time[on] - s.begin) / (s.end - s.begin))
    if share is not None:
        lift = share(time, lift)
    if scale:
        lift /= lift.sum(axis=0).mean()
    point = pressure_of(stances, time)
    com = _carried(lift, point, time, scale, height)
    force = lift[..., None] * mass * G * (com - point) / np.maximum(com[:, 2:] - point[..., 2:], 0.2)
    ankle, pitch, toe = feet_of(stances, time)
    hips = hips_of(com, ankle, pitch)
    if shake:  # skin, cloth and breath: slow wobbles of the trunk that no force makes
        random = np.random.default_rng(seed)
        for f in (1.3, 2.1, 3.4, 4.7):
            hips = hips + shake / f * random.normal(size=3) * np.sin(2 * np.pi * (f * time + random.uniform())[:, None])
    heads, tails = joints_of(hips, ankle, pitch, toe, ball_up, lower)
    pick = np.round(np.arange(0, seconds * rate + 1e-9) * FINE / rate).astype(int)
    pick = pick[pick < count]
    rest_heads, rest_tails = at_rest(ball_up, lower)
    parents = np.array(PARENTS, "i4")
    skeleton = Skeleton(
        NAMES,
        parents,
        matrices_of(rest_heads[None], rest_tails[None])[0],
        np.linalg.norm(rest_tails - rest_heads, axis=1),
    )
    motion = Motion(time[pick], NAMES, matrices_of(heads[pick], tails[pick]))
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
