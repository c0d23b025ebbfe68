"""Faces of the sphere as polygons on the map of longitude and latitude that tile it.

All sides are cut and sampled once, for both faces beside them, so that neighbours share every point. Two things are
left to do on a map, where points are joined by straight lines: no line may come too near to a site, which must stay in
its own cell; and no two lines may cross, where a face is narrower than its lines stray.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Geometries, Indices, Packed
from stereodel._extras import optional
from stereodel._threads import in_order, thread_count
from stereodel.constants import BORDER_STEPS, CHORD_CLEARANCE, DEGREE_ROUNDING, THIN_CELL
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Pieces
from stereodel.curves.ragged import Ragged, spans
from stereodel.curves.trace import Arcs, great
from stereodel.io.layers import Progress, is_there, packed, unpacked
from stereodel.io.on_map import close_in_longitude, lines_on_map, polygons_on_map, refined, repaired, steps_of, unit
from stereodel.sphere import xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude

shapely = optional("shapely", "geo")

BLOCK = 20_000
"""Faces, and arcs, that are worked on at once by a thread: more take more memory and no less time."""
WORLD = 360.0 * 180.0
"""Area of the map, square degrees."""


@dataclass(frozen=True, eq=False)
class Net:
    """Great-circle arcs between vertices, as they bound faces."""

    vertices: FloatArray
    """(v, 3) unit vectors."""
    ends: Indices
    """(e, 2): the vertices where each arc starts and ends."""
    normals: Callable[[], FloatArray] | None = None
    """Gives those of the arcs' planes (e, 3), where their ends may be opposite; asked for long arcs alone."""
    sites: FloatArray | None = None
    """(n, 3): unit vectors that must stay on their side of arcs."""
    site: Indices | None = None
    """(e,): that of each arc."""

    def __len__(self) -> int:
        return len(self.ends)

    def arcs(self, block: slice = slice(None)) -> Arcs:
        """Some of the arcs, numbered from 0."""
        start, end = self.vertices[self.ends[block]].transpose(1, 0, 2)
        long = (np.sum(start * end, axis=1) < 0).any()
        return great(start, end, self._normals[block] if long else None)

    @cached_property
    def _normals(self) -> FloatArray:
        return np.zeros((len(self), 3)) if self.normals is None else self.normals()


def sphere_lines(arcs: Arcs, max_segment: float, latitude: Latitude, lines: Ragged | None = None) -> Geometries:
    """A LineString for each arc or row of arcs, a MultiLineString for one that crosses the 180th meridian or a pole."""
    border = Antimeridian(latitude=latitude)
    pieces = border.cut(arcs)
    rows = Ragged(np.arange(len(arcs)), np.arange(len(arcs) + 1)) if lines is None else lines
    return lines_on_map(rows, np.arange(len(rows)), len(rows), pieces, _sampled(pieces, max_segment), border)


def sphere_polygons(
    net: Net, faces: Ragged, max_segment: float, latitude: Latitude, progress: Progress | None = None
) -> Packed:
    """A Polygon or MultiPolygon for each face, a row of sides; None for one without sides.

    Faces are no larger than a hemisphere. Arcs and faces are taken in blocks, by several threads. All geometries would
    take three times the memory of their well-known binary.
    """
    border, threads = Antimeridian(latitude=latitude), thread_count(None, len(faces))
    told = _Told(progress, len(range(0, len(net), BLOCK)) + len(range(0, len(faces), BLOCK)))
    pieces, samples = _prepared(net, max_segment, border, threads, told)
    rows = np.arange(len(faces))
    result, wrong, large = _drawn(faces, rows, pieces, samples, border, threads, told)
    # If all rings are simple and counterclockwise they tile the map, as each side is shared by two. So chords of the
    # others are halved, and what lies on the other side of them is drawn anew, too.
    while len(places := _crossing(faces.take(wrong), pieces, samples, border)):
        finer = np.zeros(len(net), dtype=bool)
        finer[pieces.arcs.edge[np.searchsorted(samples.offsets, places, side="right") - 1]] = True
        middles = unit(samples.values[places, :3] + samples.values[places + 1, :3])
        samples = samples.inserted(places + 1, _with_lonlat(middles, latitude))
        changed = np.unique(faces.row[finer[np.maximum(faces.values, ~faces.values)]])
        result[changed], wrong[changed], large[changed] = _drawn(faces, changed, pieces, samples, border, threads)
    # A border that runs round a pole the other way by rounding has the rest of the map inside.
    some = np.flatnonzero(large)
    result[some[_Walk(faces.take(some), pieces, samples).widths < THIN_CELL]] = None
    bad = np.flatnonzero(wrong)
    bad = bad[is_there(result[bad])]
    result[bad] = packed(repaired(unpacked(result[bad]), np.ones(len(bad), dtype=bool)))
    return result


