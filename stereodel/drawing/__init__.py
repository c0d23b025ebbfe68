"""The geometry of pictures before rendering: pages and their items, scenes, sketches, views, styles."""

from stereodel.drawing.colors import as_color
from stereodel.drawing.diagrams import diagram_page
from stereodel.drawing.fonts import MissingCharactersWarning
from stereodel.drawing.graticule import Graticule
from stereodel.drawing.legend import with_legend
from stereodel.drawing.page import Ball, Dots, Fill, Label, Page, Polygons, Polylines, Stroke
from stereodel.drawing.scales import ColorScale
from stereodel.drawing.scene import Scene
from stereodel.drawing.scene_items import Layer
from stereodel.drawing.sheets import styled
from stereodel.drawing.sketch import Sketch
from stereodel.drawing.solid import PlacedScene, Solid
from stereodel.drawing.space_curves import CircleArc, Segment
from stereodel.drawing.style import DotStyle, LineStyle
from stereodel.drawing.title import with_title
from stereodel.drawing.view import StereographicView, View

__all__ = [
    "Ball",
    "CircleArc",
    "ColorScale",
    "DotStyle",
    "Dots",
    "Fill",
    "Graticule",
    "Label",
    "Layer",
    "LineStyle",
    "MissingCharactersWarning",
    "Page",
    "PlacedScene",
    "Polygons",
    "Polylines",
    "Scene",
    "Segment",
    "Sketch",
    "Solid",
    "StereographicView",
    "Stroke",
    "View",
    "as_color",
    "diagram_page",
    "styled",
    "with_legend",
    "with_title",
]
