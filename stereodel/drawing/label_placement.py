"""Names beside their places: each on the side where it has room, and where there is none, none.

Labels are placed one after another, and those that come first matter most. Each may stand on eight sides of its place,
to the right before all others. It takes the side on which it covers no label that was placed before it, lies within the
disc, and covers the fewest dots, the first such side where several are alike; without such a side it is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.label import halo_reach, in_disc, label_box, meets, placed_label
from stereodel.drawing.page import Label

SIDES: Final = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))
"""Where a name may stand beside its place, right and up, in the order in which they are tried."""

RISE: Final = 0.2
"""How far lines of type may lie beyond the box of their own letters, up or down, in terms of their size."""

SLANT: Final = 0.75
"""Of the distance of a name that is beside its place, along either axis where it stands at a corner of it."""


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
    """Labels on the sides of their places where they have room, without those that have none.

    Parameters
    ----------
    labels : iterable of Label
        Anchored at their places, those that matter most first.
    distance : float
        From a place to its label, points.
    center, radius : (float, float), float
        Of the disc of the page in which they must lie, page units.
    points_per_unit : float
        Scale of the page.
    before : sequence of Label
        What is on the page already.
    dots : (n, 2) array, optional
        Places on the page that are better not covered.

    Returns
    -------
    list of Label
        In their order; no two of them, and none of them and of those before, overlap.

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
    """The box that is a label's alone, points, (2, 2): its halo cuts no type before it, whatever letters reach up."""
    rise = RISE * label.size * np.array([[0.0, -1.0], [0.0, 1.0]])
    return label_box(label, points_per_unit) + halo_reach(label) + rise


def on_its_sides(label: Label, distance: float) -> Iterator[Label]:
    """The label on each of its sides."""
    for right, up in SIDES:
        away = distance if not (right and up) else SLANT * distance
        candidate = placed_label(label, (right * away, up * away))
        # At a corner of the place a corner of the label is nearest to it.
        yield replace(candidate, valign="bottom" if up > 0 else "top") if right and up else candidate
