"""Tables of text that people write: one line of column names, then rows."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Sequence

from ..errors import DesirePathError
from . import atomic_file

MAX_BYTES = 1 << 25  # bytes of a table


def read(
    path: str | os.PathLike[str], needed: Sequence[str], *, columns: str | None = None
) -> tuple[list[str], list[list[str]]]:
    """(column names, rows): the names in lower case, every row that is not empty as its cells, all strings.

    needed: names that must be there. columns: how a sentence to the user calls them, default: `needed`.
    """
    path = os.fspath(path)
    columns = columns or ",".join(needed)
    try:
        with atomic_file.reader(path) as file:
            if os.fstat(file.fileno()).st_size > MAX_BYTES:
                raise DesirePathError(
                    f"{path} is larger than {MAX_BYTES >> 20} MB: give a shorter table with the columns {columns}."
                )
            stream = io.TextIOWrapper(file, encoding="utf-8-sig", newline="")
            rows = [row for row in csv.reader(stream) if any(cell.strip() for cell in row)]
    except MemoryError:
        raise DesirePathError(f"There is not enough memory for {path}: give a shorter table.") from None
    except OSError as error:
        raise DesirePathError(
            f"{path} cannot be read ({error.strerror}): give a table with the columns {columns}."
        ) from None
    except (UnicodeDecodeError, csv.Error):
        raise DesirePathError(f"{path} is no table of text: give one with the columns {columns}.") from None
    names = [cell.strip().lower() for cell in rows[0]] if rows else []
    if not set(needed) <= set(names):
        raise DesirePathError(f"{path} has no columns {' and '.join(needed)}: let its first line say {columns}.")
    return names, rows[1:]
