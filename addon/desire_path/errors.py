"""One sentence that says what is wrong and what to do next."""

from __future__ import annotations


class DesirePathError(ValueError):
    """Bad input, told in a sentence for the person at the screen; it can be printed whatever names are in it."""

    def __init__(self, text: str = "") -> None:
        super().__init__(str(text).encode("utf-8", "backslashreplace").decode("utf-8"))
