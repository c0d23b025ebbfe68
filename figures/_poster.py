"""What the pictures of real data share: title, credit, the arrays of a diagram, coastlines."""

from dataclasses import replace

import numpy as np

from stereodel import SphericalVoronoi, data, lonlat_to_xyz
from stereodel.render import ColorScale, Label, Page, Scene
from stereodel.render.style import LineStyle

LATITUDE = "authalic"  # areas of cells are those on the ellipsoid
LEFT, TOP = -1.02, 1.2  # page units, radii of the globe
BAR = (-0.6, -1.17), (1.2, 0.028)
EXTENT = (-1.06, 1.06, -1.36, 1.28)


def diagram_arrays(voronoi: SphericalVoronoi) -> dict:
    """What a scene needs of a diagram."""
    names = ("points", "vertices", "region_indices", "region_offsets")
    return {name: getattr(voronoi, name) for name in names}


def add_cells(scene: Scene, g: dict, colors: np.ndarray) -> None:
    """The cells of `diagram_arrays`."""
    scene.add_cells(g["points"], g["vertices"], g["region_indices"], g["region_offsets"], colors=colors)


def add_coast(scene: Scene, style: LineStyle) -> None:
    """The coastlines of the world."""
    lines = [lonlat_to_xyz(line, latitude=LATITUDE) for line in data.coastlines().lines()]
    scene.add_polylines(lines, role="coast", style=style)


def spaced(number: int) -> str:
    """A number with its thousands apart."""
    return f"{number:,}".replace(",", "\N{NO-BREAK SPACE}")


def poster(items: tuple, title: str, subtitle: str, credit: str, *, ink: tuple, **options: object) -> Page:
    """A page with a title above and a credit below."""
    faint = (*ink[:3], 0.62)
    texts = (
        Label(title, (LEFT, TOP), align="left", valign="baseline", size=17.0, color=ink),
        Label(subtitle, (LEFT, TOP - 0.07), align="left", valign="baseline", size=8.5, color=ink),
        Label(credit, (LEFT, EXTENT[2] + 0.025), align="left", valign="baseline", size=6.0, color=faint),
    )
    return Page(EXTENT, (*items, *texts), **options)


def captioned(page: Page, title: str, subtitle: str, credit: str, *, ink: tuple, above: float, below: float) -> Page:
    """A page of globes with a title above and a credit below, in strips of so many points."""
    left, right, bottom, top = page.extent
    point = (right - left) / page.width
    edge, faint = left + 10 * point, (*ink[:3], 0.62)
    texts = (
        Label(title, (edge, top + (above - 24) * point), align="left", valign="baseline", size=17.0, color=ink),
        Label(subtitle, (edge, top + (above - 38) * point), align="left", valign="baseline", size=8.5, color=ink),
        Label(credit, (edge, bottom - (below - 7) * point), align="left", valign="baseline", size=6.0, color=faint),
    )
    extent = (left, right, bottom - below * point, top + above * point)
    return replace(page, extent=extent, items=(*page.items, *texts))


def legend(scale: ColorScale, ticks: dict, title: str, ink: tuple) -> tuple:
    """The bar below the globe."""
    return scale.legend(*BAR, ticks, title=title, ink=ink, type_size=8.0)
