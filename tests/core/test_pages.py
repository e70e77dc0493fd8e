"""What the pages for newcomers say is there: sections that code refers to, tests that hold what must hold, paths."""

import re
import shlex
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from desire_path import KINDS, SOILS, commands

ROOT = Path(__file__).resolve().parents[2]
MODEL = ROOT / "native" / "model.md"
TEXTS = {".c", ".h", ".py", ".md", ".toml", ""}
EXAMPLES = {"test_pages.py", "test_where.py"}  # what these name is made up
TEST = re.compile(r"\b(test_\w+\.(?:c|py)),\s*(?://\s*|#\s*)?(\w+)")


def kept():
    """Files of the project, as git knows them; all there are where it knows none."""
    told = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    if told.returncode:
        return [path for path in ROOT.rglob("*") if path.is_file() and "build" not in path.parts]
    return [ROOT / name for name in told.stdout.split("\0") if name and (ROOT / name).is_file()]


def texts(*places):
    for path in kept():
        if path.suffix in TEXTS and path.relative_to(ROOT).parts[0] in places and path.name not in EXAMPLES:
            yield path, path.read_text(encoding="utf-8", errors="replace")


def references(text):
    """Sections of the model that a text names: '11.1-11.3, 11.7 and 11.11' are five."""
    item = r"(\d+(?:\.\d+)*)"
    for run in re.findall(r"\bMODEL ((?:(?:\s|,|-|and\b)*\d+(?:\.\d+)+)+|\d+\b)", text):
        for first, last in re.findall(rf"{item}(?:-{item})?", run):
            chapter, _, number = first.rpartition(".")
            yield first
            for between in range(int(number) + 1, int(last.rpartition(".")[2] or 0) + 1):
                yield f"{chapter}.{between}"


def headings():
    return set(re.findall(r"^#+ (\d+(?:\.\d+)*) ", MODEL.read_text(encoding="utf-8"), re.MULTILINE))


def test_every_reference_to_the_model_leads_to_a_heading():
    known, count = headings(), 0
    for path, text in texts("native", "addon", "tests", "scripts", "README.md"):
        for section in references(text):
            count += 1
            assert section in known, f"{path.relative_to(ROOT)}: MODEL {section} is no section of native/model.md"
        lost = re.search(r"\b[Dd]esign,? \d|\b[Oo]racles? \d", text)
        assert not lost, f"{path.relative_to(ROOT)}: '{lost[0]}' leads nowhere; say MODEL and a section"
    assert count > 40


def test_references_are_understood():
    told = (
        "MODEL 11.1-11.3, 11.7 and 11.11 of it. MODEL 7 and MODEL 8.\n(ours; MODEL 6.2) MODEL 4.3, step 2: DP_MODEL 5"
    )
    assert list(references(told)) == ["11.1", "11.2", "11.3", "11.7", "11.11", "7", "8", "6.2", "4.3"]


def test_sections_are_numbered_in_their_order():
    numbers = [
        [int(digit) for digit in found.split(".")]
        for found in re.findall(r"^##+ (\d+(?:\.\d+)*) ", MODEL.read_text(encoding="utf-8"), re.MULTILINE)
    ]
    assert numbers == sorted(numbers) and len(numbers) == len({tuple(number) for number in numbers})


def test_every_section_of_the_model_is_pointed_to():
    named = {section for _, text in texts("native", "addon", "tests") for section in references(text)}
    sections = {section for section in headings() if "." in section}
    assert not sections - named, "no code names these sections of native/model.md"


def test_departures_and_oracles_name_tests_that_are_there():
    """'test_soil_compress_edge.c, over_an_edge': a file somewhere below tests/, and a name in it."""
    files, count = {}, 0
    for path in kept():
        if path.name.startswith("test_"):
            files[path.name] = files.get(path.name, "") + path.read_text(encoding="utf-8")
    for path, text in texts("native", "addon"):
        for file, name in TEST.findall(text):
            count += 1
            assert file in files, f"{path.relative_to(ROOT)} names {file}, which is not there"
            held = re.search(rf"TEST\({name}\)|def (?:test_)?{name}\(|\b{name}\b", files[file])
            assert held, f"{path.relative_to(ROOT)} names {name}, which {file} has not"
    assert count > 60


def test_every_oracle_is_held_by_a_test():
    text = MODEL.read_text(encoding="utf-8")
    for oracle in re.split(r"^### 11\.", text, flags=re.MULTILINE)[1:]:
        assert TEST.search(oracle), f"MODEL 11.{oracle.splitlines()[0]} names no test"


