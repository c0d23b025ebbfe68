"""Labels on maps: their position at a place, and which have room."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Final, Literal

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel.drawing.fonts import font_properties, quiet_fonts, set_text
from stereodel.drawing.page import Item, Label
from stereodel.drawing.style import TYPE

GAP: Final = 1.0
"""Least distance between labels, points."""


def placed_label(label: Label, offset: tuple[float, float]) -> Label:
    """A label on the side of its place given by an offset in points."""
    align: Literal["left", "center", "right"] = "left" if offset[0] > 0 else "right" if offset[0] < 0 else "center"
    valign: Literal["bottom", "center", "top"] = "bottom" if offset[1] > 0 else "top"
    if offset[0] or not offset[1]:
        valign = "center"
    return replace(label, offset=offset, align=align, valign=valign)


def within_disc(label: Label, center: tuple[float, float], radius: float, points_per_unit: float) -> Label:
    """A label moved to another side of its place if it would leave a disc of the page; without halo if all sides do.

    The opposite side is tried first, then those at right angles. A halo outside the disc would interrupt the line
    around it.
    """
    right, up = label.offset
    turned = (placed_label(label, offset) for offset in ((-right, -up), (-up, right), (up, -right)))
    inside = (each for each in (label, *turned) if in_disc(each, center, radius, points_per_unit))
    return next(inside, replace(label, halo=0.0))


def in_disc(label: Label, center: tuple[float, float], radius: float, points_per_unit: float) -> bool:
    """Whether a label lies within a disc of the page, with its halo, which is round about the corners of its box."""
    low, high = label_box(label, points_per_unit)
    reach = np.maximum(
        np.abs(low - points_per_unit * np.array(center)), np.abs(high - points_per_unit * np.array(center))
    )
    return float(np.hypot(*reach)) + label.halo <= points_per_unit * radius


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


def meets(box: FloatArray, boxes: FloatArray) -> bool:
    """Whether a box (2, 2) is nearer than `GAP` to one of others (n, 2, 2), in points."""
    # Boxes overlap if they do so in both directions.
    return bool(((box[0] < boxes[:, 1] + GAP).all(axis=1) & (boxes[:, 0] < box[1] + GAP).all(axis=1)).any())


def label_box(label: Label, points_per_unit: float) -> FloatArray:
    """Lower left and upper right corner of an unrotated label, in points, (2, 2)."""
    with of_extra("draw"):
        from matplotlib import rc_context
        from matplotlib.textpath import text_to_path

    text, math = set_text(label)
    with rc_context({"mathtext.fontset": TYPE["mathtext.fontset"]}), quiet_fonts():
        width, height, _ = text_to_path.get_text_width_height_descent(text, font_properties(label), ismath=math)
    left = {"left": 0.0, "center": -width / 2, "right": -width}[label.align]
    low = {"bottom": 0.0, "baseline": 0.0, "center": -height / 2, "top": -height}[label.valign]
    corner = points_per_unit * np.array(label.anchor) + np.array(label.offset) + np.array([left, low])
    return np.stack([corner, corner + np.array([width, height])])
