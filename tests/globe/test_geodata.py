"""What users draw: GeoJSON, tables of shapes; everything that is none is refused in words."""

import json

import geopandas
import numpy as np
import pytest
import shapely

from stereodel.globe.geodata import shapes_of

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


def test_every_kind_is_sorted_with_its_feature():
    shapes = shapes_of(EVERYTHING)
    assert [len(part) for part in shapes.points] == [1, 2, 1]
    assert shapes.point_features == [0, 1, 7]
    assert [len(line) for line in shapes.lines] == [2, 2, 3]
    assert shapes.line_features == [2, 3, 3]
    assert [len(rings) for rings in shapes.polygons] == [2, 1, 1, 1]
    assert shapes.polygon_features == [4, 5, 5, 7]
    assert shapes.points[0].tolist() == [[1.0, 2.0]]
    np.testing.assert_array_equal(shapes.column("size"), [3, np.nan, np.nan, 4.5] + [np.nan] * 6)


def test_files_objects_and_tables_are_the_same(tmp_path):
    path = tmp_path / "all.geojson"
    path.write_text(json.dumps(EVERYTHING))
    frame = geopandas.GeoDataFrame.from_features(EVERYTHING, crs="EPSG:4326")
    for source in (path, str(path), frame):
        shapes = shapes_of(source)
        assert [len(rings) for rings in shapes.polygons] == [2, 1, 1, 1]
        assert sum(len(part) for part in shapes.points) == 4


def test_shapes_and_series_are_taken_and_other_coordinates_transformed(tmp_path):
    assert shapes_of(shapely.Point(3, 4)).points[0].tolist() == [[3.0, 4.0]]
    series = geopandas.GeoSeries([shapely.Point(10, 50)], crs="EPSG:4326").to_crs("EPSG:3857")
    np.testing.assert_allclose(shapes_of(series).points[0], [[10, 50]], atol=1e-9)
    path = tmp_path / "points.gpkg"
    geopandas.GeoDataFrame({"a": [1]}, geometry=series.array, crs="EPSG:3857").to_file(path)
    np.testing.assert_allclose(shapes_of(path).points[0], [[10, 50]], atol=1e-9)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", "is no JSON"),
        ("[1, 2]", "is no GeoJSON"),
        ('{"type": "Topology"}', "is no GeoJSON: its type is 'Topology'"),
        ('{"type": "FeatureCollection"}', "without a list of features"),
        ('{"type": "FeatureCollection", "features": [{"type": "Point"}]}', "feature 0 has no type Feature"),
        ('{"type": "Feature", "geometry": {"type": "Circle", "coordinates": [1, 2]}}', "of type 'Circle'"),
        ('{"type": "Polygon"}', "Polygon without coordinates"),
        ('{"type": "LineString", "coordinates": [[1, 2], [3]]}', "positions of two or three numbers"),
        ('{"type": "LineString", "coordinates": [[1, 2], ["a", 4]]}', "positions of two or three numbers"),
        ('{"type": "LineString", "coordinates": [[1, 2], [3, 95]]}', r"bad.geojson: LineString.* latitude 95"),
        ('{"type": "Point", "coordinates": [NaN, 2]}', "NaN|nan|finite"),
    ],
)
def test_what_is_no_geojson_is_refused(tmp_path, content, message):
    path = tmp_path / "bad.geojson"
    path.write_text(content)
    with pytest.raises(ValueError, match=message) as error:
        shapes_of(path)
    assert "bad.geojson" in str(error.value)


def test_files_that_are_not_there(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere\.geojson"):
        shapes_of(tmp_path / "nowhere.geojson")
    with pytest.raises(TypeError, match="source must be a file"):
        shapes_of(3)


def test_columns_must_be_there_and_hold_numbers():
    shapes = shapes_of(feature({"type": "Point", "coordinates": [0, 0]}, name="here"))
    with pytest.raises(ValueError, match="'depth' is no property of the features; they have name"):
        shapes.column("depth")
    with pytest.raises(ValueError, match="'name' holds something that is no number"):
        shapes.column("name")
