"""Arrays (rows, samples, ..) whose rows are there for some spans of samples only: walkers who go in turn.

Poses, mass centres and loads of many walkers over a long time are mostly of walkers who are elsewhere. A TrackArray
keeps what is there, in blocks, and is an array to everybody who asks: a window of it, or all of it, is made dense when
it is read. Where a row is not there it tells what it was or will be nearest to that time, or a value of its own.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ..arrays import read_only

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class TrackArray(np.lib.mixins.NDArrayOperatorsMixin):
    """Blocks of rows over spans of samples, read like an array of shape (rows, times, *tail).

    blocks: (rows rising (r,), first sample, values (r, n, *tail)); no row twice at a sample.
    missing: what is told where a row is not there; None: its nearest value in time.
    """

    def __init__(
        self, count: int, times: int, blocks: Iterable[tuple[ArrayLike, int, np.ndarray]], missing: Any = None
    ) -> None:
        self.blocks = tuple((np.asarray(rows, np.int64), int(first), values) for rows, first, values in blocks)
        values = self.blocks[0][2]
        self.shape = (int(count), int(times), *values.shape[2:])
        self.dtype, self.missing = values.dtype, missing
        self._of_row: list[list[tuple[int, int, int]]] = [[] for _ in range(count)]
        for number, (rows, first, _) in enumerate(self.blocks):
            for place, row in enumerate(rows.tolist()):
                self._of_row[row].append((first, number, place))
        for spans in self._of_row:
            spans.sort()

    ndim = property(lambda self: len(self.shape))
    nbytes = property(lambda self: sum(values.nbytes for _, _, values in self.blocks))

    def __len__(self) -> int:
        return int(self.shape[0])

    # ---- who is there ----------------------------------------------------------------------------

    def there(self, first: int, after: int) -> np.ndarray:
        """Which rows are there in all samples first..after-1, bool (rows,)."""
        found = np.zeros(len(self), bool)
        for rows, begin, values in self.blocks:
            if begin <= first and after <= begin + values.shape[1]:
                found[rows] = True
        return found

    def spans(self, row: int) -> list[tuple[int, int]]:
        """(first sample, sample after the last) of each span of a row, rising."""
        return [(first, first + self.blocks[number][2].shape[1]) for first, number, _ in self._of_row[row]]

    # ---- reading ---------------------------------------------------------------------------------

    def window(self, rows: Sequence[int] | np.ndarray, first: int, after: int) -> np.ndarray:
        """Some rows, samples first..after-1, as an array of their own."""
        out = np.empty((len(rows), after - first, *self.shape[2:]), self.dtype)
        for to, row in zip(out, rows):
            self._fill(to, int(row), first, after)
        return out

    def _fill(self, to: np.ndarray, row: int, first: int, after: int) -> None:
        spans = self._of_row[row]
        to[...] = 0 if self.missing is None else self.missing
        for n, (begin, number, place) in enumerate(spans):
            values = self.blocks[number][2][place]
            end = begin + len(values)
            a, b = max(begin, first), min(end, after)
            if self.missing is None:  # hold on to the last one, and begin with the first
                until = min(after, spans[n + 1][0] if n + 1 < len(spans) else after)
                if until > max(end, first):
                    to[max(end, first) - first : until - first] = values[-1]
                if n == 0 and first < begin:
                    to[: min(begin, after) - first] = values[0]
            if a < b:
                to[a - first : b - first] = values[a - begin : b - begin]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        dense = self.window(range(len(self)), 0, self.shape[1])
        return dense if dtype is None else dense.astype(dtype, copy=False)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **more: Any) -> Any:
        return getattr(ufunc, method)(*(np.asarray(each) if each is not None else each for each in inputs), **more)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(np.asarray(self), name)

    def __getitem__(self, key: Any) -> Any:
        key = key if isinstance(key, tuple) else (key,)
        if any(each is None for each in key):
            return np.asarray(self)[key]
        if Ellipsis in [each for each in key if not isinstance(each, np.ndarray)]:
            at = next(n for n, each in enumerate(key) if each is Ellipsis)
            key = (*key[:at], *(slice(None),) * (self.ndim - len(key) + 1), *key[at + 1 :])
        key = key + (slice(None),) * (2 - len(key))
        rows, samples, rest = key[0], key[1], key[2:]
        if isinstance(samples, (int, np.integer)):
            at = range(self.shape[1])[samples]
            return self.window(*self._rows(rows), at, at + 1)[(self._own(rows), 0, *rest)]
        if isinstance(samples, slice) and isinstance(rows, (int, np.integer, slice, list, np.ndarray)):
            span = range(self.shape[1])[samples]
            low, high = (min(span[0], span[-1]), max(span[0], span[-1]) + 1) if len(span) else (0, 0)
            step = slice(None) if span.step == 1 else slice(None, None, span.step)
            found = self.window(*self._rows(rows), low, high)[:, step]
            return found[(self._own(rows), slice(None), *rest)]
        return np.asarray(self)[key]

    def _rows(self, rows: Any) -> tuple[np.ndarray]:
        """Which rows a key asks for, as the first argument of window()."""
        found = np.arange(len(self))[rows]
        return (np.atleast_1d(found).reshape(-1),)

    @staticmethod
    def _own(rows: Any) -> int | slice:
        """What is left of a key for rows when those alone are read."""
        return 0 if isinstance(rows, (int, np.integer)) else slice(None)

    # ---- to disk and back ------------------------------------------------------------------------

    def to_arrays(self, name: str) -> dict[str, np.ndarray]:
        """Plain arrays by name: blocks one after the other, and where each belongs."""
        return {
            name: np.concatenate([values.reshape(-1, *self.shape[2:]) for _, _, values in self.blocks]),
            f"{name}_rows": np.concatenate([rows for rows, _, _ in self.blocks]),
            f"{name}_span": np.array([(len(rows), first, values.shape[1]) for rows, first, values in self.blocks]),
        }

    @staticmethod
    def from_arrays(arrays: Mapping[str, np.ndarray], name: str, count: int, times: int) -> TrackArray:
        """What to_arrays() wrote; ValueError where it makes no sense."""
        values, rows = np.ascontiguousarray(arrays[name], "f8"), np.asarray(arrays[f"{name}_rows"]).astype(np.int64)
        span = np.asarray(arrays[f"{name}_span"]).astype(np.int64).reshape(-1, 3)
        sizes = span[:, 0] * span[:, 2]
        if (
            not len(span)
            or (span < (1, 0, 1)).any()
            or (span[:, 1] + span[:, 2] > times).any()
            or span[:, 0].sum() != len(rows)
            or sizes.sum() != len(values)
            or ((rows < 0) | (rows >= count)).any()
        ):
            raise ValueError(f"{name} is not where its walkers are")
        blocks, row, at = [], 0, 0
        for (own, first, n), size in zip(span.tolist(), sizes.tolist()):
            block = values[at : at + size].reshape(own, n, *values.shape[1:])
            blocks.append((rows[row : row + own], first, block))
            row, at = row + own, at + size
        found = TrackArray(count, times, blocks)
        for spans in map(found.spans, range(count)):
            if any(end > begin for (_, end), (begin, _) in zip(spans, spans[1:])):
                raise ValueError(f"{name} has a walker twice at a time")
        return found

    # ---- others like it --------------------------------------------------------------------------

    def rows(self, rows: ArrayLike) -> TrackArray:
        """Some of the rows, rising, without those who are never there."""
        rows = np.asarray(rows)
        blocks = []
        for number in sorted({number for row in rows.tolist() for _, number, _ in self._of_row[row]}):
            own, first, values = self.blocks[number]
            keep = np.isin(own, rows)
            if keep.any():
                blocks.append((np.searchsorted(rows, own[keep]), first, values[keep]))
        if not blocks:  # nobody: one row for no time
            blocks = [(np.zeros(0, int), 0, np.zeros((0, 0, *self.shape[2:]), self.dtype))]
        return TrackArray(len(rows), self.shape[1], blocks, self.missing)

    def read_only(self) -> TrackArray:
        """The same numbers, not to be written through it, as a record keeps them."""
        if not any(values.flags.writeable for _, _, values in self.blocks):
            return self
        kept = copy.copy(self)
        kept.blocks = tuple((rows, first, read_only(values)) for rows, first, values in self.blocks)
        return kept

    def like(self, tail: tuple[int, ...], dtype: Any, missing: Any) -> TrackArray:
        """An array of the same rows and spans, full of what is missing elsewhere."""
        blocks = [
            (rows, first, np.full((*values.shape[:2], *tail), missing, dtype)) for rows, first, values in self.blocks
        ]
        return TrackArray(len(self), self.shape[1], blocks, missing)

    def alike(self, values: Iterable[np.ndarray], missing: Any) -> TrackArray:
        """An array of the same rows and spans that holds these values, block by block."""
        blocks = [(rows, first, own) for (rows, first, _), own in zip(self.blocks, values)]
        return TrackArray(len(self), self.shape[1], blocks, missing)

    def put(self, rows: Sequence[int] | np.ndarray, samples: ArrayLike, values: ArrayLike) -> None:
        """Set rows (r,) at samples (n,) to values (r, n, ..); what falls on nobody is dropped."""
        samples = np.asarray(samples)
        values = np.broadcast_to(values, (len(rows), len(samples), *self.shape[2:]))
        if not len(samples):
            return
        low, high = int(samples.min()), int(samples.max()) + 1
        for row, own in zip(rows, values):
            for first, number, place in self._of_row[int(row)]:
                to = self.blocks[number][2][place]
                if first < high and low < first + len(to):
                    inside = (samples >= first) & (samples < first + len(to))
                    to[samples[inside] - first] = own[inside]


Array: TypeAlias = np.ndarray | TrackArray


def pieces(array: Array, row: int) -> list[tuple[int, np.ndarray]]:
    """(first sample, values (n, ..)) of a row wherever it is there."""
    if not isinstance(array, TrackArray):
        return [(0, array[row])]
    return [(first, array.blocks[number][2][place]) for first, number, place in array._of_row[row]]


def blocks(array: Array) -> Sequence[tuple[np.ndarray, int, np.ndarray]]:
    """(rows rising (r,), first sample, values (r, n, ..)) it is made of; of a plain array all of it."""
    return array.blocks if isinstance(array, TrackArray) else [(np.arange(len(array)), 0, array)]


def parts(array: Array) -> list[np.ndarray]:
    """The arrays it is made of."""
    if not isinstance(array, TrackArray):
        return [array]
    return [each for rows, first, values in array.blocks for each in (rows, np.array(first), values)]


def values(array: Array) -> list[np.ndarray]:
    """What it holds, block by block; arrays like it have the same blocks."""
    return [each for _, _, each in array.blocks] if isinstance(array, TrackArray) else [array]


def writable(array: Array) -> Array:
    """A copy that may be written, in tracks where it is."""
    if isinstance(array, TrackArray):
        return array.alike([own.copy() for own in values(array)], array.missing)
    return array.copy()


def joined(arrays: Sequence[Array]) -> Array:
    """Arrays over the same samples as one, row after row."""
    if not any(isinstance(each, TrackArray) for each in arrays):
        return np.concatenate(arrays)
    found, count = [], 0
    for each in arrays:
        found += [(rows + count, first, values) for rows, first, values in blocks(each)]
        count += len(each)
    return TrackArray(count, arrays[0].shape[1], found)


def put(array: Array, rows: Sequence[int] | np.ndarray, samples: ArrayLike, values: ArrayLike) -> None:
    """Set rows (r,) at samples (n,) of an array or TrackArray to values (r, n, ..)."""
    if isinstance(array, TrackArray):
        array.put(rows, samples, values)
    else:
        array[np.ix_(np.asarray(rows), np.asarray(samples))] = values


def blank(array: Array, tail: tuple[int, ...], dtype: Any, missing: Any) -> Array:
    """An array over the rows and samples of another, dense or not, full of what is missing."""
    if isinstance(array, TrackArray):
        return array.like(tail, dtype, missing)
    return np.full((*array.shape[:2], *tail), missing, dtype)


def some(array: Array, rows: ArrayLike) -> Array:
    """Some rows, rising, of an array or TrackArray."""
    return array.rows(rows) if isinstance(array, TrackArray) else array[np.asarray(rows)]
