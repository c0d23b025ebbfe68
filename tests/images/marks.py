"""What vector files show, whatever their format: strokes, fills and pictures in painter's order.

Everything is in points from the lower left corner of the page. Shares nothing with what writes the files.
"""

import re
from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely
from scipy.spatial import cKDTree

PLACE = 1e-3
"""Points by which a path may lie elsewhere: files hold three decimals."""

FINE = 1e-4
"""Points by which a chord strays from its curve where two paths are compared by their distance."""

POINTS = {b"M": 1, b"L": 1, b"Q": 2, b"C": 3, b"Z": 0}
"""Points that follow a command of a path."""


@dataclass(frozen=True, eq=False)
class Path:
    """Cubics (n, 4, 2), straight pieces with their controls at thirds, run after run; none has length zero unless
    it is the whole run."""

    pieces: np.ndarray
    run: np.ndarray
    """(n,): the number of the run that a piece belongs to."""
    closed: np.ndarray
    """(m,): whether a run is closed."""

    def runs(self):
        """The runs as arrays (k, 4, 2)."""
        return np.split(self.pieces, np.flatnonzero(np.diff(self.run)) + 1) if len(self.pieces) else []

    def chosen(self, kept):
        """Some of the runs, numbered anew."""
        number = np.cumsum(kept) - 1
        of_kept = kept[self.run]
        return Path(self.pieces[of_kept], number[self.run[of_kept]], self.closed[kept])

    def chords(self, tolerance=FINE):
        """Chords (n, 2, 2) that stray from the path by at most `tolerance`, and the run of each (n,)."""
        bend = np.linalg.norm(self.pieces[:, :-2] - 2 * self.pieces[:, 1:-1] + self.pieces[:, 2:], axis=-1)
        parts = np.maximum(1, np.ceil(np.sqrt(0.75 * bend.max(axis=-1, initial=0.0) / tolerance))).astype(np.intp)
        piece = np.repeat(np.arange(len(parts)), parts)
        step = np.arange(len(piece)) - np.repeat(np.cumsum(parts) - parts, parts)
        ends = [_on(self.pieces[piece], (step + more) / parts[piece]) for more in (0, 1)]
        return np.stack(ends, axis=1), self.run[piece]

    def box(self):
        """Left, bottom, right, top."""
        points = self.chords(1e-2)[0].reshape(-1, 2)
        return np.concatenate([points.min(axis=0), points.max(axis=0)])


@dataclass(frozen=True, eq=False)
class Mark:
    """One thing that is drawn: a path that is stroked or filled, or a picture."""

    kind: Literal["stroke", "fill", "image"]
    color: tuple[int, int, int, int] = (0, 0, 0, 255)
    """Red, green, blue, opacity in levels of 1/255."""
    path: Path | None = None
    width: float = 0.0
    dash: tuple[float, ...] = ()
    cap: str = ""
    join: str = ""
    even_odd: bool = False
    place: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """Of a picture: left, bottom, right, top."""
    pixels: np.ndarray | None = None
    """Of a picture: (h, w, 4), rows from the top."""
    clips: tuple[Path, ...] = ()
    light: "Light | None" = None
    """Of a fill that is lit: in place of its colour, of which the opacity stays."""
    group: str = ""
    """The named group that it lies in, with a number, in SVG."""


@dataclass(frozen=True, eq=False)
class Light:
    """A radial gradient between circles about (1 − s) focus + s centre with radii s · radius."""

    focus: np.ndarray
    center: np.ndarray
    radius: float
    offsets: np.ndarray
    """Values of s, from 0 to 1."""
    colors: np.ndarray
    """Red, green and blue at each of them (n, 3), from 0 to 1."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """What a file shows and tells."""

    size: tuple[float, float]
    """Width and height in points."""
    marks: list[Mark]
    """In painter's order."""
    title: str
    description: str
    texts: list[str]
    """The lines of type, as they are copied out of the file."""


def short_numbers(text):
    """Whether no number of a text has more decimals than three."""
    return re.search(r"\.\d{4}", text) is None


def levels(red, green, blue, opacity=1.0):
    """A colour in levels of 1/255."""
    return tuple(int(np.floor(255 * value + 0.5)) for value in (red, green, blue, opacity))