class _Told:
    """Tells how much of so many steps is done."""

    def __init__(self, progress: Progress | None, steps: int) -> None:
        self._progress, self._steps, self._done = progress, steps, 0

    def step(self) -> None:
        """One more is done."""
        self._done += 1
        if self._progress is not None:
            self._progress(self._done / self._steps)


def _blocks(size: int) -> Iterator[slice]:
    return (slice(begin, min(begin + BLOCK, size)) for begin in range(0, size, BLOCK))


def _prepared(net: Net, max_segment: float, border: Antimeridian, threads: int, told: _Told) -> tuple[Pieces, Ragged]:
    """All arcs cut at the border, and points of them (k, 5) that bring their longitude and latitude.

    Of the pieces clipping asks for no more than which of them meet.
    """
    slices = list(_blocks(len(net.vertices)))
    lonlat = np.zeros((len(net.vertices), 2))
    for block, found in zip(
        slices,
        in_order(lambda b: xyz_to_lonlat(net.vertices[b], latitude=border.latitude), slices, threads),
        strict=True,
    ):
        lonlat[block] = found
    # Room for both ends of each arc and some more; what is not written to takes no memory.
    values, filled = np.empty((3 * len(net), 5)), 0
    parts: list[tuple[Indices, BoolArray, BoolArray, BoolArray, Indices]] = []
    for part, points in in_order(
        partial(_prepared_block, net, lonlat, max_segment, border), _blocks(len(net)), threads
    ):
        parts.append(part)
        if filled + len(points) > len(values):
            values = np.concatenate([values[:filled], np.empty((len(values) + len(points), 5))])
        values[filled : filled + len(points)] = points
        filled += len(points)
        told.step()
    if not parts:
        parts.append(_prepared_block(net, lonlat, max_segment, border, slice(0, 0))[0])
    edge, opens, shuts, along, sizes = (np.concatenate([part[k] for part in parts]) for k in range(5))
    offsets = np.append(0, np.cumsum(sizes))
    # Which points are the same can be told by the numbers of the vertices; cuts are no ends of arcs.
    first = np.append(True, edge[1:] != edge[:-1])[: len(edge)]
    last = np.append(first[1:], True)[: len(edge)]
    start, end = (np.where(at, net.ends[edge, k], np.int32(-1))[:, None] for k, at in enumerate((first, last)))
    nothing = np.zeros((len(edge), 0))
    arcs = Arcs(start, end, nothing, nothing, nothing, nothing, nothing, edge)
    return Pieces(arcs, opens, shuts, np.ones(len(edge), dtype=bool), along), Ragged(values[:filled], offsets)


def _prepared_block(
    net: Net, lonlat: FloatArray, max_segment: float, border: Antimeridian, block: slice
) -> tuple[tuple[Indices, BoolArray, BoolArray, BoolArray, Indices], FloatArray]:
    """Of the pieces of some arcs: edge, whether it begins and ends at the border and runs along it, size and points."""
    pieces = border.cut(net.arcs(block))
    samples = _sampled(pieces, max_segment)
    edge = pieces.arcs.edge
    if net.sites is not None and net.site is not None:
        samples = _clear_of_sites(samples, pieces, border, net.sites[net.site[block]])
    values = np.concatenate([samples.values, np.zeros((len(samples.values), 2))], axis=1)
    unknown = np.ones(len(values), dtype=bool)
    # Most points are vertices, each of several arcs.
    for place, vertex in zip((samples.offsets[:-1], samples.offsets[1:] - 1), net.ends[block][edge].T, strict=True):
        same = (samples.values[place] == net.vertices[vertex]).all(axis=1)
        values[place[same], 3:] = lonlat[vertex[same]]
        unknown[place[same]] = False
    values[unknown] = _with_lonlat(samples.values[unknown], border.latitude)
    return (edge + block.start, pieces.opens, pieces.shuts, pieces.along, samples.sizes), values


