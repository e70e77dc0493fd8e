"""mannequin.py - a plain walker of one skinned mesh, with shoes, built around a recorded skeleton.

The body is a union of ellipsoids and tapered capsules about the bones, made one smooth skin; each
vertex follows the bones whose shapes it is nearest to. Shoes are modelled flat on the ground, as
the recording shows the feet in mid-stance, and then carried back to the rest pose, so that a sole
is level when its foot stands.
"""

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

# (bone, start, end, radius at start, radius at end); a place is a bone's name for its head,
# (name, share) for a point along it, or a point of the rest pose [m]
BODY = (
    ("Hips", (-0.045, -0.030, -0.045), (0.045, -0.030, -0.045), 0.112, 0.112),
    ("Hips", (-0.075, -0.005, -0.085), (0.075, -0.005, -0.085), 0.092, 0.092),
    ("LowerBack", (-0.035, -0.015, 0.055), (0.035, -0.015, 0.055), 0.100, 0.100),
    ("Spine", (-0.045, -0.008, 0.130), (0.045, -0.008, 0.130), 0.102, 0.102),
    ("Spine1", (-0.065, 0.005, 0.215), (0.065, 0.005, 0.215), 0.108, 0.108),
    ("Spine1", (-0.095, 0.022, 0.262), (0.095, 0.022, 0.262), 0.074, 0.074),
    ("Neck", (0.0, 0.020, 0.300), (0.0, 0.018, 0.390), 0.058, 0.050),
    ("Neck1", (0.0, 0.018, 0.370), (0.0, 0.014, 0.440), 0.050, 0.050),
    ("Head", (0.0, 0.014, 0.515), (0.0, 0.000, 0.500), 0.101, 0.099),
    ("Head", (0.0, -0.036, 0.445), (0.0, -0.016, 0.480), 0.054, 0.082),
)
SIDE = (  # once for each side, the names completed by it
    ("Shoulder", ("Shoulder", 0.45), ("Arm", 0.0), 0.066, 0.060),
    ("Arm", ("Arm", 0.0), ("ForeArm", 0.0), 0.057, 0.042),
    ("ForeArm", ("ForeArm", 0.0), ("ForeArm", 0.55), 0.042, 0.043),
    ("ForeArm", ("ForeArm", 0.5), ("ForeArm", 1.45), 0.043, 0.029),
    ("Hand", ("Hand", 0.55), ("Hand", 0.95), 0.034, 0.038),
    ("Hand", ("Hand", 0.95), ("Hand", 1.35), 0.036, 0.022),
    ("UpLeg", ("UpLeg", 0.04), ("UpLeg", 0.5), 0.094, 0.080),
    ("UpLeg", ("UpLeg", 0.5), ("Leg", 0.0), 0.080, 0.058),
    ("Leg", ("Leg", 0.0), ("Leg", 0.32), 0.057, 0.056),
    ("Leg", ("Leg", 0.25), ("Leg", 0.98), 0.056, 0.040),
)
CLOTHES = {"Hips": 1, "UpLeg": 1, "Leg": 1, "Head": 2, "Hand": 2, "Neck": 2, "Neck1": 2}
HEM, COLLAR = 0.0, 0.335  # how high the jacket begins and ends in the rest pose [m]
BLEND = 0.022  # how soft the skin changes from bone to bone [m]
VOXEL = 0.011  # [m]

FEWEST = 5  # frames in which a foot stands
ANKLE = 0.082  # the ankle over the ground in mid-stance, shoes on [m]
HEEL_BEHIND = 0.062  # the shoe's end behind the ankle [m]
TIP_AHEAD = 0.024  # its tip ahead of the toe bone's end [m]
SOLE = 0.024  # thickness of the outsole [m]
EDGE = 0.007  # its lower edge is this round [m]
# share of the length from heel to tip, half width on the inner and the outer side (in lengths),
# height of the upper over the outsole [m]
LAST = np.array(
    (
        (0.000, 0.000, 0.000, 0.070),
        (0.012, 0.048, 0.048, 0.072),
        (0.045, 0.088, 0.088, 0.074),
        (0.100, 0.112, 0.114, 0.076),
        (0.180, 0.118, 0.124, 0.078),
        (0.280, 0.106, 0.126, 0.079),
        (0.400, 0.096, 0.132, 0.073),
        (0.520, 0.112, 0.148, 0.061),
        (0.620, 0.142, 0.164, 0.052),
        (0.700, 0.160, 0.170, 0.046),
        (0.780, 0.164, 0.158, 0.042),
        (0.860, 0.152, 0.132, 0.039),
        (0.920, 0.128, 0.100, 0.036),
        (0.965, 0.092, 0.066, 0.031),
        (0.990, 0.050, 0.034, 0.025),
        (1.000, 0.008, -0.006, 0.020),
    )
)


