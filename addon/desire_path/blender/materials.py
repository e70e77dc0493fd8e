"""materials.py - a ground is given a material of what it is made of; a material of the user's stays as it is.

    soils, painted soils, plants --recipe--> node groups (looks.py) --> empty slots, or slots of ours
                                                                   --> a group in a material of the user's, to plug in

What is painted is a vertex group, which no shader reads: its shares are kept as float attributes of the mesh, and
written anew by every bake.
"""

import os
import zlib

import bpy
import numpy as np

from ..errors import DesirePathError
from ..files import disk
from ..ground.detail import DETAILS, WALLS, with_clods
from . import axes, compat, cover, look_soils, looks, plants, playback, playback_tree, soils, surfaces

UNTOUCHED = "desire_path_as_made"  # custom property of a material of ours: its name and nodes as we left them
FLOORED = {"EARTH", "PACKED", "MUD"}  # what has a grass floor where plants grow


def detail_of(settings):
    """What a soil is like below a cell, a Detail."""
    name = _soil_name(settings)
    look, wet = look_soils.look_of(name)
    usual = DETAILS.get(name) or DETAILS["wet-sand" if look == "SAND" and wet > 0.5 else _alike(look)]
    return with_clods(usual, soils.soil_of(settings).clod_size)


def wall_of(settings):
    """How rough its high walls are, a deviation [m]."""
    return WALLS.get(_alike(look_soils.look_of(_soil_name(settings))[0]), 0.0)


def _alike(look):
    """Whose grit and walls a look has."""
    return {"CRUST": "snow", "PACKED": "packed-earth"}.get(look, look.lower())


def _soil_name(settings):
    """What the soil of a ground's settings, or of a painted one, is called."""
    if settings.soil_file:
        return bpy.path.display_name_from_filepath(settings.soil_file).lower().replace(" ", "-")
    return settings.soil


def recipe(scene, obj, kind):
    """The looks.Recipe of a ground; kind: one of op_material.KINDS."""
    settings = obj.desire_path
    base, painted = look_soils.look_of(_soil_name(settings)), ()
    if kind == "AUTO":
        its = [(_share(each), *look_soils.look_of(_soil_name(each))) for each in settings.painted]
        painted = tuple(dict.fromkeys(its))
    else:
        base = ("EARTH", base[1] if base[0] == "EARTH" else 0.0) if kind == "GRASS" else (kind, _wet_as(kind, base))
    floor = ""
    if kind == "GRASS" or kind == "AUTO" and settings.plants and base[0] in FLOORED:
        floor = "plants" if settings.plants else "trodden"
    unit = axes.unit_scale(scene)
    scale = tuple(float(np.float32(each * unit)) for each in obj.matrix_world.to_scale())
    more = surfaces.looked(obj, lambda each: look_soils.look_of(_soil_name(each))) if kind == "AUTO" else ()
    return looks.Recipe(base, painted, floor, scale, float(unit), *more)


def _wet_as(kind, base):
    """How wet a look is that was asked for by name: as the soil has it, where that is the same."""
    return base[1] if base[0] == kind else {"MUD": look_soils.SOILS["mud"][1]}.get(kind, 0.0)


def _share(painted):
    return looks.SHARE.format(_soil_name(painted))


def is_ours(material):
    """Whether we made a material."""
    return material is not None and looks.TAG in material


def _called(plan):
    there = [plan.base[0], *(each[1] for each in plan.painted + plan.seen)]
    names = dict.fromkeys(look_soils.LOOKS[look][0] for look in there)
    if plan.floor:
        names["Grass"] = None
    wet = "Wet " if plan.base[0] in {"SAND", "EARTH"} and plan.base[1] > 0.5 else ""
    return f"Desire Path {wet}{', '.join(names)}"


# ---- materials ----------------------------------------------------------------------------------------


def add(scene, obj, kind="AUTO", replace=False):
    """Give a ground its material; returns a sentence that tells what was done.

    kind: one of op_material.KINDS; replace: in place of the user's own materials
    Raises DesirePathError where nothing can be done; then nothing has changed.
    """
    plan = recipe(scene, obj, kind)
    theirs = _of_the_user(obj)
    own = [] if replace else theirs
    _check(obj, own, plan)
    _shares(obj)
    _grown(obj)
    group = looks.ground(plan, _called(plan))
    sentences = []
    if own:
        sentences += [_offer(each, group) for each in own]
    free = [k for k, slot in enumerate(obj.material_slots) if replace or not _is_users(slot.material)]
    if free or not len(obj.material_slots):
        material = _material(plan, group, [slot.material for slot in obj.material_slots])
        _fill(obj, free, material)
        sentences.append(f"'{obj.name}' is made of '{material.name}'.{_guessed(obj, kind)}")
    if replace:
        sentences += [_keep(each) for each in theirs if each.users == 0]
    return " ".join((*sentences, *_tidy()))


def _guessed(obj, kind):
    """What to say of a look that goes by the name of a file which says nothing of it."""
    name = _soil_name(obj.desire_path)
    if (
        kind != "AUTO"
        or not obj.desire_path.soil_file
        or any(word in name for word, _ in (*look_soils.WORDS, ("earth", "")))
    ):
        return ""
    return f" The name of its soil file, '{name}', says no look: it is taken for earth; Kind chooses another."


