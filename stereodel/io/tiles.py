"""Faces of the sphere as polygons on the map of longitude and latitude that tile it.

All sides are cut and sampled once, for both faces beside them, so that neighbours share every point. Two things are
left to do on a map, where points are joined by straight lines: no line may come too near to a site, which must stay in
its own cell; and no two lines may cross, where a face is narrower than its lines stray.
"""

from __future__ import annotations

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Geometries, Indices
from stereodel._extras import optional
from stereodel.constants import BORDER_STEPS, CHORD_CLEARANCE, DEGREE_ROUNDING, THIN_CELL
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Pieces
from stereodel.curves.ragged import Ragged, spans
from stereodel.curves.trace import Arcs
from stereodel.io.on_map import close_in_longitude, lines_on_map, polygons_on_map, refined, repaired, steps_of, unit
from stereodel.sphere import xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude

shapely = optional("shapely", "geo")

BLOCK = 100_000
"""Faces that are made into polygons at once: more take more memory and no less time."""
WORLD = 360.0 * 180.0
"""Area of the map, square degrees."""


def sphere_lines(arcs: Arcs, max_segment: float, latitude: Latitude, lines: Ragged | None = None) -> Geometries:
    """A LineString for each arc or row of arcs, a MultiLineString for one that crosses the 180th meridian or a pole."""
    border = Antimeridian(latitude=latitude)
    pieces = border.cut(arcs)
    rows = Ragged(np.arange(len(arcs)), np.arange(len(arcs) + 1)) if lines is None else lines
    return lines_on_map(rows, np.arange(len(rows)), len(rows), pieces, _sampled(pieces, max_segment), border)


def sphere_polygons(
    arcs: Arcs, faces: Ragged, max_segment: float, latitude: Latitude, sites: FloatArray | None = None
) -> Geometries:
    """A Polygon or MultiPolygon for each face, a row of sides; empty for one without sides.

    Faces are no larger than a hemisphere. Sites (e, 3) are unit vectors that must stay on their side of each arc.
    """
    border = Antimeridian(latitude=latitude)
    pieces = border.cut(arcs)
    samples = _sampled(pieces, max_segment)
    if sites is not None:
        samples = _clear_of_sites(samples, pieces, border, sites)
    result, wrong = _drawn(faces, pieces, samples, border)
    # If all rings are simple and counterclockwise they tile the map, as each side is shared by two. So chords of the
    # others are halved, and what lies on the other side of them is drawn anew, too.
    while len(places := _crossing(faces.take(wrong), pieces, samples, border)):
        finer = np.zeros(len(arcs), dtype=bool)
        finer[pieces.arcs.edge[np.searchsorted(samples.offsets, places, side="right") - 1]] = True
        samples = samples.inserted(places + 1, unit(samples.values[places] + samples.values[places + 1]))
        changed = np.unique(faces.row[finer[np.maximum(faces.values, ~faces.values)]])
        result[changed], wrong[changed] = _drawn(faces.take(changed), pieces, samples, border)
    # A border that runs round a pole the other way by rounding has the rest of the map inside.
    large = np.flatnonzero(shapely.area(result) > WORLD / 10)
    result[large[_Walk(faces.take(large), pieces, samples).widths < THIN_CELL]] = shapely.Polygon()
    return repaired(result, wrong)


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
        off = _straying(some, step, middle, pieces.along[piece], border)
        off[:, 0] *= np.hypot(middle[:, 0], middle[:, 1])
        near = np.hypot(*off.T) > np.maximum(CHORD_CLEARANCE * np.degrees(away), DEGREE_ROUNDING)
        return step[near], middle[near]

    return refined(samples, rule)


def _straying(samples: Ragged, step: Indices, middle: FloatArray, along: BoolArray, border: Antimeridian) -> FloatArray:
    """How far the middles of chords on the map are off those of the arcs, (s, 2), in longitude and latitude."""
    flat = border.flat(samples)
    off = np.abs(xyz_to_lonlat(middle, latitude=border.latitude) - (flat[step] + flat[step + 1]) / 2)
    off[:, 0] = np.minimum(off[:, 0], np.abs(360 - off[:, 0]))
    off[along] = 0.0
    return off


def _drawn(faces: Ragged, pieces: Pieces, samples: Ragged, border: Antimeridian) -> tuple[Geometries, BoolArray]:
    """Polygons of faces, and which of them are not simple and counterclockwise."""
    results, wrongs = [np.zeros(0, dtype=object)], [np.zeros(0, dtype=bool)]
    for begin in range(0, len(faces), BLOCK):
        block = faces.take(np.arange(begin, min(begin + BLOCK, len(faces))))
        count = len(block)
        loops, owner = clip.regions(block, np.arange(count), count, pieces, samples, border)
        result, outer = polygons_on_map(loops, owner, count)
        wrong = ~shapely.is_valid(result)
        wrong[owner[~outer]] = True  # convex faces have no holes
        results.append(result)
        wrongs.append(wrong)
    return np.concatenate(results), np.concatenate(wrongs)


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
        start, chord = self.samples.values[self.step], self.samples.values[self.step + 1]
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
    middle = unit(walk.samples.values[step] + walk.samples.values[step + 1])
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
