"""Faces of the sphere as polygons that tile the map of longitude and latitude.

Each side is cut and sampled once for the two faces that share it, so that neighbours share every point. Two problems
remain on a map, where points are joined by straight chords: no chord may come too near to a site, which must stay
inside its own cell; and no two chords may cross where a face is narrower than the distance between chord and arc.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import count
from typing import Any

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices, Packed
from stereodel._tasks.progress import Progress
from stereodel._tasks.threads import in_order, thread_count
from stereodel.constants import AT_POLE, BORDER_STEPS, CHORD_CLEARANCE, DEGREE_ROUNDING, THIN_CELL
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Pieces
from stereodel.curves.ragged import Ragged, offsets_of, spans
from stereodel.curves.trace import Arcs, great, sides_of
from stereodel.io.formats import wkb
from stereodel.io.formats.map_rows import packed, shapely, unpacked
from stereodel.io.maps.on_map import (
    close_in_longitude,
    invalid,
    lines_on_map,
    polygons_on_map,
    refined,
    repaired,
    simple,
)
from stereodel.sphere import xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units

Step = Callable[[], None]
"""Reports progress."""

BLOCK = 20_000
"""Faces, or arcs, in a thread's block: larger blocks take more memory and save no time."""
WORLD = 360.0 * 180.0
"""Area of the map, square degrees."""
SHORT = 0.48
"""Half the length of chords of arcs of up to 57°, which are 5 % longer than their chords."""
LONGER = 1.1
"""Bound on the ratio of those arcs to their chords, with a margin for rounding."""


@dataclass(frozen=True, eq=False)
class Net:
    """Great-circle arcs between vertices, which bound the faces."""

    vertices: FloatArray
    """(v, 3) unit vectors."""
    ends: Indices
    """(e, 2): the vertices where each arc starts and ends."""
    normals: Callable[[], FloatArray] | None = None
    """Returns the arcs' normals (e, 3), needed where endpoints may be antipodal; called only if there are long arcs."""
    sites: FloatArray | None = None
    """(n, 3): unit vectors that must stay on their own side of the arcs."""
    site: Indices | None = None
    """(e,): index of the site next to each arc."""

    def __len__(self) -> int:
        return len(self.ends)

    def arcs(self, block: slice | Indices = slice(None)) -> Arcs:
        """A block of the arcs, renumbered from 0."""
        start, end = self.vertices[self.ends[block]].transpose(1, 0, 2)
        long = (np.sum(start * end, axis=1) < 0).any()
        return great(start, end, self._normals[block] if long else None)

    @cached_property
    def _normals(self) -> FloatArray:
        return np.zeros((len(self), 3)) if self.normals is None else self.normals()


@dataclass(frozen=True, eq=False)
class Sides:
    """The arcs of a net on the map."""

    border: Antimeridian
    pieces: Pieces
    """The arcs cut at the border, with only what clipping needs: which of them meet."""
    samples: Ragged
    """Sample points of the pieces (k, 5): unit vectors followed by longitude and latitude."""
    inland: BoolArray
    """(e,): which arcs certainly do not meet the border; each has one piece."""


def sphere_lines(arcs: Arcs, max_segment: float, latitude: Latitude, lines: Ragged | None = None) -> Packed:
    """A LineString for each arc or row of arcs, a MultiLineString for one that crosses the 180th meridian or a pole."""
    border = Antimeridian(latitude=latitude)
    pieces = border.cut(arcs)
    rows = Ragged(np.arange(len(arcs)), np.arange(len(arcs) + 1)) if lines is None else lines
    return lines_on_map(rows, np.arange(len(rows)), len(rows), pieces, _sampled(pieces, max_segment), border)


def sphere_polygons(
    net: Net, faces: Ragged, max_segment: float, latitude: Latitude, progress: Progress | None = None
) -> Packed:
    """A Polygon or MultiPolygon for each face, given as a row of sides; None for a face without sides.

    Faces are at most hemispheres. Arcs and faces are processed in blocks by several threads. The result is well-known
    binary, a third of the memory of geometry objects.
    """
    threads = thread_count(None, len(faces))
    steps = sum(len(list(_blocks(len(each)))) for each in (net, faces))
    done = count(1)

    def step() -> None:
        if progress is not None:
            progress("drawing", next(done), steps)

    sides = _prepared(net, max_segment, Antimeridian(latitude=latitude), threads, step)
    result, wrong, large = _drawn(faces, np.arange(len(faces)), sides, threads, step)
    # Rings that are all simple and counterclockwise tile the map, since each side is shared by two faces. So the chords
    # of the other rings are halved, and the faces across them are rebuilt, too.
    while len(places := _crossing(faces.take(wrong), sides)):
        samples = sides.samples
        finer = np.zeros(len(net), dtype=bool)
        finer[sides.pieces.arcs.edge[np.searchsorted(samples.offsets, places, side="right") - 1]] = True
        middles = units(samples.values[places, :3] + samples.values[places + 1, :3])
        sides = replace(sides, samples=samples.inserted(places + 1, _with_lonlat(middles, latitude)))
        changed = np.unique(faces.row[finer[np.maximum(faces.values, ~faces.values)]])
        result[changed], wrong[changed], large[changed] = _drawn(faces, changed, sides, threads)
    # A border that rounding errors lead around the wrong side of a pole encloses the rest of the map.
    some = np.flatnonzero(large)
    result[some[_Walk(faces.take(some), sides).widths < THIN_CELL]] = None
    bad = np.flatnonzero(wrong)
    bad = bad[wkb.is_there(result[bad])]
    if len(bad):
        result[bad] = packed(repaired(unpacked(result[bad]), np.ones(len(bad), dtype=bool)))
    return result


