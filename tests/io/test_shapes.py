"""The taker of shapes: GeoJSON, frames, geometries; the same from each; what is none of them is refused in words."""

import gzip
import json

import geopandas
import numpy as np
import pytest
import shapely

from stereodel.io import read_points
from stereodel.io.reading import shapes_of

RING = [[0, 0], [10, 0], [10, 10], [0, 0]]


def feature(geometry, **properties):
    return {"type": "Feature", "properties": properties, "geometry": geometry}


SEVERAL = [{"type": "Point", "coordinates": [5, 5]}, {"type": "Polygon", "coordinates": [RING]}]
EVERYTHING = {
    "type": "FeatureCollection",
    "features": [
        feature({"type": "Point", "coordinates": [1, 2, 300.0]}, size=3),
        feature({"type": "MultiPoint", "coordinates": [[1, 2], [3, 4]]}, size=None),
        feature({"type": "LineString", "coordinates": [[1, 2], [3, 4]]}),
        feature({"type": "MultiLineString", "coordinates": [[[1, 2], [3, 4]], [[5, 6], [7, 8], [9, 10]]]}, size=4.5),
        feature({"type": "Polygon", "coordinates": [RING, [[1, 1], [2, 1], [2, 2], [1, 1]]]}),
        feature({"type": "MultiPolygon", "coordinates": [[RING], [RING]]}),
        feature(None),
        feature({"type": "GeometryCollection", "geometries": SEVERAL}),
        feature({"type": "Point", "coordinates": []}),
        feature({"type": "MultiPolygon", "coordinates": []}),
    ],
}


def test_every_kind_is_sorted_with_its_feature(tmp_path):
    """Files, frames and geometries are the same."""
    path = tmp_path / "all.geojson"
    path.write_text(json.dumps(EVERYTHING))
    frame = geopandas.GeoDataFrame.from_features(EVERYTHING, crs="EPSG:4326")
    geometries = (frame.geometry, list(frame.geometry), iter(frame.geometry))
    for source in (EVERYTHING, EVERYTHING["features"], path, str(path), frame, *geometries):
        shapes = shapes_of(source)
        assert len(shapes.properties) == len(EVERYTHING["features"])
        assert shapes.points.tolist() == [[1, 2], [1, 2], [3, 4], [5, 5]]
        assert shapes.point_feature.tolist() == [0, 1, 1, 7]
        line = [[1, 2], [3, 4]]
        assert [row.tolist() for row in shapes.lines] == [line, line, [[5, 6], [7, 8], [9, 10]]]
        assert shapes.line_feature.tolist() == [2, 3, 3]
        assert [ring.tolist() for ring in shapes.rings] == [RING, [[1, 1], [2, 1], [2, 2], [1, 1]], RING, RING, RING]
        assert shapes.ring_polygon.tolist() == [0, 0, 1, 2, 3]
        assert shapes.polygon_feature.tolist() == [4, 5, 5, 7]
        assert [len(rings) for rings in shapes.polygons] == [2, 1, 1, 1]
    for source in (EVERYTHING, frame):
        sizes = shapes_of(source).column("size")
        np.testing.assert_array_equal(sizes, [3, np.nan, np.nan, 4.5] + [np.nan] * 6)


MERCATOR = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::3857"}}
FAR = [1113194.9079327357, 6446275.841017158]  # 10° E, 50° N


@pytest.fixture
def in_metres():
    """A square about 10° E, 50° N, and its middle, in coordinates of EPSG:3857 that are degrees as well."""
    corners = [[FAR[0] + x, FAR[1] + y] for x, y in ((-9e5, -9e5), (9e5, -9e5), (9e5, 9e5), (-9e5, 9e5), (-9e5, -9e5))]
    square = feature({"type": "Polygon", "coordinates": [corners]})
    return [square, feature({"type": "Point", "coordinates": FAR})]


def test_the_member_crs_counts_at_every_door(tmp_path, in_metres):
    collection = {"type": "FeatureCollection", "crs": MERCATOR, "features": in_metres}
    text = json.dumps(collection)
    (tmp_path / "a.geojson").write_text(text)
    (tmp_path / "a.json.gz").write_bytes(gzip.compress(text.encode()))
    lines = [{**each, "crs": MERCATOR} for each in in_metres]
    (tmp_path / "a.geojsonl").write_text("\n".join(map(json.dumps, lines)))

    class Other:
        __geo_interface__ = collection

    inner = [{**each, "geometry": {**each["geometry"], "crs": MERCATOR}} for each in in_metres]
    parts = {"type": "GeometryCollection", "geometries": [each["geometry"] for each in inner]}
    (tmp_path / "inner.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": inner}))
    sources = [collection, lines, [collection], Other(), inner, parts, feature(parts), *sorted(tmp_path.iterdir())]
    assert len(sources) == 11
    for source in sources:
        shapes = shapes_of(source)
        np.testing.assert_allclose(shapes.points, [[10, 50]], atol=1e-9)
        assert 44 < shapes.rings.values[:, 1].min() < shapes.rings.values[:, 1].max() < 56
    for source in tmp_path.iterdir():
        with pytest.raises(ValueError, match="row 1: a Point is needed, not Polygon"):
            read_points(source)
    (tmp_path / "b.geojsonl").write_text(json.dumps(lines[1]))
    (tmp_path / "c.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": inner[1:]}))
    for name in ("b.geojsonl", "c.geojson"):
        np.testing.assert_allclose(read_points(tmp_path / name).lonlat, [[10, 50]], atol=1e-9)
    mixed = ([lines[1], in_metres[1]], [inner[1], in_metres[1]])
    for source in (*mixed, *({"type": "FeatureCollection", "features": each} for each in mixed)):
        with pytest.raises(ValueError, match="several coordinate systems, degrees, urn:ogc:def:crs:EPSG::3857"):
            shapes_of(source)


def test_nested_collections_and_closed_lines():
    line = shapely.LinearRing(RING)
    nested = shapely.GeometryCollection([shapely.GeometryCollection([line, shapely.MultiPoint([(1, 2), (3, 4)])])])
    for source in (nested, nested.__geo_interface__, [nested], [nested.__geo_interface__]):
        shapes = shapes_of(source)
        assert [row.tolist() for row in shapes.lines] == [RING]
        assert shapes.points.tolist() == [[1, 2], [3, 4]]
        assert not len(shapes.rings)


def test_open_rings_are_closed():
    shapes = shapes_of({"type": "Polygon", "coordinates": [RING[:-1]]})
    assert shapes.rings.values.tolist() == RING


@pytest.mark.parametrize("source", [[], {"type": "FeatureCollection", "features": []}, geopandas.GeoSeries([])])
def test_nothing(source):
    shapes = shapes_of(source)
    assert (len(shapes.points), len(shapes.lines), len(shapes.rings), len(shapes.properties)) == (0, 0, 0, 0)
    assert shapes.points.shape == shapes.lines.values.shape == shapes.rings.values.shape == (0, 2)
