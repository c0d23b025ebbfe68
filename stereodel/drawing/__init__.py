"""The geometry of pictures before rendering: pages and their items, scenes, sketches, views, styles."""

from stereodel.curves.view import StereographicView, View
from stereodel.drawing.page import Ball, Dots, Fill, Label, Page, Polygons, Polylines, Stroke
from stereodel.drawing.page.colors import as_color
from stereodel.drawing.page.fonts import MissingCharactersWarning
from stereodel.drawing.page.labels import with_title
from stereodel.drawing.page.scales import ColorScale, SizeScale
from stereodel.drawing.page.sheets import styled
from stereodel.drawing.page.style import DotStyle, LineStyle
from stereodel.drawing.scene.diagrams import diagram_page
from stereodel.drawing.scene.graticule import Graticule
from stereodel.drawing.scene.legend import with_legend
from stereodel.drawing.scene.scene import Scene
from stereodel.drawing.scene.scene_items import Layer
from stereodel.drawing.scene.sketch import Sketch
from stereodel.drawing.scene.solid import PlacedScene, Solid
from stereodel.drawing.scene.space_curves import CircleArc, Segment

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
    "SizeScale",
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