def add(armature):
    """A mannequin bound to an armature with the bones of the CMU walk; returns its mesh object."""
    vertices, faces, weights, material = _body(armature)
    parts = [(vertices, faces, weights, material)]
    for side in ("Left", "Right"):
        parts.append(_shoe(armature, side))
    bones = [bone.name for bone in armature.data.bones]
    count, all_faces, all_material = 0, [], []
    for vertices, faces, _, material in parts:
        all_faces += [[v + count for v in face] for face in faces]
        all_material += list(material)
        count += len(vertices)
    mesh = bpy.data.meshes.new("Mannequin")
    mesh.from_pydata(np.concatenate([p[0] for p in parts]).tolist(), [], all_faces)
    mesh.polygons.foreach_set("material_index", np.array(all_material, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(all_faces), bool))
    _face_outwards(mesh)
    mesh.update()
    obj = bpy.data.objects.new("Mannequin", mesh)
    bpy.context.scene.collection.objects.link(obj)
    first = 0
    for vertices, _, weights, _ in parts:
        for name, weight in weights.items():
            group = obj.vertex_groups.get(name) or obj.vertex_groups.new(name=name)
            level = np.round(weight * 256).astype(int)
            for each in np.unique(level[level > 1]):
                rows = np.flatnonzero(level == each) + first
                group.add(rows.tolist(), each / 256, "REPLACE")
        first += len(vertices)
    assert all(group.name in bones for group in obj.vertex_groups)
    obj.parent = armature
    bound = obj.modifiers.new("Armature", "ARMATURE")
    bound.object = armature
    return obj


def _face_outwards(mesh):
    work = bmesh.new()
    work.from_mesh(mesh)
    bmesh.ops.recalc_face_normals(work, faces=work.faces)
    work.to_mesh(mesh)
    work.free()


# ---- the body ------------------------------------------------------------------------------------


def _place(armature, at, side=""):
    if len(at) == 3:
        return np.array(at)
    name, share = at
    bone = armature.data.bones[side + name]
    return np.array(bone.head_local) + share * (np.array(bone.tail_local) - bone.head_local)


def _shapes(armature):
    out = [(bone, _place(armature, a), _place(armature, b), r, s) for bone, a, b, r, s in BODY]
    for side in ("Left", "Right"):
        out += [(side + bone, _place(armature, a, side), _place(armature, b, side), r, s) for bone, a, b, r, s in SIDE]
    return out


def _distance(points, a, b, r, s):
    """From points to the surface of a tapered capsule [m]."""
    axis = b - a
    along = np.clip((points - a) @ axis / max(axis @ axis, 1e-12), 0.0, 1.0)
    near = a + along[:, None] * axis
    return np.linalg.norm(points - near, axis=1) - (r + along * (s - r))


def _body(armature):
    shapes = _shapes(armature)
    hull = bmesh.new()
    for _, a, b, r, s in shapes:
        _capsule(hull, a, b, r, s)
    mesh = bpy.data.meshes.new("hull")
    hull.to_mesh(mesh)
    hull.free()
    obj = bpy.data.objects.new("hull", mesh)
    bpy.context.scene.collection.objects.link(obj)
    one = obj.modifiers.new("one skin", "REMESH")
    one.mode, one.voxel_size = "VOXEL", VOXEL
    soft = obj.modifiers.new("soft", "SMOOTH")
    soft.factor, soft.iterations = 0.5, 10
    done = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    vertices = np.empty((len(done.vertices), 3), np.float32)
    done.vertices.foreach_get("co", vertices.ravel())
    faces = [list(p.vertices) for p in done.polygons]
    bpy.data.objects.remove(obj)
    bpy.data.meshes.remove(mesh)

    names = sorted({shape[0] for shape in shapes})
    distance = np.full((len(names), len(vertices)), 9.0)
    for bone, a, b, r, s in shapes:
        row = names.index(bone)
        distance[row] = np.minimum(distance[row], _distance(vertices.astype(float), a, b, r, s))
    share = np.exp(-np.clip(distance - distance.min(axis=0), 0.0, 1.0) / BLEND)
    share[share < 0.02] = 0.0
    share /= share.sum(axis=0)
    bone_of = share.argmax(axis=0)
    dress = np.array([CLOTHES.get(n.replace("Left", "").replace("Right", ""), 0) for n in names])
    material = np.array([dress[bone_of[face[0]]] for face in faces])
    # the hem and the collar are level, whichever bone moves them
    high = np.array([vertices[face, 2].mean() for face in faces])
    of = np.array(names)[bone_of[[face[0] for face in faces]]]
    waist, throat = np.isin(of, ("Hips", "LowerBack")), np.isin(of, ("Spine1", "Neck"))
    material[waist] = np.where(high[waist] > HEM, 0, 1)
    material[throat] = np.where(high[throat] > COLLAR, 2, 0)
    return vertices, faces, dict(zip(names, share)), material


