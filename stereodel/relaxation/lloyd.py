"""Lloyd's method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, as_amounts, as_count, as_scalar, as_workers, locked, read_only
from stereodel._docs import shared
from stereodel._double_double import unit
from stereodel._notebook import Displayed
from stereodel._spaces import PLANE, SPHERE, surface_of
from stereodel.constants import BALANCED
from stereodel.relaxation.cell_triangles import (
    MIDPOINTS,
    RADON,
    RoundCells,
    as_polygon,
    flat_cells,
    flat_nodes,
    outside,
    spherical_nodes,
)
from stereodel.sphere.coordinates import LONLAT, as_sites, as_told, refuse_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation import SphericalVoronoi
from stereodel.triangulation.delaunay import Triangulation, as_triangulation

Density = Callable[[FloatArray], npt.ArrayLike]
Step = tuple[float, FloatArray]
"""The energy of a set of points and the centroids of their cells."""


class Progress(NamedTuple):
    """The argument of the callback of `lloyd`, after each step.

    Attributes
    ----------
    step : int
        Number of the step, from 1.
    energy : float
        Energy after it.
    move : float
        The largest displacement of a point, in coordinate units in the plane, in degrees on the sphere.
    """

    step: int
    energy: float
    move: float


@dataclass(frozen=True)
class Quality:
    """Measures of how even the cells of relaxed points are; the result of `Relaxation.quality`.

    Attributes
    ----------
    neighbors : dict
        Number of points by number of neighbours in the triangulation. In the plane, points on the hull are not counted.
    defects : int
        Number of points that do not have six neighbours.
    area_ratio : float
        Area of the largest cell, within the bounds, over that of the smallest.
    """

    neighbors: dict[int, int]
    defects: int
    area_ratio: float


@dataclass(frozen=True, eq=False)
class Relaxation(Displayed):
    """The result of `lloyd`; arrays are read-only.

    Attributes
    ----------
    points : (n, 2) or (n, 3) array
        The relaxed points, unit vectors on the sphere, in the order given.
    energies : (steps + 1,) array
        Energy before the first step and after each.
    moves : (steps,) array
        The largest displacement of a point in each step, in coordinate units in the plane, in degrees on the sphere.
    converged : bool
        Whether the last step moved no point farther than the tolerance.
    latitude : str or None
        The kind of latitude by which the points were given.
    bounds : (k, 2) array or None
        Corners of the polygon divided by the cells; None on the sphere.

    Examples
    --------
    >>> from stereodel.relaxation import lloyd
    >>> lloyd([[0.1, 0.5], [0.3, 0.5]], bounds=(0, 0, 1, 1), steps=99, tolerance=1e-9).converged
    True
    """

    points: FloatArray
    energies: FloatArray
    moves: FloatArray
    converged: bool
    latitude: Latitude | None = None
    bounds: FloatArray | None = None

    @property
    def lonlat(self) -> FloatArray:
        """Longitude and latitude of `points`, (n, 2) in degrees, if the points were given by them."""
        return as_told(self.points, self.latitude)

    def quality(self) -> Quality:
        """How even the cells are.

        Returns
        -------
        Quality
            Neighbours, defects and ratio of areas. On the sphere, six less the number of neighbours sums to twelve over
            all points; the best to be expected is twelve points with five neighbours and all others with six.

        Examples
        --------
        >>> from stereodel.relaxation import lloyd
        >>> steps = (1 + np.arange(40)) * (5**0.5 - 1) / 2 % 1, (np.arange(40) + 0.5) / 40
        >>> even = lloyd(lonlat=np.column_stack([360 * steps[0], 180 * steps[1] - 90]), steps=60).quality()
        >>> sum(even.neighbors.values()), even.area_ratio < 1.5
        (40, True)
        """
        triangulation = as_triangulation(self.points)
        degrees = np.diff(triangulation.vertex_neighbor_vertices[0])
        if self.bounds is None:
            areas = SphericalVoronoi(self.points).areas()
        else:
            degrees[triangulation.convex_hull] = 0
            triangles, site = flat_cells(self.points, self.bounds, None)
            areas = np.bincount(site, PLANE.areas(*triangles.transpose(1, 0, 2)), len(self.points)).astype(np.float64)
        counts = np.unique_counts(degrees[degrees > 0])
        neighbors = dict(zip(counts.values.tolist(), counts.counts.tolist(), strict=True))
        held = areas[areas > 0]
        defects = sum(count for number, count in neighbors.items() if number != 6)
        return Quality(neighbors, defects, float(held.max() / held.min()) if len(held) else 1.0)


@shared(**LONLAT)
def lloyd(
    points: npt.ArrayLike | Triangulation | None = None,
    *,
    lonlat: npt.ArrayLike | None = None,
    latitude: Latitude | None = None,
    steps: int = 20,
    density: Density | None = None,
    bounds: npt.ArrayLike | None = None,
    tolerance: float = 0.0,
    factor: float = 1.0,
    callback: Callable[[Progress], object] | None = None,
    workers: int | None = None,
) -> Relaxation:
    """Move points to the centroids of their Voronoi cells, repeatedly.

    Parameters
    ----------
    points : array_like (n, 2) or (n, 3), PlanarDelaunay or SphericalDelaunay
        Points of the plane, directions, or a triangulation of them.
    {instead}
    steps : int, optional
        Largest number of steps, 0 or more.
    density : callable, optional
        Density as a function of position: takes points (m, 2), or unit vectors (m, 3), and returns m finite numbers ≥
        0. By default it is constant.
    bounds : array_like, (4,) or (k, 2)
        The region divided by the cells of the plane: (xmin, ymin, xmax, ymax), or the corners of a convex polygon,
        counterclockwise. Not allowed on the sphere, where the cells divide the whole surface.
    tolerance : float, optional
        Stop after a step that moves no point farther than this, in coordinate units in the plane, in degrees on the
        sphere.
    factor : float, optional
        Length of a step relative to the distance from the centroid, in (0, 2). Values above 1 overshoot
        (over-relaxation): with 1.9, little more than half as many steps are needed.
    callback : callable, optional
        Called after each step with a `Progress`: step, energy, move. Its result is ignored; an exception
        ends the relaxation.
    workers : int, optional
        Number of threads; -1 for all processors. Does not affect the result.

    Returns
    -------
    Relaxation
        With `lonlat` if the points were given by longitude and latitude.

    Raises
    ------
    ValueError, TypeError
        If a point is not finite and real, or outside `bounds`; if `bounds` are missing in the plane, given on the
        sphere, or not convex; if `density` returns other values or another option is out of range; if `points` and
        `lonlat` are both given, or `latitude` without `lonlat`.

    Notes
    -----
    The energy is the sum over the cells of ∫ ρ(x) |x − p|² dx, on the sphere with the chord |x − p|. A step takes p to
    the mass centroid of its cell, on the sphere projected to the surface from the centre, which minimises this
    integral. The new cells are at least as good, so the energy never increases, up to rounding and, with a density,
    quadrature.

    This holds for every `factor`: with the old cells the energy depends only on the distance from the centroid (on the
    sphere, the angle), which never grows. A point that would leave the bounds stops at the centroid.

    Without a density the integrals are exact up to rounding. With one they are sums over triangles of a site and two
    corners of its cell by Radon's rule of degree five; on the sphere triangles are first halved until no side is longer
    than 11.5°. A density that varies within a cell is sampled at seven nodes in each of its triangles.

    A dropped duplicate has no cell and stays for a step, in which the kept one mostly moves away; so does a point whose
    cell has zero mass, or is the whole sphere. Symmetric points stay symmetric, on a great circle for example: such
    a state may be a saddle of the energy.

    Source: S. Lloyd, "Least squares quantization in PCM" (1957, 1982); Q. Du, V. Faber, M. Gunzburger, "Centroidal
    Voronoi tessellations: applications and algorithms", SIAM Review 41 (1999); on surfaces Q. Du, M. Gunzburger, L. Ju,
    "Constrained centroidal Voronoi tessellations for surfaces" (2003).

    Examples
    --------
    >>> from stereodel.relaxation import lloyd
    >>> relaxed = lloyd([[0.1, 0.5], [0.3, 0.5]], bounds=(0, 0, 1, 1), steps=60)
    >>> print(relaxed.points.round(6))
    [[0.25 0.5 ]
     [0.75 0.5 ]]
    >>> print(lloyd([[1, 0, 0], [0, 1, 0]], steps=1).points.round(3))
    [[ 0.707 -0.707  0.   ]
     [-0.707  0.707  0.   ]]
    >>> print(lloyd(lonlat=[(0, 0), (90, 0)], steps=1).lonlat.round(3))
    [[-45.   0.]
     [135.   0.]]
    """
    if isinstance(points, Triangulation):
        refuse_lonlat(lonlat, latitude)
        given, kind = points.points, points.latitude
    else:
        given, kind = as_sites(points, lonlat, latitude)
    if density is not None and not callable(density):
        raise TypeError(
            f"density must be a function of points, not {type(density).__name__}; of values at points, "
            'LinearInterpolator(points, values, extrapolate="nearest") is one'
        )
    share = as_scalar(factor, "factor", low=0.0, high=2.0, open_low=True, open_high=True)
    limit = as_scalar(tolerance, "tolerance", low=0.0)
    last, threads = as_count(steps, "steps", low=0), as_workers(workers)
    surface, polygon = surface_of(given), None
    step: Callable[[FloatArray], Step]
    if surface is SPHERE:
        if bounds is not None:
            raise ValueError("bounds are for points of the plane; on the sphere leave them out")
        here, advance = unit(given).hi, partial(_round_advance, factor=share)
        step = partial(_round_step, density=density, workers=threads)
    else:
        here, polygon = given, read_only(as_polygon(bounds))
        advance = partial(_flat_advance, factor=share, bounds=polygon)
        step = partial(_flat_step, bounds=polygon, density=density, workers=threads)
        if (wrong := outside(given, polygon)).any():
            k = int(np.argmax(wrong))
            raise ValueError(f"points[{k}] is {given[k].tolist()}, outside bounds")
    energy, centroids = step(here)
    energies, moves, converged = [energy], [], False
    for number in range(1, last + 1):
        before, here = here, centroids if share == 1.0 else advance(here, centroids)
        moves.append(float(surface.distances(before, here).max(initial=0.0)))
        energy, centroids = step(here)
        energies.append(energy)
        if callback is not None:
            callback(Progress(number, energy, moves[-1]))
        if converged := moves[-1] <= limit:
            break
    found = locked(here.copy()), locked(np.array(energies)), locked(np.array(moves))
    return Relaxation(*found, converged, kind, polygon)


def _flat_step(points: FloatArray, bounds: FloatArray, density: Density | None, workers: int | None) -> Step:
    triangles, site = flat_cells(points, bounds, workers)
    nodes, weights = flat_nodes(triangles, MIDPOINTS if density is None else RADON)
    energy, mass, moments = _integrals(density, points, site, nodes, weights)
    return energy, points + moments / np.where(mass > 0, mass, 1.0)[:, None]


def _round_step(points: FloatArray, density: Density | None, workers: int | None) -> Step:
    cells = RoundCells(points, workers)
    if density is None:
        mass, moments, centroids = cells.diagram.areas(), cells.moments(), cells.diagram.centroids()
        # |x − p|² = 2 (1 − x·p) for unit vectors
        energy = 2 * float((mass - np.einsum("ni,ni->n", moments, points)).sum())
    else:
        triangles, site = cells.triangles()
        nodes, weights = spherical_nodes(triangles, RADON)
        energy, mass, moments = _integrals(density, points, site, nodes - points[site][:, None], weights)
        moments += points * mass[:, None]
        lengths = np.linalg.norm(moments, axis=1, keepdims=True)
        centroids = moments / np.where(lengths > 0, lengths, 1.0)
    # A cell without mass, or whose mean has no direction, leaves its point where it is.
    pulled = (np.linalg.norm(moments, axis=1) > BALANCED * mass) & (mass > 0)
    return energy, np.where(pulled[:, None], centroids, points)


def _flat_advance(points: FloatArray, centroids: FloatArray, factor: float, bounds: FloatArray) -> FloatArray:
    reached = points + factor * (centroids - points)
    return np.where(outside(reached, bounds)[:, None], centroids, reached)


def _round_advance(points: FloatArray, centroids: FloatArray, factor: float) -> FloatArray:
    """Along great circles."""
    step = centroids - points
    tangent = step - points * np.einsum("ni,ni->n", points, step)[:, None]
    length = np.linalg.norm(tangent, axis=1, keepdims=True)
    angle = factor * np.arctan2(length, np.einsum("ni,ni->n", points, centroids)[:, None])
    still = length == 0
    reached = points * np.cos(angle) + tangent / np.where(still, 1.0, length) * np.sin(angle)
    return np.where(still, points, unit(reached).hi)


def _integrals(
    density: Density | None, points: FloatArray, site: AnyIndices, nodes: FloatArray, weights: FloatArray
) -> tuple[float, FloatArray, FloatArray]:
    """Energy, and the mass (n,) and first moment (n, d) of each cell, from nodes (t, k, d) relative to their sites.

    Mass and moment are over a scale of their cell, a power of two near its largest density. A centroid does not depend
    on it, but products of densities near the ends of doubles would be 0 or infinite.
    """
    scale, largest = np.ones(len(points)), 1.0
    if density is not None:
        flat = (nodes + points[site][:, None]).reshape(-1, points.shape[1])
        values = as_amounts(density(flat), "density(points)", "weight")
        if values.shape != (len(flat),):
            said = f"a number for each point, shape {(len(flat),)}, got {values.shape}"
            raise ValueError(f"density(points) must return {said}")
        values, highest = values.reshape(weights.shape), np.zeros(len(points))
        np.maximum.at(highest, site, values.max(axis=1))
        scale = np.ldexp(0.5, np.frexp(highest)[1])
        weights, largest = weights * (values / scale[site][:, None]), scale.max(initial=0.0) or 1.0
    mass: FloatArray = np.bincount(site, weights.sum(axis=1), len(points)).astype(np.float64)
    first = np.einsum("tk,tkd->td", weights, nodes)
    moments = np.column_stack([np.bincount(site, column, len(points)) for column in first.T]).astype(np.float64)
    with np.errstate(over="ignore", under="ignore"):  # 0 or infinite beyond the ends of doubles
        energies = weights * (nodes**2).sum(axis=-1) * (scale / largest)[site][:, None]
        return float(energies.sum() * largest), mass, moments
