"""Placement of labels: each on a side of its place where there is room, or left out.

Labels are placed in order of priority. Each has eight candidate positions around its place, the right-hand side first.
It takes the position where it overlaps no earlier label, lies within the disc, and covers the fewest dots; ties go to
the earlier position. Without such a position it is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.label import in_disc, label_box, meets, placed_label
from stereodel.drawing.page import Label

SIDES: Final = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))
"""Candidate positions around a place, right and up, in the order in which they are tried."""

RISE: Final = 0.2
"""How far lines of type may extend beyond the box of their letters, up or down, in units of their size."""

SLANT: Final = 0.75
"""Factor on the distance, along both axes, for positions at a corner of the place."""


def placed_apart(
    labels: Iterable[Label],
    distance: float,
    *,
    center: tuple[float, float],
    radius: float,
    points_per_unit: float,
    before: Sequence[Label] = (),
    dots: FloatArray | None = None,
) -> list[Label]:
    """Labels at positions where they have room, without those that have none.

    Parameters
    ----------
    labels : iterable of Label
        Labels anchored at their places, in order of priority.
    distance : float
        Distance from a place to its label, in points.
    center, radius : (float, float), float
        Centre and radius, in page units, of the disc that must contain the labels.
    points_per_unit : float
        Scale of the page.
    before : sequence of Label
        Labels that are already on the page.
    dots : (n, 2) array, optional
        Places on the page that should not be covered.

    Returns
    -------
    list of Label
        Labels in the same order, none of which overlaps another or one of `before`.

    Examples
    --------
    >>> names = [Label(name, (0.0, 0.0)) for name in ("Ulm", "Neu-Ulm", "Wiblingen")]
    >>> placed = placed_apart(names, 8.0, center=(0.0, 0.0), radius=1.0, points_per_unit=100.0)
    >>> [(label.text, label.align) for label in placed]
    [('Ulm', 'left'), ('Neu-Ulm', 'right'), ('Wiblingen', 'center')]
    """
    scale = points_per_unit
    boxes = np.array([label_box(label, scale) for label in before]).reshape(-1, 2, 2)
    marks = np.zeros((0, 2)) if dots is None else scale * dots
    placed = []
    for label in labels:
        found = [
            (covered, side, candidate, box)
            for side, candidate in enumerate(on_its_sides(label, distance))
            for box in [label_box(candidate, scale)]
            if in_disc(candidate, center, radius, scale) and not meets(claimed(candidate, scale), boxes)
            for covered in [int(((marks > box[0]) & (marks < box[1])).all(axis=1).sum())]
        ]
        if found:
            _, _, best, box = min(found, key=lambda choice: choice[:2])
            placed.append(best)
            boxes = np.concatenate([boxes, box[None]])
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
