"""`stereodel voronoi` and `stereodel triangulate`: areas of the cells, triangles, and tables in every format."""

import json

import geopandas
import numpy as np
import pytest
import shapely
from typer.testing import CliRunner

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay, lonlat_to_xyz
from stereodel.cli import app
from stereodel.cli.options import FLAT, TABLES
from stereodel.earth import AUTHALIC_RADIUS_KM
from stereodel.io import read_points


def frame_of(path):
    return (geopandas.read_parquet if path.suffix == ".parquet" else geopandas.read_file)(path)


@pytest.mark.parametrize(("unit", "whole"), [("km2", 4 * np.pi * AUTHALIC_RADIUS_KM**2), ("sr", 4 * np.pi)])
def test_areas_add_up_to_the_sphere(run, rows, unit, whole):
    table = rows(run("voronoi", "cities.csv", "-o", "-", "--area-unit", unit))
    assert [row["name"] for row in table] == ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    assert sum(float(row[f"area_{unit}"]) for row in table) == pytest.approx(whole, rel=1e-12)


def test_one_point_has_the_whole_earth_and_a_duplicate_nothing(folder, run, rows):
    (folder / "same.csv").write_text("lon,lat\n180,10\n-180,10\n", encoding="utf-8")
    areas = [float(row["area_sr"]) for row in rows(run("voronoi", "same.csv", "-o", "-", "--area-unit", "sr"))]
    assert areas == [pytest.approx(4 * np.pi), 0.0]


def test_plane(folder, run, rows):
    (folder / "plane.csv").write_text("x,y\n0,0\n-2,0\n2,0\n0,2\n0,-2\n", encoding="utf-8")
    areas = [row["area"] for row in rows(run("voronoi", "plane.csv", "--plane", "x", "y", "-o", "-"))]
    assert areas == ["4", "", "", "", ""]
    run("voronoi", "plane.csv", "--plane", "x", "y", "-o", "cells.parquet")
    cells = geopandas.read_parquet(folder / "cells.parquet")
    assert cells.crs is None
    assert cells.geometry[0].area == pytest.approx(4)


@pytest.mark.parametrize("kind", ["geojson", "geojsonl", "parquet", "gpkg", "shp"])
def test_shapes_tile_the_map(folder, run, kind):
    run("voronoi", "cities.csv", "-o", f"cells.{kind}", "--max-segment", 10)
    cells = frame_of(folder / f"cells.{kind}")
    assert list(cells.columns) == ["lon", "lat", "row", "name", "people", "area_km2", "geometry"]
    assert cells["name"].tolist() == ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    assert cells.is_valid.all()
    assert sum(shape.area for shape in cells.geometry) == pytest.approx(360 * 180)
    places = read_points("cities.csv").lonlat
    assert cells.contains(geopandas.GeoSeries(geopandas.points_from_xy(*places.T), crs="EPSG:4326")).all()
    if kind == "geojson":  # its RFC wants outer rings counterclockwise, and WGS84 without a member "crs"
        assert "crs" not in json.loads((folder / "cells.geojson").read_text())
        assert all(shape.exterior.is_ccw for shape in cells.explode().geometry)


def test_cells_on_land_and_in_the_polygons_of_a_file(folder, run, rows):
    whole = rows(run("voronoi", "cities.csv", "-o", "-"))
    parts = rows(run("voronoi", "cities.csv", "--clip", "land", "-o", "-"))
    run("voronoi", "cities.csv", "--clip", "land", "-o", "land.gpkg")
    cells = geopandas.read_file(folder / "land.gpkg")
    # Two runs: sums of NumPy 2.0 depend on where in memory the values lie.
    assert [float(row["area_km2"]) for row in parts] == pytest.approx(cells["area_km2"].tolist(), rel=1e-14)
    assert all(0 < float(part["area_km2"]) < float(row["area_km2"]) for part, row in zip(parts, whole, strict=True))
    assert cells["area_km2"].sum() == pytest.approx(1.47e8, rel=0.01)
    square = {"type": "Polygon", "coordinates": [[[9, 47], [11, 47], [11, 49], [9, 49], [9, 47]]]}
    (folder / "square.geojson").write_text(json.dumps(square), encoding="utf-8")
    found = rows(run("voronoi", "cities.csv", "--clip", "square.geojson", "-o", "-"))
    assert [row["name"] for row in found if float(row["area_km2"]) > 0] == ["Ulm"]
    assert run.said == f"note: {len(found) - 1} of {len(found)} cells have no part inside --clip\n"