def _capsule(hull, a, b, r, s):
    """Two balls and the cone between, as closed meshes that overlap."""
    for at, radius in ((a, r), (b, s)):
        bmesh.ops.create_uvsphere(hull, u_segments=24, v_segments=14, radius=radius, matrix=Matrix.Translation(at))
    axis = b - a
    length = float(np.linalg.norm(axis))
    if length > 1e-4:
        turn = Vector(axis).to_track_quat("Z", "Y").to_matrix().to_4x4()
        bmesh.ops.create_cone(
            hull,
            cap_ends=True,
            segments=24,
            radius1=r,
            radius2=s,
            depth=length,
            matrix=Matrix.Translation((a + b) / 2) @ turn,
        )


# ---- shoes ---------------------------------------------------------------------------------------


def _stance(armature, side):
    """Bone matrices of foot and toe in the standing foot's frame, averaged over the clip.

    The frame: x along the foot, z up, the origin on the ground under the ankle.
    """
    scene = bpy.context.scene
    first, last = armature.animation_data.action.frame_range
    frames = range(int(np.ceil(first)), int(last) + 1)
    now = scene.frame_current
    foot, toe = [], []
    for frame in frames:
        scene.frame_set(frame)
        foot.append(np.array(armature.pose.bones[side + "Foot"].matrix))
        toe.append(np.array(armature.pose.bones[side + "ToeBase"].matrix))
    scene.frame_set(now)
    foot, toe = np.array(foot), np.array(toe)
    rate = scene.render.fps / scene.render.fps_base
    speed = np.maximum(*(np.linalg.norm(np.gradient(m[:, :3, 3], axis=0), axis=1) * rate for m in (foot, toe)))
    stands = speed <= max(0.09, np.sort(speed)[FEWEST - 1])  # a runner's foot never stands for long
    mean_foot, mean_toe = [], []
    for m, n in zip(foot[stands], toe[stands]):
        ahead = (n[:3, 3] - m[:3, 3]) * (1, 1, 0)
        ahead /= np.linalg.norm(ahead)
        frame = np.eye(4)
        frame[:3, 0], frame[:3, 2] = ahead, (0, 0, 1)
        frame[:3, 1] = np.cross((0, 0, 1), ahead)
        frame[:3, 3] = m[:3, 3] - (0, 0, ANKLE)
        mean_foot.append(np.linalg.solve(frame, m))
        mean_toe.append(np.linalg.solve(frame, n))
    return _mean(mean_foot), _mean(mean_toe)


def _mean(matrices):
    mean = np.median(matrices, axis=0)
    u, _, v = np.linalg.svd(mean[:3, :3])
    mean[:3, :3] = u @ v
    return mean


def _rim(u):
    return [np.interp(u, LAST[:, 0], LAST[:, k]) for k in (1, 2, 3)]


