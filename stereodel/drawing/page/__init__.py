"""Flat pages: items, labels, colours, styles."""

from stereodel.drawing.page.items import (
    Ball,
    Beziers,
    Dots,
    Fill,
    Item,
    Label,
    Painter,
    Picture,
    Polygons,
    Polylines,
    Stroke,
)
from stereodel.drawing.page.page import Page, picture_extra

__all__ = [
    "Ball",
    "Beziers",
    "Dots",
    "Fill",
    "Item",
    "Label",
    "Page",
    "Painter",
    "Picture",
    "Polygons",
    "Polylines",
    "Stroke",
    "picture_extra",
]
