"""Triangulations to be judged: hulls and planar ones of SciPy, grids, icosahedra."""

import numpy as np
from scipy.spatial import ConvexHull, Delaunay

from tests import sets

GOLDEN = (1 + np.sqrt(5)) / 2


def unit_normal(n, seed):
    return sets.directions(np.random.default_rng(seed), n)


def hull(points):
    found = ConvexHull(points)
    s = found.simplices.astype(int)
    normal = np.cross(points[s[:, 1]] - points[s[:, 0]], points[s[:, 2]] - points[s[:, 0]])
    inward = (normal * found.equations[:, :3]).sum(axis=1) < 0
    s[inward] = s[inward][:, ::-1]
    return s


def planar(points):
    s = Delaunay(points).simplices.astype(int)
    a, b, c = (points[s[:, k]] for k in range(3))
    clockwise = (b - a)[:, 0] * (c - a)[:, 1] < (b - a)[:, 1] * (c - a)[:, 0]
    s[clockwise] = s[clockwise][:, ::-1]
    return s


def grid(n):
    """Integer grid and its squares, each cut along one diagonal chosen at random."""
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    k = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    square = np.column_stack([k, k + 1, k + n + 1, k + n])
    square = np.where(np.random.default_rng(0).random(len(k))[:, None] < 0.5, square, np.roll(square, 1, axis=1))
    return np.column_stack([x.ravel(), y.ravel()]).astype(float), np.vstack([square[:, :3], square[:, [0, 2, 3]]])


def lifted_grid(n):
    """The grid on rays (exact), with the projection pole as last point and its star."""
    xy, s = grid(n)
    xy -= n // 2
    rays = np.column_stack([2 * xy, 1 - (xy**2).sum(axis=1)])
    i = np.arange(n - 1)
    rim = np.concatenate([i, n - 1 + i * n, n * n - 1 - i, n * (n - 1) - i * n])
    star = np.column_stack([np.roll(rim, -1), rim, np.full(len(rim), n * n)])
    return np.vstack([rays, [0, 0, -1]]), np.vstack([s, star])


ICOSAHEDRON = np.array([np.roll([0, a, b * GOLDEN], k) for k in range(3) for a in (1, -1) for b in (1, -1)])


def flipped(s, t=0, k=0):
    """The diagonal of the two triangles on the edge opposite corner k of t, changed."""
    a, b, c = np.roll(s[t], -k)
    other = next(u for u in range(len(s)) if u != t and {b, c} <= set(s[u].tolist()))
    d = next(p for p in s[other] if p not in (b, c))
    result = s.copy()
    result[t], result[other] = (a, b, d), (a, d, c)
    return result


RING = np.array([[5, 0, 1], [4, 3, 1], [3, 4, 1], [0, 5, 1], [-3, 4, 1], [-4, -3, 1]], dtype=float)
