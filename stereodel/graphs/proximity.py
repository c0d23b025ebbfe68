"""What the graphs of nearness share: edges from the kernel, or from a line or great circle."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, IntArray
from stereodel._spaces import space_of
from stereodel.triangulation.given import Triangulation
from stereodel.triangulation.planar_delaunay import PlanarDelaunay
from stereodel.triangulation.topology import as_edges

Kind = Literal["gabriel", "urquhart", "relative"]
Indices = npt.NDArray[np.integer]


def proximity_edges(triangulation: Triangulation, kind: Kind, workers: int | None) -> IntArray:
    """Edges (e, 2) with i < j, in lexicographic order, of a graph of nearness."""
    threads = triangulation._thread_count(workers)
    if triangulation.dimension < 2:
        return _flat_edges(triangulation, kind)
    points = triangulation.points
    return space_of(points).proximity(points, triangulation.simplices, triangulation.neighbors, kind, threads, True)


def short_steps(points: FloatArray, circle: Indices) -> Indices:
    """Steps (e, 2) around three or more different directions of a great circle that are less than half-turns.

    A step of less than a half-turn has all other points outside its diametral circle, a longer one inside, a half-turn
    on it: the next point tells.
    """
    three = np.column_stack([circle, np.roll(circle, -1), np.roll(circle, -2)]).astype(np.int32)
    return three[_kernel.sphere.diametral(points, three) > 0, :2]


def _flat_edges(triangulation: Triangulation, kind: Kind) -> IntArray:
    order, points = triangulation._flat_order, triangulation.points
    if isinstance(triangulation, PlanarDelaunay) or len(order) < 3:
        return as_edges(order[:-1], order[1:])
    steps = short_steps(points, order)
    if kind == "relative":
        steps = steps[[_has_empty_lune(points, order, step) for step in steps]]
    return as_edges(*steps.T)


def _has_empty_lune(points: FloatArray, circle: Indices, step: Indices) -> bool:
    """Whether no point of a great circle is strictly nearer to both ends of a step than these are to each other.

    That takes a step of more than a third of the circle, the squared chord of which is 3: two steps at most.
    """
    a, b = step
    chord = np.subtract(*(points[[a, b]] / np.linalg.norm(points[[a, b]], axis=1)[:, None]))
    if chord @ chord < 2.99:
        return True
    others = circle[(circle != a) & (circle != b)]

    def nearer(end: int) -> npt.NDArray[np.bool_]:
        rows = [np.broadcast_to(k, others.shape) for k in (end, others, a, b)]
        return _kernel.sphere.compare_lengths(points, np.column_stack(rows).astype(np.int32)) < 0

    return not (nearer(a) & nearer(b)).any()
