"""Pages of globes: one disc, or several side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from stereodel._arrays import as_count, as_scalar
from stereodel.conformal import MoebiusMap
from stereodel.curves.chart import Chart
from stereodel.curves.view import MapView, StereographicView, View
from stereodel.drawing.page import Item, Label, Page
from stereodel.drawing.page.labels import haloed
from stereodel.drawing.page.placing import MARGIN
from stereodel.drawing.page.style import BLACK, PRINT_WIDTH
from stereodel.globe.layers import FINE
from stereodel.sphere import xyz_to_lonlat


class Drawable(Protocol):
    """Interface of what a panel shows, such as a `Globe`."""

    def items(self, chart: Chart) -> tuple[Item, ...]:
        """The page items of a chart, in painter's order."""


@dataclass(frozen=True, eq=False)
class Panel:
    """One disc of a page.

    Parameters
    ----------
    globe : Globe
    lens : MoebiusMap, optional
    view : View or StereographicView, optional
        By default orthographic from above the focus.
    title : str
        Title above the disc; text between two dollar signs is a formula in matplotlib's mathtext.
    """

    globe: Drawable
    lens: MoebiusMap | None = None
    view: MapView | None = None
    title: str = ""


def hemispheres(lon: float, lat: float = 0.0, *, flat: bool = False) -> tuple[MapView, MapView]:
    """Orthographic views, or `flat` stereographic ones, of the hemisphere about a place in degrees and of the opposite.

    Examples
    --------
    >>> hemispheres(-20.0)
    (View(lon=-20.0, lat=0.0, roll=0.0), View(lon=160.0, lat=0.0, roll=0.0))
    """
    kind: type[View] | type[StereographicView] = StereographicView if flat else View
    return kind(lon, lat), kind(lon + 180.0 if lon <= 0 else lon - 180.0, -lat + 0.0)


def default_view(lens: MoebiusMap) -> View:
    """View from above the image of the focus, or of (0, 0) if nothing is magnified."""
    if lens.magnification == 1:
        return View(0.0, 0.0)
    lon, lat = xyz_to_lonlat(lens(lens.focus))
    return View(float(lon), float(lat))


def panels(
    contents: Sequence[Panel], *, columns: int | None = None, width: float = PRINT_WIDTH, tolerance: float = FINE
) -> Page:
    """Globes side by side, row by row.

    Parameters
    ----------
    contents : sequence of Panel
        At least one.
    columns : int, optional
        Panels in a row; by default all.
    width : float
        Width of the page in points.
    tolerance : float
        Largest deviation of the drawing from the exact image, in points.
    """
    if not contents:
        raise ValueError("contents must have at least one panel")
    across = len(contents) if columns is None else min(as_count(columns, "columns"), len(contents))
    size = as_scalar(width, "width", low=0.0, open_low=True)
    fine = as_scalar(tolerance, "tolerance", low=0.0, open_low=True)
    pitch = 2 * (1 + MARGIN)
    unit = size / (across * pitch)  # points per radius of a disc
    head = 14.0 / unit if any(panel.title for panel in contents) else 0.0  # height of titles with their margin
    rows = -(-len(contents) // across)
    items: list[Item] = []
    views = []
    for number, panel in enumerate(contents):
        row, column = divmod(number, across)
        at = ((column + 0.5) * pitch, (rows - row) * pitch + (rows - row - 1) * head - pitch / 2)
        lens = MoebiusMap.identity() if panel.lens is None else panel.lens
        view = default_view(lens) if panel.view is None else panel.view
        chart = Chart(lens, view, at, 1.0, fine / unit, unit)
        items += panel.globe.items(chart)
        views.append(chart.matrix)
        if panel.title:
            items.append(Label(panel.title, (at[0], at[1] + pitch / 2), (0.0, 3.0), "center", "baseline", color=BLACK))
    extent = (0.0, across * pitch, 0.0, rows * (pitch + head))
    return haloed(Page(extent, tuple(items), width=size, views=tuple(views)))