REGIONS = """name,region,lon,lat
Quito,America,-78.5,-0.2
Suva,Pacific,178.4,-18.1
Lima,America,-77,-12
Apia,Pacific,-171.8,-13.8
Ulm,Europe,10,48.4
Oslo,Europe,10.7,59.9
Pole,,0,-90
Quito again,Nowhere,-78.5,-0.2
McMurdo,,166.7,-77.8
Nome,America,-165.4,64.5
"""


@pytest.fixture
def regions(folder):
    square = {"type": "Polygon", "coordinates": [[[-170, -60], [60, -60], [60, 70], [-170, 55], [-170, -60]]]}
    (folder / "square.geojson").write_text(json.dumps(square), "utf-8")
    (folder / "regions.csv").write_text(REGIONS, encoding="utf-8")
    (folder / "shops.csv").write_text("x,y,turnover\n-78,0,0.1\n-78,-12,0.2\n-78,1,0.3\n9,48,7\n3,-80,\n", "utf-8")
    return folder


@pytest.mark.parametrize(
    ("kind", "options"),
    [
        *((kind, []) for kind in TABLES if kind not in FLAT),
        ("parquet", ["--clip", "square.geojson"]),
        ("parquet", ["--plane", "lon", "lat"]),
        ("geojson", ["--plane", "lon", "lat"]),
    ],
)
def test_dissolved_cells_are_those_of_geopandas(regions, run, rows, kind, options):
    """The same regions as one line of GeoPandas makes of the cells, valid, with areas added and cells counted."""
    run("voronoi", "regions.csv", *options, "-o", "cells.parquet")
    run("voronoi", "regions.csv", *options, "--dissolve", "region", "-o", f"regions.{kind}")
    cells, found = (frame_of(regions / name) for name in ("cells.parquet", f"regions.{kind}"))
    area = "area" if "--plane" in options else "area_km2"
    if kind != "kml":  # which has columns of its own
        assert list(found.columns) == ["region", "cells", area, "geometry"]
    expected = cells.dissolve("region", aggfunc={area: ["sum", "count"]}, method="unary")
    expected.columns = ["geometry", "sum", "count"]
    found = found.assign(region=found["region"].fillna("")).set_index("region").loc[expected.index]
    assert found.is_valid.all()
    assert found["cells"].astype(int).tolist() == expected["count"].tolist()
    ours, theirs = np.asarray(found.geometry.force_2d()), np.asarray(expected.geometry)
    assert (shapely.area(shapely.symmetric_difference(ours, theirs)) < 1e-9 * shapely.area(theirs)).all()
    areas = found[area].astype(float).fillna(np.inf)  # GeoJSON knows no infinity
    assert np.allclose(areas, expected["sum"], rtol=1e-14 if kind not in ("kml", "shp") else 1e-9, atol=0)
    table = rows(run("voronoi", "regions.csv", *options, "--dissolve", "region", "-o", "-"))
    if not options:
        run("voronoi", "regions.csv", "--dissolve", "region", "-o", "regions.xlsx", "--overwrite")
        sheet = geopandas.read_file(regions / "regions.xlsx")
        assert sheet["cells"].tolist() == [int(row["cells"]) for row in table]
        assert sheet[area].tolist() == pytest.approx([float(row[area]) for row in table], rel=1e-14)
    assert [row["region"] for row in table] == ["America", "Pacific", "Europe", ""]
    sums = [expected["sum"][row["region"]] for row in table]
    assert [float(row[area] or "inf") for row in table] == pytest.approx(sums, rel=1e-14)


