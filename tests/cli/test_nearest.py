"""`stereodel nearest` beside brute force."""

import numpy as np
import pytest

from stereodel import angular_distance, lonlat_to_xyz
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
    # Munich's centre is some 120 km east of Ulm; the pole 41.6 degrees of 111.2 km away.
    assert float(table[0]["distance_km"]) == pytest.approx(123, abs=5)
    assert float(table[3]["distance_km"]) == pytest.approx(
        np.radians(angular_distance(*lonlat_to_xyz([[0, 90], [10, 48.4]], latitude="authalic"))) * MEAN_RADIUS_KM,
        rel=1e-12,
    )


@pytest.mark.parametrize("count", [2, 5, 9])
def test_several_sites_are_ranked(queries, count, run, rows):
    table = rows(run("nearest", "cities.csv", "--of", "queries.csv", "-k", count, "-o", "-"))
    sites, asking = (
        lonlat_to_xyz([(float(row["lon"]), float(row["lat"])) for row in rows((queries / name).read_text())])
        for name in ("cities.csv", "queries.csv")
    )
    order = np.argsort(angular_distance(asking[:, None], sites), axis=1)[:, :count]
    assert [int(row["site_row"]) for row in table] == (order + 1).ravel().tolist()
    assert [int(row["rank"]) for row in table] == list(range(1, order.shape[1] + 1)) * len(asking)


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


def test_stdin_for_both_is_refused(folder, run):
    assert "cannot both be stdin" in run("nearest", "-", "--of", "-", "-o", "-", code=2)