def _keep(material):
    """A material of the user's that nothing shows any more stays in the file."""
    if material.library is not None:
        return f"'{material.name}' is shown by nothing now."
    material.use_fake_user = True
    return f"'{material.name}' is yours and stays in the file, by a fake user."


def _is_users(material):
    return material is not None and not is_ours(material)


def _of_the_user(obj):
    """The user's own materials on an object, each once."""
    return list(dict.fromkeys(slot.material for slot in obj.material_slots if _is_users(slot.material)))


def _check(obj, own, plan):
    """Say beforehand what cannot be done."""
    for each in (obj.desire_path, *obj.desire_path.painted):
        if each.soil_file:
            soils.soil_of(each)  # a file that no bake would take
    mesh = obj.data
    if mesh.library is not None and not len(obj.material_slots):
        raise DesirePathError(
            f"The mesh '{mesh.name}' of '{obj.name}' is linked from another file and has no material slot: make the "
            "mesh local, or give it a material in that file."
        )
    if mesh.library is not None and any(name not in mesh.attributes for name, *_ in (*plan.painted, *plan.lain)):
        raise DesirePathError(
            f"The mesh '{mesh.name}' of '{obj.name}' is linked from another file, so where its soils are painted "
            "cannot be written into it: make the mesh local, or choose one look for all of it as Kind."
        )
    for each in own:
        if each.library is not None:
            raise DesirePathError(
                f"The material '{each.name}' of '{obj.name}' is linked from another file: make it local, or tick "
                "Replace to use another one in its place."
            )
        if not each.use_nodes or each.node_tree is None:
            raise DesirePathError(
                f"The material '{each.name}' of '{obj.name}' uses no nodes: turn on Use Nodes in its tab, or tick "
                "Replace to use another one in its place."
            )


def _material(plan, group, shown):
    """The material of this file that shows a group, created where there is none.

    One that was tuned by hand serves the ground that shows it, and no other.
    """
    mark = group[looks.TAG]
    for each in bpy.data.materials:
        serves = each.library is None and each.get(looks.TAG) == mark and _shows(each, group)
        if serves and (each in shown or each.get(UNTOUCHED) == _print_of(each)):
            return each
    return _new(plan, group)


def _new(plan, group):
    """A material of its own that shows a group."""
    material, mark = bpy.data.materials.new(_called(plan)), group[looks.TAG]
    if not material.use_nodes:
        material.use_nodes = True
    material[looks.TAG] = mark
    tree = material.node_tree
    tree.nodes.clear()
    n = looks.Shade(tree)
    node = n.add("ShaderNodeGroup", {"node_tree": group, "width": 240.0})
    leave = n.add("ShaderNodeOutputMaterial", Surface=node.outputs["Shader"])
    leave.location = (300.0, 0.0)
    material[UNTOUCHED] = _print_of(material)
    material.diffuse_color = (*look_soils.SOLID.get(plan.base[0], (0.09, 0.06, 0.036)), 1.0)  # in solid view
    return material


def _print_of(material):
    """Its name and nodes in words: what a hand that tunes it changes."""
    tree = material.node_tree
    said = [material.name]
    for node in sorted(tree.nodes, key=lambda each: each.name):
        said += [node.name, node.bl_idname, f"{node.mute}"]
        for socket in node.inputs:
            value = getattr(socket, "default_value", None)
            said.append(f"{tuple(value) if hasattr(value, '__len__') and not isinstance(value, str) else value}")
    said += sorted(f"{each.from_node.name} {each.from_socket.name} {each.to_node.name}" for each in tree.links)
    return zlib.crc32("\n".join(said).encode()) & 0x7FFFFFFF


def _shows(material, group):
    tree = material.node_tree
    return tree is not None and any(getattr(each, "node_tree", None) == group for each in tree.nodes)


def _offer(material, group):
    """Put the group into a material of the user's, unconnected."""
    tree = material.node_tree
    old = [each for each in tree.nodes if each.bl_idname == "ShaderNodeGroup" and _is_grounds(each.node_tree)]
    if old:
        for each in old:
            each.node_tree = group  # links stay, by the names of sockets
        return f"'{material.name}' is yours: its node group shows the soils as they are now."
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree, node.width = group, 240.0
    places = [each.location for each in tree.nodes if each != node]
    if places:
        node.location = (min(each.x for each in places), min(each.y for each in places) - 400.0)
    for each in tree.nodes:
        each.select = each == node
    tree.nodes.active = node
    return f"'{material.name}' is yours and stays as it is: the node group '{group.name}' in it can be plugged in."


def _is_grounds(tree):
    return tree is not None and looks.TAG in tree and "Normal" in _outputs(tree)


def _outputs(tree):
    if hasattr(tree, "interface"):
        return {each.name for each in tree.interface.items_tree if getattr(each, "in_out", "") == "OUTPUT"}
    return set(tree.outputs.keys())


