"""Labels: their boxes, their sides of places, which have room, their halos, and the title of a page.

Names beside places (`placed_apart`) have eight candidate positions, the right-hand side first. In order of priority,
each takes the one where it overlaps no earlier label, lies within the disc and covers the fewest dots, or is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Final, Literal

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel.drawing.page.colors import Color, contrast
from stereodel.drawing.page.fonts import families_of, font_properties, quiet_fonts, set_text
from stereodel.drawing.page.items import Item, Label, painted
from stereodel.drawing.page.page import Page
from stereodel.drawing.page.style import BLACK, HALO_OPACITY, TYPE, WHITE

GAP: Final = 1.0
"""Least distance between labels, points."""

SIDES: Final = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))
"""Candidate positions around a place, right and up, in the order in which they are tried."""

RISE: Final = 0.2
"""How far lines of type may extend beyond the box of their letters, up or down, in units of their size."""

SLANT: Final = 0.75
"""Factor on the distance, along both axes, for positions at a corner of the place."""

ACROSS: Final = 9
UP: Final = 3
"""Places in the box of a label at which the ground is sampled."""

MOST: Final = 0.75
"""Share of these places that must have one colour for the halo to have it: on more of another, it would be a patch."""

VEIL: Final = 0.6
"""Opacity of a halo on several colours: black type on a white one has contrast 7.4 even where the ground is black."""

LEGIBLE: Final = 7.0
"""Least contrast of small type, a ratio of luminances plus 0.05 (Web Content Accessibility Guidelines, level AAA)."""

TITLE_SIZE: Final = 12.0
"""Type size of a title in points."""

TITLE_GAP: Final = 5.0
"""Space above and below the title in points."""


Disc = tuple[tuple[float, float], float, float]
"""Centre and radius of a disc of a page, in page units, and the points in one of them."""


def label_box(label: Label, points_per_unit: float) -> FloatArray:
    """Lower left and upper right corner of an unrotated label, in points, (2, 2)."""
    width, height = _measured(*set_text(label), tuple(families_of(label)), label.size)
    left = {"left": 0.0, "center": -width / 2, "right": -width}[label.align]
    low = {"bottom": 0.0, "baseline": 0.0, "center": -height / 2, "top": -height}[label.valign]
    corner = points_per_unit * np.array(label.anchor) + np.array(label.offset) + np.array([left, low])
    return np.stack([corner, corner + np.array([width, height])])


@lru_cache(maxsize=4096)
def _measured(text: str, math: bool, families: tuple[str, ...], size: float) -> tuple[float, float]:
    """Width and height of type in points."""
    with of_extra("draw"):
        from matplotlib import rc_context
        from matplotlib.textpath import text_to_path

    with rc_context({"mathtext.fontset": TYPE["mathtext.fontset"]}), quiet_fonts():
        width, height, _ = text_to_path.get_text_width_height_descent(
            text, font_properties(families, size), ismath=math
        )
    return width, height


def meets(box: FloatArray, boxes: FloatArray) -> bool:
    """Whether a box (2, 2) is nearer than `GAP` to one of others (n, 2, 2), in points."""
    # Boxes overlap if they do so in both directions.
    return bool(((box[0] < boxes[:, 1] + GAP).all(axis=1) & (boxes[:, 0] < box[1] + GAP).all(axis=1)).any())


def in_disc(label: Label, disc: Disc) -> bool:
    """Whether a label lies within a disc of the page, with its halo, which is round about the corners of its box."""
    center, radius, scale = disc
    reach = np.abs(label_box(label, scale) - scale * np.array(center)).max(axis=0)
    return float(np.hypot(*reach)) + label.halo <= scale * radius


def placed_label(label: Label, offset: tuple[float, float]) -> Label:
    """A label on the side of its place given by an offset in points."""
    align: Literal["left", "center", "right"] = "left" if offset[0] > 0 else "right" if offset[0] < 0 else "center"
    valign: Literal["bottom", "center", "top"] = "bottom" if offset[1] > 0 else "top"
    if offset[0] or not offset[1]:
        valign = "center"
    return replace(label, offset=offset, align=align, valign=valign)


def within_disc(label: Label, disc: Disc) -> Label:
    """A label moved to another side of its place if it would leave a disc of the page; without halo if all sides do."""
    # The opposite side first, then those at right angles. A halo outside the disc would interrupt the line around it.
    right, up = label.offset
    turned = (placed_label(label, offset) for offset in ((-right, -up), (-up, right), (up, -right)))
    inside = (each for each in (label, *turned) if in_disc(each, disc))
    return next(inside, replace(label, halo=0.0))


def with_room(items: Iterable[Item], extent: tuple[float, float, float, float], points_per_unit: float) -> list[Item]:
    """Page items without labels that would overlap an earlier label or leave (left, right, bottom, top)."""
    low, high = points_per_unit * np.array(extent[::2]), points_per_unit * np.array(extent[1::2])
    kept: list[Item] = []
    boxes = np.zeros((0, 2, 2))
    for item in items:
        if isinstance(item, Label):
            box = label_box(item, points_per_unit)
            if meets(box, boxes) or (box[0] < low).any() or (box[1] > high).any():
                continue
            boxes = np.concatenate([boxes, box[None]])
        kept.append(item)
    return kept


def placed_apart(
    labels: Iterable[Label], distance: float, disc: Disc, before: Sequence[Label] = (), dots: FloatArray | None = None
) -> list[Label]:
    """Labels in order of priority, at positions in a disc where they have room, without those that have none.

    distance: points from a place to its label.
    before: labels that are already on the page.
    dots: places on the page (n, 2) that should not be covered.

    >>> names = [Label(name, (0.0, 0.0)) for name in ("Ulm", "Neu-Ulm", "Wiblingen")]
    >>> placed = placed_apart(names, 8.0, ((0.0, 0.0), 1.0, 100.0))
    >>> [(label.text, label.align) for label in placed]
    [('Ulm', 'left'), ('Neu-Ulm', 'right'), ('Wiblingen', 'center')]
    """
    scale = disc[2]
    boxes = np.array([label_box(label, scale) for label in before]).reshape(-1, 2, 2)
    marks = np.zeros((0, 2)) if dots is None else scale * dots

    def covered(label: Label) -> int:
        low, high = label_box(label, scale)
        return int(((marks > low) & (marks < high)).all(axis=1).sum())

    placed = []
    for label in labels:
        free = [
            side
            for side in on_its_sides(label, distance)
            if in_disc(side, disc) and not meets(claimed(side, scale), boxes)
        ]
        if free:
            placed.append(min(free, key=covered))
            boxes = np.concatenate([boxes, label_box(placed[-1], scale)[None]])
    return placed


def claimed(label: Label, points_per_unit: float) -> FloatArray:
    """The box reserved for a label, in points, (2, 2), so that its halo never covers earlier type."""
    rise = RISE * label.size * np.array([[0.0, -1.0], [0.0, 1.0]])
    halo = label.halo * np.array([[-1.0], [1.0]])
    return label_box(label, points_per_unit) + halo + rise


def on_its_sides(label: Label, distance: float) -> Iterator[Label]:
    """The label at each candidate position."""
    for right, up in SIDES:
        away = distance if not (right and up) else SLANT * distance
        candidate = placed_label(label, (right * away, up * away))
        # At a corner position, a corner of the label is nearest to the place.
        yield replace(candidate, valign="bottom" if up > 0 else "top") if right and up else candidate


def haloed(page: Page) -> Page:
    """A page on which the halos of labels that are `on_ground` have the colour of the ground, all other items, below.

    Where that has several colours, as at a coast, halos are a veil of white, or of black below light type.
    """
    return replace(page, items=tuple(_tinted(item, page) for item in page.items))


def _tinted(label: Item, page: Page) -> Item:
    if not (isinstance(label, Label) and label.on_ground and label.halo):
        return label
    unit = page.points_per_unit
    (left, bottom), (right, top) = label_box(label, unit) / unit
    places = np.stack(np.meshgrid(np.linspace(left, right, ACROSS), np.linspace(bottom, top, UP)), axis=-1)
    found = painted(page.items, places.reshape(-1, 2), page.background).round(3)
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


def with_title(page: Page, title: str) -> Page:
    """The page with a title above the picture and in its metadata; unchanged if the title is empty.

    Parameters
    ----------
    page : Page
        Page whose width is kept and which grows upwards.
    title : str
        One line; text between two dollar signs is a formula.

    Examples
    --------
    >>> page = with_title(Page((0.0, 2.0, 0.0, 1.0), width=200.0), "Nothing")
    >>> page.title, page.items[0].text, round(float(page.height), 1)
    ('Nothing', 'Nothing', 120.8)
    """
    if not title:
        return page
    left, right, bottom, top = page.extent
    label = Label(title, ((left + right) / 2, top), (0.0, TITLE_GAP), "center", "bottom", TITLE_SIZE, BLACK)
    extent = (left, right, bottom, top + title_height(title) / page.points_per_unit)
    return replace(page, extent=extent, items=(*page.items, replace(label, name="title")), title=title)


def title_height(title: str) -> float:
    """Points that a page grows by for a title."""
    if not title:
        return 0.0
    (_, low), (_, high) = label_box(Label(title, (0.0, 0.0), valign="bottom", size=TITLE_SIZE), 1.0)
    return float(high - low) + 2 * TITLE_GAP
