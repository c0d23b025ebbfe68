"""Views of globes for properties, and where lines and loops on a page are."""

import numpy as np
from hypothesis import strategies as st

from stereodel import MoebiusMap
from stereodel.curves.view import StereographicView, View

views = st.one_of(
    st.builds(View, st.floats(-180, 180), st.floats(-90, 90)),
    st.builds(StereographicView, st.floats(-180, 180), st.floats(-90, 90), angular_radius=st.floats(20, 150)),
)


def distance(points, line):
    """Of points (n, d) from a line through points (m, d)."""
    start, way = line[:-1], np.diff(line, axis=0)
    share = np.einsum("ijk,jk->ij", points[:, None] - start, way) / np.maximum(np.sum(way**2, axis=1), 1e-300)
    nearest = start + np.clip(share, 0, 1)[..., None] * way
    return np.linalg.norm(points[:, None] - nearest, axis=-1).min(axis=1)


def winding(loops, places):
    """How often closed loops go round places, counterclockwise."""
    total = np.zeros(len(places), dtype=int)
    for loop in loops:
        a, b = loop[:-1, None] - places, loop[1:, None] - places
        cross = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
        total += ((a[..., 1] <= 0) & (b[..., 1] > 0) & (cross > 0)).sum(axis=0)
        total -= ((a[..., 1] > 0) & (b[..., 1] <= 0) & (cross < 0)).sum(axis=0)
    return total


def disc(size):
    """Places (…, 2) of the middles of pixels of a square around the unit disc, from its upper left corner."""
    middle = (np.arange(size) + 0.5) * 2 / size - 1
    return np.stack(np.meshgrid(middle, -middle), axis=-1)


def sampled(lines):
    """Points of all edges of lines, a row for each, on the sphere."""
    return lines.edges.arcs_under(MoebiusMap.identity(), 1e-5).through(MoebiusMap.identity()).sampled(1e-5)


def length(lines):
    """Of all edges of lines together, on the sphere."""
    return sum(np.linalg.norm(np.diff(row, axis=0), axis=1).sum() for row in sampled(lines))
