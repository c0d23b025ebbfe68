"""`stereodel nearest` beside brute force."""

import io
import tracemalloc

import geopandas
import numpy as np
import pytest

from stereodel import angular_distance, lonlat_to_xyz
from stereodel.cli.nearest import _pairs
from stereodel.earth import MEAN_RADIUS_KM

QUERIES = "lon,lat,who\n11.6,48.1,Ada\n179.99,-30,Max\n-179.99,-30,Eva\n0,90,Ole\n"


@pytest.fixture
def queries(folder):
    (folder / "queries.csv").write_text(QUERIES, encoding="utf-8")
    return folder


def test_names_rows_and_kilometres(queries, run, rows):
    table = rows(run("nearest", "cities.csv", "--of", "queries.csv", "-o", "-"))
    assert [row["who"] for row in table] == ["Ada", "Max", "Eva", "Ole"]
    assert [row["site_name"] for row in table] == ["Ulm", "Perth", "Perth", "Ulm"]
    assert [row["site_row"] for row in table] == ["3", "5", "5", "3"]
    ranked = rows(run("nearest", "cities.csv", "--of", "queries.csv", "-k", 2, "-o", "-"))
    assert [row["rank"] for row in ranked] == ["1", "2"] * 4
    assert [row["site_name"] for row in ranked[::2]] == [row["site_name"] for row in table]
    # Munich's centre is some 120 km east of Ulm; the pole 41.6 degrees of 111.2 km away.
    assert float(table[0]["distance_km"]) == pytest.approx(123, abs=5)
    away = np.radians(angular_distance(*lonlat_to_xyz([[0, 90], [10, 48.4]], latitude="authalic"))) * MEAN_RADIUS_KM
    assert float(table[3]["distance_km"]) == pytest.approx(away, rel=1e-12)


def test_columns_kept(queries, run, rows):
    options = ("nearest", "cities.csv", "--of", "queries.csv", "-o", "-", "--keep", "people")
    first = rows(run(*options))[0]
    assert first["site_people"] == "128000"
    assert "site_name" not in first
    assert "no column 'mayor'; the columns are name, people" in run(*options, "--keep", "mayor", code=2)


def test_plane(folder, run, rows):
    (folder / "sites.csv").write_text("x,y\n0,0\n300,400\n", encoding="utf-8")
    (folder / "asking.csv").write_text("x,y\n200,300\n", encoding="utf-8")
    (row,) = rows(run("nearest", "sites.csv", "--of", "asking.csv", "--plane", "x", "y", "-o", "-"))
    assert (row["site_row"], float(row["distance"])) == ("2", pytest.approx(2**0.5 * 100))


def test_geodetic_latitudes_can_change_the_answer(folder, run, rows):
    """At 45°, geodetic and geocentric latitude are 0.19° apart."""
    (folder / "sites.csv").write_text("lon,lat\n0,0\n0,90\n", encoding="utf-8")
    (folder / "asking.csv").write_text("lon,lat\n0,45.1\n", encoding="utf-8")
    options = ("nearest", "sites.csv", "--of", "asking.csv", "-o", "-")
    assert rows(run(*options, "--latitude", "spherical"))[0]["site_row"] == "2"
    assert rows(run(*options, "--latitude", "geodetic"))[0]["site_row"] == "1"


@pytest.mark.parametrize("planar", [True, False])
@pytest.mark.parametrize("exclude_self", [True, False])
@pytest.mark.parametrize("max_distance", [None, 30.0])
@pytest.mark.parametrize("count", [1, 3, 40, 100])
def test_pairs_are_those_of_brute_force(rng, planar, exclude_self, max_distance, count):
    """Sites of which several are at one place, and queries at some of these places and beside them."""
    places = rng.uniform(-80, 80, (12, 2))
    sites, queries = places[rng.integers(0, 12, 60)], np.concatenate([places[:8], rng.uniform(-80, 80, (6, 2))])
    sites, queries = (sites, queries) if planar else (lonlat_to_xyz(sites), lonlat_to_xyz(queries))
    limit = np.inf if max_distance is None else max_distance * (1 if planar else np.radians(1) * MEAN_RADIUS_KM)
    query, *found = _pairs(sites, queries, count, limit, exclude_self)
    if planar:
        distance = np.hypot(*(sites - queries[:, None]).transpose(2, 0, 1))
    else:
        distance = np.radians(angular_distance(queries[:, None], sites)) * MEAN_RADIUS_KM
    for number, row in enumerate(distance):
        order = np.lexsort((np.arange(len(row)), row))
        order = order[(sites[order] != queries[number]).any(axis=1) | (not exclude_self)]
        order = [site for site in order[:count] if row[site] <= limit]
        site, rank, distances = (of[query == number] for of in found)
        assert site.tolist() == order
        assert rank.tolist() == list(range(1, len(order) + 1))
        assert distances == pytest.approx(row[order], abs=1e-9)


