"""Where an equation lives, and who may know whom, is found by scripts that must tell the truth."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"


def run(name, *words):
    return subprocess.run(
        [sys.executable, str(SCRIPTS / name), *map(str, words)], capture_output=True, text=True, cwd="/"
    )


@pytest.fixture
def tree(tmp_path):
    """A small tree with known tags."""

    def put(path, text):
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    put("native/soil/soil.h", "// heaps. TRAIL (9)(10), (12)-(14)\nint f(void);\n")
    put(
        "native/soil/soil_press.c",
        '#include "soil/soil.h"\n// TRAIL (10) is below\n'
        "int f(void) { return 1; }  // TRAIL (10)\nint g = 2;  // SOFT22 (10), TRAIL 4.2.1\n",
    )
    put("native/python/py_soil.c", '{"f", f, "TRAIL (10)"},  // TRAIL (10)\n')
    put("tests/native/soil/test_soil_press.c", "// TRAIL (10)\n")
    put("tests/reference/soil.py", "depth = 1  # TRAIL (10)\n")
    put("addon/desire_path/ground/soil.py", "depth = 1  # TRAIL (10)\n")
    put("native/model.md", "# The model\n\n## 6 The soil\n\n### 6.2 Pressed\n\nTRAIL (9) (10).\n\n### 6.10 Last\n")
    put("native/README.md", "TRAIL (9), MODEL 6.2\n")
    put("native/soil/soil_slip.c", "// MODEL 6, MODEL 6.2\nint h = 3;  // MODEL 6.2, 3 cells\n")
    put("tests/core/test_slip.py", "# MODEL 6.2-6.4 and 6.10\n")
    return tmp_path


def test_where_finds_what_is_there(tree):
    told = run("where", "--root", tree, 10).stdout
    sections = re.split(r"\n  (\w+): .*", told)
    found = dict(zip(sections[1::2], sections[2::2]))
    assert told.startswith("TRAIL (10)\n")
    assert "native/soil/soil_press.c:3" in found["computed"] and found["computed"].count(":") == 1
    assert "native/soil/soil.h:1" in found["told"] and "soil_press.c:2" in found["told"]
    assert "addon/desire_path/ground/soil.py:1" in found["python"] and "py_soil.c:1" in found["python"]
    assert "tests/native/soil/test_soil_press.c:1" in found["tested"]
    assert "tests/reference/soil.py:1" in found["twin"]
    assert "native/model.md:7" in found["model"] and found["model"].count("native/") == 1


@pytest.mark.parametrize(
    "words, line",
    [
        ((13,), "soil.h:1"),
        ((12,), "soil.h:1"),
        (("(14)",), "soil.h:1"),
        ((9,), "soil.h:1"),
        (("SOFT22", 10), "soil_press.c:4"),
        (("soft22", "10"), "soil_press.c:4"),
        (("4.2.1",), "soil_press.c:4"),
        (("TRAIL", "4.2.1"), "soil_press.c:4"),
        (("MODEL", "6.2"), "model.md:5"),
        (("model", "6.2"), "soil_slip.c:1"),
        (("MODEL", "6.2"), "test_slip.py:1"),
        (("MODEL", "6.2"), "soil_slip.c:2"),
        (("MODEL", "6"), "model.md:3"),
        (("MODEL", 6), "soil_slip.c:1"),
        (("MODEL", "6.3"), "test_slip.py:1"),
        (("MODEL", "6.10"), "test_slip.py:1"),
    ],
)
def test_where_understands_ranges_papers_and_sections(tree, words, line):
    told = run("where", "--root", tree, *words)
    assert told.returncode == 0 and line in told.stdout


def test_where_says_what_is_not_there(tree):
    told = run("where", "--root", tree, 11)
    assert told.returncode == 1 and told.stdout == ""
    assert told.stderr == "No line is tagged TRAIL (11): scripts/where lists all there are.\n"
    told = run("where", "--root", tree, "SOFT22", 9)
    assert told.returncode == 1 and "there is TRAIL (9)" in told.stderr
    assert run("where", "--root", tree, "nonsense").returncode == 2


def test_where_without_words_is_a_table(tree):
    lines = run("where", "--root", tree).stdout.splitlines()
    assert [line[:16].strip() for line in lines[1:]] == [
        "TRAIL (9)",
        "TRAIL (10)",
        "TRAIL (12)",
        "TRAIL (13)",
        "TRAIL (14)",
        "TRAIL 4.2.1",
        "SOFT22 (10)",
        "MODEL 6",
        "MODEL 6.2",
        "MODEL 6.3",
        "MODEL 6.4",
        "MODEL 6.10",
    ]
    assert "soil/soil_press.c:3" in lines[2]


@pytest.mark.parametrize("number", [1, 2, 3, 4, 9, 10, 11, 12, 13, 14, 15, 16, 17])
def test_every_equation_is_on_the_line_that_computes_it(number):
    told = run("where", number).stdout
    assert re.search(r"\n  computed: .*\n    native/\w+/\w+\.c:\d+ ", told), told
    assert re.search(r"\n  model: .*\n    native/model\.md:\d+ ", told), told


@pytest.mark.parametrize(
    "paper, number",
    [*(("TRAIL", n) for n in range(1, 18)), *(("SOFT22", n) for n in range(1, 15) if n != 2)],  # (2) is a sign
)
def test_every_equation_of_the_papers_has_a_slow_twin(paper, number):
    told = run("where", paper, number).stdout
    assert re.search(r"\n  twin: .*\n    tests/reference/\w+\.py:\d+ ", told), told


def test_rooms_hold(tmp_path):
    told = run("rooms")
    assert told.returncode == 0, told.stderr
    assert "maps       knows base" in told.stdout


@pytest.mark.parametrize(
    "path, text, words",
    [
        ("native/soil/a.c", '#include "walker/walker.h"\n', "soil may not know walker"),
        ("native/base/a.c", '#include "soil/soil.h"\n', "base may not know soil"),
        ("native/sim/a.c", '#include "soil/soil_heaps.h"\n', "by its door, soil/soil.h"),
        ("native/sim/a.c", '#include "python/door.h"\n', "sim may not know python"),
        ("native/soil/a.c", '#include "soil.h"\n', "by its room"),
        ("native/soil/a.c", "#include <pthread.h>\n", "<pthread.h> is of one system"),
        ("native/soil/a.c", "#include <openexr.h>\n", "<openexr.h> is of one system"),
        ("native/attic/a.c", '#include "base/vec.h"\n', "does not know"),
        ("addon/desire_path/ground/sim.py", "def f():\n    import bpy\n", "stays free of bpy"),
        ("addon/desire_path/ground/sim.py", "from ..blender import axes\n", "does not know blender/"),
        ("addon/desire_path/ground/sim.py", "from desire_path import maps\n", "import relatively"),
        ("addon/desire_path/blender/a.py", "from .. import _native\n", "leave _native"),
        ("addon/desire_path/blender/a.py", "import threading\n", "threading stays out"),
        ("addon/desire_path/rig/a.py", "from concurrent.futures import ThreadPoolExecutor\n", "concurrent stays out"),
        ("addon/desire_path/rig/a.py", "def f():\n    import math\n", "a.py:2: import at the top"),
        ("addon/desire_path/rig/a.py", 'b = lazy.module("..bake.bake", __package__)\n', "may not come late"),
        ("addon/desire_path/rig/a.py", 'b = lazy.module("bpy")\n', "stays free of bpy"),
        ("addon/desire_path/rig/a.py", 'b = lazy.module("threading")\n', "threading stays out"),
        ("addon/desire_path/rig/a.py", "import asyncio\n", "asyncio stays out"),
        ("addon/desire_path/rig/a.py", "from importlib import import_module\n", "importlib stays out"),
        ("native/soil/a.c", "int stray(void)\n{\n    return 1;\n}\n", "stray is given to other files"),
        ("native/soil/a.c", "const float STRAY[2] = {1, 2};\n", "STRAY is given to other files"),
        ("addon/desire_path/rig/a.py", "def f(told):\n    pass\n", "'told' names much"),
        ("native/soil/a.c", "static int way;  // made\n", "'way' names much: say what it is, as velocity"),
    ],
)
def test_rooms_fall(tmp_path, path, text, words):
    file = tmp_path / path
    file.parent.mkdir(parents=True)
    file.write_text(text)
    told = run("rooms", "--quiet", "--root", tmp_path)
    assert told.returncode == 1 and words in told.stderr and path in told.stderr


def test_circles_of_files_are_named(tmp_path):
    room = tmp_path / "native" / "soil"
    room.mkdir(parents=True)
    (room / "soil.h").write_text("int dp_soil_one(void);\nint dp_soil_two(void);\n")
    (room / "one.c").write_text('#include "soil/soil.h"\n\nint dp_soil_one(void)\n{\n    return dp_soil_two();\n}\n')
    (room / "two.c").write_text("static int x;\n\nint dp_soil_two(void)\n{\n    return x;  // not dp_soil_one()\n}\n")
    assert run("rooms", "--quiet", "--root", tmp_path).returncode == 0
    (room / "two.c").write_text("int dp_soil_two(void)\n{\n    return dp_soil_one();\n}\n")
    told = run("rooms", "--quiet", "--root", tmp_path)
    assert told.returncode == 1 and "native/soil/one.c, native/soil/two.c: a circle" in told.stderr
    assert "one.c needs two.c for dp_soil_two" in told.stderr and "two.c needs one.c for dp_soil_one" in told.stderr
    (room / "two.c").unlink()
    (room / "one.h").write_text('#include "soil/two.h"\n')
    (room / "two.h").write_text('#include "soil/one.h"\n')
    assert "one.h needs two.h, which it includes" in run("rooms", "--quiet", "--root", tmp_path).stderr


@pytest.mark.parametrize("text, code", [("int stray", 1), ("int dp_own", 0), ("static int stray", 0)])
def test_names_that_files_share_begin_with_dp(tmp_path, text, code):
    built = tmp_path / "build" / "plain"
    built.mkdir(parents=True)
    (tmp_path / "heap.c").write_text(f"{text}(void) {{ return 1; }}\nint dp_user(void);\n")
    cc = os.environ.get("CC", "cc")
    subprocess.run([cc, "-c", "-o", tmp_path / "heap.c.o", tmp_path / "heap.c"], check=True)
    subprocess.run(["ar", "rc", built / "libdp_soil.a", tmp_path / "heap.c.o"], check=True)
    told = run("rooms", "--quiet", "--root", tmp_path)
    assert told.returncode == code and ("heap.c: stray is seen" in told.stderr) == bool(code), told.stderr


@pytest.mark.parametrize(
    "files, words",
    [
        ({"rig/a.py": "from . import b\n", "rig/b.py": "from .a import C\n"}, "rig/a.py, addon/desire_path/rig/b.py"),
        (
            {"rig/a.py": "from ..bake import b\n", "bake/b.py": "", "bake/c.py": "from ..rig import d\n"},
            "rooms bake, rig",
        ),
        (
            {
                "blender/a.py": "from .late import b\n",
                "blender/b.py": "from . import a\n",
                "blender/late.py": 'b = lazy.module(".b", __package__)\n',
            },
            "blender/a.py, addon/desire_path/blender/b.py",
        ),
    ],
)
def test_circles_fall(tmp_path, files, words):
    for name, text in files.items():
        file = tmp_path / "addon" / "desire_path" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    told = run("rooms", "--quiet", "--root", tmp_path)
    assert told.returncode == 1 and words in told.stderr and "each needs the others" in told.stderr


def test_every_script_helps():
    scripts = sorted(path for path in SCRIPTS.iterdir() if path.is_file())
    assert {"build", "test", "format", "package", "where", "rooms", "bench"} <= {path.name for path in scripts}
    for path in scripts:
        assert os.access(path, os.X_OK), path
        told = subprocess.run([str(path), "--help"], capture_output=True, text=True, cwd="/")
        assert told.returncode == 0 and len(told.stdout) > 80, (path, told.stderr)
