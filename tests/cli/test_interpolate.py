"""`stereodel interpolate` at points and on grids, and `stereodel contour`: lines of equal values."""

import geopandas
import numpy as np
import pytest
from scipy.io import netcdf_file

from stereodel import lonlat_to_xyz


@pytest.fixture
def values(folder):
    """The height z of 400 points of the unit sphere, linear in space."""
    rng = np.random.default_rng(3)
    lonlat = np.column_stack([rng.uniform(-180, 180, 400), np.degrees(np.arcsin(rng.uniform(-1, 1, 400)))])
    table = np.column_stack([lonlat, lonlat_to_xyz(lonlat)[:, 2]])
    np.savetxt(folder / "values.csv", table, delimiter=",", header="lon,lat,z", comments="", fmt="%.12g")
    return folder


@pytest.mark.parametrize("method", ["nearest", "linear", "smooth", "natural"])
def test_grid(values, method, run, rows):
    run("interpolate", "values.csv", "--value", "z", "--grid", 15, "--method", method, "-o", "grid.csv")
    table = rows((values / "grid.csv").read_text())
    lonlat = np.array([[float(row["lon"]), float(row["lat"])] for row in table])
    assert lonlat.shape == (24 * 13, 2)
    assert lonlat[0].tolist() == [-180, -90]
    assert lonlat[-1].tolist() == [165, 90]
    error = np.array([float(row["z"]) for row in table]) - np.sin(np.radians(lonlat[:, 1]))
    assert np.abs(error).max() < (0.35 if method == "nearest" else 0.05)


def test_netcdf(values, run, rows):
    options = ("interpolate", "values.csv", "--value", "z", "--grid", 5, "--box=170,-10,-170,10")
    run(*options, "-o", "grid.nc")
    with netcdf_file(values / "grid.nc", mmap=False) as file:
        assert file.variables["lon"].data.tolist() == [170, 175, 180, 185, 190]
        assert file.variables["lat"].units == b"degrees_north"
        text = rows(run(*options, "-o", "-"))
        assert [float(row["z"]) for row in text] == file.variables["z"].data.ravel().tolist()


def test_missing_values(folder, run, rows):
    (folder / "holes.csv").write_text("lon,lat,t\n0,0,1\n90,0,\n0,90,3\n", encoding="utf-8")
    options = ("interpolate", "holes.csv", "--value", "t", "--at", "holes.csv", "--method", "nearest", "-o", "-")
    message = run(*options, code=2)
    assert "holes.csv: row 2: the t is missing" in message
    assert "--skip-missing" in message
    assert [row["t"] for row in rows(run(*options, "--skip-missing"))] == ["1", "1", "3"]


def test_outside_is_empty(folder, run, rows):
    (folder / "three.csv").write_text("lon,lat,t\n0,0,1\n10,0,2\n0,10,3\n", encoding="utf-8")
    (folder / "at.csv").write_text("lon,lat\n2,2\n-170,2\n", encoding="utf-8")
    inside, outside = rows(run("interpolate", "three.csv", "--value", "t", "--at", "at.csv", "-o", "-"))
    assert 1 < float(inside["t"]) < 3
    assert outside["t"] == ""


def test_levels_and_multiples(folder, run):
    run("contour", "cities.csv", "--value", "people", "--levels", "2000000,5000000", "-o", "lines.gpkg")
    lines = geopandas.read_file(folder / "lines.gpkg")
    assert set(lines["level"]) == {2e6, 5e6}
    assert lines.is_valid.all()
    run("contour", "cities.csv", "--value", "people", "--interval", 2_000_000, "-o", "lines.geojson")
    levels = geopandas.read_file(folder / "lines.geojson")["level"]
    assert set(levels) == {2e6 * k for k in range(1, 8)}


def test_the_plane(folder, run):
    (folder / "plane.csv").write_text("x,y,z\n0,0,0\n2,0,4\n2,2,4\n0,2,0\n", encoding="utf-8")
    run("contour", "plane.csv", "--plane", "x", "y", "--value", "z", "--levels", "1", "-o", "lines.parquet")
    (line,) = geopandas.read_parquet(folder / "lines.parquet").geometry
    assert {x for x, _ in line.coords} == {0.5}
