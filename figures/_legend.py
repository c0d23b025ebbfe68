"""The legend of the figures that show a triangulation and its dual: 1, 2 and 7."""

from collections.abc import Mapping

from stereodel.drawing import DotStyle, LineStyle, Page, with_legend
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.style import LINES

PAGE_WIDTH = 340.0  # points


def with_graphs(page: Page, others: Mapping[str, LineStyle | DotStyle | Color] | None = None) -> Page:
    """The page with both graphs named below the picture, and what else it shows."""
    graphs = {"Delaunay triangulation": LINES["delaunay"], "Voronoi diagram": LINES["voronoi"]}
    return with_legend(page, graphs | dict(others or {}), columns=2, indent=0.1 * page.width)
