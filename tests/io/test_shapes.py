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
        feature(
            {
                "type": "GeometryCollection",
                "geometries": [{"type": "Point", "coordinates": [5, 5]}, {"type": "Polygon", "coordinates": [RING]}],
            }
        ),
        feature({"type": "Point", "coordinates": []}),
        feature({"type": "MultiPolygon", "coordinates": []}),
    ],
}


def assert_everything(shapes):
    assert len(shapes.properties) == len(EVERYTHING["features"])
    assert shapes.points.tolist() == [[1, 2], [1, 2], [3, 4], [5, 5]]
    assert shapes.point_feature.tolist() == [0, 1, 1, 7]
    assert [line.tolist() for line in shapes.lines] == [
        [[1, 2], [3, 4]],
        [[1, 2], [3, 4]],
        [[5, 6], [7, 8], [9, 10]],
    ]
    assert shapes.line_feature.tolist() == [2, 3, 3]
    assert [ring.tolist() for ring in shapes.rings] == [RING, [[1, 1], [2, 1], [2, 2], [1, 1]], RING, RING, RING]
    assert shapes.ring_polygon.tolist() == [0, 0, 1, 2, 3]
    assert shapes.polygon_feature.tolist() == [4, 5, 5, 7]
    assert [len(rings) for rings in shapes.polygons] == [2, 1, 1, 1]


def test_every_kind_is_sorted_with_its_feature(tmp_path):
    """Files, frames and geometries are the same."""
    path = tmp_path / "all.geojson"
    path.write_text(json.dumps(EVERYTHING))
    frame = geopandas.GeoDataFrame.from_features(EVERYTHING, crs="EPSG:4326")
    geometries = (frame.geometry, list(frame.geometry), iter(frame.geometry))
    for source in (EVERYTHING, EVERYTHING["features"], path, str(path), frame, *geometries):
        assert_everything(shapes_of(source))
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


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", "is not JSON"),
        ("[1, 2]", "is not GeoJSON"),
        ('{"type": "Topology"}', "is not GeoJSON: its type is 'Topology'"),
        ('{"type": "FeatureCollection"}', "without a list of features"),
        ('{"type": "FeatureCollection", "features": [{"type": "Point"}]}', "row 1: is not a GeoJSON Feature"),
        ('{"type": "Feature", "geometry": {"type": "Circle", "coordinates": [1, 2]}}', "of type 'Circle'"),
        ('{"type": "Polygon"}', "Polygon without coordinates"),
        ('{"type": "Polygon", "coordinates": [[[1, 2], [3, 4], [1, 2]]]}', "a ring of 2 points; a ring needs three"),
        ('{"type": "LineString", "coordinates": [[1, 2], [3]]}', "are not two or three numbers"),
        ('{"type": "LineString", "coordinates": [[1, 2], ["a", 4]]}', "are not two or three numbers"),
        ('{"type": "LineString", "coordinates": [["1", "2"], ["3", "4"]]}', "row 1: .* are not two or three numbers"),
        ('{"type": "Point", "coordinates": [true, 4]}', "are not two or three numbers"),
        ('{"type": "Point", "coordinates": 5}', "row 1: has a Point whose coordinates are 5, which is no list"),
        (
            '{"type": "MultiPolygon", "coordinates": [5]}',
            "has a MultiPolygon whose coordinates are 5, which",
        ),
        ('{"type": "Polygon", "coordinates": {}}', "has a Polygon whose coordinates are {}, which is no list"),
        ('{"type": "GeometryCollection", "geometries": 5}', "whose geometries are 5, which is no list"),
        ('{"type": "Point", "coordinates": [1e999, 4]}', "not finite"),
        ('{"type": "Point", "crs": 3, "coordinates": [1, 4]}', "the member crs of the file is 3"),
        ('{"type": "LineString", "coordinates": [[1, 2], [3, 95]]}', r"bad.geojson: row 1: latitude 95"),
        ('{"type": "Point", "coordinates": [NaN, 2]}', "NaN|nan|finite"),
    ],
)
def test_what_is_not_geojson_is_refused(tmp_path, content, message):
    path = tmp_path / "bad.geojson"
    path.write_text(content)
    with pytest.raises(ValueError, match=message) as error:
        shapes_of(path)
    assert "bad.geojson" in str(error.value)


@pytest.mark.parametrize(
    ("source", "error", "message"),
    [
        ("nowhere.geojson", FileNotFoundError, r"nowhere\.geojson"),
        (3, TypeError, "source must be a file"),
        ([EVERYTHING, 3], TypeError, r"source\[1\] must be a geometry"),
        (shapely.Point(0, 95), ValueError, "latitude 95"),
    ],
)
def test_other_objects_and_missing_files_are_refused(source, error, message):
    with pytest.raises(error, match=message):
        shapes_of(source)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("depth", "'depth' is not a property of the features; they have name"),
        ("name", "'name' holds something that is not a number"),
    ],
)
def test_columns_must_be_there_and_hold_numbers(name, message):
    shapes = shapes_of(feature({"type": "Point", "coordinates": [0, 0]}, name="here"))
    with pytest.raises(ValueError, match=message):
        shapes.column(name)