def _with_lonlat(points: FloatArray, latitude: Latitude) -> FloatArray:
    """Points (n, 3) with their longitude and latitude behind them."""
    return np.concatenate([points, xyz_to_lonlat(points, latitude=latitude)], axis=1)


def _sampled(pieces: Pieces, max_segment: float) -> Ragged:
    """Points of pieces of great circles, at most so many degrees apart, also in longitude."""
    step_rad, sweep = float(np.radians(max_segment)), pieces.arcs.stop - pieces.arcs.begin
    steps = np.maximum(np.ceil(sweep / step_rad), 1).astype(np.intp)
    return close_in_longitude(pieces.arcs.spread(steps), step_rad)


def _clear_of_sites(samples: Ragged, pieces: Pieces, border: Antimeridian, sites: FloatArray) -> Ragged:
    """Points of pieces with further ones where a chord strays by too large a part of its distance from the site."""
    foot = np.abs(np.sum(sites[pieces.arcs.edge] * pieces.arcs.axis, axis=1))

    def rule(some: Ragged, rows: Indices) -> tuple[Indices, FloatArray]:
        step = steps_of(some)
        piece = rows[some.row[step]]
        p, q = some.values[step], some.values[step + 1]
        middle = unit(p + q)
        # A site is at least as far from an arc as from its plane, and as from its middle but for half the chord.
        gap, half = sites[pieces.arcs.edge[piece]] - middle, np.sqrt(np.sum((q - p) ** 2, axis=1)) / 2
        away = np.maximum(foot[piece], np.sqrt(np.sum(gap**2, axis=1)) - half)
        allowed = np.maximum(CHORD_CLEARANCE * np.degrees(away), DEGREE_ROUNDING)
        # Few chords come near to that, and of the others no latitudes are needed.
        unsure = np.flatnonzero(_most_straying(middle, half) > allowed)
        off = _straying(some, step[unsure], middle[unsure], pieces.along[piece[unsure]], border)
        off[:, 0] *= np.hypot(middle[unsure, 0], middle[unsure, 1])
        near = unsure[np.hypot(*off.T) > allowed[unsure]]
        return step[near], middle[near]

    return refined(samples, rule)


def _most_straying(middle: FloatArray, half: FloatArray) -> FloatArray:
    """Bounds on how far short chords on the map are off their arcs, degrees of a great circle; infinite for others.

    Along a great circle, t in radians, |φ''| ≤ tan φ and |λ''| ≤ tan φ/cos φ. Where cos φ is at least c on an arc of
    the length 2h, and at most 2c at its middle, they are off by h²/(2c) in latitude and h²/c in λ cos φ. Other kinds of
    latitude change the former by 1.5 % of 1/c + 1. Together that is below 2h²/c. The cosine changes by h at most.
    """
    reach, h = np.hypot(middle[:, 0], middle[:, 1]), 1.1 * half  # arcs of up to 57° are 5 % longer than their chords
    least = reach - h
    short = (half < 0.48) & (2 * least > reach)
    return np.where(short, np.degrees(2 * h**2 / np.where(short, least, 1.0)), np.inf)


def _straying(samples: Ragged, step: Indices, middle: FloatArray, along: BoolArray, border: Antimeridian) -> FloatArray:
    """How far the middles of chords on the map are off those of the arcs, (s, 2), in longitude and latitude."""
    # The two ends of each chord alone: an end on the meridian or at a pole has the side of the other.
    ends = Ragged(samples.values[np.stack([step, step + 1], axis=1).ravel()], 2 * np.arange(len(step) + 1))
    flat = border.flat(ends)
    off = np.abs(xyz_to_lonlat(middle, latitude=border.latitude) - (flat[::2] + flat[1::2]) / 2)
    off[:, 0] = np.minimum(off[:, 0], np.abs(360 - off[:, 0]))
    off[along] = 0.0
    return off


def _drawn(
    faces: Ragged,
    rows: Indices,
    pieces: Pieces,
    samples: Ragged,
    border: Antimeridian,
    threads: int,
    told: _Told | None = None,
) -> tuple[Packed, BoolArray, BoolArray]:
    """Some of the faces as polygons, which of them are not simple and counterclockwise, and which are large."""
    result = np.full(len(rows), None, dtype=object)
    wrong, large = np.zeros(len(rows), dtype=bool), np.zeros(len(rows), dtype=bool)
    blocks = list(_blocks(len(rows)))

    def drawn(block: slice) -> tuple[Packed, BoolArray, BoolArray]:
        return _drawn_block(faces.take(rows[block]), pieces, samples, border)

    pieces.of_edge  # noqa: B018 - once, and not by each thread
    for block, found in zip(blocks, in_order(drawn, blocks, threads), strict=True):
        result[block], wrong[block], large[block] = found
        if told is not None:
            told.step()
    return result, wrong, large


