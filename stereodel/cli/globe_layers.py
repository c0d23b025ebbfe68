"""What is on the globe that `stereodel globe` draws, layer upon layer."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from stereodel import SphericalDelaunay, SphericalVoronoi
from stereodel.cli.options import Latitude, box_of
from stereodel.cli.sources import Table, naming
from stereodel.data import blue_marble
from stereodel.drawing.style import DOTS, LINES
from stereodel.globe import Globe, Raster

CROWDED = 500  # points from which on lines and dots are drawn finer, so that what they bound can still be seen
FINEST = 0.2  # of the usual widths
OWN_TEXTURE = "blue-marble"


@dataclass(frozen=True)
class Features:
    """Which maps of the Earth are drawn."""

    land: bool | None
    """Unless there is a texture, when None."""
    coastlines: bool
    borders: bool
    rivers: bool
    lakes: bool
    graticule: float | None
    """Degrees; 0 for none, None for what suits the picture."""
    resolution: str


def texture_of(name: str | None, box: str | None, latitude: Latitude) -> Raster | None:
    """The picture that options ask for, with rows of a kind of latitude."""
    if name is None:
        if box is not None:
            raise ValueError("--texture-box is for a --texture")
        return None
    if name == OWN_TEXTURE:
        return Raster(blue_marble(), latitude=latitude.value)
    bounds = None if box is None else box_of(box, "--texture-box")
    return Raster.open(name, bounds=bounds, latitude=latitude.value)


def new_globe(features: Features, latitude: Latitude, texture: Raster | None) -> Globe:
    """A globe with maps of the Earth, from the ground up."""
    globe = Globe(latitude=latitude.value)
    if texture is not None:
        globe.add_raster(texture)
    if features.land or (features.land is None and texture is None):
        globe.add_land(resolution=features.resolution)
    if features.lakes:
        globe.add_lakes(resolution=features.resolution)
    if features.graticule != 0:
        globe.add_graticule(features.graticule)
    if features.rivers:
        globe.add_rivers(resolution=features.resolution)
    if features.coastlines:
        globe.add_coastlines(resolution=features.resolution)
    if features.borders:
        globe.add_borders(resolution=features.resolution)
    return globe


def add_files(globe: Globe, files: Iterable[Path]) -> None:
    """Draw what is in files; what is wrong in one is said with its name."""
    for path in files:
        with naming(str(path)):
            globe.add_layer(path)


def add_points(globe: Globe, table: Table, shown: frozenset[str]) -> None:
    """Draw points, with the ridges of their cells and the edges of their triangles."""
    places = table.points(Latitude(globe.latitude))
    weight = max(FINEST, min(1.0, float(np.sqrt(CROWDED / max(1, len(places))))))
    triangulation = SphericalDelaunay(places)
    if "triangles" in shown:
        globe.add_triangulation(triangulation, style=LINES["delaunay"].scaled(weight), name="delaunay")
    if "cells" in shown:
        globe.add_cells(SphericalVoronoi(triangulation), style=LINES["voronoi"].scaled(weight), name="voronoi")
    if "points" in shown:
        globe.add_points(table.places, style=DOTS["sites"].scaled(weight), name="sites")
