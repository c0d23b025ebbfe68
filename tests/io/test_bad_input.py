"""What files and functions of input and output refuse: the words of each case, and a target as it was."""

import gzip
import io
import json
import os
import re

import geopandas
import numpy as np
import pytest
import shapely
import xarray as xr

from stereodel import MoebiusMap, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from stereodel.interpolation import contours
from stereodel.io import Grid, PointTable, from_ugrid, read_points, to_geodataframe, to_trimesh, to_ugrid, warp, write
from stereodel.io.reading import shapes_of
from tests import sets
from tests.refused import refused

POINTS = sets.sphere("random").drawn(60)
CELLS, TRIANGLES, PLANE = SphericalVoronoi(POINTS), SphericalDelaunay(POINTS), PlanarVoronoi(POINTS[:, :2])
TEXT = {"type": "Feature", "properties": {"name": "here"}, "geometry": {"type": "Point", "coordinates": [0, 0]}}
LINES, FAR = contours(TRIANGLES, POINTS[:, 2], 0.5), PointTable([[0.0, 0.0], [1e300, 1.0]], surface="plane")
TABLE, MESH, NODES = PointTable([[1, 2]]), to_ugrid(TRIANGLES), "face_node_connectivity"


def lines(text):
    return [line.split(" → ") for line in text.strip().splitlines()]


TABLES = """
lon,lat|1,2|3,95.2 → row 2: latitude 95.2 is outside [-90, 90]
lon,lat|1,2|,4 → row 2: the longitude is missing
lon,lat|1,|1,n/a → row 1: the latitude is missing (and 1 more rows like it)
lon,lat|1,2|3,north → row 2: the latitude 'north' is not a number
lon,lat|1,2|inf,4 → row 2: the longitude is inf, but must be finite
lon,lat|1,2|3 → row 2 has 1 field, but there are 2 columns
 → the table is empty
name,lon,lat,lon| → several columns with the name 'lon'
a,10,48.4|b,2,51 → column_1', 'column_2', 'column_3
{] → not JSON
{"type": "Point"} → row 1: the longitude is missing
a,b|1,1 → no column looks like the longitude; say which with lon=, the columns are 'a', 'b'
start_lon,end_lon,lat|1,1,1 → 'start_lon', 'end_lon' may all be the longitude; say which with lon=
lon,a|1,1 → no column looks like the latitude
lon_lat|1 → lon and lat are both the column 'lon_lat'
"""


