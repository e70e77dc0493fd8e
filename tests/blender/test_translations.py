"""Every label, description and reason of the add-on is in every language there is, and Blender finds it there."""

import ast
import pathlib

import bpy

import desire_path.blender as addon
from desire_path.blender import (
    compat,
    panels,
    props,
    sentences,
    soils,
    state,
    translations,
    translations_crowd,
    translations_described,
    translations_said,
    translations_soil,
    translations_track,
)

FOLDER = pathlib.Path(addon.__file__).parent
FITS = {"label": 23, "prop": 14, "prop_search": 14}  # letters in a line of the sidebar: alone, beside a number
WIDER = {"manual.py"}  # what is drawn in the preferences
DRAWS = {"label": "*", "prop": "*", "prop_search": "*", "menu": "*", "operator": "Operator"}


def of_classes():
    """(context, label) of operators, panels, menus, and of what they and objects remember."""
    for each in addon._CLASSES:
        operator = issubclass(each, bpy.types.Operator)
        if getattr(each, "bl_label", ""):
            yield getattr(each, "bl_translation_context", "Operator" if operator else "*"), each.bl_label
    for group in props.CLASSES:
        for each in group.bl_rna.properties:
            if each.identifier in group.__annotations__ and not each.is_hidden and each.name != each.identifier:
                yield each.translation_context, each.name
                for item in each.enum_items if each.type == "ENUM" else ():
                    yield each.translation_context, item.name


def of_panels(draws=tuple(DRAWS), but=()):
    """(context, label) of every text that is written out where panels draw; but: files that are left out."""
    for path in sorted(each for each in FOLDER.glob("*.py") if each.name not in but):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr in draws:
                words = (word.value for word in call.keywords if word.arg == "text")
                for text in (each for value in words for each in ast.walk(value) if isinstance(each, ast.Constant)):
                    if isinstance(text.value, str) and text.value[:1].isupper():
                        yield DRAWS[call.func.attr], text.value


def of_lines():
    """(context, label) of every text that is written out where panels break lines."""
    for path in sorted(FOLDER.glob("*.py")):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            lines = isinstance(call, ast.Call) and getattr(call.func, "id", "") == "_lines"
            if lines and isinstance(call.args[1], ast.Constant):
                yield "*", call.args[1].value


def descriptions():
    """What Blender tells beside the pointer of operators, of their numbers, and of what objects remember."""
    for each in addon._CLASSES:
        if issubclass(each, bpy.types.Operator):
            room, name = each.bl_idname.split(".")
            told = getattr(getattr(bpy.ops, room), name).get_rna_type()
            own = {name for base in each.__mro__ for name in getattr(base, "__annotations__", ()) if ours(base)}
            yield told.description
            yield from of_numbers(told.properties, own)
    for group in props.CLASSES:
        yield from of_numbers(group.bl_rna.properties, group.__annotations__)


def ours(base):
    return base.__module__.startswith(addon.__name__)


def of_numbers(properties, own):
    for each in properties:
        if each.identifier in own and not each.is_hidden:
            yield each.description
            for item in each.enum_items if each.type == "ENUM" else ():
                yield item.description


def reasons():
    """Why buttons cannot be pressed, and what else is said in the user's language."""
    for path in sorted(FOLDER.glob("*.py")):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(call, ast.Call):
                continue
            name = getattr(call.func, "attr", None) or f"a call of {getattr(call.func, 'id', '')}"
            if name in {"poll_message_set", "a call of say"} and isinstance(call.args[0], ast.Constant):
                yield call.args[0].value
            if name == "poll_message_set":
                said = ast.unparse(call.args[0])
                assert not said.startswith("f") or said == "f'Select {words} first'", f"{path.name}: {said}"
            if name == "a call of active" and len(call.args) == 4:
                yield f"Select {call.args[3].value} first"


