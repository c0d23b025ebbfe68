"""Pages as files: pixels through OpenGL, SVG and PDF through matplotlib; `stereodel.drawing.Page.save` calls it."""

from stereodel.render.figure import Figure

__all__ = ["Figure"]
