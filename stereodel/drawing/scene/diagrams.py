"""Pages of diagrams and triangulations: a globe, or a rectangle of the plane, with exact curves."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_lonlat
from stereodel._notebook import drawn
from stereodel._spaces import PLANE
from stereodel.constants import MOST_SHOWN_POINTS, UNDECIDED
from stereodel.curves.borders import frame_of
from stereodel.curves.view import View
from stereodel.drawing.page import Page
from stereodel.drawing.scene.scene import Scene
from stereodel.drawing.scene.sketch import Sketch
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from stereodel.triangulation.delaunay import Triangulation
from stereodel.triangulation.diagram import Diagram
from stereodel.triangulation.topology import edges_of

MARGIN = 0.02
"""White space around the picture, in units of its half width."""


def diagram_page(
    mesh: Triangulation | Diagram[Any], *, view: npt.ArrayLike = (0.0, 20.0), bounds: npt.ArrayLike | None = None
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

    Raises
    ------
    ValueError, TypeError
        If a latitude is outside [−90, 90], a rectangle is empty, or `mesh` is of another type.

    Examples
    --------
    >>> from stereodel import SphericalVoronoi
    >>> page = diagram_page(SphericalVoronoi.from_lonlat([[10, 50], [10, -50], [190, 0]]), view=(10, 30))
    >>> page.width
    340.0
    """
    if not isinstance(mesh, Triangulation | Diagram):
        raise TypeError(f"mesh must be a triangulation or a Voronoi diagram of stereodel, not {type(mesh).__name__}")
    given: Any = mesh
    return _plane(given, bounds) if mesh.surface is PLANE else _globe(given, view)


def _globe(mesh: SphericalDelaunay | SphericalVoronoi, view: npt.ArrayLike) -> Page:
    scene = Scene()
    if isinstance(mesh, Diagram):
        chords = np.linalg.norm(np.diff(mesh.vertices[mesh.ridge_vertices], axis=1), axis=-1)
        if ((chords > UNDECIDED) & (chords < 1.9)).all():  # the ends say what arc: nearly always, and six times as fast
            scene.add_edges(mesh.vertices, mesh.ridge_vertices, name="voronoi")
        else:
            scene.add_arcs(mesh.ridge_arcs(), name="voronoi")
    else:
        scene.add_edges(mesh.points, edges_of(mesh.simplices[~mesh.closing]), name="delaunay")
    scene.add_points(mesh.points, name="sites")
    return scene.page(View(*as_lonlat(view, "view").tolist()), width=340.0)


def _plane(mesh: PlanarDelaunay | PlanarVoronoi, bounds: npt.ArrayLike | None) -> Page:
    box = frame_of(mesh.points, bounds)
    sketch = Sketch()
    if isinstance(mesh, Diagram):
        segments, _ = mesh.segments((box.left, box.bottom, box.right, box.top))
        sketch.add_segments(segments, name="voronoi")
    else:
        sketch.add_edges(mesh.points, mesh.edges, name="delaunay")
    low, high = np.array([box.left, box.bottom]), np.array([box.right, box.top])
    inside = ((low < mesh.points) & (mesh.points < high)).all(axis=1)
    sketch.add_points(mesh.points[inside], name="sites")
    sketch.add_polyline(box.corners, closed=True, name="frame")
    pad = MARGIN * (box.right - box.left) / 2
    return sketch.page((box.left - pad, box.right + pad, box.bottom - pad, box.top + pad))


Triangulation._mimes = Diagram._mimes = drawn(diagram_page, MOST_SHOWN_POINTS)  # type: ignore[assignment]
