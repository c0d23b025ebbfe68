"""Evenly spread random sites, shared by the figures that the paper fills with "vertices"."""

from collections.abc import Callable

import numpy as np

from stereodel import lonlat_to_xyz

OVAL = 6.0
"""Exponent n of the curve |x|ⁿ + |y|ⁿ = 1, between a circle (2) and a square (∞)."""


def spread(
    count: int, draw: Callable[[int], np.ndarray], *, first: np.ndarray | None = None, candidates: int = 12
) -> np.ndarray:
    """`count` points, each the one of `candidates` drawn that lies farthest from all before it (Mitchell's rule)."""
    sites = draw(1) if first is None else first
    while len(sites) < count:
        drawn = draw(candidates)
        distances = np.linalg.norm(drawn[:, None] - sites[None], axis=-1).min(axis=1)
        sites = np.vstack([sites, drawn[[np.argmax(distances)]]])
    return sites


def on_sphere(count: int, seed: int) -> np.ndarray:
    """Unit vectors (count, 3)."""
    rng = np.random.default_rng(seed)

    def draw(n: int) -> np.ndarray:
        vectors = rng.normal(size=(n, 3))
        return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)

    return spread(count, draw)


def in_cap(count: int, seed: int, middle: tuple[float, float], reach: float) -> np.ndarray:
    """Unit vectors (count, 3) at most `reach` degrees from a place, which is given by longitude and latitude."""
    rng, axis = np.random.default_rng(seed), lonlat_to_xyz(middle)

    def draw(n: int) -> np.ndarray:
        vectors = rng.normal(size=(64 * n, 3))
        vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
        return vectors[vectors @ axis > np.cos(np.radians(reach))][:n]

    return spread(count, draw)


def in_rectangle(count: int, hull: int, width: float, height: float, seed: int, *, margin: float) -> np.ndarray:
    """Points (count, 2) of a rectangle about the origin, at least `margin` inside it.

    The first `hull` of them lie on an oval and the others well inside it, so that the triangulation has no slivers
    along its convex hull, as it has where random points lie next to a straight side.
    """
    rng = np.random.default_rng(seed)
    half = np.array([width, height]) / 2 - margin

    def on_oval(n: int) -> np.ndarray:
        ways = rng.normal(size=(n, 2))
        return half * ways / np.linalg.norm(ways, ord=OVAL, axis=1, keepdims=True)

    rim = spread(hull, on_oval, candidates=40)
    inner = 0.86 * half  # whose corners are inside the oval
    return spread(count, lambda n: rng.uniform(-inner, inner, size=(n, 2)), first=rim)
