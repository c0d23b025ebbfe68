"""What decides exact ties: infinitesimal displacements, ordered by the points themselves.

Plane: the heights x² + y² grow by ε, the more the earlier the point stands in lexicographic order. Sphere: directions
move outward, p̂(1 + ε), in the same way; four points of a great circle, which that does not separate, take second,
smaller displacements along x, then y, then z. An exact zero is therefore decided by the first point, in that order,
whose cofactor is not zero. Since the order is one of points (of directions), no input order changes a triangulation,
and points in strictly convex position stay so under infinitesimal displacement: nothing is hidden, no zero is left.

H. Edelsbrunner, E. P. Mücke, "Simulation of simplicity", ACM Transactions on Graphics 9 (1990), with the order of the
points in place of their indices.
"""

from __future__ import annotations

from functools import cmp_to_key

from stereodel.predicates.integers import sign_of_roots
from stereodel.predicates.plane import orient2d_integer
from stereodel.predicates.rays import Ray, compare_directions, turn_ray

Point = tuple[int, int]


def incircle_tie(a: Point, b: Point, c: Point, d: Point) -> int:
    """Sign of incircle(a, b, c, d) for four different cocircular points after displacement, never zero.

    The height of row i has the cofactor (−1)^i times the orientation of the others; three points of a circle are not
    collinear, so the first point always decides.
    """
    points = (a, b, c, d)
    first = points.index(min(points))
    return _parity(first) * orient2d_integer(*points[:first], *points[first + 1 :])


def bubble_tie(a: Ray, b: Ray, c: Ray, p: Ray) -> int:
    """Sign of in_bubble(a, b, c, p) for four different directions of one circle after displacement, never zero.

    in_bubble is minus the determinant with rows (x̂, ŷ, ẑ, 1); moving p̂ to p̂(1 + ε) is, up to a positive factor of its
    row, moving the 1 to 1 − ε. Three points of a small circle are independent, so the first point decides there.
    """
    rays = (a, b, c, p)
    first = rays.index(min(rays, key=cmp_to_key(compare_directions)))
    others = rays[:first] + rays[first + 1 :]
    parity = _parity(first)
    return -parity * turn_ray(*others) or _great_circle_tie(parity, *others)


def _great_circle_tie(parity: int, a: Ray, b: Ray, c: Ray) -> int:
    """The same for four points of a great circle; a, b, c are those after the first, `parity` = (−1)^its row.

    The cofactor of column k is (−1)^k times the area of the triangle of the others, seen along axis k. Whether that is
    zero depends on the normal of the plane alone, so the first axis that counts is the same for all four points.
    """
    for axis in range(3):
        cofactor = _shadow(a, b, c, axis)
        if cofactor:
            return -parity * _parity(axis) * cofactor
    raise ArithmeticError("three of the four directions are the same")


def _parity(row: int) -> int:
    """(−1)^row."""
    return 1 - 2 * (row % 2)


def _shadow(a: Ray, b: Ray, c: Ray, axis: int) -> int:
    """Sign of the determinant of unit vectors with rows (two components without `axis`, 1)."""
    i, j = (k for k in range(3) if k != axis)

    def minor(u: Ray, v: Ray) -> int:
        return u[i] * v[j] - u[j] * v[i]

    return sign_of_roots(((minor(b, c), a[3]), (-minor(a, c), b[3]), (minor(a, b), c[3])))
