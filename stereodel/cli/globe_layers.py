"""Layers of the globe that `stereodel globe` draws."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stereodel import SphericalDelaunay, SphericalVoronoi
from stereodel.cli.options import Latitude, box_of, refuse
from stereodel.data import blue_marble
from stereodel.drawing.colors import as_color
from stereodel.drawing.fonts import as_font
from stereodel.drawing.lengths import as_length
from stereodel.drawing.style import DOTS, LINES, MAP_DOT, MAP_LINES, DotStyle, LineStyle
from stereodel.globe import Globe, Raster
from stereodel.io import PointTable
from stereodel.io.reading import naming

CROWDED = 500  # number of points above which lines and dots become finer, so that cells stay visible
FINEST = 0.2  # smallest factor for the usual widths
OWN_TEXTURE = "blue-marble"
LAYER_KEYS = ("color", "width", "outline", "size", "column")  # of --layer FILE,key=…


@dataclass(frozen=True)
class Features:
    """Maps of the Earth to draw."""

    land: bool | None
    """Whether to fill the land; None fills it unless there is a texture."""
    coastlines: bool
    borders: bool
    rivers: bool
    lakes: bool
    graticule: float | None
    """Spacing in degrees; 0 for no graticule, None for a spacing that suits the picture."""
    resolution: str


def texture_of(name: str | None, box: str | None, latitude: Latitude) -> Raster | None:
    """The image given by options, with rows in a kind of latitude."""
    if name is None:
        refuse({"--texture-box": box}, "a --texture, and there is none")
        return None
    if name == OWN_TEXTURE:
        refuse({"--texture-box": box}, f"files of a part of the Earth; {OWN_TEXTURE} shows all of it")
        return Raster(blue_marble(), latitude=latitude.value)
    bounds = None if box is None else box_of(box, "--texture-box")
    return Raster.open(name, bounds=bounds, latitude=latitude.value)


def new_globe(
    features: Features,
    latitude: Latitude,
    texture: Raster | None,
    title: str = "",
    font: Sequence[str] | None = None,
) -> Globe:
    """A globe with maps of the Earth, drawn from the bottom layer up."""
    globe = Globe(latitude=latitude.value, font=as_font(font, "--font"), title=title)
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


@dataclass(frozen=True)
class LayerChoice:
    """A file to draw and its style, as given by `--layer`: ``FILE,color=…,width=…``."""

    path: Path
    looks: Mapping[str, str]

    @classmethod
    def of(cls, text: str) -> LayerChoice:
        """Parse an option; an existing file whose name contains commas and equals signs is taken literally."""
        if Path(text).exists():
            return cls(Path(text), {})
        path, *given = re.split(r",(?=\w+=)", text)
        looks = dict(part.split("=", 1) for part in given)
        for key in looks:
            if key not in LAYER_KEYS:
                raise ValueError(f"--layer {text}: {key} is unknown; the keys are {', '.join(LAYER_KEYS)}")
        return cls(Path(path), looks)

    def arguments(self) -> dict[str, Any]:
        """Arguments for `Globe.add_layer`."""
        looks, line, rim = self.looks, MAP_LINES["line"], MAP_LINES["outline"]
        color = as_color(looks["color"], "--layer: color") if "color" in looks else None
        width = as_length(looks["width"], "--layer: width") if "width" in looks else None
        edge = as_color(looks["outline"], "--layer: outline") if looks.get("outline", "none") != "none" else rim.color
        outline = None if looks.get("outline") == "none" else LineStyle(edge, rim.width if width is None else width)
        radius = as_length(looks["size"], "--layer: size") / 2 if "size" in looks else MAP_DOT.radius
        found = {
            "outline": outline,
            "style": LineStyle(color or line.color, line.width if width is None else width),
            "dot_style": DotStyle(color or MAP_DOT.color, radius, MAP_DOT.rim, min(MAP_DOT.rim_width, radius / 3)),
            "column": looks.get("column"),
            "legend": self.path.stem,
        }
        return found if color is None else found | {"color": color}


def add_files(globe: Globe, layers: Iterable[LayerChoice]) -> None:
    """Draw the contents of files; errors name the file."""
    for layer in layers:
        with naming(str(layer.path)):
            globe.add_layer(layer.path, **layer.arguments())


@dataclass(frozen=True)
class PointLooks:
    """How points are drawn."""

    shown: frozenset[str]
    labels: str | None = None
    rank: str | None = None
    color: str | None = None
    size: str | None = None

    def __post_init__(self) -> None:
        if self.labels is None:
            refuse({"--rank": self.rank}, "--labels, and there are none")

    def dots(self, weight: float) -> DotStyle:
        """The style of dots, finer where there are many."""
        usual = DOTS["sites"].scaled(weight)
        radius = usual.radius if self.size is None else as_length(self.size, "--point-size") / 2
        color = usual.color if self.color is None else as_color(self.color, "--color")
        return DotStyle(color, radius, usual.rim, radius * usual.rim_width / usual.radius)


def add_points(globe: Globe, table: PointTable, looks: PointLooks) -> None:
    """Draw points, the ridges of their cells, the edges of their triangles, and labels."""
    places = table.points(globe.latitude)
    weight = max(FINEST, min(1.0, float(np.sqrt(CROWDED / max(1, len(places))))))
    triangulation = SphericalDelaunay(places)
    if "triangles" in looks.shown:
        globe.add_triangulation(triangulation, style=LINES["delaunay"].scaled(weight), name="delaunay")
        globe.legend["triangles"] = LINES["delaunay"].scaled(weight)
    if "cells" in looks.shown:
        globe.add_cells(SphericalVoronoi(triangulation), style=LINES["voronoi"].scaled(weight), name="voronoi")
        globe.legend["cells"] = LINES["voronoi"].scaled(weight)
    if "points" in looks.shown:
        style = looks.dots(weight)
        globe.add_points(table.places, style=style, name="sites")
        globe.legend[Path(table.name).stem] = style
    if looks.labels is not None:
        column = table.column(looks.labels)
        texts = ["" if value is None else str(value).strip() for value in column.tolist()]
        named = np.array([text not in ("", "nan") for text in texts], dtype=np.bool_)
        rank = None if looks.rank is None else table.numbers(looks.rank)[named]
        names = [text for text in texts if text not in ("", "nan")]
        globe.add_labels(table.places[named], names, rank=rank, movable=True)
