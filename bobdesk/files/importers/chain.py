"""Lines that meet end to end become one: the longest way through what a file holds."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, IntArray

_SAME_END = 1e-5  # of the drawing's extent
_MOST_STEPS = 20_000
_MOST_BRANCHES = 300

# A path of the file and whether it is run backwards.
Part = tuple[int, bool]


@dataclass(frozen=True)
class _Link:
    """Paths joined where exactly two meet, from the node `start` to the node `end`."""

    start: int
    end: int
    length: float
    parts: tuple[Part, ...]

    def backwards(self) -> _Link:
        parts = tuple((path, not turned) for path, turned in reversed(self.parts))
        return _Link(self.end, self.start, self.length, parts)


def longest_chain(paths: list[FloatArray]) -> tuple[Part, ...]:
    """Return which paths make the longest line, in order, each with whether it is run backwards.

    Paths join where their ends lie within 1e-5 of the extent of all. Where more than two meet (the
    ladies' start), the longest way without a path twice is taken. It runs as most of it is drawn.

    Parameters
    ----------
    paths
        (n_i, 2) each, n_i at least 2.
    """
    different = _different(paths)
    if len(different) < len(paths):
        chain = longest_chain([paths[index] for index in different])
        return tuple((different[path], turned) for path, turned in chain)
    lengths = np.array([np.hypot(*np.diff(path, axis=0).T).sum() for path in paths])
    nodes = _nodes(paths)
    links = _links(nodes, lengths)
    first = max(links, key=lambda link: link.length)
    best: tuple[_Link, ...] = (first,)
    best_length = first.length
    for trail, length in _trails(links):
        if length > best_length * (1 + 1e-12):
            best, best_length = trail, length
    parts = tuple(part for link in best for part in link.parts)
    backwards = sum(float(lengths[path]) for path, turned in parts if turned)
    if 2 * backwards > sum(float(lengths[path]) for path, _ in parts):
        parts = tuple((path, not turned) for path, turned in reversed(parts))
    return parts


def joined(arrays: list[FloatArray], parts: tuple[Part, ...]) -> FloatArray:
    """Put the rows of the parts one after the other; a common end comes once."""
    pieces: list[FloatArray] = []
    for path, turned in parts:
        piece = arrays[path][::-1] if turned else arrays[path]
        pieces.append(piece[1:] if pieces else piece)
    return np.concatenate(pieces)


def _different(paths: list[FloatArray]) -> list[int]:
    """Return the indices of the paths without repeated ones, which would make a way there and back."""
    seen: dict[bytes, int] = {}
    for index, path in enumerate(paths):
        seen.setdefault(min(path.tobytes(), path[::-1].tobytes()), index)
    return list(seen.values())


def _nodes(paths: list[FloatArray]) -> IntArray:
    """Return the number of the node at the start and end of each path, (m, 2)."""
    # Here, for the table of formats is shown before scipy is loaded.
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    ends = np.concatenate([path[[0, -1]] for path in paths])
    extent = float(max(np.ptp(path, axis=0).max() for path in paths))
    extent = max(extent, float(np.ptp(ends, axis=0).max()), 1e-12)
    cells = (ends - ends.min(axis=0)) / (2 * _SAME_END * extent)
    # Two ends within half a cell share a cell in one of four grids that are half a cell apart.
    rows, columns, count = [], [], len(ends)
    for shift in ((0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)):
        _, cell = np.unique(np.floor(cells + shift), axis=0, return_inverse=True)
        rows.append(np.arange(len(ends)))
        columns.append(count + cell.reshape(-1))
        count += int(cell.max()) + 1
    row, column = np.concatenate(rows), np.concatenate(columns)
    _, labels = connected_components(coo_matrix((np.ones(len(row)), (row, column)), shape=(count, count)))
    return labels[: len(ends)].reshape(-1, 2).astype(np.int64)


def _links(nodes: IntArray, lengths: FloatArray) -> list[_Link]:
    """Join the paths at every node where exactly two ends meet."""
    at: dict[int, list[int]] = defaultdict(list)
    ends = nodes.tolist()
    for path, (start, end) in enumerate(ends):
        at[start].append(path)
        at[end].append(path)
    used: set[int] = set()
    links: list[_Link] = []
    # Rings have no node where a link must begin, so they come after all others.
    for only_from_ends in (True, False):
        for path, (start, end) in enumerate(ends):
            for turned, node in ((False, start), (True, end)):
                if path not in used and (not only_from_ends or len(at[node]) != 2):
                    links.append(_link_from(path, turned, ends, at, used, lengths))
    return links


def _link_from(
    path: int, turned: bool, ends: list[list[int]], at: dict[int, list[int]], used: set[int], lengths: FloatArray
) -> _Link:
    start = ends[path][1 if turned else 0]
    parts: list[Part] = []
    length = 0.0
    while True:
        used.add(path)
        parts.append((path, turned))
        length += float(lengths[path])
        node = ends[path][0 if turned else 1]
        onward = [other for other in at[node] if other not in used] if len(at[node]) == 2 else []
        if not onward:
            return _Link(start, node, length, tuple(parts))
        path = onward[0]
        turned = ends[path][0] != node


def _trails(links: list[_Link]) -> Iterator[tuple[tuple[_Link, ...], float]]:
    """Yield ways over several links, none of them twice, and their lengths; gives up after 20,000."""
    chosen = sorted(links, key=lambda link: -link.length)
    onward: dict[int, list[tuple[int, _Link]]] = defaultdict(list)
    for number, link in enumerate(chosen[:_MOST_BRANCHES]):
        onward[link.start].append((number, link))
        if link.end != link.start:
            onward[link.end].append((number, link.backwards()))
    starts = sorted(onward, key=lambda node: (len(onward[node]) != 1, -onward[node][0][1].length))
    steps = 0
    for start in starts:
        stack: list[tuple[int, tuple[_Link, ...], float, frozenset[int]]] = [(start, (), 0.0, frozenset())]
        while stack:
            node, trail, length, passed = stack.pop()
            for number, link in reversed(onward[node]):
                if number in passed:
                    continue
                yield (*trail, link), length + link.length
                stack.append((link.end, (*trail, link), length + link.length, passed | {number}))
                steps += 1
                if steps > _MOST_STEPS:
                    return
