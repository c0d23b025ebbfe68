r"""
Claim P23: only stereographic projections keep the triangulation
================================================================

The same 150 sites, within 60° of a point, under six projections, and the Delaunay triangulation of their images in the
plane. Triangles that are not Delaunay triangles of the sphere are vermilion. The blue curve is the image of one circle
of the sphere. The stereographic projection maps it to a circle, like every other circle, and every triangle of the
plane is one of the sphere. Under each of the other projections some circles do not remain circles, and triangles break.
Preserving angles is not enough: Mercator's projection does so.

Chosen by us: the sites and their seed, the centre of the projections, at which all planes but Mercator's touch, and the
circle.
"""

from collections.abc import Callable

import numpy as np
from _sites import in_cap

from stereodel import Gnomonic, Orthographic, PlanarDelaunay, SphereCircle, SphericalDelaunay, Stereographic
from stereodel.drawing import LineStyle, Page, Polylines, Sketch
from stereodel.drawing.page.style import BLACK, BLUE, GRAY, PRINT_WIDTH, VERMILION, DotStyle, with_opacity
from stereodel.render import Figure
from stereodel.sphere import xyz_to_lonlat

PLACE, REACH = (10.0, 25.0), 60.0  # degrees
SITES, SEED = 150, 24
CIRCLE = SphereCircle.around((36.0, 18.0), 24.0)
COLUMNS, PITCH, DROP, SIDE = 3, 5.75, 6.75, 5.2  # cm
EXTENT = (-2.75, 14.25, -10.6, 2.7)

Projection = Callable[[np.ndarray], np.ndarray]


def azimuthal(distance: Callable[[np.ndarray], np.ndarray]) -> Projection:
    """The azimuthal projection about `PLACE` with a given distance in the plane for each angle from there."""

    def forward(xyz: np.ndarray) -> np.ndarray:
        plane = Stereographic(PLACE).forward(xyz)
        reach = np.linalg.norm(plane, axis=-1, keepdims=True)
        return plane / reach * distance(2 * np.arctan(reach / 2))

    return forward


def mercator(xyz: np.ndarray) -> np.ndarray:
    """Mercator's projection."""
    lon, lat = np.moveaxis(np.radians(xyz_to_lonlat(xyz)), -1, 0)
    return np.stack([lon, np.arctanh(np.sin(lat))], axis=-1)


def conic(xyz: np.ndarray) -> np.ndarray:
    """Lambert's conformal conic projection with the constant ½."""
    lon, lat = np.moveaxis(np.radians(xyz_to_lonlat(xyz)), -1, 0)
    reach = np.sqrt(np.tan(np.pi / 4 - lat / 2))
    return np.stack([reach * np.sin(lon / 2), -reach * np.cos(lon / 2)], axis=-1)


PROJECTIONS: dict[str, Projection] = {
    "stereographic": Stereographic(PLACE).forward,
    "gnomonic": Gnomonic(PLACE).forward,
    "orthographic": Orthographic(PLACE).forward,
    "equidistant": azimuthal(lambda chi: chi),
    "equal-area": azimuthal(lambda chi: 2 * np.sin(chi / 2)),
    "Mercator": mercator,
    "Lambert's conformal conic": conic,
}
"""All that are tried; the last is not drawn."""

DRAWN = tuple(PROJECTIONS)[:6]


def triples(simplices: np.ndarray) -> list[frozenset]:
    """Triangles as sets of their corners."""
    return [frozenset(corners) for corners in simplices.tolist()]


def geometry() -> dict:
    """Of each projection the images of the sites, the triangles, which of them the sphere lacks, and the circle."""
    sites = in_cap(SITES, SEED, PLACE, REACH)
    own = set(triples(SphericalDelaunay(sites).simplices))
    found = {}
    for name in DRAWN:
        images = PROJECTIONS[name](sites)
        triangles = PlanarDelaunay(images).simplices
        center = (images.min(axis=0) + images.max(axis=0)) / 2
        size = SIDE / np.ptp(images, axis=0).max()
        found[f"{name}_sites"] = size * (images - center)
        found[f"{name}_triangles"] = triangles
        found[f"{name}_broken"] = np.array([triangle not in own for triangle in triples(triangles)])
        found[f"{name}_circle"] = size * (PROJECTIONS[name](CIRCLE.sample(720)) - center)
    return found


def draw(g: dict) -> Page:
    """Six panels."""
    sketch = Sketch()
    for number, name in enumerate(DRAWN):
        row, column = divmod(number, COLUMNS)
        add_panel(sketch, g, name, np.array([PITCH * column, -DROP * row]))
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def add_panel(sketch: Sketch, g: dict, name: str, at: np.ndarray) -> None:
    """Triangles, the broken ones tinted, the circle, and how many broke."""
    sites, triangles, broken = at + g[f"{name}_sites"], g[f"{name}_triangles"], g[f"{name}_broken"]
    for corners in triangles[broken]:
        sketch.add_polygon(sites[corners], name="broken", color=with_opacity(VERMILION, 0.4))
    parts = (("kept", ~broken, GRAY, 0.45), ("broken", broken, VERMILION, 0.7))
    for part, chosen, color, width in parts[: 1 + broken.any()]:
        sides = np.sort(triangles[chosen][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        ends = sites[np.unique(sides, axis=0)]
        offsets = 2 * np.arange(len(ends) + 1)
        sketch.add_items([Polylines(ends.reshape(-1, 2), offsets, color, width, part)])
    sketch.add_polyline(at + g[f"{name}_circle"], closed=True, name="arc", style=LineStyle(BLUE, 1.3))
    sketch.add_points(sites, name="sites", style=DotStyle("black", 0.9))
    below = at + [0.0, -2.85]
    sketch.add_label(below, name, (0, -2), valign="top", size=10.0)
    count = int(broken.sum())
    text = f"{count} of {len(triangles)} triangles broken" if count else f"all {len(triangles)} triangles kept"
    sketch.add_label(below, text, (0, -15), valign="top", color=VERMILION if count else BLACK)


FIGURE = Figure("claim_projections", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
