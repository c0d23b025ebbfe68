"""Pages of diagrams and triangulations: a globe, or a rectangle of the plane, with exact curves."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, as_lonlat
from stereodel._notebook import drawn
from stereodel._spaces import PLANE
from stereodel.constants import MOST_SHOWN_POINTS, UNDECIDED
from stereodel.curves.borders import frame_of
from stereodel.curves.view import View
from stereodel.drawing.page import Page
from stereodel.drawing.page.style import DOTS
from stereodel.drawing.scene.by_value import DotLooks
from stereodel.drawing.scene.legend import with_legend
from stereodel.drawing.scene.scene import Scene
from stereodel.drawing.scene.sketch import Sketch
from stereodel.sphere.vectors import units
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from stereodel.triangulation.delaunay import Triangulation
from stereodel.triangulation.diagram import Diagram
from stereodel.triangulation.topology import edges_of


def diagram_page(
    mesh: Triangulation | Diagram[Any],
    *,
    view: npt.ArrayLike = (0.0, 20.0),
    bounds: npt.ArrayLike | None = None,
    **looks: Any,
) -> Page:
    """The ridges of a diagram, or the edges of a triangulation, with the points.

    Parameters
    ----------
    mesh : SphericalVoronoi, SphericalDelaunay, PlanarVoronoi or PlanarDelaunay
    view : array_like, shape (2,)
        (lon, lat) in degrees of the centre of the view. Sphere only.
    bounds : (4,) array_like, optional
        (xmin, ymin, xmax, ymax) of the part of the plane to show; by default the bounding box of the points, extended
        on all sides by a tenth of its longer side.
    **looks
        How the points look, all alike or by value: `size`, `color`, `values`, `scale`, `legend`, `size_scale` and
        `size_legend` as for `stereodel.globe.Globe.add_points`. Then there is a legend below.

    Examples
    --------
    >>> from stereodel import SphericalVoronoi
    >>> page = diagram_page(SphericalVoronoi.from_lonlat([[10, 50], [10, -50], [190, 0]]), view=(10, 30))
    >>> page.width
    340.0
    """
    if not isinstance(mesh, Triangulation | Diagram):
        raise TypeError(f"mesh must be a triangulation or a Voronoi diagram of stereodel, not {type(mesh).__name__}")
    dots = DotLooks.of(len(mesh.points), DOTS["sites"], **looks)
    given: Any = mesh
    page, centers, seen = _plane(given, bounds) if mesh.surface is PLANE else _globe(given, view)
    shown = dots.items(centers, np.flatnonzero(seen), 1 / page.points_per_unit, "sites")
    page = replace(page, items=(*page.items, *shown))
    return with_legend(page, dots.entries) if dots.entries else page


Shown = tuple[Page, FloatArray, BoolArray]
"""A page without the points, where they are on it, and which of them are seen."""


def _globe(mesh: SphericalDelaunay | SphericalVoronoi, view: npt.ArrayLike) -> Shown:
    scene = Scene()
    if isinstance(mesh, Diagram):
        chords = np.linalg.norm(np.diff(mesh.vertices[mesh.ridge_vertices], axis=1), axis=-1)
        if ((chords > UNDECIDED) & (chords < 1.9)).all():  # the ends say what arc: nearly always, and six times as fast
            scene.add_edges(mesh.vertices, mesh.ridge_vertices, name="voronoi")
        else:
            scene.add_arcs(mesh.ridge_arcs(), name="voronoi")
    else:
        scene.add_edges(mesh.points, edges_of(mesh.simplices[~mesh.closing]), name="delaunay")
    seen, sites = View(*as_lonlat(view, "view").tolist()), units(mesh.points)
    return scene.page(seen, width=340.0), seen.project(sites), seen.depth(sites) > 0


def _plane(mesh: PlanarDelaunay | PlanarVoronoi, bounds: npt.ArrayLike | None) -> Shown:
    box = frame_of(mesh.points, bounds)
    sketch = Sketch()
    if isinstance(mesh, Diagram):
        segments, _ = mesh.segments((box.left, box.bottom, box.right, box.top))
        sketch.add_segments(segments, name="voronoi")
    else:
        sketch.add_edges(mesh.points, mesh.edges, name="delaunay")
    low, high = np.array([box.left, box.bottom]), np.array([box.right, box.top])
    inside = ((low < mesh.points) & (mesh.points < high)).all(axis=1)
    sketch.add_polyline(box.corners, closed=True, name="frame")
    pad = 0.01 * (box.right - box.left)
    page = sketch.page((box.left - pad, box.right + pad, box.bottom - pad, box.top + pad))
    return page, mesh.points, np.asarray(inside)


Triangulation._mimes = Diagram._mimes = drawn(diagram_page, MOST_SHOWN_POINTS)  # type: ignore[assignment]
