"""Arcs of the sphere as rows of numbers, so that a figure's geometry is arrays alone."""

from collections.abc import Iterable

import numpy as np

from stereodel.drawing import CircleArc
from stereodel.sphere import SphereArc


def to_rows(arcs: Iterable[SphereArc | CircleArc]) -> np.ndarray:
    """Centre, two radii and swept angle of each arc, (n, 10)."""
    return np.array([np.hstack(_frame(arc)) for arc in arcs]).reshape(-1, 10)


def _frame(arc: SphereArc | CircleArc) -> tuple:
    """Of `CircleArc`, those that begin at 0: images of a grid."""
    return arc.frame() if isinstance(arc, SphereArc) else (arc.center, arc.u, arc.v, arc.stop)


def rows_through(starts: np.ndarray, middles: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """The same of the arcs from starts through middles to ends, unit vectors (n, 3)."""
    axis = np.cross(middles - starts, ends - starts)
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    center = axis * (axis * starts).sum(axis=1, keepdims=True)
    u, last = starts - center, ends - center
    v = np.cross(axis, u)
    sweep = np.arctan2((v * last).sum(axis=1), (u * last).sum(axis=1)) % (2 * np.pi)
    return np.column_stack([center, u, v, sweep])


def from_rows(rows: np.ndarray) -> list[CircleArc]:
    """The arcs back, ready to be drawn."""
    return [CircleArc(row[0:3], row[3:6], row[6:9], 0.0, float(row[9])) for row in rows]
