"""Evenly spread random sites, shared by the figures that the paper fills with "vertices"."""

from collections.abc import Callable

import numpy as np


def spread(count: int, draw: Callable[[int], np.ndarray], *, candidates: int = 12) -> np.ndarray:
    """`count` points, each the one of `candidates` drawn that lies farthest from all before it (Mitchell's rule)."""
    sites = draw(1)
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


def in_rectangle(count: int, width: float, height: float, seed: int, *, margin: float = 0.0) -> np.ndarray:
    """Points (count, 2) of a rectangle about the origin, at least `margin` inside it."""
    rng = np.random.default_rng(seed)
    half = np.array([width, height]) / 2 - margin
    return spread(count, lambda n: rng.uniform(-half, half, size=(n, 2)))