def test_dissolved_borders_are_those_of_cells(regions, run):
    """No side between cells of one region is left, and every other point is there to the bit."""
    run("voronoi", "regions.csv", "-o", "cells.parquet")
    run("voronoi", "regions.csv", "--dissolve", "region", "-o", "regions.parquet")
    cells, found = (geopandas.read_parquet(regions / f"{name}.parquet") for name in ("cells", "regions"))

    def sides(frame):
        found = {}
        for region, shape in zip(frame["region"], frame.geometry.force_2d(), strict=True):
            for part in shape.geoms if hasattr(shape, "geoms") else [shape]:
                for ring in (part.exterior, *part.interiors):
                    for side in zip(ring.coords[:-1], ring.coords[1:], strict=True):
                        found.setdefault(frozenset(side), []).append(region)
        return found

    before, after = sides(cells), sides(found)
    between = {side for side, of in before.items() if len(of) == 2 and of[0] == of[1]}
    assert between
    assert set(after) == set(before) - between


def test_values_of_other_points_by_cells(regions, run, rows):
    other = ("--of", "shops.csv", "--of-lon", "x", "--of-lat", "y", "--sum", "turnover", "--mean", "turnover", "--rows")
    message = run("voronoi", "regions.csv", *other, "-o", "-", code=2)
    assert message == ("error: shops.csv: row 5: the turnover is missing; leave such rows out with --skip-missing\n")
    table = rows(run("voronoi", "regions.csv", *other, "--skip-missing", "-o", "-"))
    said = {row["name"]: (row["sum_turnover"], row["mean_turnover"], row["rows"]) for row in table}
    assert said["Quito"] == ("0.4", "0.2", "2")  # once rounded
    assert said["Quito again"] == said["Oslo"] == ("0.0", "", "0")
    assert said["Pole"] == ("0.0", "", "1")  # a place without a value is counted, and adds none
    together = rows(run("voronoi", "regions.csv", *other, "--skip-missing", "--dissolve", "region", "-o", "-"))
    assert list(together[0].values())[3:] == ["0.6", "0.2", "3"]
    run("voronoi", "regions.csv", *other, "--skip-missing", "--clip", "square.geojson", "-o", "cells.gpkg")
    cells = geopandas.read_file(regions / "cells.gpkg").set_index("name")
    assert cells["sum_turnover"].to_dict() == {name: float(said[name][0]) for name in cells.index}


def test_sums_by_cells_are_those_of_numpy(rng, folder, run, rows):
    sites, points = rng.uniform(-50, 50, (40, 2)), rng.uniform(-60, 60, (2000, 2))
    values = rng.normal(size=2000)
    for name, header, table in (("sites", "x,y", sites), ("of", "x,y,v", np.column_stack([points, values]))):
        np.savetxt(folder / f"{name}.csv", table, delimiter=",", header=header, comments="", fmt="%.17g")
    gathered = ("--of", "of.csv", "--sum", "v", "--mean", "v", "--rows")
    table = rows(run("voronoi", "sites.csv", "--plane", "x", "y", *gathered, "-o", "-"))
    cell = np.argmin(((points[:, None] - sites) ** 2).sum(axis=2), axis=1)
    count, total = np.bincount(cell, minlength=40), np.bincount(cell, values, minlength=40)
    assert [int(row["rows"]) for row in table] == count.tolist()
    assert np.allclose([float(row["sum_v"]) for row in table], total)
    assert np.allclose([float(row["mean_v"]) for row in table], total / count)


def corners(rows, text):
    return np.array([[int(row[name]) for name in row] for row in rows(text)])


