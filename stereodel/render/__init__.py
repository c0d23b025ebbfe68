"""Pictures: views, scenes and their pages; vector files through matplotlib, pixels through OpenGL."""

from stereodel.render.animate import Animation
from stereodel.render.colors import ColorScale
from stereodel.render.curves import CircleArc, Segment
from stereodel.render.figure import Figure
from stereodel.render.motion.film import Film
from stereodel.render.motion.formats import save_pictures
from stereodel.render.motion.workers import FrameError
from stereodel.render.page import Label, Page
from stereodel.render.saving import save_page
from stereodel.render.scene import Scene
from stereodel.render.sketch import Sketch
from stereodel.render.style import DotStyle, LineStyle
from stereodel.render.things import Layer
from stereodel.render.view import StereographicView, View

__all__ = [
    "Animation",
    "CircleArc",
    "ColorScale",
    "DotStyle",
    "Figure",
    "Film",
    "FrameError",
    "Label",
    "Layer",
    "LineStyle",
    "Page",
    "Scene",
    "Segment",
    "Sketch",
    "StereographicView",
    "View",
    "save_page",
    "save_pictures",
]
