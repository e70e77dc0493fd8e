"""Every label of the add-on is in every language there is, and Blender finds it there."""

import ast
import pathlib

import bpy

import desire_path.blender as addon
from desire_path.blender import props, state, translations

FOLDER = pathlib.Path(addon.__file__).parent
DRAWS = {"label": "*", "prop": "*", "prop_search": "*", "menu": "*", "operator": "Operator"}


def of_classes():
    """(context, label) of operators, panels, menus, and of what they and objects remember."""
    for each in addon._CLASSES:
        operator = issubclass(each, bpy.types.Operator)
        if getattr(each, "bl_label", ""):
            yield ("Operator" if operator else "*"), each.bl_label
    for group in props.CLASSES:
        for each in group.bl_rna.properties:
            if each.identifier in group.__annotations__ and not each.is_hidden and each.name != each.identifier:
                yield "*", each.name
                for item in each.enum_items if each.type == "ENUM" else ():
                    yield "*", item.name


def of_panels():
    """(context, label) of every text that is written out where panels draw."""
    for path in sorted(FOLDER.glob("*.py")):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr in DRAWS:
                words = (word.value for word in call.keywords if word.arg == "text")
                for text in (each for value in words for each in ast.walk(value) if isinstance(each, ast.Constant)):
                    if isinstance(text.value, str) and text.value[:1].isupper():
                        yield DRAWS[call.func.attr], text.value


def labels():
    return {*of_classes(), *of_panels(), *(("*", word) for word, _ in state.LOOKS.values())}


def test_every_label_is_in_every_language():
    wanted = labels()
    assert len(wanted) > 100
    for language, table in translations.TABLE.items():
        missing = sorted(wanted - set(table))
        assert not missing, f"{language} lacks {missing}"
        assert all(text.strip() == text and text for text in table.values())


def test_blender_finds_them():
    view = bpy.context.preferences.view
    if "de_DE" not in bpy.app.translations.locales:
        return  # a Blender without languages
    before = view.language
    try:
        view.language = "de_DE"
        view.use_translate_interface = True
        assert bpy.app.translations.pgettext_iface("Walk It", "Operator") == "Loslaufen"
        assert bpy.app.translations.pgettext_iface("Loose Layer") == "Lockere Schicht"
    finally:
        view.language = before
