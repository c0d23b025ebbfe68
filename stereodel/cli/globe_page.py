"""The picture of `stereodel globe`: points on a ball, with their cells or triangles, through a fisheye if wanted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from stereodel import MoebiusMap, SphericalDelaunay, SphericalVoronoi, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel._arrays import FloatArray
from stereodel.cli.globe_arcs import Arcs, edges_of, ridges_of
from stereodel.cli.options import Latitude
from stereodel.render import Page, Scene, View
from stereodel.render.style import BLUE, DOTS, LINES, LineStyle
from stereodel.sphere import graticule

COAST = LineStyle(BLUE, 0.5)
EXTENT = (-1.02, 1.02, -1.02, 1.02)  # globe radii
CROWDED = 500  # points from which on lines and dots are drawn finer, so that what they bound can still be seen
FINEST = 0.2  # of the usual widths


@dataclass(frozen=True)
class GlobePicture:
    """What is drawn: points (n, 3) as unit vectors, what of them, from above which point, through which lens."""

    points: FloatArray
    shown: frozenset[str]
    view: View
    lens: MoebiusMap
    coast: Sequence[FloatArray] = ()

    def page(self) -> Page:
        """The picture, ready to be written as pixels or paths."""
        scene = Scene()
        weight = max(FINEST, min(1.0, float(np.sqrt(CROWDED / max(1, len(self.points))))))
        scene.add_arcs([self.lens.image_of(arc) for arc in graticule(15.0)], role="graticule")
        scene.add_polylines([self.lens(line) for line in self.coast], role="coast", style=COAST)
        triangulation = SphericalDelaunay(self.points)
        if "triangles" in self.shown:
            self._add(scene, edges_of(self.points, triangulation.edges), "delaunay", weight)
        if "cells" in self.shown:
            self._add(scene, ridges_of(SphericalVoronoi(triangulation)), "voronoi", weight)
        if "points" in self.shown:
            scene.add_points(self.lens(self.points), role="sites", style=DOTS["sites"].scaled(weight))
        return Page(EXTENT, scene.layout(self.view), views=(self.view.matrix,))

    def _add(self, scene: Scene, arcs: Arcs, role: str, weight: float) -> None:
        seen = arcs.through(self.lens).facing(self.view.matrix[2])
        scene.add_arcs(seen.curves(), role=role, style=LINES[role].scaled(weight))


def shores(latitude: Latitude) -> list[FloatArray]:
    """The coastlines of the Earth as unit vectors, (k, 3) each."""
    from stereodel.data import coastlines

    lines = coastlines()
    return np.split(lonlat_to_xyz(lines.lonlat, latitude=latitude.value), lines.offsets[1:-1])


def middle_of(points: FloatArray) -> tuple[float, float]:
    """Longitude and latitude of the mean of unit vectors (n, 3); (0, 0) if they have none."""
    mean = points.sum(axis=0)
    # Sums of n unit vectors are rounded by less than n² / 2 roundoffs; what is below means nothing.
    if np.sqrt(np.sum(mean**2)) <= 1e-9 * len(points):
        return (0.0, 0.0)
    lon, lat = xyz_to_lonlat(mean)
    return (float(lon), float(lat))


def lens_at(focus: tuple[float, float], magnification: float) -> MoebiusMap:
    """The fisheye of a focus, the identity for magnification 1."""
    return MoebiusMap.identity() if magnification == 1.0 else fisheye(focus, magnification=magnification)
