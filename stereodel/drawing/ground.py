"""The ground under the labels of a page: its colour, which tints the halos of labels that are on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.constants import GROUND_PIXEL
from stereodel.drawing.colorimetry import contrast
from stereodel.drawing.colors import Color
from stereodel.drawing.label import label_box
from stereodel.drawing.page import Beziers, Fill, Item, Label, Page, Picture, Polygons
from stereodel.drawing.style import BLACK, HALO_OPACITY, WHITE

ACROSS: Final = 9
UP: Final = 3
"""Places in the box of a label at which the ground is sampled."""

MOST: Final = 0.75
"""Share of these places that must have one colour for the halo to have it: on more of another, it would be a patch."""

VEIL: Final = 0.6
"""Opacity of a halo on several colours: black type on a white one has contrast 7.4 even where the ground is black."""

LEGIBLE: Final = 7.0
"""Least contrast of small type, a ratio of luminances plus 0.05 (Web Content Accessibility Guidelines, level AAA)."""

BEZIER_STEPS: Final = np.linspace(0.0, 1.0, 8, endpoint=False)


def haloed(page: Page) -> Page:
    """A page on which the halos of labels that are `on_ground` have the colour of the ground below the words.

    Where that has several colours, as at a coast, halos are a veil of white, or of black below light type.
    Labels are above everything else, so that all other items are the ground. Styles change its colours: halos are
    determined again when a page has been styled.
    """
    if not any(label.on_ground and label.halo for label in page.labels):
        return page
    ground = [item for item in page.items if not isinstance(item, Label)]

    def tinted(item: Item) -> Item:
        return _tinted(item, page, ground) if isinstance(item, Label) and item.on_ground and item.halo else item

    return replace(page, items=tuple(map(tinted, page.items)))


def _tinted(label: Label, page: Page, ground: Sequence[Item]) -> Label:
    unit = page.points_per_unit
    (left, bottom), (right, top) = label_box(label, unit) / unit
    places = np.stack(np.meshgrid(np.linspace(left, right, ACROSS), np.linspace(bottom, top, UP)), axis=-1)
    found = painted(ground, places.reshape(-1, 2), page.background).round(3)
    colors, counts = np.unique(found, axis=0, return_counts=True)
    if counts.max() < MOST * len(found):
        return replace(label, halo_color=(*away_from(label.color), VEIL))
    red, green, blue = legible(colors[counts.argmax()], label.color).tolist()
    return replace(label, halo_color=(red, green, blue, HALO_OPACITY))


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


def painted(items: Sequence[Item], places: FloatArray, background: Color = WHITE) -> FloatArray:
    """Colours, sRGB (n, 3), of regions and images at places of a page (n, 2), without lines and shading."""
    colors = np.tile(np.array(WHITE[:3]), (len(places), 1))
    _lay(colors, np.tile(np.array(background), (len(places), 1)))
    for item in items:
        match item:
            case Fill():
                inside = np.sum([_turns(_corners(path), places) for path in item.paths], axis=0) % 2 != 0
                _lay(colors, np.where(inside[:, None], item.color, 0.0))
            case Polygons():
                _lay(colors, _polygon_colors(item, places))
            case Picture():
                inside = np.sum([_turns(_corners(path), places) for path in item.outline], axis=0) != 0
                pixels = [
                    item.painter.paint((x, y, GROUND_PIXEL, GROUND_PIXEL), (1, 1))[0, 0] / 255
                    for x, y in places.tolist()
                ]
                _lay(colors, np.where(inside[:, None], pixels, 0.0))
    return colors


def _lay(colors: FloatArray, over: FloatArray) -> None:
    """Composite colours with opacity (n, 4) over others, in place."""
    colors += over[:, 3:] * (over[:, :3] - colors)


def _polygon_colors(item: Polygons, places: FloatArray) -> FloatArray:
    """The colour of the region that contains each place, (n, 4); opacity 0 if none does."""
    loops = item.loops
    last = np.zeros(len(loops.values), dtype=bool)
    last[loops.offsets[1:] - 1] = True
    # Only edges at the heights of the places can wind around one.
    low, high = places[:, 1].min(), places[:, 1].max()
    start, end = loops.values, np.roll(loops.values, -1, axis=0)
    near = ~last & (np.minimum(start[:, 1], end[:, 1]) <= high) & (np.maximum(start[:, 1], end[:, 1]) >= low)
    owner = item.owner[loops.row[near]]
    regions, number = np.unique(owner, return_inverse=True)
    found = np.zeros((len(places), 4))
    for k, place in enumerate(places):
        turns = np.bincount(number, _crossings(start[near], end[near], place), minlength=len(regions))
        for region in regions[np.flatnonzero(turns)]:
            found[k] = item.colors[region]
    return found


def _turns(corners: FloatArray, places: FloatArray) -> FloatArray:
    """Winding numbers of a closed line with corners (m, 2) about places (n, 2)."""
    following = np.roll(corners, -1, axis=0)
    return np.array([_crossings(corners, following, place).sum() for place in places])


def _crossings(start: FloatArray, end: FloatArray, place: FloatArray) -> FloatArray:
    """For each edge: +1 if it goes up on the right of a place, −1 if it goes down there, else 0."""
    up = (start[:, 1] <= place[1]) & (end[:, 1] > place[1])
    down = (start[:, 1] > place[1]) & (end[:, 1] <= place[1])
    a, b = start - place, end - place
    side = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return np.where(up & (side > 0), 1.0, 0.0) - np.where(down & (side < 0), 1.0, 0.0)


def _corners(path: Beziers) -> FloatArray:
    """Points along a path of Bézier curves."""
    s = BEZIER_STEPS[None, :, None]
    p0, p1, p2, p3 = (path[:, i, None] for i in range(4))
    points = (1 - s) ** 3 * p0 + 3 * s * (1 - s) ** 2 * p1 + 3 * s**2 * (1 - s) * p2 + s**3 * p3
    return points.reshape(-1, 2)