def test_many_sites_at_one_place_cost_no_more(folder):
    """A row for each of them and each query that is there would be a thousand times as much."""
    sites = np.concatenate([np.zeros((20_000, 2)), [[1.0, 0.0], [0.0, 2.0]]])
    tracemalloc.start()
    _, site, *_ = _pairs(sites, np.zeros((20_000, 2)), 2, np.inf, exclude_self=True)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert site[:4].tolist() == [20_000, 20_001] * 2
    assert peak < 30e6


def test_exclude_self_and_max_distance_in_the_command(folder, run, rows):
    options = ("--exclude-self", "--max-distance", 9000, "-o", "-")
    table = rows(run("nearest", "cities.csv", "--of", "cities.csv", *options))
    pairs = [("Lagos", "Ulm"), ("Ulm", "Lagos"), ("Kyoto", "Perth"), ("Perth", "Kyoto")]
    assert [(row["name"], row["site_name"]) for row in table] == pairs


SQUARES = """{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "west", "size": 4}, "geometry":
 {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]]}},
{"type": "Feature", "properties": {"name": "mark", "size": null}, "geometry": {"type": "Point", "coordinates": [5, 5]}},
{"type": "Feature", "properties": {"name": "road", "size": 1}, "geometry":
 {"type": "LineString", "coordinates": [[3, 0], [3, 2]]}}]}"""


@pytest.fixture
def shapes(folder):
    """Shapes in two formats, and a table of points; distances are on a sphere, with plain latitudes."""
    geopandas.read_file(io.StringIO(SQUARES)).to_crs("EPSG:3857").to_file(folder / "shapes.gpkg")
    (folder / "shapes.geojson").write_text(SQUARES, encoding="utf-8")
    (folder / "inner.csv").write_text("lon,lat,name\n1,1,in\n2.9,1,near\n5,6,north\n", encoding="utf-8")
    return ("--of", "inner.csv", "--latitude", "spherical", "-o", "-")


@pytest.mark.parametrize("name", ["shapes.geojson", "shapes.gpkg", "-"])
def test_lines_and_polygons(shapes, run, rows, name):
    table = rows(run("nearest", name, *shapes, "--keep", "name", "--keep", "size", stdin=SQUARES))
    expected = [("in", "1", "west"), ("near", "3", "road"), ("north", "2", "mark")]
    assert [(row["name"], row["site_row"], row["site_name"]) for row in table] == expected
    assert [row["site_size"] for row in table] == ["4", "1", ""]
    degree = np.radians(1) * MEAN_RADIUS_KM
    across = np.degrees(np.arcsin(np.sin(np.radians(0.1)) * np.cos(np.radians(1))))
    assert [float(row["distance_km"]) / degree for row in table] == pytest.approx([0, across, 1], abs=1e-9)
    near = rows(run("nearest", name, *shapes, "--max-distance", 50, stdin=SQUARES))
    assert [row["name"] for row in near] == ["in", "near"]


def test_what_is_said_of_shapes(shapes, run):
    said = run("nearest", "inner.csv", "--of", "shapes.gpkg", "-o", "-", code=2)
    assert "shapes.gpkg: row 1: a Point is needed, not Polygon; take e.g. centroids first" in said
    for option, name in ((("-k", 2), "--count"), (("--exclude-self",), "--exclude-self")):
        said = run("nearest", "shapes.gpkg", *shapes, *option, code=2)
        assert f"{name} is for points, and shapes.gpkg has lines or polygons, of which the nearest one alone is" in said
        assert "found; leave out what is for points" in said
    said = run("nearest", "shapes.gpkg", *shapes, "--plane", "lon", "lat", code=2)
    assert "there is no column 'lon'; the columns are 'name', 'size'" in said