def path_of(commands, numbers):
    """The path of a string of absolute commands (M, L, Q, C, Z), and their numbers one after another."""
    kinds = np.frombuffer(commands, dtype="S1")
    count = np.zeros(len(kinds), dtype=np.intp)
    for kind, points in POINTS.items():
        count[kinds == kind] = points
    assert 2 * count.sum() == len(numbers), "commands and numbers of a path do not agree"
    assert len(kinds) == 0 or kinds[0] == b"M", "a path must begin somewhere"
    points = np.asarray(numbers, dtype=np.float64).reshape(-1, 2)
    last = np.cumsum(count) - 1
    move, close = kinds == b"M", kinds == b"Z"
    assert move[1:][close[:-1]].all(), "a path goes on after it was closed"
    first = np.maximum.accumulate(np.where(move, np.arange(len(kinds)), 0))
    end = points[np.where(close, last[first], last)] if len(points) else np.zeros((0, 2))
    begin = np.roll(end, 1, axis=0)
    pieces = np.linspace(begin, end, 4, axis=1)
    cubic, quadratic = np.flatnonzero(kinds == b"C"), np.flatnonzero(kinds == b"Q")
    pieces[cubic, 1], pieces[cubic, 2] = points[last[cubic] - 2], points[last[cubic] - 1]
    bend = points[last[quadratic] - 1]
    pieces[quadratic, 1] = (begin[quadratic] + 2 * bend) / 3
    pieces[quadratic, 2] = (end[quadratic] + 2 * bend) / 3
    run = np.cumsum(move) - 1
    closed = np.zeros(move.sum(), dtype=bool)
    closed[run[close]] = True
    return tidy(pieces[~move], run[~move], closed)


def tidy(pieces, run, closed):
    """A path without pieces of length zero; a run of nothing else keeps one, and one of no pieces falls out."""
    long = np.abs(pieces - pieces[:, :1]).max(axis=(1, 2), initial=0.0) > PLACE / 10
    has_long = np.bincount(run, weights=long, minlength=len(closed)) > 0
    first = np.concatenate([[True], run[1:] != run[:-1]])[: len(run)]
    kept = long | (first & ~has_long[run])
    there = np.bincount(run, minlength=len(closed)) > 0
    number = np.cumsum(there) - 1
    return Path(pieces[kept], number[run[kept]], closed[there])


def transformed(path, matrix):
    """A path under an affine map (3, 3)."""
    return Path(path.pieces @ matrix[:2, :2].T + matrix[:2, 2], path.run, path.closed)


def together(paths):
    """Several paths as one."""
    paths = list(paths)
    before = np.cumsum([0] + [len(path.closed) for path in paths])
    return Path(
        np.concatenate([np.zeros((0, 4, 2)), *(path.pieces for path in paths)]),
        np.concatenate([np.zeros(0, np.intp), *(path.run + n for path, n in zip(paths, before, strict=False))]),
        np.concatenate([np.zeros(0, bool), *(path.closed for path in paths)]),
    )


def area(path):
    """Area of each run, positive where it goes counterclockwise; an open run is closed."""
    chords, run = path.chords()
    first = np.searchsorted(run, np.arange(len(path.closed)))
    (x0, y0), (x1, y1) = (chords[:, end].T - chords[first, 0][run].T for end in (0, 1))
    return np.bincount(run, weights=(x0 * y1 - x1 * y0) / 2, minlength=len(path.closed))


def distances(points, sides, enough=0.0):
    """Distance of each of the points (n, 2) from the nearest of the segments (m, 2, 2).

    Where an end of a segment is closer than `enough`, the distance from that end.
    """
    distance = cKDTree(sides.reshape(-1, 2)).query(points)[0]
    far = np.flatnonzero(distance > enough)
    tree = shapely.STRtree(shapely.linestrings(sides))
    index, distance[far] = tree.query_nearest(shapely.points(points[far]), return_distance=True, all_matches=False)
    assert np.array_equal(index[0], np.arange(len(far)))
    return distance


def _on(pieces, s):
    s = np.asarray(s)[:, None]
    p0, p1, p2, p3 = (pieces[:, i] for i in range(4))
    return (1 - s) ** 3 * p0 + 3 * s * (1 - s) ** 2 * p1 + 3 * s**2 * (1 - s) * p2 + s**3 * p3
