"""What the add-on tells is told in the language of the interface: every sentence that is written out has one there."""

import re

import bpy
from scenes import meshes
from written import sentences as written
from written import texts

from desire_path.blender import messages, sentences

FEW = 0.1  # share of the sentences


def test_sentences_are_in_every_language():
    """All but a few: what was written last is told in English until somebody translates it."""
    found = written()
    assert len(found) > 400, len(found)
    for language, parts in sentences.LANGUAGES.items():
        table = {english for part in parts for english in part.GERMAN}
        missing = sorted(found - table)
        print(f"{language} lacks {missing}")
        assert len(missing) < FEW * len(found), f"{language} lacks {missing}"


def test_hardly_anything_is_told_that_nobody_writes():
    found, pieces = written(), "\n".join(each for there in texts().values() for each in there)
    *whole, phrases = sentences.LANGUAGES["de"]
    gone = [english for part in whole for english in part.GERMAN if english not in found]
    assert len(gone) < FEW * len(found), gone
    for english in phrases.GERMAN:
        parts = [each.strip(" .'") for each in english.split("{}") if len(each) > 3 and not each.isalpha()]
        lost = [each for each in parts if each not in pieces and "is a ground" not in each]
        assert not lost, (english, lost)


def test_each_template_finds_itself():
    """Who says most is asked first, so that none is taken for another one."""
    for english, there in sentences.words("de").plain.items():
        assert sentences.said("de", english) == there
    for part in sentences.LANGUAGES["de"]:
        for english, there in part.GERMAN.items():
            pieces = english.split("{}")
            if len(pieces) == 1:
                continue
            values = [f"{'' if each else ' '}N{k}x" for k, each in enumerate(pieces[:-1])]  # a space parts neighbours
            assert sorted(re.findall(r"N\dx", there.format(*values))) == [each.strip() for each in values], english
            made = "".join(one + other for one, other in zip(pieces, [*values, ""]))
            assert sentences.said("de", made) == there.format(*values), english


def test_values_are_told_too_and_names_are_not():
    said = lambda text: sentences.said("de", text)
    assert said("Nothing moves 'on': it has no keys; give it an action.") == (
        "Nichts bewegt 'on': es hat keine Keyframes; ihm eine Aktion geben."
    )
    assert said("The walk and the settings have changed since the bake: bake again.") == (
        "Seit dem Backen geändert: der Gang und die Einstellungen. Noch einmal backen."
    )
    two = "2 bakes. Baked frames 1 to 16 on 'A' and 'B' in 1.0 s: 2 contacts, deepest print 14 mm; files in /tmp/A, /B."
    assert said(f"{two} '/the ground' is gone: bake again when it is back.") == (
        "2 Mal gebacken. Bilder 1 bis 16 gebacken auf 'A' und 'B' in 1.0 s: 2 Kontakte, tiefster Abdruck 14 mm; "
        "Dateien in /tmp/A, /B. '/the ground' ist fort: noch einmal backen, wenn es wieder da ist."
    )
    assert said("'A': 12 contacts, 1.20 m/s; In the air for 3 % of the time. Tables in /a.b.") == (
        "'A': 12 Kontakte, 1.20 m/s; In der Luft 3 % der Zeit. Tabellen in /a.b."
    )
    for other in ("", "{}", "What nobody wrote.", "a. b; c and d", "x" * 9000):
        assert said(other) == other
    assert sentences.said("fr_FR", "Nothing was baked.") == "Nothing was baked."


def test_blender_tells_them():
    """In the language that is chosen; a Blender that came without languages, as a module does, has English alone."""
    choices = {"de_DE": "'Grid' ist noch kein Boden", "en_US": "'Grid' is no ground yet"}
    view, land = bpy.context.preferences.view, meshes.grid(4, 4, 1.0)
    meshes.activate(land)
    before = view.language
    try:
        for language, wanted in choices.items():
            if bpy.app.translations.locales:
                view.language = language
            elif language != "en_US":
                continue
            land.name = "Grid"
            try:
                bpy.ops.object.desire_path_bake()
            except RuntimeError as problem:
                told = str(problem)
            assert wanted in told, told
            assert "'Grid' is no ground yet" in messages.text().splitlines()[-1]  # for who helps
    finally:
        view.language = before
