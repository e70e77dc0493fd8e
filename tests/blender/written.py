"""written.py - every sentence that the add-on writes out, as a template: with {} for what comes in."""

import ast
import functools
import itertools
import pathlib
import re

import desire_path

ROOT = pathlib.Path(desire_path.__file__).parent
# what is told at a command line, to who writes scripts, or in another language already
APART = re.compile(
    r"(commands|command_\w+|__main__|old_names|keywords|needs|(translations|sentences)\w*)\.py|(farm|paths|study)/"
)
SENTENCE = re.compile(r"^['\"A-Z{(][^\n]* [^\n]*[.?!]$")
LETTERS = 8  # of a sentence that says something by itself


def sources():
    for path in sorted(ROOT.rglob("*.py")):
        if not APART.match(path.relative_to(ROOT).as_posix()) and not APART.match(path.name):
            yield path, ast.parse(path.read_text(encoding="utf-8"))


def is_text(node):
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def templates(node):
    """What a piece of source may say, one for each way through its ifs; None where it is no text."""
    if is_text(node):
        return [re.sub(r"\{[^{}\"]*\}", "{}", node.value)]
    if isinstance(node, ast.JoinedStr):
        return ["".join(parts) for parts in itertools.product(*(part(each) for each in node.values))]
    if isinstance(node, (ast.BinOp, ast.IfExp)):
        if isinstance(node, ast.BinOp) and not isinstance(node.op, ast.Add):
            return None
        sides = (node.left, node.right) if isinstance(node, ast.BinOp) else (node.body, node.orelse)
        found = [templates(each) for each in sides]
        if found == [None, None]:
            return None
        one, other = (each or ["{}"] for each in found)
        return [*one, *other] if isinstance(node, ast.IfExp) else [a + b for a in one for b in other]
    if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "format":
        return templates(node.func.value)
    return None


def part(node):
    """What a part of an f-string may say."""
    if isinstance(node, ast.Constant):
        return [node.value]
    return (isinstance(node.value, ast.IfExp) and templates(node.value)) or ["{}"]


def walk(node):
    """All templates below a piece of source, without its docstrings and what is told by say()."""
    if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)):
        body = node.body[1:] if isinstance(node.body[0], ast.Expr) and is_text(node.body[0].value) else node.body
        for each in body:
            yield from walk(each)
        return
    if isinstance(node, ast.Expr) and is_text(node.value):
        return
    if isinstance(node, ast.Call) and "say" in {getattr(node.func, "id", ""), getattr(node.func, "attr", "")}:
        return
    found = templates(node)
    yield from found or ()
    for each in ast.iter_child_nodes(node):
        if not (found and isinstance(node, (ast.JoinedStr, ast.BinOp)) and templates(each)):
            yield from walk(each)


@functools.lru_cache(maxsize=1)
def texts():
    """Every template that is written out, by the file it stands in."""
    return {path.relative_to(ROOT).as_posix(): list(walk(tree)) for path, tree in sources()}


def says(template):
    return SENTENCE.match(template) and sum(map(str.isalnum, template)) >= LETTERS


def sentences():
    return {each for found in texts().values() for each in found if says(each)}
