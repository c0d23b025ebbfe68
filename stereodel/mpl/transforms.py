"""matplotlib transforms between longitude and latitude in degrees and the page of a view through a lens."""

from __future__ import annotations

from typing import Any, Final, Literal, cast

import numpy as np
import numpy.typing as npt
from matplotlib.path import Path
from matplotlib.transforms import Transform

from stereodel._arrays import FloatArray
from stereodel.conformal import MoebiusMap
from stereodel.conformal.polylines import largest_scale
from stereodel.constants import LIMB_DEPTH, PAGE_TOLERANCE
from stereodel.drawing.view import MapView
from stereodel.mpl.great_paths import Indices, Lines, chains_of
from stereodel.mpl.page_regions import inverse_of, region_loops
from stereodel.sphere import lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.vectors import turned

Edges = Literal["great circle", "straight"]
COARSE_STEP: Final = 2.0
"""Degrees of straight edges over which the largest scale of a lens is asked for."""

EDGES: Final[tuple[Edges, ...]] = ("great circle", "straight")


class LonLatToPage(Transform):
    """Longitude and latitude to the unit disc of a view; edges of paths are resampled, and cut where the view ends.

    Open paths stay lines. A path with a closed part is a region, bounded by all its closed parts together by the
    even-odd rule; where the edge of the view cuts it, its outline follows that edge.

    Parameters
    ----------
    lens : MoebiusMap
    view : View or StereographicView
    edges : {"great circle", "straight"}
        What joins two vertices: the shorter great-circle arc, or what is straight on the map of longitude and latitude.
    """

    input_dims = output_dims = 2
    has_inverse = True

    def __init__(self, lens: MoebiusMap, view: MapView, edges: Edges = "great circle") -> None:
        super().__init__()
        self.lens, self.view, self.edges = lens, view, edges
        self._tolerance = PAGE_TOLERANCE

    @property
    def tolerance(self) -> float:
        """How far the pieces of lines may stray from them, page units; a closer look wants a smaller one."""
        return self._tolerance

    @tolerance.setter
    def tolerance(self, value: float) -> None:
        if value != self._tolerance:
            self._tolerance = value
            self.invalidate()

    def transform_non_affine(self, values: npt.ArrayLike) -> FloatArray:
        """Page points (n, 2); NaN for what is hidden and for what is no place, such as a latitude beyond 90°."""
        lonlat = np.ma.filled(np.ma.asarray(values, dtype=np.float64), np.nan)
        rows = lonlat.reshape(-1, 2)
        page = np.full(rows.shape, np.nan)
        place = np.flatnonzero(_is_place(rows))
        axes = turned(self.lens(lonlat_to_xyz(rows[place])), self.view.matrix)
        seen = axes[:, 2] >= self.view.edge - LIMB_DEPTH
        page[place[seen]] = self.view.flattened(axes[seen])
        return page.reshape(lonlat.shape)

    def transform_path_non_affine(self, path: Path) -> Path:
        """The visible part of a path, with its curves, as straight pieces."""
        lonlat, offsets, closed = _vertices(path)
        if not len(lonlat):
            return Path(np.zeros((0, 2)))
        if self.edges == "straight":
            lonlat, offsets = _followed(lonlat, offsets, self.lens, self.tolerance / self.view.stretch)
        lines = Lines(lonlat_to_xyz(lonlat), offsets)
        if closed.any():
            rings, places = _chosen(lines, lonlat, closed)
            loops = region_loops(rings, places, self.lens, self.view, self.tolerance)
            return _compound(loops, closed=True)
        return _compound(chains_of(lines, self.lens, self.view, self.tolerance).split(), closed=False)

    def inverted(self) -> Transform:
        """From the page to longitude and latitude."""
        return PageToLonLat(self)


class PageToLonLat(Transform):
    """The unit disc of a view to longitude and latitude; NaN outside it."""

    input_dims = output_dims = 2
    has_inverse = True

    def __init__(self, forward: LonLatToPage) -> None:
        super().__init__()
        self._forward, self._back = forward, inverse_of(forward.lens)

    def transform_non_affine(self, values: npt.ArrayLike) -> FloatArray:
        """Longitude and latitude (n, 2) in degrees."""
        page = np.asarray(values, dtype=np.float64)
        axes = self._forward.view.raised(page.reshape(-1, 2))
        lonlat = np.full((len(axes), 2), np.nan)
        inside = np.isfinite(axes).all(axis=1)
        lonlat[inside] = xyz_to_lonlat(self._back(turned(axes[inside], self._forward.view.matrix.T)))
        return lonlat.reshape(page.shape)

    def inverted(self) -> Transform:
        """From longitude and latitude to the page."""
        return self._forward


def _is_place(lonlat: FloatArray) -> npt.NDArray[np.bool_]:
    with np.errstate(invalid="ignore"):
        place: npt.NDArray[np.bool_] = np.isfinite(lonlat[:, 0]) & (np.abs(lonlat[:, 1]) <= 90.0)
    return place


