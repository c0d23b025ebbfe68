"""Delaunay triangulation of the plane, exact (row P1 of the ledger)."""

from __future__ import annotations

from stereodel._docs import shared
from stereodel._spaces import PLANE
from stereodel.triangulation.delaunay import FAMILY, Triangulation


@shared(**FAMILY)
class PlanarDelaunay(Triangulation, surface=PLANE):
    """Delaunay triangulation of points in the plane: no point lies inside the circumcircle of a triangle.

    Parameters
    ----------
    points : (n, 2) array_like
        Finite numbers of any size; y up. Copied.
    {options}

    Attributes
    ----------
    points : (n, 2) array
    simplices : (m, 3) array of int32
        Triangles, counterclockwise, smallest index first; rows along a space-filling curve, so that consecutive
        triangles are mostly close to one another.
    neighbors : (m, 3) array of int32
        `neighbors[i, k]` is the triangle opposite corner k of triangle i; -1 where there is none.
    convex_hull : (h, 2) array of int32
        Directed edges of the hull, counterclockwise, in lexicographic order; points on the hull's sides split them.
    {edges}
    circumcenters : (m, 2) array
        Centres of the circumcircles, rounded from the exact ones.
    duplicates : (k, 2) array of int32
        Pairs [dropped, kept] of exactly equal points (-0 equals 0); the lowest index is kept, and is the one in
        `simplices`.
    dimension : int
        -1 without points, 0 for one, 1 if all are collinear, 2 otherwise. Below 2 there are no simplices.
    inconclusive : dict
        How many tests each stage left open: "filter" (doubles), "double_double", and "exact": exactly zero, decided by
        the tie rule.

    Raises
    ------
    ValueError, TypeError
        For values that are not finite real numbers, or other shapes; the message names the entry.

    Notes
    -----
    The result is that of exact arithmetic on the given doubles. Cocircular points are triangulated as if the first of
    them in lexicographic order were lifted a little above the paraboloid z = x² + y²: a rule on points, so that no
    order of input changes the triangles.

    {changes}

    Source: divide and conquer by L. Guibas and J. Stolfi (1985) along a space-filling curve; insertion as in the
    paper's pseudo-code, with the projection pole as a ghost vertex (rows P1, P7, P14). `HullInsertion` is a readable
    form.

    Examples
    --------
    >>> triangulation = PlanarDelaunay([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]])
    >>> triangulation.edges.tolist()
    [[0, 1], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3], [2, 4], [3, 4]]
    >>> triangle, outside = triangulation.find_simplex([[1.5, 1], [3, 3]])
    >>> print(triangulation.simplices[triangle], outside)
    [1 2 4] -1
    """
