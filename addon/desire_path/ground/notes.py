"""Texts and numbers in the header of a map: how long texts are written, and read as one again.

FFmpeg 5 takes 255 bytes of a text and reads what is left of it as attributes, which now and then makes it lose the
picture. So a longer text is written in parts, `parameters`, `parameters_2`, `parameters_3` .., each but the last as
full as whole letters of UTF-8 allow.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

MAX_TEXT = 255  # bytes of UTF-8 of one attribute
MAX_LETTER = 4  # bytes of one letter


def parts(notes: Mapping[str, str | float] | Iterable[tuple[str, str | float]]) -> list[tuple[str, str | float]]:
    """Notes (name, text or number) as they are written: no text longer than MAX_TEXT bytes."""
    found: list[tuple[str, str | float]] = []
    for name, value in notes.items() if isinstance(notes, Mapping) else notes:
        if isinstance(value, str):
            found += [(_numbered(name, k), text) for k, text in enumerate(_cut(value), 1)]
        else:
            found.append((name, float(value)))
    return found


def joined(notes: Iterable[tuple[str, str | float]]) -> dict[str, str | float]:
    """Notes by name as they were before parts()."""
    found = dict(notes)
    for name in tuple(found):
        part, k = found.get(name), 1
        while isinstance(part, str) and len(_bytes(part)) > MAX_TEXT - MAX_LETTER:
            k += 1
            part = found.get(_numbered(name, k))
            if isinstance(part, str):
                found[name] = f"{found[name]}{found.pop(_numbered(name, k))}"
    return found


def _numbered(name: str, k: int) -> str:
    return name if k == 1 else f"{name}_{k}"


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _cut(text: str) -> Iterator[str]:
    left = _bytes(text)
    while len(left) > MAX_TEXT:
        end = MAX_TEXT
        while left[end] & 0xC0 == 0x80:  # in the middle of a letter
            end -= 1
        yield left[:end].decode("utf-8", "surrogatepass")
        left = left[end:]
    yield left.decode("utf-8", "surrogatepass")