@pytest.mark.parametrize(("content", "message"), lines(TABLES))
def test_tables(content, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        read_points(io.BytesIO(content.replace("|", "\n").encode("latin1")))


FEATURES = """
null → is not a GeoJSON Feature
[1, 2] → is not a GeoJSON Feature
{"properties": [1], "geometry": {"type": "Point", "coordinates": [1, 2]}} → is not a GeoJSON Feature
{"type": "Point", "coordinates": [1, 2]} → is not a GeoJSON Feature
{"geometry": null} → a Point is needed, not no geometry
{"geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}} → a Point is needed, not LineStr
{"properties": null, "geometry": {"type": "Point", "coordinates": []}} → the longitude is missing
{"properties": null, "geometry": {"type": "Point", "coordinates": [0, 100]}} → latitude 100
{"properties": null, "geometry": {"type": "Point", "coordinates": [1]}} → a Point has two or three coordinates, not [1]
{"properties": null, "geometry": {"type": "Point", "coordinates": 5}} → a Point has two or three coordinates, not 5
{"properties": null, "geometry": {"type": "Point", "coordinates": "ab"}} → a Point has two or three coord
{"properties": null, "geometry": {"type": "Point", "coordinates": ["1", "2"]}} → a Point has two or three coord
"""


@pytest.mark.parametrize(("feature", "message"), lines(FEATURES))
def test_features_of_points(feature, message):
    first = {"properties": None, "geometry": {"type": "Point", "coordinates": [1, 2, 3]}}
    collection = {"type": "FeatureCollection", "features": [first, json.loads(feature)]}
    with pytest.raises(ValueError, match=re.escape(f"row 2: {message}")):
        read_points(io.StringIO(json.dumps(collection)))


SHAPES = """
{ → is not JSON
[1, 2] → is not GeoJSON
{"type": "Topology"} → is not GeoJSON: its type is 'Topology'
{"type": "FeatureCollection"} → without a list of features
{"type": "FeatureCollection", "features": [{"type": "Point"}]} → row 1: is not a GeoJSON Feature
{"type": "Feature", "geometry": {"type": "Circle", "coordinates": [1, 2]}} → of type 'Circle'
{"type": "Polygon"} → Polygon without coordinates
{"type": "Polygon", "coordinates": [[[1, 2], [3, 4], [1, 2]]]} → a ring of 2 points; a ring needs three
{"type": "LineString", "coordinates": [[1, 2], [3]]} → are not two or three numbers
{"type": "LineString", "coordinates": [[1, 2], ["a", 4]]} → are not two or three numbers
{"type": "LineString", "coordinates": [["1", "2"], ["3", "4"]]} → are not two or three numbers
{"type": "Point", "coordinates": [true, 4]} → are not two or three numbers
{"type": "Point", "coordinates": 5} → row 1: has a Point whose coordinates are 5, which is no list
{"type": "MultiPolygon", "coordinates": [5]} → has a MultiPolygon whose coordinates are 5, which
{"type": "Polygon", "coordinates": {}} → has a Polygon whose coordinates are {}, which is no list
{"type": "GeometryCollection", "geometries": 5} → whose geometries are 5, which is no list
{"type": "Point", "coordinates": [1e999, 4]} → not finite
{"type": "Point", "crs": 3, "coordinates": [1, 4]} → the member crs of the file is 3
{"type": "LineString", "coordinates": [[1, 2], [3, 95]]} → bad.geojson: row 1: latitude 95
{"type": "Point", "coordinates": [NaN, 2]} → finite
"""


@pytest.mark.parametrize(("content", "message"), lines(SHAPES))
def test_geojson_of_shapes(tmp_path, content, message):
    path = tmp_path / "bad.geojson"
    path.write_text(content)
    with pytest.raises(ValueError, match=f"bad.geojson.*{re.escape(message.removeprefix('bad.geojson'))}"):
        shapes_of(path)


def named(**options):
    """Cells as a frame, by other options."""
    return lambda: to_geodataframe(CELLS, **options)


def read(**options):
    return lambda: read_points(io.StringIO("lon,lat\n1,1"), **options)


def to_points(wrong):
    return lambda: read_points(geopandas.GeoSeries([shapely.Point(0, 0), wrong]))


def face(entries, value):
    """A mesh whose second face has other nodes."""
    nodes = MESH[NODES].astype(np.float64)
    nodes[1, entries] = value
    return lambda: from_ugrid(MESH.assign({NODES: nodes}))


test_values = refused(
    (read(lon="x"), "lon is 'x', which is not one of the columns 'lon', 'lat'"),
    (read(lon="lat"), "lon and lat are both the column 'lat'"),
    (read(format="xlsx"), "format is 'xlsx'"),
    (lambda: read_points(io.BytesIO(gzip.compress(b"lon,lat\n" * 1000)[:-9])), "the compressed file is damaged"),
    (lambda: PointTable([[1, 2]], {"name": ["a", "b"]}), "column 'name' has shape"),
    (lambda: PointTable([[1, 2]], crs="EPSG:31467"), "crs is 'EPSG:31467', but points of the sphere are in"),
    # Shapes
    (lambda: shapes_of(shapely.Point(0, 95)), "latitude 95"),
    (lambda: shapes_of(TEXT).column("depth"), "'depth' is not a property of the features; they have name"),
    (lambda: shapes_of(TEXT).column("name"), "'name' holds something that is not a number"),
    (lambda: warp(shapely.Point(0, 91), MoebiusMap.identity()), "latitude 91"),
    (lambda: warp(shapely.Point(0, 1), MoebiusMap.identity(), tolerance=0), "tolerance"),
    (lambda: warp(shapely.Point(0, 1), MoebiusMap.identity(), tolerance=np.inf), "tolerance"),
    # Frames
    (named(what="faces"), "what is 'faces'"),
    (named(max_segment=0), "max_segment"),
    (named(max_segment=91), "max_segment"),
    (named(radius=-1), "radius"),
    (named(latitude="north"), "latitude"),
    (named(columns={"name": ["a"]}), r"columns\['name'\] has shape"),
    (named(columns={"name": ["a"] * 60}, what="edges"), "columns belong to points"),
    (named(clip="land", what="ridges"), "clip is for cells and triangles of the sphere"),
    (named(clip=shapely.Point(1, 2)), "clip has no polygons"),
    (lambda: to_geodataframe(PLANE, clip="land"), "clip is for cells and triangles of the sphere"),
    (lambda: to_geodataframe([], clip="land"), "not of contours"),
    (lambda: to_geodataframe(LINES, what="cells"), "not of contours"),
    *(
        (lambda bounds=bounds: to_geodataframe(PLANE, bounds=bounds), r"bounds .*\(xmin, ymin, xmax, ymax\)")
        for bounds in [(0, 0, 1), (0, 1, 2, 1), (3, 0, 0, 2)]
    ),
    *(
        (to_points(wrong), "row 2: a Point is needed")
        for wrong in (None, shapely.Point(), shapely.LineString([(0, 0), (1, 1)]))
    ),
    (to_points(shapely.Point(7, 91)), "row 2: latitude 91"),
    # Grids
    (lambda: Grid([0, 1, 3], [0]), "lon must grow by equal steps"),
    (lambda: Grid([1, 0], [0]), "lon must grow by equal steps"),
    (lambda: Grid([0], [0, 95]), "lat"),
    (lambda: Grid([], [0]), r"lon must have shape \(n,\)"),
    (lambda: Grid([0, 1], [0], {"z": [[1]]}), r"values\['z'\] must have shape \(1, 2\), got \(1, 1\)"),
    (lambda: Grid([0], [0], {"z": [[1]]}, {"y": "m"}), "units are given for 'y'"),
    (lambda: Grid.regular(7), "spacing is 7, but 180 must be a whole multiple"),
    (lambda: Grid.regular(1, (0, 50, 10, 40)), "south must be below north"),
    (lambda: Grid.regular(1, of=PointTable(np.zeros((0, 2)))), "no points, whose extent would be .*; give bounds"),
    (lambda: Grid.regular(1e-300, of=FAR), "spacing is 1e-300, which makes a grid of"),
    # Meshes
    (lambda: from_ugrid(xr.Dataset()), "one mesh topology, it has 0: none"),
    (lambda: from_ugrid(MESH.drop_vars(NODES)), f"names '{NODES}', which is not in the dataset"),
    (face(0, 10**6), "face 1 names node 1000000, but the nodes are 0 to 59"),
    (face(0, 60), "face 1 names node 60, "),
    (face(0, -2), "face 1 names node -2, .* _FillValue"),
    (face(slice(None), -1), "face 1 has 0 nodes, but a face has at least three"),
    (face(0, 1.5), "face 1 names node 1.5, "),
    (lambda: to_trimesh(CELLS, colors=np.zeros((3, 3))), r"colors must have shape \(60, 3\) or \(60, 4\)"),
    (lambda: to_trimesh(CELLS, colors=np.full((60, 3), 2.0)), "from 0 to 1"),
    (lambda: to_trimesh(CELLS, colors=np.full((60, 3), 256)), "from 0 to 255"),
    # Files
    (lambda: write(io.BytesIO(), TABLE), "format is None"),
    (lambda: write(io.BytesIO(), CELLS, format="pdf"), "format is 'pdf', but must be one of 'csv'"),
    # Other errors
    (lambda: shapes_of("nowhere.geojson"), r"nowhere\.geojson", FileNotFoundError),
    (lambda: shapes_of(3), "source must be a file", TypeError),
    (lambda: shapes_of([shapely.Point(1, 2), 3]), r"source\[1\] must be a geometry", TypeError),
    (lambda: shapes_of([shapely.Point(1, 95)]), r"is it the longitude, or not in degrees\?$", ValueError),
    (lambda: to_geodataframe(POINTS), "mesh must be", TypeError),
    (lambda: to_geodataframe([LINES[0], 5]), r"mesh\[1\] must be a Contour, not int", TypeError),
)


@pytest.mark.parametrize(
    ("name", "content", "options", "error", "message"),
    [
        ("a.svg", CELLS, {}, ValueError, "format is 'svg', but must be one of 'csv'"),
        ("a.PNG", CELLS, {}, ValueError, "format is 'png', but must be one of 'csv'"),
        ("a.ods", TABLE, {}, ValueError, "format is 'ods'"),
        ("a.csv", [[1, 2]], {}, TypeError, r"mesh\[0\] must be a Contour, not list"),
        ("a.csv", 5, {}, TypeError, "thing must be a mesh, a PointTable or a GeoDataFrame, not int"),
        ("a.csv", TABLE, {"what": "cells"}, TypeError, "what is not an option"),
        ("a.csv", TABLE, {"decimals": 3}, TypeError, "decimals is not an option"),
        ("a.csv", PointTable([[1, 2]], {"\udfff": [1]}), {}, ValueError, "the column name .* has a char.* that .csv"),
        ("a.glb", TABLE, {}, TypeError, "mesh must be a triangulation"),
        ("a.geojson", CELLS, {"radius": -1}, ValueError, "radius"),
        ("a.nc", CELLS, {"what": "edges"}, ValueError, "what is 'edges'"),
        ("a.tif", Grid.regular(90), {}, ValueError, "no values"),
        ("a.tif", 5, {}, TypeError, "must be a Grid"),
    ],
)
def test_what_cannot_be_written_leaves_what_was_there(tmp_path, name, content, options, error, message):
    path = tmp_path / name
    path.write_text("before")
    with pytest.raises(error, match=message):
        write(path, content, **options)
    assert path.read_text() == "before"
    assert os.listdir(tmp_path) == [name]
