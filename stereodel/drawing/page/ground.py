"""What lies at places of a page: winding numbers, colours of regions, and colours on which type is legible."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray, Indices
from stereodel.curves.ragged import Ragged
from stereodel.drawing.page.colorimetry import contrast
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.style import BLACK, WHITE

LEGIBLE: Final = 7.0
"""Least contrast of small type, a ratio of luminances plus 0.05 (Web Content Accessibility Guidelines, level AAA)."""

BEZIER_STEPS: Final = np.linspace(0.0, 1.0, 8, endpoint=False)


def away_from(ink: Color) -> tuple[float, float, float]:
    """White or black, whichever contrasts more with the ink."""
    return max(WHITE[:3], BLACK[:3], key=lambda far: float(contrast(far, ink[:3])))


def legible(ground: FloatArray, ink: Color) -> FloatArray:
    """A colour mixed with white or black, whichever is farther from the ink, until type on it is legible."""
    away = away_from(ink)
    for share in np.linspace(0.0, 1.0, 21):
        mixed: FloatArray = ground + share * (away - ground)
        if contrast(mixed, ink[:3]) >= LEGIBLE:
            break
    return mixed


def colors_within(loops: Ragged, owner: Indices, colors: FloatArray, places: FloatArray) -> FloatArray:
    """The colour of the region that contains each place, (n, 4); opacity 0 if none does."""
    last = np.zeros(len(loops.values), dtype=bool)
    last[loops.offsets[1:] - 1] = True
    # Only edges at the heights of the places can wind around one.
    low, high = places[:, 1].min(), places[:, 1].max()
    start, end = loops.values, np.roll(loops.values, -1, axis=0)
    near = ~last & (np.minimum(start[:, 1], end[:, 1]) <= high) & (np.maximum(start[:, 1], end[:, 1]) >= low)
    owner = owner[loops.row[near]]
    regions, number = np.unique(owner, return_inverse=True)
    found = np.zeros((len(places), 4))
    for k, place in enumerate(places):
        turns = np.bincount(number, _crossings(start[near], end[near], place), minlength=len(regions))
        for region in regions[np.flatnonzero(turns)]:
            found[k] = colors[region]
    return found


def winding(paths: Iterable[FloatArray], places: FloatArray) -> FloatArray:
    """Winding numbers of closed runs of cubics (k, 4, 2) about places (n, 2)."""
    found = np.zeros(len(places))
    for corners in map(_corners, paths):
        following = np.roll(corners, -1, axis=0)
        found += [_crossings(corners, following, place).sum() for place in places]
    return found


def _crossings(start: FloatArray, end: FloatArray, place: FloatArray) -> FloatArray:
    """For each edge: +1 if it goes up on the right of a place, −1 if it goes down there, else 0."""
    up = (start[:, 1] <= place[1]) & (end[:, 1] > place[1])
    down = (start[:, 1] > place[1]) & (end[:, 1] <= place[1])
    a, b = start - place, end - place
    side = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return np.where(up & (side > 0), 1.0, 0.0) - np.where(down & (side < 0), 1.0, 0.0)


def _corners(path: FloatArray) -> FloatArray:
    """Points along a path of Bézier curves."""
    s = BEZIER_STEPS[None, :, None]
    p0, p1, p2, p3 = (path[:, i, None] for i in range(4))
    points = (1 - s) ** 3 * p0 + 3 * s * (1 - s) ** 2 * p1 + 3 * s**2 * (1 - s) * p2 + s**3 * p3
    return points.reshape(-1, 2)
