"""Frozen records of numbers and words as JSON files that people save, change and share: soils, kinds of plants."""

from __future__ import annotations

import os
from dataclasses import asdict, fields
from typing import Any, ClassVar, Protocol, TypeVar

from .. import lazy
from ..errors import DesirePathError

json = lazy.module("json")  # Blender registers with the soils there are, before one is read or written
atomic_file = lazy.module(".atomic_file", __package__)

MAX_TEXT = 1 << 16  # bytes of a file


class Dataclass(Protocol):
    """What dataclasses have in common."""

    __dataclass_fields__: ClassVar[dict[str, Any]]


Record = TypeVar("Record", bound=Dataclass)


def save(record: Dataclass, path: str | os.PathLike[str], tag: str, version: int, what: str) -> None:
    """Write a dataclass as JSON, whole or not at all.

    tag, version: say in the file what it is; what: the same for people, "soil"
    """
    text = json.dumps({tag: version, **asdict(record)}, indent=2, default=float) + "\n"
    with atomic_file.file(path, f"The {what}", "w", encoding="utf-8") as stream:
        stream.write(text)


def text_of(path: str | os.PathLike[str], what: str, limit: int = MAX_TEXT) -> bytes:
    """The bytes of a file, one more than `limit` at most; DesirePathError where it cannot be read."""
    try:
        with atomic_file.reader(path) as file:
            return bytes(file.read(limit + 1))
    except FileNotFoundError:
        raise DesirePathError(f"There is no {what} at {path}: check the path.") from None
    except (OSError, ValueError) as error:
        raise DesirePathError(
            f"The {what} {path} cannot be read ({getattr(error, 'strerror', None) or error}): check its name and whose "
            "file it is."
        ) from None


def load(kind: type[Record], path: str | os.PathLike[str], tag: str, version: int, what: str) -> Record:
    """A dataclass `kind` out of a file that `save` wrote; what it leaves out is as by default.

    Raises DesirePathError for any file that is none.
    """
    name = kind.__name__
    text = text_of(path, what)
    try:
        given = json.loads(text.decode("utf-8")) if len(text) <= MAX_TEXT else None
    except (ValueError, RecursionError, MemoryError):
        raise DesirePathError(f"{path} is not a {what}: save one with {name}.save().") from None
    given = given if isinstance(given, dict) else {}
    found = given.pop(tag, None)
    if type(found) is not int or found != version:
        raise DesirePathError(f"{path} is not a {what} of this version: save one with {name}.save().")
    unknown = sorted(set(given) - {each.name for each in fields(kind)})
    if unknown:
        raise DesirePathError(f"{path} says {unknown[0][:40]}, which no {what.split()[0]} has: remove it.")
    return kind(**given)