def test_the_changelog_begins_with_what_comes_and_what_is():
    heads = re.findall(r"^## (.*)", (ROOT / "addon" / "desire_path" / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    version = re.search(r'VERSION = "(.*)"', (ROOT / "addon" / "desire_path" / "version.py").read_text("utf-8"))[1]
    assert heads[:2] == ["Unreleased", version]


@pytest.mark.parametrize(
    "page", ["native/README.md", "native/model.md", ".github/CONTRIBUTING.md", "addon/desire_path/CHANGELOG.md"]
)
def test_paths_on_the_pages_are_there(page):
    for path in re.findall(r"`((?:native|addon|tests|scripts|\.github)/[\w./-]+)`", (ROOT / page).read_text("utf-8")):
        assert (ROOT / path).exists(), f"{page} names {path}, which is not there"


@pytest.mark.parametrize("page", ["README.md", "native/README.md", ".github/CONTRIBUTING.md"])
def test_what_a_page_links_to_and_shows_is_there(page):
    text = (ROOT / page).read_text("utf-8")
    targets = re.findall(r"\]\(([^)\s#]+)", text) + re.findall(r'(?:src|href)="([^"#]+)', text)
    near = [each for each in targets if "://" not in each and not each.startswith("mailto:")]
    known = set(kept())
    missing = [
        each for each in near if not (path := (ROOT / page).parent / each).is_dir() and path.resolve() not in known
    ]
    assert not missing and (near or page != "README.md"), f"{page} shows {missing}"


@pytest.mark.parametrize("page", ["native/README.md", "native/model.md"])
def test_names_of_the_core_on_the_pages_are_there(page):
    sources = "".join(text for path, text in texts("native") if path.suffix in {".c", ".h"})
    for name in re.findall(r"`(dp_\w+|Dp\w+)`", (ROOT / page).read_text("utf-8")):
        assert re.search(rf"\b{name}\b", sources), f"{page} names {name}, which the core has not"


def test_tables_of_the_readme_name_every_soil_and_kind():
    text = (ROOT / "README.md").read_text("utf-8")
    for head, known in (("soil", SOILS), ("kind", KINDS)):
        table = re.search(rf"^\| {head} \| what it is like \|\n\| ---.*\n((?:\|.*\n)+)", text, re.MULTILINE)[1]
        rows = [name for row in table.splitlines() for name in re.findall(r"`([\w-]+)`", row.split("|")[1])]
        assert sorted(rows) == sorted(known), f"README.md's table of what {head}s are like, and the {head}s there are"


def test_recipes_name_what_their_files_hold():
    """Tables and lists of which a recipe speaks stand in a file that the same step names."""
    recipes = (ROOT / "native" / "README.md").read_text("utf-8").split("## Recipes")[1]
    heads = re.findall(r"^### (.*)", recipes, re.MULTILINE)
    assert heads == ["A soil", "A kind of plant", "A soil's number", "A map", "A rig name", "A room"]
    count = 0
    for step in re.split(r"^(?:\d+\. |### )", recipes, flags=re.MULTILINE)[1:]:
        files = [ROOT / path for path in re.findall(r"`([\w./-]+/[\w./-]+)`", step) if (ROOT / path).is_file()]
        held = "".join(path.read_text("utf-8") for path in files)
        for name in re.findall(r"`([A-Z_]{3,})`", step):
            assert re.search(rf"\b{name}\b", held), f"native/README.md speaks of {name}, which {files} have not"
            count += 1
    assert count >= 10


def test_the_picture_of_the_rooms_holds_all_of_them():
    picture = (ROOT / "native" / "README.md").read_text("utf-8").split("```")[1]
    rooms = {
        path.parent.name for place in ("native", "addon/desire_path") for path in (ROOT / place).glob("*/*.[chp]*")
    }
    rooms -= {"walks", "__pycache__", "build"}
    assert {"soil", "sim", "ground", "blender"} <= rooms
    missing = {room for room in rooms if not re.search(rf"\b{room}\b", picture)}
    assert not missing, "rooms that native/README.md does not show"


README = (ROOT / "README.md").read_text("utf-8")


def square(x):
    """Vertices and triangles of a square of ground, 4 m wide, from x on."""
    return np.array([(x, -2, 0), (x + 4, -2, 0), (x + 4, 2, 0), (x, 2, 0)], float), [(0, 1, 2), (0, 2, 3)]


@pytest.mark.parametrize("script", re.findall(r"```python\n(from desire_path.*?)```", README, re.DOTALL))
def test_scripts_of_the_readme_run(script, tmp_path, monkeypatch):
    shutil.copy(ROOT / "addon" / "desire_path" / "walks" / "walk.npz", tmp_path)
    monkeypatch.chdir(tmp_path)
    exec(script, {"west": square(-4.0), "east": square(0.0)})


def test_commands_of_the_readme_are_understood():
    lines = re.findall(r"^    python -m desire_path (.*?)(?: +#.*)?$", README, re.MULTILINE)
    assert len(lines) > 10
    for line in lines:
        commands._parser().parse_args(shlex.split(line))
