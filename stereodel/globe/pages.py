"""Pages of globes: one disc, or several side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from stereodel._arrays import as_count, as_scalar
from stereodel.conformal import MoebiusMap
from stereodel.drawing.fonts import FontLike, as_font, in_font
from stereodel.drawing.label import with_room
from stereodel.drawing.page import Item, Label, Page
from stereodel.drawing.style import BLACK, PRINT_WIDTH
from stereodel.drawing.view import MapView, StereographicView, View
from stereodel.globe.chart import Chart
from stereodel.sphere import xyz_to_lonlat

MARGIN = 0.03
"""Round a disc, in its radii."""

TITLE_HEIGHT = 14.0
"""Of type above a panel, with its margin, points."""


class Drawable(Protocol):
    """What a panel shows: a `Globe`."""

    def items(self, chart: Chart) -> tuple[Item, ...]:
        """What a chart shows, in painter's order."""


@dataclass(frozen=True, eq=False)
class Panel:
    """One disc of a page.

    Parameters
    ----------
    globe : Globe
    lens : MoebiusMap, optional
    view : View or StereographicView, optional
        By default from above the focus.
    title : str
        Written above the disc; what stands between two dollar signs is a formula of matplotlib's mathtext.
    """

    globe: Drawable
    lens: MoebiusMap | None = None
    view: MapView | None = None
    title: str = ""


def hemispheres(lon: float, lat: float = 0.0, *, flat: bool = False) -> tuple[MapView, MapView]:
    """The views of the hemisphere about a point, degrees, and of the other one, to be set side by side.

    Parameters
    ----------
    lon, lat : float
    flat : bool
        Stereographic, not orthographic.

    Examples
    --------
    >>> hemispheres(-20.0)
    (View(lon=-20.0, lat=0.0, roll=0.0), View(lon=160.0, lat=0.0, roll=0.0))
    """
    kind: type[View] | type[StereographicView] = StereographicView if flat else View
    return kind(lon, lat), kind(lon + 180.0 if lon <= 0 else lon - 180.0, -lat + 0.0)


def default_view(lens: MoebiusMap) -> View:
    """From above the image of the focus, or of (0, 0) where nothing is magnified."""
    if lens.magnification == 1:
        return View(0.0, 0.0)
    lon, lat = xyz_to_lonlat(lens(lens.focus))
    return View(float(lon), float(lat))


def panels(
    contents: Sequence[Panel],
    *,
    columns: int | None = None,
    width: float = PRINT_WIDTH,
    tolerance: float = 0.02,
    font: FontLike | None = None,
) -> Page:
    """Globes side by side, row by row.

    Parameters
    ----------
    contents : sequence of Panel
    columns : int, optional
        By default all in one row.
    width : float
        Of the page in points.
    tolerance : float
        How far what is drawn may be from what it stands for, in points.
    font : str, path-like, or sequence of them, optional
        Of titles, and of labels of globes that have none of their own; see `stereodel.drawing.fonts.as_font`.

    Raises
    ------
    FileNotFoundError
        For the file of a font that is not there.
    ValueError
        For no panels, a width or tolerance that is not positive, or fonts that the machine does not have.
    """
    if not contents:
        raise ValueError("contents must have a panel or more")
    across = len(contents) if columns is None else min(as_count(columns, "columns"), len(contents))
    size = as_scalar(width, "width", low=0.0, open_low=True)
    fine = as_scalar(tolerance, "tolerance", low=0.0, open_low=True)
    pitch = 2 * (1 + MARGIN)
    unit = size / (across * pitch)  # points for a radius of a disc
    head = TITLE_HEIGHT / unit if any(panel.title for panel in contents) else 0.0
    rows = -(-len(contents) // across)
    items: list[Item] = []
    views = []
    for number, panel in enumerate(contents):
        row, column = divmod(number, across)
        at = ((column + 0.5) * pitch, (rows - row) * pitch + (rows - row - 1) * head - pitch / 2)
        lens = MoebiusMap.identity() if panel.lens is None else panel.lens
        view = default_view(lens) if panel.view is None else panel.view
        around = (at[0] - pitch / 2, at[0] + pitch / 2, at[1] - pitch / 2, at[1] + pitch / 2)
        items += with_room(panel.globe.items(Chart(lens, view, at, 1.0, fine / unit, unit)), around, unit)
        views.append(view.matrix)
        if panel.title:
            items.append(Label(panel.title, (at[0], at[1] + pitch / 2), (0.0, 3.0), "center", "baseline", color=BLACK))
    extent = (0.0, across * pitch, 0.0, rows * (pitch + head))
    return in_font(Page(extent, tuple(items), width=size, views=tuple(views)), as_font(font))
