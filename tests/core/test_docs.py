"""What scripts/docs puts before the makers of pages: comments behind fields as docstrings, // as Doxygen reads it."""

import ast
import importlib.machinery
import importlib.util
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "scripts" / "docs"


def script():
    loader = importlib.machinery.SourceFileLoader("docs_script", str(DOCS))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("docs_script", loader))
    loader.exec_module(module)
    return module


MODULE = '''"""A module."""

MAX_SIZE = 3  # of anything [m]
QUIET = 4


class Soil:
    """One kind."""

    depth: float = 0.3  # L0 [m] > 0
    said: float = 0.4  # not this
    """but this"""
    sum: tuple = (
        1,
        2,
    )  # of both

    def work(self):
        local = 3  # says nothing
        return local
'''


def test_comments_behind_fields_become_docstrings():
    tree = ast.parse(script().commented(MODULE))
    told = [node.value.value for node in tree.body if isinstance(node, ast.Expr)]
    assert told == ["A module.", "of anything [m]"]
    soil = next(node for node in tree.body if isinstance(node, ast.ClassDef))
    told = [node.value.value for node in soil.body if isinstance(node, ast.Expr)]
    assert told == ["One kind.", "L0 [m] > 0", "but this", "of both"]
    assert "'says nothing'" not in script().commented(MODULE)


HEADER = """// soil/soil.h - loose ground. It slides.
//
//   press ---> heap
#pragma once

// A limit of <things>, `<path>` as it is. More of it
// @param at  [m]
typedef struct Soil
{
    float depth;  // L0 [m] > 0
                  // and further
    float other;
} Soil;

// ---- a part ----

// Nobody's.

int f(void);
"""


def test_header_comments_are_documentation():
    told = script().header(HEADER).splitlines()
    assert told[:3] == ["/// @file", "///", "/// @brief loose ground."] and "///        press ---> heap" in told
    assert "/// @brief A limit of \\<things\\>, <code>&lt;path&gt;</code> as it is." in told
    assert "/// @param at  [m]" in told
    assert "    float depth;  ///< L0 [m] \\> 0" in told and "///< and further" in told
    assert "    float other;" in told and "// ---- a part ----" in told and "// Nobody's." in told
    assert subprocess.run([sys.executable, DOCS, "--header", "/nowhere"], capture_output=True).returncode == 1