def _blocks(size: int) -> Iterator[slice]:
    return (slice(begin, min(begin + BLOCK, size)) for begin in range(0, size, BLOCK))


def _prepared(net: Net, max_segment: float, border: Antimeridian, threads: int, step: Step) -> Sides:
    """All arcs cut at the border, with their sample points."""
    lonlat = np.zeros((len(net.vertices), 2))

    def located(block: slice) -> None:
        lonlat[block] = xyz_to_lonlat(net.vertices[block], latitude=border.latitude)

    deque(in_order(located, _blocks(len(net.vertices)), threads), maxlen=0)
    inland = np.zeros(len(net), dtype=bool)
    parts: list[tuple[Any, ...]] = []
    prepared = partial(_prepared_block, net, lonlat, max_segment, border, inland)
    for part in in_order(prepared, _blocks(len(net)), threads):
        parts.append(part)
        step()
    parts = parts or [prepared(slice(0, 0))]
    edge, opens, shuts, along, sizes, values = (np.concatenate(each) for each in zip(*parts, strict=True))
    # Vertex indices say which points coincide; cuts are not endpoints of arcs.
    first = np.append(True, edge[1:] != edge[:-1])[: len(edge)]
    last = np.append(first[1:], True)[: len(edge)]
    start, end = (np.where(at, net.ends[edge, k], np.int32(-1))[:, None] for k, at in enumerate((first, last)))
    nothing = np.zeros((len(edge), 0))
    arcs = Arcs(start, end, nothing, nothing, nothing, nothing, nothing, edge)
    pieces = Pieces(arcs, opens, shuts, np.ones(len(edge), dtype=bool), along)
    return Sides(border, pieces, Ragged(values, offsets_of(sizes)), inland)


def _prepared_block(
    net: Net, lonlat: FloatArray, max_segment: float, border: Antimeridian, inland: BoolArray, block: slice
) -> tuple[Indices, BoolArray, BoolArray, BoolArray, Indices, FloatArray]:
    """The pieces of a block of arcs: edge, whether each opens, shuts and follows the border, size; and the points.

    Which of the arcs do not meet the border is written to `inland`.
    """
    inland[block], ends = _inland(net, block), net.ends[block]
    pieces = border.cut(net.arcs(block))
    samples = _sampled(pieces, max_segment)
    if net.sites is not None and net.site is not None:
        samples = _clear_of_sites(samples, pieces, border, net.sites[net.site[block]])
    values = np.concatenate([samples.values, np.zeros((len(samples.values), 2))], axis=1)
    unknown = np.ones(len(values), dtype=bool)
    # Most points are vertices, each of several arcs.
    for place, vertex in zip((samples.offsets[:-1], samples.offsets[1:] - 1), ends[pieces.arcs.edge].T, strict=True):
        same = (samples.values[place] == net.vertices[vertex]).all(axis=1)
        values[place[same], 3:] = lonlat[vertex[same]]
        unknown[place[same]] = False
    values[unknown] = _with_lonlat(samples.values[unknown], border.latitude)
    return pieces.arcs.edge + block.start, pieces.opens, pieces.shuts, pieces.along, samples.sizes, values


def _inland(net: Net, block: slice) -> BoolArray:
    """Which of some arcs certainly do not meet the border of the map: in a large diagram, nearly all of them."""
    start, end = net.vertices[net.ends[block]].transpose(1, 0, 2)
    # No point of an arc is farther from its start than its end is; twice that leaves room for rounding.
    return np.maximum(np.abs(start[:, 1]), start[:, 0]) > 2 * np.maximum(_lengths(end - start), AT_POLE)


def _with_lonlat(points: FloatArray, latitude: Latitude) -> FloatArray:
    """Points (n, 3) followed by their longitude and latitude, (n, 5)."""
    return np.concatenate([points, xyz_to_lonlat(points, latitude=latitude)], axis=1)