def _shoe(armature, side):
    foot_stands, toe_stands = _stance(armature, side)
    ball = toe_stands[0, 3]
    tip = (toe_stands @ (0, armature.data.bones[side + "ToeBase"].length, 0, 1))[0] + TIP_AHEAD
    length = tip + HEEL_BEHIND
    inner = -1.0 if side == "Left" else 1.0  # y of the inner side; the foot looks along +x
    vertices, faces, material = [], [], []
    _loft(vertices, faces, material, _outsole, length, inner, 4)
    _loft(vertices, faces, material, _upper, length, inner, 3)
    vertices = np.array(vertices)
    x = vertices[:, 0]
    bend = np.clip((x - ball + 0.022) / 0.044, 0.0, 1.0)
    bend = bend * bend * (3 - 2 * bend)
    # back to the rest pose: undo what the two bones will do to it
    rest = {}
    for name, stands in (("Foot", foot_stands), ("ToeBase", toe_stands)):
        bone = armature.data.bones[side + name]
        rest[name] = stands @ np.linalg.inv(np.array(bone.matrix_local))
    mixed = (1 - bend)[:, None, None] * rest["Foot"] + bend[:, None, None] * rest["ToeBase"]
    flat = np.concatenate([vertices, np.ones((len(vertices), 1))], axis=1)
    back = np.linalg.solve(mixed, flat[..., None])[:, :3, 0]
    return (back.astype(np.float32), faces, {side + "Foot": 1 - bend, side + "ToeBase": bend}, material)


def _loft(vertices, faces, material, section, length, inner, slot):
    """Rings of equal size along the foot, closed at both ends."""
    u = np.unique(
        np.concatenate([LAST[:, 0], np.linspace(0, 1, 45), 1 - np.linspace(0, 0.05, 8), np.linspace(0, 0.05, 8)])
    )
    rings = []
    for each in u:
        ring = section(each, length)
        ring[:, 0] *= inner
        start = len(vertices)
        vertices += [(each * length - HEEL_BEHIND, y, z) for y, z in ring]
        rings.append(range(start, start + len(ring)))
    n = len(rings[0])
    for low, high in zip(rings, rings[1:]):
        for k in range(n):
            faces.append([low[k], high[k], high[(k + 1) % n], low[(k + 1) % n]])
    faces += [list(rings[0]), list(rings[-1])]
    material += [slot] * (len(faces) - len(material))


def _widths(u, length, more=0.0):
    inner, outer, height = _rim(u)
    return inner * length + more, outer * length + more, height


def _lift(u):
    """How far the sole's underside is off the ground: toe spring, and the waist before the heel."""
    spring = 0.012 * np.clip((u - 0.80) / 0.20, 0, 1) ** 2
    heel = 0.004 * np.clip(1 - u / 0.06, 0, 1) ** 2
    waist = np.clip(1 - abs(u - 0.38) / 0.11, 0, 1)
    return spring + heel + 0.004 * waist * waist * (3 - 2 * waist)


def _outsole(u, length):
    """y (inner side positive) and z around the outsole at a share of its length."""
    inner, outer, _ = _widths(u, length, 0.003)
    low = _lift(u)
    end = min(u, 1 - u) * length
    edge = EDGE * (1 - np.sqrt(max(1 - (1 - min(end / EDGE, 1)) ** 2, 0)))
    base = low + edge
    r = min(EDGE, 0.45 * max(inner + outer, 1e-3))
    turn = np.linspace(0, np.pi / 2, 5)
    wall = [(r * (1 - np.cos(t)), base + r * (1 - np.sin(t))) for t in turn]
    outside = [(-outer + y, z) for y, z in wall]
    under = [(y, base) for y in np.linspace(-outer + r, inner - r, 7)[1:-1]]
    inside = [(inner - y, z) for y, z in reversed(wall)]
    top = max(SOLE + 0.4 * low, base + r + 0.001)
    above = [(inner - 0.001, top), (0.3 * inner, top), (-0.3 * outer, top), (-outer + 0.001, top)]
    return np.array(outside + under + inside + above)


def _upper(u, length):
    inner, outer, height = _widths(u, length, -0.002)
    foot = SOLE - 0.004 + 0.4 * _lift(u)
    angle = np.linspace(0, np.pi, 17)
    middle, half = (inner - outer) / 2, max((inner + outer) / 2, 1e-4)
    power = 0.62
    y = middle - half * np.sign(np.cos(angle)) * abs(np.cos(angle)) ** power
    z = foot + height * np.sin(angle) ** power
    # the shaft narrows towards its top, over the ankle
    narrow = np.clip(1 - abs(u - 0.22) / 0.30, 0, 1) * 0.22
    y = middle + (y - middle) * (1 - narrow * ((z - foot) / max(height, 1e-4)) ** 2)
    return np.stack([y, z], axis=1)
