"""Voronoi cells of the sphere: integrals along their ridges, and decomposition into triangles."""

from __future__ import annotations

import numpy as np

from stereodel import _kernel
from stereodel._arrays import AnyIndices, FloatArray
from stereodel.constants import CLOSE_SITES, QUADRATURE_CHORD
from stereodel.curves.ragged import spans
from stereodel.relaxation.quadrature import split_long
from stereodel.triangulation import SphericalVoronoi

_SIGNS = np.array([[x, y, z] for x in (1.0, -1.0) for y in (1.0, -1.0) for z in (1.0, -1.0)])
_OCTANTS = np.array([np.diag(s) if s.prod() > 0 else np.diag(s)[::-1] for s in _SIGNS])
"""The sphere as eight counterclockwise triangles (8, 3, 3)."""


class RoundCells:
    """The cells of unit vectors `sites` (n, 3), by `ridges` (r, 2): the sites on the left and right of each."""

    def __init__(self, sites: FloatArray, workers: int | None) -> None:
        self._diagram = SphericalVoronoi(sites, workers=workers)
        self.sites = sites
        self.ridges = self._diagram.ridge_points
        self._start, end = np.moveaxis(self._diagram.vertices[self._diagram.ridge_vertices], 1, 0)
        self._normals = _normals(sites[self.ridges[:, 0]], sites[self.ridges[:, 1]])
        # The angle from start to end about the normal: at most half a turn, as the whole ridge of two sites is in two
        # parts. A tiny one, or one of half a turn, may be rounded to the other side.
        side = np.einsum("ri,ri->r", self._normals, np.cross(self._start, end))
        self._angles = np.arctan2(np.abs(side), np.einsum("ri,ri->r", self._start, end))

    def areas(self) -> FloatArray:
        """Solid angles (n,)."""
        return self._diagram.areas()

    def centroids(self) -> FloatArray:
        """Directions (n, 3) of the moments, unit vectors, accurate in tiny cells too; NaN without a cell."""
        return self._diagram.centroids()

    def moments(self) -> FloatArray:
        """Integrals (n, 3) of the unit vectors over the cells.

        Half the sum of the ridges' normals times their angles, by Stokes' theorem.
        """
        # The boundary of the left cell runs along a ridge, that of the right cell against it.
        turned = self._normals * (self._angles / 2)[:, None]
        left, right = self.ridges.T
        count = len(self.sites)
        return np.column_stack([np.bincount(left, t, count) - np.bincount(right, t, count) for t in turned.T])

    def triangles(self) -> tuple[FloatArray, AnyIndices]:
        """Counterclockwise triangles (t, 3, 3) of a site and a piece of a ridge, or parts of them; and the sites (t,).

        No side is longer than QUADRATURE_CHORD. The cell of a single site is the whole sphere.
        """
        if len(self.sites) and not len(self.ridges):
            return split_long(_OCTANTS, np.zeros(8, dtype=np.intp))
        # Each ridge in pieces of equal angle, none longer than the chord: ridge by ridge, step 0, 1, … of each.
        pieces = np.ceil(self._angles / QUADRATURE_CHORD).astype(int)
        ridge = np.repeat(np.arange(len(pieces)), pieces)
        step = spans(np.zeros_like(pieces), pieces)
        ends = [self._along(ridge, (step + k) * self._angles[ridge] / pieces[ridge]) for k in (0, 1)]
        # A piece runs with its left site on the left: the triangle with the right one takes it backwards.
        left, right = self.ridges[ridge].T
        lefts = np.stack([self.sites[left], *ends], axis=1)
        rights = np.stack([self.sites[right], *ends[::-1]], axis=1)
        return split_long(np.concatenate([lefts, rights]), np.concatenate([left, right]))

    def _along(self, ridge: AnyIndices, angle: FloatArray) -> FloatArray:
        start, normal = self._start[ridge], self._normals[ridge]
        return start * np.cos(angle)[:, None] + np.cross(normal, start) * np.sin(angle)[:, None]


def _normals(left: FloatArray, right: FloatArray) -> FloatArray:
    """Unit vectors (r, 3) from right to left, in twice the precision for close ones alone."""
    differences = left - right
    lengths = np.linalg.norm(differences, axis=1, keepdims=True)
    close = lengths[:, 0] < CLOSE_SITES
    lengths[close] = 1.0
    normals = differences / lengths
    normals[close] = _kernel.sphere.bisector_normals(left[close], right[close])
    return normals