def _sampled(pieces: Pieces, max_segment: float) -> Ragged:
    """Points on pieces of great circles, at most `max_segment` degrees apart, in longitude as well."""
    step_rad, sweep = float(np.radians(max_segment)), pieces.arcs.stop - pieces.arcs.begin
    steps = np.maximum(np.ceil(sweep / step_rad), 1).astype(np.intp)
    return close_in_longitude(pieces.arcs.spread(steps), step_rad)


def _clear_of_sites(samples: Ragged, pieces: Pieces, border: Antimeridian, sites: FloatArray) -> Ragged:
    """The samples, refined where a chord departs from its arc by too large a share of its distance to the site."""
    foot = np.abs(np.sum(sites[pieces.arcs.edge] * pieces.arcs.axis, axis=1))

    def rule(some: Ragged, rows: Indices) -> tuple[Indices, FloatArray]:
        step, _ = sides_of(some)
        piece = rows[some.row[step]]
        p, q = some.values[step], some.values[step + 1]
        middle, half = units(p + q), _lengths(q - p) / 2
        # A site is at least as far from an arc as from its plane, and as from its midpoint less half the chord.
        away = np.maximum(foot[piece], _lengths(sites[pieces.arcs.edge[piece]] - middle) - half)
        allowed = np.maximum(CHORD_CLEARANCE * np.degrees(away), DEGREE_ROUNDING)
        # Few chords come close to the limit; the others need no latitudes.
        unsure = np.flatnonzero(_most_straying(middle, half) > allowed)
        off = _straying(some, step[unsure], middle[unsure], pieces.along[piece[unsure]], border)
        off[:, 0] *= np.hypot(middle[unsure, 0], middle[unsure, 1])
        near = unsure[np.hypot(*off.T) > allowed[unsure]]
        return step[near], middle[near]

    return refined(samples, rule)


def _lengths(vectors: FloatArray) -> FloatArray:
    """Lengths of vectors (n, 3), for comparisons."""
    return np.sqrt(np.einsum("ij,ij->i", vectors, vectors))


def _most_straying(middle: FloatArray, half: FloatArray) -> FloatArray:
    """Bounds on the distance of short chords on the map from their arcs, in degrees of a great circle; else infinite.

    Along a great circle, parametrised by arc length in radians, |φ''| ≤ tan φ and |λ''| ≤ tan φ/cos φ. On an arc of
    length 2h where cos φ is at least c, and at most 2c at the midpoint, a chord is off by h²/(2c) in latitude and h²/c
    in λ cos φ. Other kinds of latitude change the former by 1.5 % of 1/c + 1. The sum is below 2h²/c. The cosine
    changes by at most h.
    """
    reach = np.hypot(middle[:, 0], middle[:, 1])
    least = reach - LONGER * half
    near = (half < SHORT) & (2 * least > reach) & (least > 0)
    return np.where(near, np.degrees(2 * (LONGER * half) ** 2 / np.where(near, least, 1.0)), np.inf)


def _straying(samples: Ragged, step: Indices, middle: FloatArray, along: BoolArray, border: Antimeridian) -> FloatArray:
    """Distances of the midpoints of chords on the map from those of their arcs, (s, 2), in longitude and latitude."""
    # Endpoints of each chord by itself: an endpoint on the 180th meridian or at a pole takes the side of the other one.
    ends = Ragged(samples.values[np.stack([step, step + 1], axis=1).ravel()], 2 * np.arange(len(step) + 1))
    flat = border.flat(ends)
    off = np.abs(xyz_to_lonlat(middle, latitude=border.latitude) - (flat[::2] + flat[1::2]) / 2)
    off[:, 0] = np.minimum(off[:, 0], np.abs(360 - off[:, 0]))
    off[along] = 0.0
    return off


def _drawn(
    faces: Ragged, rows: Indices, sides: Sides, threads: int, step: Step = lambda: None
) -> tuple[Packed, BoolArray, BoolArray]:
    """Polygons of some of the faces, which are not simple and counterclockwise, and which are large."""
    result = np.full(len(rows), None, dtype=object)
    wrong, large = np.zeros(len(rows), dtype=bool), np.zeros(len(rows), dtype=bool)
    blocks = list(_blocks(len(rows)))
    sides.pieces.of_edge  # noqa: B018 - computed once here, not by each thread
    drawn = in_order(lambda block: _drawn_block(faces.take(rows[block]), sides), blocks, threads)
    for block, found in zip(blocks, drawn, strict=True):
        result[block], wrong[block], large[block] = found
        step()
    return result, wrong, large


