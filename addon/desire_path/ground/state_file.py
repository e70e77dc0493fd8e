"""What the ground has become, as bytes and as a file: written whole or not at all, taken back before a first step."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ..errors import DesirePathError
from ..files import atomic_file

if TYPE_CHECKING:
    from typing_extensions import Buffer


def write(path: str | os.PathLike[str], state: Buffer) -> None:
    """Write a state to one file, whole or not at all."""
    with atomic_file.file(os.fspath(path), "The state") as stream:
        stream.write(state)


def read(path: str | os.PathLike[str]) -> bytes:
    """The bytes that write() wrote; DesirePathError if the file cannot be read."""
    path = os.fspath(path)
    try:
        with open(path, "rb") as stream:
            return stream.read()
    except OSError as problem:
        raise DesirePathError(
            f"The state {path} cannot be read ({problem.strerror}): check its name and whose file it is."
        ) from None


def restore(core: Any, state: Buffer, name: str) -> None:
    """Let the core's simulation go on from a state, which a sentence calls by `name`; nothing has changed where it
    cannot (DesirePathError)."""
    try:
        core.load_state(state)
    except ValueError as problem:
        if "damaged" in str(problem):
            raise DesirePathError(
                f"{name} is damaged, or the state of another ground, walk or plants: run this one from its start."
            ) from None
        raise DesirePathError(
            "A state can only be loaded before the first step: make the simulation anew and load the walk first."
        ) from None
