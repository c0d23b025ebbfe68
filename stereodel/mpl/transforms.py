"""matplotlib transforms between longitude and latitude in degrees and the page of a view through a lens."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any, Final, Literal, cast

import numpy as np
import numpy.typing as npt
from matplotlib.path import Path
from matplotlib.transforms import Transform

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.conformal import MoebiusMap
from stereodel.constants import DEGREE_ROUNDING, PAGE_TOLERANCE, WHOLE_TURNS
from stereodel.curves import trace
from stereodel.curves.chart import Chart
from stereodel.curves.insides import on_the_left
from stereodel.curves.ragged import Ragged
from stereodel.curves.seams import stitched
from stereodel.curves.trace import sides_of, unwrapped
from stereodel.curves.view import MapView
from stereodel.io.reading import shapes_of
from stereodel.sphere import lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.vectors import turned

Edges = Literal["great circle", "straight"]
EDGES: Final[tuple[Edges, ...]] = ("great circle", "straight")
NOTHING = Path(np.zeros((0, 2)))


class LonLatToPage(Transform):
    """Longitude and latitude to the unit disc of a view; edges of paths are resampled and cut at the edge of the view.

    Open paths remain lines. A path with closed parts is a region, bounded by all of them together by the even-odd rule;
    where it is cut by the edge of the view, its outline follows that edge. Edges between vertices are the shorter
    great-circle arcs, or straight on the map of longitude and latitude.
    """

    input_dims = output_dims = 2
    has_inverse = True

    def __init__(self, lens: MoebiusMap, view: MapView, edges: Edges = "great circle") -> None:
        super().__init__()
        self.lens, self.view, self.edges = lens, view, edges
        # Great circles are arcs themselves, so their chords have the whole tolerance.
        share = 0.5 if edges == "straight" else 1.0
        self._chart = Chart(lens, view, tolerance=PAGE_TOLERANCE, share=share, fineness=1.0)
        self._middle = xyz_to_lonlat(lens.inverse()(self._chart.matrix[2]))

    @property
    def tolerance(self) -> float:
        """Largest deviation of line segments from the exact lines, in page units; reduce it for closer zoom."""
        return self._chart.tolerance

    @tolerance.setter
    def tolerance(self, value: float) -> None:
        if value != self.tolerance:
            self._chart = replace(self._chart, tolerance=value)
            self.invalidate()

    def transform_non_affine(self, values: npt.ArrayLike) -> FloatArray:
        """Page points (n, 2); NaN for hidden points and for invalid ones, such as a latitude beyond 90°."""
        lonlat = np.ma.filled(np.ma.asarray(values, dtype=np.float64), np.nan)
        rows = lonlat.reshape(-1, 2)
        page = np.full(rows.shape, np.nan)
        place = np.flatnonzero(_is_place(rows))
        found, seen = self._chart.points(lonlat_to_xyz(rows[place]))
        page[place[seen]] = found[seen]
        return page.reshape(lonlat.shape)

    def transform_path_non_affine(self, path: Path) -> Path:
        """The visible part of a path, its curves included, as straight segments."""
        lines, closed = _parts(path)
        if not len(lines.values):
            return Path(lines.values)
        if not closed.any():
            return compound(self.lines(lines), closed=False)
        rings = lines.take(closed)
        return compound(self.regions(rings, np.zeros(len(rings), dtype=np.intp), 1)[0], closed=True)

    def lines(self, lines: Ragged) -> Ragged:
        """The visible parts of lines (k, 2) in degrees, as polylines on the page."""
        lines = unwrapped(lines) if self.edges == "straight" else self._led(lines)
        first, sides = sides_of(lines)
        xyz = lonlat_to_xyz(lines.values)
        edges = self._edges(lines.values[first], lines.values[first + 1], xyz[first], xyz[first + 1])
        return self._chart.lines(edges, sides)[0]

    def regions(self, rings: Ragged, owner: Indices, count: int) -> tuple[Ragged, Indices]:
        """The visible parts of regions, as closed loops on the page along the edge of the view, and the region of each.

        Rings (k, 2) are in degrees, in any direction, with the first point repeated at the end; `owner` is the region
        of each.
        """
        # So that points a whole turn apart are bitwise the same point.
        lon = np.rint(rings.values[:, 0] / WHOLE_TURNS) * WHOLE_TURNS
        rings = Ragged(np.stack([lon, rings.values[:, 1]], axis=1), rings.offsets)
        rings = rings if self.edges == "straight" else self._led(rings)
        rings, (_, held) = on_the_left(rings, owner, count, self._middle[None], straight=self.edges == "straight")
        middle = np.isin(np.arange(count), held)
        rings = unwrapped(rings)
        # The map is cut at its own western border if it is as wide as the Earth, otherwise at ±180°.
        lon = rings.values[:, 0]
        west, east = lon.min(initial=np.inf), lon.max(initial=-np.inf)
        start, end, sides, owner = stitched(rings, owner, west if east - west == 360.0 else 180.0)
        # On the sphere an edge ends where the next one of its ring starts, whatever the longitudes of the two.
        p, q = lonlat_to_xyz(start), np.empty((len(start), 3))
        q[sides.values] = p[sides.values[sides.following]]
        edges = self._edges(start, end, p, q)
        return self._chart.regions(edges, sides, owner, edges.left(sides), count, lambda shown: middle & ~shown)

    def _led(self, lines: Ragged) -> Ragged:
        """The lines, with great circles between antipodal places led over the north; from a pole, down its meridian."""
        lon, lat = lines.values.T
        across = np.abs(np.mod(np.diff(lon), 360.0) - 180.0) <= DEGREE_ROUNDING
        opposite = (np.abs(lat[:-1] + lat[1:]) <= DEGREE_ROUNDING) & (across | (np.abs(lat[:-1]) == 90.0))
        opposite[lines.offsets[1:-1] - 1] = False
        if not opposite.any():
            return lines
        at = np.flatnonzero(opposite)
        between = np.stack([lon[at], np.where(np.abs(lat[at]) == 90.0, 0.0, 90.0)], axis=1)
        return lines.inserted(at + 1, between)

    def _edges(self, start: FloatArray, end: FloatArray, p: FloatArray, q: FloatArray) -> trace.Edges:
        """Edges from start to end in degrees, p to q on the sphere."""
        straight = self.edges == "straight"
        return trace.Edges.straight(start, end, ends=(p, q)) if straight else trace.Edges.of(trace.great(p, q))

    def inverted(self) -> Transform:
        """From the page to longitude and latitude."""
        return PageToLonLat(self)


class PageToLonLat(Transform):
    """The unit disc of a view to longitude and latitude; NaN outside it."""

    input_dims = output_dims = 2
    has_inverse = True

    def __init__(self, forward: LonLatToPage) -> None:
        super().__init__()
        self._forward = forward

    def transform_non_affine(self, values: npt.ArrayLike) -> FloatArray:
        """Longitude and latitude (n, 2) in degrees."""
        page = np.asarray(values, dtype=np.float64)
        axes = self._forward.view.raised(page.reshape(-1, 2))
        lonlat = np.full((len(axes), 2), np.nan)
        inside = np.isfinite(axes).all(axis=1)
        xyz = turned(axes[inside], self._forward.view.matrix.T)
        lonlat[inside] = xyz_to_lonlat(self._forward.lens.inverse()(xyz))
        return lonlat.reshape(page.shape)

    def inverted(self) -> Transform:
        """From longitude and latitude to the page."""
        return self._forward


def _is_place(lonlat: FloatArray) -> BoolArray:
    with np.errstate(invalid="ignore"):
        return np.isfinite(lonlat[:, 0]) & (np.abs(lonlat[:, 1]) <= 90.0)


def _parts(path: Path) -> tuple[Ragged, BoolArray]:
    """The parts of a path, rows of vertices (k, 2), and which are closed, with equal ends.

    An invalid point ends a part, as NaN does throughout matplotlib.
    """
    points = np.ma.filled(np.ma.asarray(path.vertices, dtype=np.float64), np.nan)
    codes = path.codes
    known = np.where(_is_place(points)[:, None], points, np.nan)
    if codes is None and np.isfinite(known).all():
        return Ragged(known, np.array([0, len(known)])), np.zeros(1, dtype=np.bool_)
    flat = Path(known, codes).cleaned(remove_nans=True, curves=False)
    points, kinds = np.asarray(flat.vertices), np.asarray(cast(Any, flat.codes))
    points, kinds = points[kinds != Path.STOP], kinds[kinds != Path.STOP]
    starts = np.flatnonzero(kinds == Path.MOVETO)
    closing = kinds == Path.CLOSEPOLY
    part = np.cumsum(kinds == Path.MOVETO) - 1
    points = np.where(closing[:, None], points[starts][part], points)
    closed = np.zeros(len(starts), dtype=np.bool_)
    closed[part[closing]] = True
    return Ragged(points, np.append(starts, len(points))), closed


def compound(lines: Ragged, *, closed: bool) -> Path:
    """One path of several lines (k, 2)."""
    codes = np.full(len(lines.values), Path.LINETO, dtype=Path.code_type)
    held = lines.sizes > 0
    codes[lines.offsets[:-1][held]] = Path.MOVETO
    if closed:
        codes[lines.offsets[1:][held] - 1] = Path.CLOSEPOLY
    return Path(lines.values, codes)


def compounds(lines: Ragged, number: Indices, count: int, *, closed: bool) -> list[Path]:
    """Several paths of lines (k, 2), with the index of each line's path, in order; paths without lines are empty."""
    everything = compound(lines, closed=closed)
    vertices, codes = np.asarray(everything.vertices), np.asarray(everything.codes)
    ends = lines.offsets[np.searchsorted(number, np.arange(count + 1))].tolist()
    return [Path(vertices[i:j], codes[i:j]) if j > i else NOTHING for i, j in pairwise(ends)]


def paths_of(geometries: Any) -> tuple[list[Path], FloatArray]:
    """A path for each polygon and line of what `shapes_of` takes, in order, rings closed; and all points, (n, 2)."""
    shapes = shapes_of(geometries)
    polygons = compounds(shapes.rings, shapes.ring_polygon, len(shapes.polygon_feature), closed=True)
    lines = compounds(shapes.lines, np.arange(len(shapes.lines)), len(shapes.lines), closed=False)
    order = np.argsort(np.concatenate([shapes.polygon_feature, shapes.line_feature]), kind="stable")
    paths = polygons + lines
    return [paths[k] for k in order.tolist()], shapes.points
