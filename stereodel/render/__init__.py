"""Pages as files: pixels through OpenGL, SVG and PDF through matplotlib."""

from stereodel.render.figure import Figure
from stereodel.render.save import save_page

__all__ = ["Figure", "save_page"]