def _fill(obj, free, material):
    """Put a material into slots; those of a mesh that is linked or others' too are the object's own from then on."""
    theirs = obj.data.library is not None or obj.data.users > 1
    if not len(obj.material_slots):
        obj.data.materials.append(None if theirs else material)
        free = [0]
    for k in free:
        slot = obj.material_slots[k]
        if slot.link == "DATA" and theirs:
            slot.link = "OBJECT"
        slot.material = material


def _tidy():
    """Remove what was ours and is used no more, but what was tuned by hand; sentences that tell what was kept."""
    sentences = []
    for each in list(bpy.data.materials):
        if each.library is None and is_ours(each) and each.users == 0:
            if each.get(UNTOUCHED) == _print_of(each):
                bpy.data.materials.remove(each)
            else:
                sentences.append(_keep(each))
    for _ in range(2):  # grounds, then looks
        for each in list(bpy.data.node_groups):
            if each.library is None and looks.TAG in each and each.users == 0:
                bpy.data.node_groups.remove(each)
    return sentences


# ---- assets ---------------------------------------------------------------------------------------------

LIBRARY = "Desire Path"  # what the library is called in the Asset Browser
FILE = "desire_path_looks.blend"
ASSETS = (
    *(looks.Recipe((look, 0.0)) for look in look_soils.LOOKS if look != "GRASS"),
    looks.Recipe(look_soils.SOILS["wet-sand"]),
    looks.Recipe(("EARTH", 0.0), floor="trodden"),
)


def write_library(folder):
    """Write a file of all looks as assets to a folder and let the Asset Browser know of it; returns its path."""
    path = os.path.join(folder, FILE)
    written = []
    try:
        for each in ASSETS:
            material = _new(each, looks.ground(each, _called(each)))
            written.append(material)
            material.asset_mark()
            material.asset_data.description = "Ground that shows what Desire Path baked into it"
            material.asset_data.tags.new("ground")
        _write(path, set(written))
    finally:
        for material in written:
            bpy.data.materials.remove(material)
        _tidy()
    known = bpy.context.preferences.filepaths.asset_libraries
    if not any(os.path.realpath(each.path) == os.path.realpath(folder) for each in known):
        bpy.ops.preferences.asset_library_add(directory=folder)
        known[-1].name = LIBRARY
    return path


def _write(path, blocks):
    """Write datablocks to a .blend file, whole or not at all."""
    new = path + ".new"
    try:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        bpy.data.libraries.write(new, blocks, fake_user=True, compress=True)
        disk.replace(new, path)  # not there where it could not be written
    except (OSError, RuntimeError) as problem:
        raise DesirePathError(f"{path} cannot be written, choose another folder: {problem}.") from None
    finally:
        if os.path.isfile(new):
            os.remove(new)


# ---- attributes that the materials read ------------------------------------------------------------------


def refresh(obj):
    """Write what a ground's material reads beside what was baked; nothing where it has none of ours."""
    if any(is_ours(each) or each is not None and _holds(each) for each in obj.data.materials):
        _shares(obj)


def forget(obj):
    """A bake was freed: plants stand again as they grew."""
    if any(is_ours(each) or each is not None and _holds(each) for each in obj.data.materials):
        _grown(obj)


def _holds(material):
    tree = material.node_tree
    return tree is not None and any(_is_grounds(getattr(each, "node_tree", None)) for each in tree.nodes)


def shares(obj):
    """The share of each painted soil and layer at the points of a mesh, by attribute, float32 (n,)."""
    count, found = len(obj.data.vertices), {}
    for each in obj.desire_path.painted:
        weight = cover.group_weights(obj, each.vertex_group)
        name = _share(each)
        found[name] = found.get(name, np.zeros(count, np.float32)) + (0.0 if weight is None else weight)
    total = np.maximum(sum(found.values(), np.zeros(count, np.float32)), 1.0)
    found = {name: (weight / total).astype(np.float32) for name, weight in found.items()}
    return {**found, **surfaces.shares(obj)}


def _shares(obj):
    mesh = obj.data
    if mesh.library is not None:
        return
    written = shares(obj)
    for name in [each.name for each in mesh.attributes if each.name.startswith(looks.SHARE.format(""))]:
        if name not in written:
            mesh.attributes.remove(mesh.attributes[name])
    for name, values in written.items():
        there = mesh.attributes.get(name) or mesh.attributes.new(name, "FLOAT", "POINT")
        if compat.float_attribute(mesh, there.name) is not None:
            there.data.foreach_set("value", values)


def _grown(obj):
    """Plants as they grew, where no bake says how they are."""
    mesh, settings = obj.data, obj.desire_path
    name = playback_tree.STRENGTH
    if not settings.plants or playback.modifier(obj) is not None or mesh.library is not None or name in mesh.attributes:
        return
    scene = obj.users_scene[0] if obj.users_scene else bpy.context.scene
    world = axes.matrix(obj.matrix_world, obj.name)
    values = cover.grown(obj, world, axes.unit_scale(scene), plants.standing(obj))
    mesh.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", values)
    settings.made_attributes = ",".join(filter(None, (settings.made_attributes, name)))
