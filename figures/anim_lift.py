"""
Animation: the rectangle of Figure 7 rises onto the hemisphere of Figure 8
==========================================================================

The rectangle is lifted to tangent spheres that shrink from an infinite one, the plane itself, to the sphere whose
diameter is half the diagonal. On the way every lift is an inverse stereographic projection, so the triangulation
never changes.
"""

import numpy as np
from _rectangle import CORNERS, lift, lifted_sides, sites

from stereodel import PlanarDelaunay, Stereographic
from stereodel.drawing import Page, Scene, View
from stereodel.film import Film

VIEW = View(0, -52)
STEPS, HOLD = 30, 10
FLATTEST = 0.04  # curvature of the first sphere, that of the last being 1
EXTENT = (-1.7, 1.7, -0.95, 1.6)


def curvatures() -> np.ndarray:
    """Curvature of the tangent sphere in units of the last one's: up, rest, down."""
    ramp = np.sin(np.linspace(0, np.pi / 2, STEPS)) ** 2
    up = FLATTEST + (1 - FLATTEST) * ramp
    return np.concatenate([up, np.ones(HOLD), up[::-1]])


def frame(curvature: float) -> Page:
    """The lift to one sphere, which touches the plane z = 0 at the origin."""
    radius = lift().sphere.radius / curvature
    sphere = Stereographic((0.0, -90.0), radius=radius)
    points = sites()
    lifted = sphere.inverse(points)
    scene = Scene(radius=radius, center=(0.0, 0.0, radius))
    plane = sphere.in_space(CORNERS) + [0.0, 0.0, radius]
    scene.add_flat_polygon(plane, name="plane")
    scene.add_outline(plane, name="frame")
    scene.add_edges(lifted, PlanarDelaunay(points).edges, name="delaunay")
    scene.add_arcs(lifted_sides(sphere.inverse), name="chord")
    scene.add_points(lifted, name="sites")
    return scene.page(VIEW, extent=EXTENT, width=200.0)


def film() -> Film:
    """One shot for each sphere."""
    return Film(frame, curvatures().tolist(), seconds=0.07, size=480)


if __name__ == "__main__":
    film().main()
