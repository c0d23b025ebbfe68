"""Diagrams as pictures: pages with true curves, which `stereodel.render` writes as SVG and PDF."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt

from stereodel._arrays import as_choice, as_lonlat
from stereodel.io.faces import triangle_faces
from stereodel.io.frames import Mesh, diagram_of, is_spherical, triangulation_of, usual_kind
from stereodel.io.plane import frame_of

MARGIN = 0.02
"""White space around the picture, in terms of its half width."""


def page_of(
    mesh: Mesh, *, what: str | None = None, view: npt.ArrayLike = (0.0, 20.0), extent: npt.ArrayLike | None = None
) -> Any:
    """Ridges or edges with the points: a globe seen from above `view`, (lon, lat), or a rectangle of the plane."""
    kind = as_choice(what or usual_kind(mesh), ("cells", "triangles"), "what")
    return _globe(mesh, kind, view) if is_spherical(mesh) else _plane(mesh, kind, extent)


def _globe(mesh: Mesh, kind: str, view: npt.ArrayLike) -> Any:
    from stereodel.drawing import Page, Scene, View

    scene = Scene()
    if kind == "cells":
        scene.add_arcs(diagram_of(mesh).ridge_arcs(), role="voronoi")
    else:
        triangulation = triangulation_of(mesh)
        edges = triangle_faces(triangulation.simplices[~triangulation.closing])[1]
        scene.add_edges(mesh.points, edges, role="delaunay")
    scene.add_points(mesh.points, role="sites")
    side = 1 + MARGIN
    return Page((-side, side, -side, side), scene.layout(View(*as_lonlat(view, "view").tolist())), width=340.0)


def _plane(mesh: Mesh, kind: str, extent: npt.ArrayLike | None) -> Any:
    from stereodel.drawing import Sketch

    box = frame_of(mesh.points, extent)
    sketch = Sketch()
    if kind == "cells":
        segments, _ = diagram_of(mesh).segments((box.left, box.right, box.bottom, box.top))
        sketch.add_segments(segments, role="voronoi")
    else:
        sketch.add_edges(mesh.points, triangulation_of(mesh).edges, role="delaunay")
    sketch.add_points(mesh.points[box.holds(mesh.points)], role="sites")
    sketch.add_polyline(box.corners(), closed=True, role="frame")
    pad = MARGIN * box.width / 2
    return sketch.page((box.left - pad, box.right + pad, box.bottom - pad, box.top + pad))
