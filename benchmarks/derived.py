"""What is made of a triangulation: nearest points, graphs, a step of relaxation, contours, beside SciPy and Matplotlib.

Everything in one process and in turns, on one triangulation, which is not part of the time of what takes one. Peers
get what they need beforehand as well: SciPy its tree and the lengths of the edges, Matplotlib the triangles.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation as MatplotlibTriangulation
from scipy.sparse import coo_array
from scipy.sparse.csgraph import minimum_spanning_tree as spanning_tree
from scipy.spatial import cKDTree

from benchmarks.distributions import make
from benchmarks.rounds import Calls, in_turns
from stereodel import PlanarDelaunay, SphericalDelaunay
from stereodel._arrays import FloatArray
from stereodel.graphs import gabriel_graph, minimum_spanning_tree, relative_neighborhood_graph, urquhart_graph
from stereodel.interpolation import contours
from stereodel.relaxation import lloyd

SIZE = 100_000
NEAREST = 8
LEVELS = np.linspace(-0.9, 0.9, 10)
ROUNDS = 5

GRAPHS = {
    "gabriel": gabriel_graph,
    "relative": relative_neighborhood_graph,
    "urquhart": urquhart_graph,
    "spanning": minimum_spanning_tree,
}


def waves(points: FloatArray) -> FloatArray:
    """Values with hills and hollows between -1 and 1."""
    return np.asarray(np.sin(9 * points[:, 0]) * np.cos(7 * points[:, 1]))


def queries(triangulation: PlanarDelaunay | SphericalDelaunay, asked: FloatArray) -> Calls:
    """The nearest point and the nearest ones."""
    tree = cKDTree(triangulation.points)
    calls: Calls = {}
    for workers in (1, 2):
        calls[f"nearest {workers}"] = lambda w=workers: triangulation.nearest(asked, workers=w)
        calls[f"tree nearest {workers}"] = lambda w=workers: tree.query(asked, workers=w)
        calls[f"k nearest {workers}"] = lambda w=workers: triangulation.nearest(asked, k=NEAREST, workers=w)
        calls[f"tree k nearest {workers}"] = lambda w=workers: tree.query(asked, k=NEAREST, workers=w)
    return calls


def graphs(triangulation: PlanarDelaunay | SphericalDelaunay) -> Calls:
    """All graphs, and SciPy's spanning tree of the triangulation's edges."""
    calls: Calls = {}
    for name, graph in GRAPHS.items():
        for workers in (1, 2):
            calls[f"{name} {workers}"] = lambda g=graph, w=workers: g(triangulation, workers=w)
    points, (i, j) = triangulation.points, triangulation.edges.T
    lengths = np.linalg.norm(points[i] - points[j], axis=1)
    matrix = coo_array((lengths, (i, j)), shape=(len(points), len(points))).tocsr()
    return calls | {"scipy spanning 1": lambda: spanning_tree(matrix)}


def others(triangulation: PlanarDelaunay | SphericalDelaunay) -> Calls:
    """A step of relaxation and contours, in the plane beside Matplotlib's."""
    points = triangulation.points
    values = waves(points)
    bounds = {"bounds": (0, 0, 1, 1)} if points.shape[1] == 2 else {}
    calls: Calls = {
        f"lloyd {workers}": lambda w=workers: lloyd(points, steps=1, workers=w, **bounds) for workers in (1, 2)
    }
    calls["contours 1"] = lambda: contours(triangulation, values, LEVELS)
    if points.shape[1] == 2:
        known = MatplotlibTriangulation(*points.T, triangulation.simplices)
        axes = Figure().subplots()
        calls["matplotlib contours 1"] = lambda: axes.tricontour(known, values, levels=LEVELS)
    return calls


def derived(largest: int) -> dict[str, Any]:
    """The experiment: uniform points, as many queries."""
    n = min(largest, SIZE)
    found: dict[str, Any] = {"n": n}
    for space, make_triangulation in (("plane", PlanarDelaunay), ("sphere", SphericalDelaunay)):
        triangulation = make_triangulation(make(space, "uniform", n))
        asked = make(space, "uniform", n, seed=2)
        calls = queries(triangulation, asked) | graphs(triangulation) | others(triangulation)
        found[space] = in_turns(calls, rounds=ROUNDS)
    return found
