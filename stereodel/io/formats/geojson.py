"""GeoJSON as specified by RFC 7946, and with the member ``crs`` of before; read without any library."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from numbers import Real
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import Column, FloatArray, as_count
from stereodel._tasks.progress import Progress
from stereodel.constants import EMPTY_RATIO, FEW_CELLS
from stereodel.io.formats import Content, FileFormat, Wanted, wkb
from stereodel.io.formats.columns import check_held, column, decoded, objects, plain_cells
from stereodel.io.formats.foreign import check_crs
from stereodel.io.formats.map_rows import MapRows, no_point, packed
from stereodel.io.formats.names import beside, listed, note

HEAD: Final = '{"type":"FeatureCollection","features":['
TAIL: Final = "]}"

# Types of geometries with coordinates; a LinearRing is a closed line of Shapely.
KINDS: Final = ("Point", "MultiPoint", "LineString", "LinearRing", "MultiLineString", "Polygon", "MultiPolygon")

# Members and types of GeoJSON that rows of a table have not.
FEATURE: Final = {"geometry", "properties", "coordinates", "Feature", "GeometryCollection", *KINDS}


class Features(Content):
    """Features that were read: properties and geometry of each, and the coordinate system, None for degrees."""

    def __init__(self, properties: list[Mapping[str, Any]], geometries: list[Any], crs: str | None) -> None:
        super().__init__({})
        self.properties, self.geometries, self.crs = properties, geometries, crs

    @classmethod
    def of(cls, *contents: Any) -> Features:
        """The features of GeoJSON objects: collections, features or geometries; ValueError names the row."""
        rows: list[Any] = []
        systems: set[str | None] = set()
        for content in contents:
            rows += _rows_of(content)
            systems |= _systems_of(content)
        if len(systems) > 1:
            names = ", ".join(sorted(name or "degrees" for name in systems))
            raise ValueError(f"there are several coordinate systems, {names}; give features of one")
        crs = systems.pop() if systems else None
        return cls([row.get("properties") or {} for row in rows], [row.get("geometry") for row in rows], crs)

    def columns(self) -> dict[str, Column]:
        """The properties as columns, None where a feature lacks one; see `read_points` for those that few have."""
        counts, rows = Counter(chain.from_iterable(self.properties)), len(self.properties)
        if rows * len(counts) <= max(FEW_CELLS, EMPTY_RATIO * counts.total()):
            return {name: column(each.get(name) for each in self.properties) for name in counts}
        common = {name: None for name, count in counts.items() if EMPTY_RATIO * count >= rows}
        others = [{name: each[name] for name in each if name not in common} or None for each in self.properties]
        result = {name: column(each.get(name) for each in self.properties) for name in common}
        added = beside(common, {"others": objects(others)})
        said = f"{len(counts) - len(common)} of {len(counts)} properties are together in the column {listed([*added])}"
        note(f"{said}, as few features have any of them")
        return result | added

    def places(self, *, skip_missing: bool) -> tuple[Column, Column]:
        """Both coordinates of features that are points, None for an empty one and, with `skip_missing`, for null."""
        places = [_place(geometry, row, skip_missing) for row, geometry in enumerate(self.geometries, 1)]
        return column(place[0] for place in places), column(place[1] for place in places)

    def parts(self) -> Iterator[tuple[int, str, list[FloatArray]]]:
        """Points, lines and polygons: number of the feature, kind of geometry, and positions, those of rings closed."""
        for number, geometry in enumerate(self.geometries):
            where = f"row {number + 1}"
            for kind, part in _parts(geometry, where):
                if kind.endswith("Polygon"):
                    yield number, kind, [_closed(_positions(ring, kind, where), kind, where) for ring in part]
                else:
                    yield number, kind, [_positions(part, kind, where)]


def parsed(text: str) -> Any:
    """A JSON document; a sequence of features (RFC 8142, or one per line), or of rows, becomes a collection."""
    try:
        return json.loads(text)
    except RecursionError:
        raise ValueError("the file is not a table: its JSON is nested too deeply") from None
    except json.JSONDecodeError as error:
        lines = [line.strip("\x1e \t\r") for line in text.split("\n")]
        with suppress(json.JSONDecodeError, RecursionError):
            if lines[0].endswith("}"):
                return {"features": [json.loads(line) for line in lines if line]}
        raise ValueError(f"the file is not JSON: {error}") from error


def read(file: Any, wanted: Wanted) -> Content:
    """The features of GeoJSON, or the columns of rows of JSON that have neither geometry nor properties."""
    found = parsed(decoded(file.content, wanted.encoding)[0])
    rows = found.get("features", [found] * ("type" not in found)) if isinstance(found, dict) else found
    plain = (isinstance(row, dict) and FEATURE.isdisjoint([*row, str(row.get("type"))]) for row in rows or ())
    if isinstance(rows, list) and rows and all(plain):
        return Content(Features(rows, [], None).columns())
    return Features.of(found)


FORMAT = FileFormat(
    (".geojson", ".json", ".jsonl", ".ndjson", ".geojsonl", ".geojsons"),
    {b"{": ".geojson", b"\x1e{": ".geojson", b"[{": ".geojson"},
    read,
)


def _kind_of(content: Any) -> Any:
    """The member ``type`` of a GeoJSON object; None for what is none."""
    return content.get("type") if isinstance(content, Mapping) else None


def _rows_of(content: Any) -> Sequence[Any]:
    """The features of a GeoJSON object: a collection, a feature or a geometry."""
    kind = _kind_of(content)
    rows: Any = [content if kind == "Feature" else {"geometry": content}]
    if isinstance(content, Mapping) and (kind == "FeatureCollection" or (kind is None and "features" in content)):
        rows = content.get("features")
    elif kind not in (*KINDS, "GeometryCollection", "Feature"):
        raise ValueError(f"this is not GeoJSON: its type is {kind!r}, neither feature nor geometry; see RFC 7946")
    if not isinstance(rows, list | tuple):
        raise ValueError("this is a FeatureCollection without a list of features")
    for row, feature in enumerate(rows, 1):
        known = isinstance(feature, Mapping) and feature.get("type", "Feature") == "Feature"
        if not known or not isinstance(feature.get("properties") or {}, Mapping):
            raise ValueError(f"row {row}: is not a GeoJSON Feature with properties by name; see RFC 7946")
    return rows


def _systems_of(thing: Mapping[str, Any], around: str | None = None) -> set[str | None]:
    """Coordinate systems in an object: what is inside has that of the object, unless it names its own."""
    system = _system(thing, around)
    inside = next((thing[name] for name in ("features", "geometries") if name in thing), (thing.get("geometry"),))
    parts = inside if isinstance(inside, list | tuple) else ()
    return set().union(*(_systems_of(part, system) for part in parts if isinstance(part, Mapping))) or {system}


def _system(thing: Mapping[str, Any], around: str | None) -> str | None:
    """The coordinate system that an object names, as GeoJSON had it before RFC 7946; None for degrees."""
    crs = thing.get("crs")
    if crs is None:
        return around
    name = (crs.get("properties") or {}).get("name") if isinstance(crs, Mapping) else None
    if not isinstance(name, str):
        raise ValueError(f"the member crs of the file is {crs!r}, which names no coordinate system")
    check_crs(name)
    return None if name.upper().endswith(("CRS84", "EPSG::4326", "EPSG:4326")) else name


def _place(geometry: Any, row: int, skip_missing: bool) -> tuple[Any, Any]:
    if geometry is None and skip_missing:
        return None, None
    given = geometry if isinstance(geometry, dict) else {"type": "no geometry"}
    kind, coordinates = given.get("type"), given.get("coordinates")
    if kind == "MultiPoint" and isinstance(coordinates, list) and len(coordinates) == 1:
        kind, coordinates = "Point", coordinates[0]
    if kind != "Point":
        raise no_point(row, kind)
    if not coordinates:
        return None, None
    if not isinstance(coordinates, list) or len(coordinates) < 2 or str in map(type, coordinates[:2]):
        raise ValueError(f"row {row}: a Point has two or three coordinates, not {coordinates!r}")
    return coordinates[0], coordinates[1]


def _parts(geometry: Any, where: str) -> Iterator[tuple[str, Any]]:
    """Kind and coordinates of the points, lines and polygons of a geometry; a null or empty one has none."""
    if geometry is None:
        return
    kind = _kind_of(geometry)
    if kind == "GeometryCollection":
        for part in _listed(geometry.get("geometries") or (), kind, where):
            yield from _parts(part, where)
        return
    if kind not in KINDS:
        raise ValueError(f"{where}: has a geometry of type {kind!r}; known are {', '.join(KINDS)}")
    coordinates = geometry.get("coordinates")
    if coordinates is None:
        raise ValueError(f"{where}: has a {kind} without coordinates")
    coordinates = _listed(coordinates, kind, where)
    if kind == "Point":
        coordinates = [coordinates] if len(coordinates) else []
    for part in coordinates if kind in ("MultiLineString", "MultiPolygon") else [coordinates]:
        if len(_listed(part, kind, where)):
            yield kind, part


def _listed(value: Any, kind: str, where: str) -> Any:
    """The same, a sequence of any kind; ValueError for what has no order."""
    if hasattr(value, "__len__") and not isinstance(value, Mapping | str):
        return value
    inside = "geometries" if kind == "GeometryCollection" else "coordinates"
    raise ValueError(f"{where}: has a {kind} whose {inside} are {value!r:.40}, which is no list; see RFC 7946")


def _positions(positions: Any, kind: str, where: str) -> FloatArray:
    """Positions (n, 2), without heights; text is none."""
    try:
        pairs = [(position[0], position[1]) for position in positions]
        kinds = set(map(type, chain.from_iterable(pairs)))
        if all(issubclass(kind, Real) and not issubclass(kind, bool) for kind in kinds):
            return np.array(pairs, dtype=np.float64).reshape(-1, 2)
    except (TypeError, IndexError, KeyError, OverflowError):
        pass
    raise ValueError(f"{where}: has a {kind} whose positions are not two or three numbers each")


def _closed(ring: FloatArray, kind: str, where: str) -> FloatArray:
    """A ring closed by its first point, which is added if it is missing."""
    closed = ring if len(ring) > 1 and (ring[0] == ring[-1]).all() else np.concatenate([ring, ring[:1]])
    if len(closed) < 4:
        raise ValueError(f"{where}: has a {kind} with a ring of {max(0, len(closed) - 1)} points; a ring needs three")
    return closed


def to_geojson(frame: Any, *, decimals: int | None = None, sequence: bool = False) -> str:
    """A GeoDataFrame as the text of a GeoJSON FeatureCollection.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame
        From `to_geodataframe` or elsewhere. Coordinates in a system other than EPSG:4326 are transformed; without a
        coordinate system they are written unchanged.
    decimals : int, optional
        Number of decimals to which coordinates are rounded; 7 correspond to a centimetre. By default as many as needed
        to read the same doubles back. Neighbours that share points still share them, but narrow polygons may become
        invalid.
    sequence : bool
        Write one feature per line, as programs for large data expect, instead of a FeatureCollection.

    Returns
    -------
    str
        Outer rings are counterclockwise, non-finite properties (NaN, infinity), also those in lists and mappings, are
        null, and there is no member ``crs``. Polygons of `to_geodataframe` are already cut at ±180°.

    Notes
    -----
    Source: H. Butler and others, "The GeoJSON Format", RFC 7946 (2016), sections 3.1.6, 3.1.9, 4 and 11.2.

    Examples
    --------
    >>> from stereodel import SphericalDelaunay
    >>> from stereodel.io import to_geodataframe
    >>> sites = to_geodataframe(SphericalDelaunay.from_lonlat([[10.0, 48.4]]), what="sites")
    >>> print(to_geojson(sites, decimals=3))
    {"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"point":0},"geometry":{"type":"Point","coordinates":[10.0,48.4]}}
    ]}
    """
    columns = {name: frame[name] for name in frame.columns if name != frame.geometry.name}
    found = list(features(MapRows(columns, packed(np.asarray(frame.geometry)), frame.crs), decimals))
    return "\n".join(found) if sequence else "\n".join([HEAD, ",\n".join(found), TAIL])


def write_geojson(layer: MapRows, path: Path, *, decimals: int | None = None, progress: Progress | None = None) -> None:
    """Write the rows of a map in the format of `to_geojson`, block by block; a sequence if the path says so."""
    check_held(layer.columns, path.suffix[1:])
    sequence = path.suffix == ".geojsonl"
    between = "\n" if sequence else ",\n"
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write("" if sequence else HEAD)
        for number, block in enumerate(layer.blocks(progress)):
            file.write(between if number else "" if sequence else "\n")
            file.write(between.join(features(block, decimals)))
        file.write("\n" if sequence else f"\n{TAIL}\n")


def features(layer: MapRows, decimals: int | None) -> Iterator[str]:
    """The rows of a map as GeoJSON features, one line each."""
    if layer.crs is not None and layer.crs != "EPSG:4326":
        layer = MapRows.of_frame(layer.frame().to_crs("EPSG:4326"))
    digits = None if decimals is None else as_count(decimals, "decimals", low=0)
    names, columns = list(layer.columns), [plain_cells(values) for values in layer.columns.values()]
    rows = zip(*columns, strict=True) if names else iter([()] * len(layer))
    compact = json.JSONEncoder(ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode
    for row, cell in zip(rows, layer.binary.tolist(), strict=True):
        properties, geometry = dict(zip(names, row, strict=True)), cell and wkb.as_geojson(cell, digits)[0]
        yield compact({"type": "Feature", "properties": properties, "geometry": geometry})