def _drawn_block(
    faces: Ragged, pieces: Pieces, samples: Ragged, border: Antimeridian
) -> tuple[Packed, BoolArray, BoolArray]:
    count = len(faces)
    loops, owner = clip.regions(faces, np.arange(count), count, pieces, samples, border)
    polygons, outer = polygons_on_map(loops, owner, count)
    wrong = ~shapely.is_valid(polygons)
    wrong[owner[~outer]] = True  # convex faces have no holes
    return packed(polygons), wrong, shapely.area(polygons) > WORLD / 10


class _Walk:
    """The steps around faces, from each point of their sides to the next."""

    def __init__(self, faces: Ragged, pieces: Pieces, samples: Ragged) -> None:
        edge = np.maximum(faces.values, ~faces.values)
        first, last = (np.searchsorted(pieces.arcs.edge, edge, side=side) for side in ("left", "right"))
        piece = spans(first, last - first)
        self.count = len(faces)
        self.pieces, number = np.unique(piece, return_inverse=True)
        self.samples = samples.take(self.pieces)
        self.origin = spans(samples.offsets[self.pieces], self.samples.sizes)
        """Where the points are among all."""
        sizes = self.samples.sizes[number] - 1
        self.step = spans(self.samples.offsets[number], sizes)
        self.face = np.repeat(np.repeat(faces.row, last - first), sizes)
        self.way = np.repeat(np.repeat(np.where(faces.values < 0, -1.0, 1.0), last - first), sizes)

    @property
    def widths(self) -> FloatArray:
        """About how wide faces are, (f,), infinite for those that are not narrow: area over length of the border.

        The area as seen from the middle of the border, where chords of one great circle cancel however they are cut. A
        narrow face is no longer than half a great circle, whose points have a mean of length 2/π.
        """
        start, chord = self.samples.values[self.step, :3], self.samples.values[self.step + 1, :3]
        chord = chord - start
        lengths = np.sqrt(np.sum(chord**2, axis=1))
        length = np.maximum(np.bincount(self.face, lengths, minlength=self.count), np.finfo(np.float64).tiny)
        sums = [np.bincount(self.face, start[:, k] * lengths, minlength=self.count) for k in range(3)]
        middle = np.stack(sums, axis=1) / length[:, None]
        seen = np.sum(middle[self.face] * np.cross(start, chord), axis=1) * self.way
        area = np.abs(np.bincount(self.face, seen, minlength=self.count))
        return np.where(np.sum(middle**2, axis=1) > 1 / 4, area / length, np.inf)


def _crossing(faces: Ragged, pieces: Pieces, samples: Ragged, border: Antimeridian) -> Indices:
    """The points behind which chords should be halved, in order.

    Those that stray as far as to another chord of the same face; all of a face in which none does.
    """
    walk = _Walk(faces, pieces, samples)
    step, face = walk.step, walk.face
    if not len(step):
        return step
    flat = border.flat(walk.samples)
    ends = np.stack([flat[step], flat[step + 1]], axis=1)
    middle = unit(walk.samples.values[step, :3] + walk.samples.values[step + 1, :3])
    along = pieces.along[walk.pieces[walk.samples.row[step]]]
    off = _straying(walk.samples, step, middle, along, border).max(axis=1)
    lines = shapely.linestrings(ends)
    i, j = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=2 * off)
    apart = (ends[i][:, :, None] != ends[j][:, None]).any(axis=-1).all(axis=(1, 2))
    near = np.zeros(len(step), dtype=bool)
    near[i[(face[i] == face[j]) & apart]] = True
    chosen = (near | (np.bincount(face, near, minlength=walk.count) == 0)[face]) & (off > DEGREE_ROUNDING)
    useful = (np.bincount(face, chosen, minlength=walk.count) <= BORDER_STEPS) & (walk.widths > THIN_CELL)
    return np.unique(walk.origin[step[chosen & useful[face]]])