def labels():
    return {*of_classes(), *of_panels(), *(("*", word) for word, _ in state.LOOKS.values())}


def test_every_word_is_in_every_language():
    told, said = set(filter(None, descriptions())), set(reasons())
    assert len(labels()) > 100 and len(told) > 120 and len(said) > 15
    wanted = {*labels(), *(("*", text) for text in told | said)}
    for language, table in translations.TABLE.items():
        lacks = {key for key in of_lines() if sentences.said(language, key[1]) == key[1]}
        missing = sorted((wanted | lacks) - set(table))
        assert not missing, f"{language} lacks {missing}"
        assert all(text.strip() == text and text for text in table.values())
        same = [text for (_, label), text in table.items() if text == label and len(label) > 20]
        assert not same and all(text.count("{") == label.count("{") for (_, label), text in table.items()), same


def test_words_of_objects_are_ours():
    """Blender's own catalogue calls an update a step, and never asks for another word of that context."""
    own = [
        each for group in props.CLASSES for each in group.bl_rna.properties if each.identifier in group.__annotations__
    ]
    assert len(own) > 100
    if compat.CONTEXTS:  # else panels say the context
        assert {each.translation_context for each in own} == {compat.WORDS}
    drawn = [
        node
        for path in (*FOLDER.glob("panels*.py"), FOLDER / "soils.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    ]
    drawn = [each for each in drawn if isinstance(each, ast.Call) and getattr(each.func, "attr", "") == "prop"]
    said = [{word.arg: ast.unparse(word.value) for word in each.keywords} for each in drawn]
    assert len(said) > 4 and all("text_ctxt" in each or each.get("text") == "''" for each in said)


def test_what_is_written_out_fits_the_sidebar():
    """Longer labels go through panels._lines, which breaks them."""
    for kind, letters in FITS.items():
        for key in of_panels((kind,), WIDER):
            for text in (key[1], *(table[key] for table in translations.TABLE.values())):
                assert len(text) <= letters, f"'{text}' has {len(text)} letters, and {kind} room for {letters}"


def test_panels_of_a_ground_stand_in_the_order_of_work():
    for place in ("PHYSICS", "VIEW3D"):
        parts = [each for each in addon._CLASSES if getattr(each, "bl_parent_id", "") == f"{place}_PT_desire_path"]
        parts = [each for each in parts if issubclass(each, panels._Ground)]
        parts.sort(key=lambda each: each.bl_order)
        assert [each.bl_label for each in parts] == ["Soil", "Painted Soils", "Layers", "Plants", "Output and Method"]


def test_no_word_is_told_that_nobody_says():
    """Of the descriptions; labels may be Blender's, too."""
    known = set(descriptions()) | set(reasons()) | {soils.DESCRIBED}
    words = {
        *translations_described.GERMAN,
        *translations_soil.GERMAN,
        *translations_said.GERMAN,
        *translations_track.GERMAN,
        *translations_crowd.GERMAN,
    }
    assert words <= known, sorted(words - known)


def test_blender_finds_them():
    """A Blender that came without languages, as a module does, says all in English."""
    view = bpy.context.preferences.view
    if not bpy.app.translations.locales:
        assert translations.say("Free the bake of '{}'?", "Weg") == "Free the bake of 'Weg'?"
        return
    before = view.language
    try:
        view.language = "de_DE"
        view.use_translate_interface = True
        assert bpy.app.translations.pgettext_iface("Walk It", "Operator") == "Loslaufen"
        assert bpy.app.translations.pgettext_iface("Loose Layer") == "Schicht"
        assert bpy.app.translations.pgettext_iface("Auto Update", compat.WORDS) == "Auto-Backen"
        assert bpy.app.translations.pgettext_tip("First frame that is baked") == "Erstes Bild, das gebacken wird"
        assert translations.say("Free the bake of '{}'?", "Weg") == "Gebackenes von 'Weg' löschen?"
    finally:
        view.language = before
