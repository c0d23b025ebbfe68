"""
Animation: the rectangle of Figure 7 rises onto the hemisphere of Figure 8
==========================================================================

The rectangle is lifted to tangent spheres that shrink from an infinite one, the plane itself, to the sphere whose
diameter is half the diagonal D, on which it extends halfway around from corner to corner. Every intermediate lift is an
inverse stereographic projection, so the triangulation never changes.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from _film import READING, SIZE, STEP, WIDTH, add_gauge, add_words, moving, nearest, timed, whole
from _rectangle import CORNERS, lift, lifted_sides, sites

from stereodel import PlanarDelaunay, Stereographic
from stereodel.drawing import Page, Scene, Sketch, View
from stereodel.drawing.page import Fill, Item
from stereodel.drawing.page.style import with_opacity
from stereodel.film import Film

VIEW = View(0, -52)
SECONDS = 3.5  # up, and down
HEIGHT, UNIT = 184.0, 51.0  # points: of the page, and of a unit of the map
MIDDLE = (WIDTH / 2, 99.0)  # of the rectangle
SHARES = (0.0, 0.25, 0.5, 1.0)  # curvatures beside the scale, in units of the last one's


def frame(curvature: float) -> Page:
    """The lift to one sphere, which touches the plane z = 0 at the origin, and a scale of curvatures."""
    scenes = [lifted(lift().sphere.radius / curvature)] if curvature else flat()
    items = [item for scene in scenes for item in scene.layout(VIEW, at=MIDDLE, scale=UNIT)]
    sketch = Sketch().add_items(emerging(item, curvature) for item in items)
    end, strength = nearest((0.0, 1.0), curvature, 0.2)
    add_words(
        sketch,
        ("the plane, a sphere without curvature", "a hemisphere, the corners on its equator")[end],
        34.0,
        strength=strength,
    )
    ticks = {place: (radius(place), f"{extent(place):.0f}°") for place in SHARES}
    add_gauge(sketch, curvature, ticks, 25.0, left=40.0, title=("$R$", "$D$ spans"))
    return whole(sketch, HEIGHT)


def flat() -> list[Scene]:
    """The rectangle before it is lifted: what lies on it, and the plane as a sheet before that."""
    on_plane, sheet = Scene(style="none"), Scene(style="none")
    plane, points = (Stereographic((0.0, -90.0)).in_space(xy) + [0.0, 0.0, 1.0] for xy in (CORNERS, sites()))
    on_plane.add_segments(*np.moveaxis(points[PlanarDelaunay(sites()).edges], 1, 0), name="delaunay")
    on_plane.add_outline(plane, name="chord")
    on_plane.add_space_points(points, name="sites")
    sheet.add_flat_polygon(plane, name="plane")
    sheet.add_outline(plane, name="frame")
    return [on_plane, sheet]


def lifted(radius: float) -> Scene:
    """The rectangle on a ball that touches it from above."""
    sphere = Stereographic((0.0, -90.0), radius=radius)
    points = sphere.inverse(sites())
    scene = Scene(radius=radius, center=(0.0, 0.0, radius))
    plane = sphere.in_space(CORNERS) + [0.0, 0.0, radius]
    scene.add_flat_polygon(plane, name="plane")
    scene.add_outline(plane, name="frame")
    scene.add_edges(points, PlanarDelaunay(sites()).edges, name="delaunay")
    scene.add_arcs(lifted_sides(sphere.inverse), name="chord")
    scene.add_points(points, name="sites")
    return scene


def emerging(item: Item, curvature: float) -> Item:
    """The ball as opaque as it is curved, so that it comes out of the paper."""
    if isinstance(item, Fill) and item.name == "ball":
        return replace(item, color=with_opacity(item.color, curvature))
    return item


def radius(curvature: float) -> str:
    """The radius of the sphere as a part of the diagonal."""
    part = round(curvature * lift().diagonal / lift().sphere.radius, 6)
    return rf"$D{'' if part == 1 else f'/{part:g}'}$" if curvature else r"$\infty$"


def extent(curvature: float) -> float:
    """The angle that the diagonal spans on the sphere, degrees."""
    if not curvature:
        return 0.0
    sphere = Stereographic((0.0, -90.0), radius=lift().sphere.radius / curvature)
    return 2 * sphere.angular_radius(float(np.linalg.norm(CORNERS[0])))


def moments() -> Iterator[tuple[float, float]]:
    """Curvatures and their times: from none to that of the last sphere and back."""
    for start, end in ((0.0, 1.0), (1.0, 0.0)):
        yield start, READING
        for share in moving(SECONDS):
            yield start + (end - start) * share, STEP


def film() -> Film:
    """One shot for each sphere."""
    shots, seconds = timed(moments())
    return Film(frame, shots, seconds=seconds, size=SIZE)


if __name__ == "__main__":
    film().main()