def _vertices(path: Path) -> tuple[FloatArray, Indices, npt.NDArray[np.bool_]]:
    """Vertices (n, 2) of the parts of a path, offsets (m + 1,), and which parts are closed, with equal ends.

    What is no place ends a part, as NaN does everywhere in matplotlib.
    """
    points = np.ma.filled(np.ma.asarray(path.vertices, dtype=np.float64), np.nan)
    codes = path.codes
    known = np.where(_is_place(points)[:, None], points, np.nan)
    if codes is None and np.isfinite(known).all():
        return known, np.array([0, len(known)]), np.zeros(1, dtype=np.bool_)
    flat = Path(known, codes).cleaned(remove_nans=True, curves=False)
    points, kinds = np.asarray(flat.vertices), np.asarray(cast(Any, flat.codes))
    points, kinds = points[kinds != Path.STOP], kinds[kinds != Path.STOP]
    starts = np.flatnonzero(kinds == Path.MOVETO)
    closing = kinds == Path.CLOSEPOLY
    part = np.cumsum(kinds == Path.MOVETO) - 1
    points = np.where(closing[:, None], points[starts][part], points)
    closed = np.zeros(len(starts), dtype=np.bool_)
    closed[part[closing]] = True
    return points, np.append(starts, len(points)), closed


def _chosen(lines: Lines, lonlat: FloatArray, kept: npt.NDArray[np.bool_]) -> tuple[Lines, FloatArray]:
    """Some of the lines, with their vertices in degrees."""
    sizes = np.diff(lines.offsets)
    rows = np.repeat(kept, sizes)
    return Lines(lines.vertices[rows], np.concatenate([[0], np.cumsum(sizes[kept])])), lonlat[rows]


def _followed(lonlat: FloatArray, offsets: Indices, lens: MoebiusMap, tolerance: float) -> tuple[FloatArray, Indices]:
    """The same lines with vertices whose great circles, after the lens, stray from the straight edges by a tolerance.

    A point that moves by (a, b) radians in unit time has an acceleration across the great circle of
    |sin φ|·√((a² cos φ)² + (2ab)²) and strays from it by an eighth of that at most, times the largest scale on the way.
    """
    lonlat, offsets = _subdivided(lonlat, offsets, _steps(lonlat, offsets), np.full(len(lonlat), 1 / COARSE_STEP))
    step, xyz = _steps(lonlat, offsets), lonlat_to_xyz(lonlat)
    a, b = np.radians(step).T
    cosine, sine = np.hypot(xyz[:, 0], xyz[:, 1]), np.minimum(np.abs(xyz[:, 2]) + np.abs(b), 1.0)
    cosine = np.minimum(cosine + np.abs(b), 1.0)  # the largest on the edge, as the sine
    bend = sine * np.hypot(cosine * a**2, 2 * a * b) / 8
    scale = largest_scale(lens, xyz, np.hypot(cosine * a, b))
    size = np.abs(step).max(axis=1)
    return _subdivided(lonlat, offsets, step, np.sqrt(bend * scale / tolerance) / np.where(size > 0, size, 1.0))


def _steps(lonlat: FloatArray, offsets: Indices) -> FloatArray:
    """From each vertex to the next of its line, (n, 2); zero from the last.

    A jump of more than half the map goes the other way round, as in files that cut nothing at ±180°; at a pole it is a
    stretch of the upper or lower border.
    """
    step = np.diff(lonlat, axis=0, append=lonlat[-1:])
    pole = (np.abs(lonlat[:, 1]) == 90.0) & (step[:, 1] == 0.0)
    jump = (np.abs(step[:, 0]) > 180.0) & (np.abs(step[:, 0]) < 360.0) & ~pole
    step[jump, 0] -= np.copysign(360.0, step[jump, 0])
    step[offsets[1:] - 1] = 0.0
    return step


def _subdivided(
    lonlat: FloatArray, offsets: Indices, step: FloatArray, density: FloatArray
) -> tuple[FloatArray, Indices]:
    """The same lines with further vertices on their straight edges: `density` for a degree of the longer coordinate."""
    counts = np.maximum(1, np.ceil(np.abs(step).max(axis=1) * density)).astype(np.intp)
    before = np.concatenate([[0], np.cumsum(counts)])
    row = np.repeat(np.arange(len(lonlat)), counts)
    share = (np.arange(before[-1]) - before[row]) / counts[row]
    return lonlat[row] + share[:, None] * step[row], before[offsets]


def _compound(pieces: list[FloatArray], *, closed: bool) -> Path:
    """One path of polylines (k, 2) each."""
    if not pieces:
        return Path(np.zeros((0, 2)))
    sizes = np.array([len(piece) for piece in pieces])
    codes = np.full(int(sizes.sum()), Path.LINETO, dtype=Path.code_type)
    ends = np.cumsum(sizes)
    codes[ends - sizes] = Path.MOVETO
    if closed:
        codes[ends - 1] = Path.CLOSEPOLY
    return Path(np.concatenate(pieces), codes)