def _drawn_block(faces: Ragged, sides: Sides) -> tuple[Packed, BoolArray, BoolArray]:
    """First the faces that do not meet the border and whose rings are simple; the others are clipped in full."""
    result, large = np.full(len(faces), None, dtype=object), np.zeros(len(faces), dtype=bool)
    wrong, others = np.zeros(len(faces), dtype=bool), np.ones(len(faces), dtype=bool)
    inland = np.bincount(faces.row, ~sides.inland[np.maximum(faces.values, ~faces.values)], minlength=len(faces)) == 0
    rows = np.flatnonzero(inland & (faces.sizes > 0))
    if len(rows):
        rings = _rings(faces.take(rows), sides)
        area, length = clip.signed_areas(rings)
        # What is thinner than the border is blurred is clipped, as are rings that stand still, which lose such steps.
        whole = simple(rings) & (area > 2 * sides.border.slack * length)
        whole[rings.row[(rings.values == rings.values[rings.following]).all(axis=1)]] = False
        rows = rows[whole]
        result[rows], large[rows] = wkb.polygons(rings.take(whole)), area[whole] > WORLD / 10
        others[rows] = False
    result[others], wrong[others], large[others] = _clipped_block(faces.take(others), sides)
    return result, wrong, large


def _rings(faces: Ragged, sides: Sides) -> Ragged:
    """Longitudes and latitudes around faces that do not meet the border."""
    back = faces.values < 0
    piece = sides.pieces.of_edge[np.maximum(faces.values, ~faces.values)]
    first, last = sides.samples.offsets[piece], sides.samples.offsets[piece + 1] - 1
    places = spans(np.where(back, last, first), last - first, np.where(back, -1, 1))
    return Ragged(sides.samples.values[places, 3:], offsets_of(last - first)[faces.offsets])


def _clipped_block(faces: Ragged, sides: Sides) -> tuple[Packed, BoolArray, BoolArray]:
    count = len(faces)
    loops, owner = clip.regions(faces, np.arange(count), count, sides.pieces, sides.samples, sides.border)
    polygons, outer = polygons_on_map(loops, owner, count)
    wrong = invalid(polygons, loops, owner)
    wrong[owner[~outer]] = True  # convex faces have no holes
    area = clip.signed_areas(loops)[0] if len(loops) else np.zeros(0)
    return polygons, wrong, np.bincount(owner, area, minlength=count) > WORLD / 10


class _Walk:
    """The steps around faces, from each sample point of their sides to the next."""

    def __init__(self, faces: Ragged, sides: Sides) -> None:
        pieces, samples = sides.pieces, sides.samples
        edge = np.maximum(faces.values, ~faces.values)
        first, last = (np.searchsorted(pieces.arcs.edge, edge, side=side) for side in ("left", "right"))
        piece = spans(first, last - first)
        self.count = len(faces)
        self.pieces, number = np.unique(piece, return_inverse=True)
        self.samples = samples.take(self.pieces)
        self.origin = spans(samples.offsets[self.pieces], self.samples.sizes)
        """Indices of the points among all samples."""
        sizes = self.samples.sizes[number] - 1
        self.step = spans(self.samples.offsets[number], sizes)
        self.face = np.repeat(np.repeat(faces.row, last - first), sizes)
        self.way = np.repeat(np.repeat(np.where(faces.values < 0, -1.0, 1.0), last - first), sizes)

    @property
    def widths(self) -> FloatArray:
        """Approximate widths of faces, (f,), area over length of the border; infinite for faces that are not narrow.

        The area is that seen from the centroid of the border, where chords of one great circle cancel however they are
        cut. A narrow face is no longer than half a great circle, whose points have a mean of length 2/π.
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


def _crossing(faces: Ragged, sides: Sides) -> Indices:
    """Indices, in order, of the points after which chords should be halved.

    These are the chords whose distance from their arcs reaches another chord of the same face; in a face without such a
    chord, all of them.
    """
    walk = _Walk(faces, sides)
    step, face = walk.step, walk.face
    if not len(step):
        return step
    flat = sides.border.flat(walk.samples)
    ends = np.stack([flat[step], flat[step + 1]], axis=1)
    middle = units(walk.samples.values[step, :3] + walk.samples.values[step + 1, :3])
    along = sides.pieces.along[walk.pieces[walk.samples.row[step]]]
    off = _straying(walk.samples, step, middle, along, sides.border).max(axis=1)
    lines = shapely.linestrings(ends)
    i, j = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=2 * off)
    apart = (ends[i][:, :, None] != ends[j][:, None]).any(axis=-1).all(axis=(1, 2))
    near = np.zeros(len(step), dtype=bool)
    near[i[(face[i] == face[j]) & apart]] = True
    chosen = (near | (np.bincount(face, near, minlength=walk.count) == 0)[face]) & (off > DEGREE_ROUNDING)
    useful = (np.bincount(face, chosen, minlength=walk.count) <= BORDER_STEPS) & (walk.widths > THIN_CELL)
    return np.unique(walk.origin[step[chosen & useful[face]]])
