"""Options of a command that know what they need: what is given and nobody would use is refused in one sentence."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NoReturn

from .errors import DesirePathError


@dataclass(frozen=True)
class Need:
    """What an option needs: whether that is there among all that is given, and what to add where it is not."""

    met: Callable[[argparse.Namespace], bool]
    add: str


class Parser(argparse.ArgumentParser):
    """A parser whose errors are one sentence, and whose options may have needs."""

    def __init__(self, *args: Any, **more: Any) -> None:
        super().__init__(*args, **more)
        self.needs: list[tuple[str, str, Any, Need]] = []
        self.set_defaults(needs=self.needs)

    def option(self, name: str, need: Need, default: Any = None, **more: Any) -> None:
        """An option as add_argument() makes it, refused by settled() where it is given without what it needs."""
        action = self.add_argument(name, default=None, **more)
        self.needs.append((action.dest, name, default, need))

    def error(self, message: str) -> NoReturn:
        """Say what is wrong in one sentence; code 2."""
        self.exit(2, f"{message.removeprefix('argument ')}; {self.prog} --help tells what may be given.\n")


def settled(args: argparse.Namespace) -> argparse.Namespace:
    """What is given, with what is usual for what is not; DesirePathError where an option lacks what it needs."""
    given = []
    for dest, name, default, need in args.needs:
        if getattr(args, dest) is None:
            setattr(args, dest, default)
        else:
            given.append((name, need))
    for name, need in given:
        if not need.met(args):
            raise DesirePathError(f"{name} {need.add}, or leave it out.")
    return args