def test_triangles_of_the_sphere(folder, run, rows):
    places = rows((folder / "cities.csv").read_text())
    points = lonlat_to_xyz([(float(row["lon"]), float(row["lat"])) for row in places])
    found = corners(rows, run("triangulate", "cities.csv", "-o", "-")) - 1
    assert found.tolist() == SphericalDelaunay(points).simplices.tolist()
    check_delaunay(points, found.astype(np.int32))


def test_edges_in_the_plane(folder, run, rows):
    points = np.random.default_rng(1).integers(0, 9, (20, 2)).astype(float)
    np.savetxt(folder / "grid.csv", points, delimiter=",", header="lon,lat", comments="")  # names of any kind
    found = corners(rows, run("triangulate", "grid.csv", "--plane", "lon", "lat", "--edges", "-o", "-"))
    assert (found - 1).tolist() == PlanarDelaunay(points).edges.tolist()


@pytest.mark.parametrize(
    ("kind", "options", "what"),
    [("json", [], "Polygon"), ("parquet", ["--edges"], "LineString"), ("gpkg", ["--edges"], "LineString")],
)
def test_shapes(folder, run, rows, kind, options, what):
    run("triangulate", "cities.csv", "-o", f"out.{kind}", *options)
    frame = frame_of(folder / f"out.{kind}")
    found = frame.drop(columns="geometry").to_numpy()
    expected = corners(rows, run("triangulate", "cities.csv", "-o", "-", *options))
    assert sorted(found.tolist()) == sorted(expected.tolist())
    assert frame.is_valid.all()
    assert set(frame.geom_type) <= {what, f"Multi{what}"}
    assert frame.crs.to_epsg() == 4326


@pytest.mark.parametrize("kind", [kind for kind in TABLES if kind != "shp"])
def test_pipes_hold_the_same(folder, run, kind):
    """What one command writes to stdout, the next one reads from stdin."""
    first = CliRunner().invoke(app, ["nearest", "cities.csv", "--of", "cities.csv", "-o", "-", "--format", kind])
    options = ["nearest", "-", "--of", "cities.csv", "-o", "out.csv", "--keep", "people"]
    assert CliRunner().invoke(app, options, input=first.stdout_bytes).exit_code == 0
    found = read_points("out.csv").columns["site_people"].tolist()
    assert sorted(found) == sorted(read_points("cities.csv").columns["people"].tolist())


@pytest.mark.parametrize(
    ("command", "kind"),
    [
        (["voronoi", "plane.csv"], "gpkg"),
        (["triangulate", "plane.csv"], "parquet"),
        (["contour", "plane.csv", "--value", "v", "--levels", "1.5"], "geojson"),
        (["nearest", "plane.csv", "--of", "plane.csv"], "parquet"),
        (["interpolate", "plane.csv", "--value", "v", "--at", "plane.csv"], "gpkg"),
        (["nearest", "plane.csv", "--of", "plane.csv"], "geojson"),
    ],
)
def test_a_plane_keeps_its_coordinate_system(folder, run, command, kind):
    lines = ["e,n,v", "570000,5360000,1", "580000,5360000,2", "575000,5370000,3", "576000,5364000,2"]
    (folder / "plane.csv").write_text("\n".join(lines), encoding="utf-8")
    run(*command, "--plane", "e", "n", "--crs", "EPSG:25832", "-o", f"out.{kind}")
    frame = frame_of(folder / f"out.{kind}")
    if kind == "geojson":  # which is in degrees
        assert frame.crs.to_epsg() == 4326
        frame = frame.to_crs("EPSG:25832")
    assert frame.crs.to_epsg() == 25832
    assert 560_000 < frame.total_bounds[0] < 580_000
    assert "--crs is 'EPSG:0'" in run(*command, "--plane", "e", "n", "--crs", "EPSG:0", "-o", "b.gpkg", code=2)
