"""`stereodel interpolate` at points and on grids, and `stereodel contour`: lines of equal values."""

import geopandas
import numpy as np
import pytest
import rasterio
from scipy.interpolate import griddata
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
    options = ("--grid", 15, "--bounds", "world", "--method", method)
    run("interpolate", "values.csv", "--value", "z", *options, "-o", "grid.csv")
    table = rows((values / "grid.csv").read_text())
    lonlat = np.array([[float(row["lon"]), float(row["lat"])] for row in table])
    assert lonlat.shape == (24 * 13, 2)
    assert lonlat[0].tolist() == [-180, -90]
    assert lonlat[-1].tolist() == [165, 90]
    error = np.array([float(row["z"]) for row in table]) - np.sin(np.radians(lonlat[:, 1]))
    assert np.abs(error).max() < (0.35 if method == "nearest" else 0.05)


def test_netcdf(values, run, rows):
    options = ("interpolate", "values.csv", "--value", "z", "--grid", 5, "--bounds=170,-10,-170,10")
    run(*options, "-o", "grid.nc")
    with netcdf_file(values / "grid.nc", mmap=False) as file:
        assert file.variables["lon"].data.tolist() == [170, 175, 180, 185, 190]
        assert file.variables["lat"].units == b"degrees_north"
        text = rows(run(*options, "-o", "-"))
        assert [float(row["z"]) for row in text] == file.variables["z"].data.ravel().tolist()


def test_a_grid_covers_the_points(values, run, rows):
    """By default it has the multiples of its spacing around them, as the numbers are written."""
    text = "lon,lat,z\n5.87,47.31,1\n15.04,47.3,2\n6.1,55.02,3\n14.9,54.9,4\n"
    (values / "german.csv").write_text(text, encoding="utf-8")
    found = rows(run("interpolate", "german.csv", "--value", "z", "--grid", 0.1, "-o", "-"))
    assert list(dict.fromkeys(row["lon"] for row in found)) == [str(k / 10) for k in range(58, 152)]
    assert list(dict.fromkeys(row["lat"] for row in found)) == [str(k / 10) for k in range(473, 552)]
    assert run.said == ""
    cells = rows(run("interpolate", "german.csv", "--value", "z", "--grid", 0.1, "--centers", "-o", "-"))
    assert (cells[0]["lon"], cells[0]["lat"], cells[-1]["lon"], cells[-1]["lat"]) == ("5.85", "47.35", "15.05", "55.05")


def test_a_grid_across_the_180th_meridian(values, run, rows):
    """Where the points lie there, the smaller arc is taken, with a note whose option gives the same."""
    (values / "fiji.csv").write_text("lon,lat,z\n177.2,-17.7,1\n-179.1,-19,2\n178.5,-16.2,3\n181.2,-16,4\n")
    for kind in ((), ("--centers",)):
        options = ("interpolate", "fiji.csv", "--value", "z", "--grid", "1", "--method", "nearest", *kind, "-o", "-")
        found = run(*options)
        half = len(kind) / 2
        assert {float(row["lon"]) for row in rows(found)} == set(np.arange(177 + half, 182.1 - half))
        said = "note: the points lie on both sides of the 180th meridian, and so does the grid; "
        assert run.said == f"{said}--bounds=177,-19,-178,-16 says the same\n"
        assert run(*options, "--bounds=177,-19,-178,-16") == found
        assert run.said == ""
    run("interpolate", "values.csv", "--value", "z", "--grid", "0.5", "-o", "all.csv")  # all over the Earth
    lon = {float(row["lon"]) for row in rows((values / "all.csv").read_text())}
    assert (min(lon), max(lon), len(lon), run.said) == (-180, 179.5, 720, "")


@pytest.mark.parametrize("kind", ["tif", "nc", "csv"])
def test_a_grid_of_the_plane(rng, folder, run, rows, kind):
    points = np.column_stack([rng.uniform(3_410_000, 3_553_000, 90), rng.uniform(5_300_000, 5_422_000, 90)])
    points = np.concatenate([points, [[3_410_000, 5_300_000], [3_553_001, 5_422_000]]])
    values = 2 * points[:, 0] - points[:, 1]
    text = "".join(f"{x!r},{y!r},{v!r}\n" for (x, y), v in zip(points.tolist(), values.tolist(), strict=True))
    (folder / "gk.csv").write_text(f"east,north,v\n{text}", encoding="utf-8")
    table = ("interpolate", "gk.csv", "--plane", "east", "north", "--crs", "EPSG:31467", "--value", "v")
    run(*table, "--grid", "5000", "--unit", "m", "-o", f"grid.{kind}")
    x, y = np.arange(3_410_000, 3_556_000, 5000), np.arange(5_300_000, 5_426_000, 5000)
    expected = griddata(points, values, tuple(np.meshgrid(x, y)), "linear")
    if kind == "csv":
        found = rows((folder / "grid.csv").read_text())
        assert list(found[0]) == ["east", "north", "v"]
        assert [(float(row["east"]), float(row["north"])) for row in found[:2]] == [(x[0], y[0]), (x[1], y[0])]
        got = np.array([float(row["v"] or "nan") for row in found]).reshape(expected.shape)
    else:
        with rasterio.open(folder / "grid.tif" if kind == "tif" else f"netcdf:{folder / 'grid.nc'}:v") as file:
            assert file.crs.to_epsg() == 31467
            assert file.units == ("m",)
            assert file.xy(0, 0) == (x[0], y[-1])
            assert file.xy(*(size - 1 for size in file.shape)) == (x[-1], y[0])
            got = file.read(1)[::-1]
    assert np.allclose(got, expected, equal_nan=True, rtol=1e-9)
    cells = ("--grid", "5000", "--centers", "--bounds=3400000,5300000,3420000,5310000", "-o", "-")
    found = rows(run(*table, "--method", "nearest", *cells))
    assert [(row["east"], row["north"]) for row in found[:2]] == [("3402500", "5302500"), ("3407500", "5302500")]
    assert len(found) == 8


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
    (folder / "none.csv").write_text("lon,lat,t\n0,0,\n1,1,\n", encoding="utf-8")
    for levels in (("--levels", 1), ("--interval", 1)):
        said = run("contour", "none.csv", "--value", "t", *levels, "--skip-missing", "-o", "none.geojson", code=1)
        assert said == "none.csv: no lines: no level lies between the values\n"


def test_the_plane(folder, run):
    (folder / "plane.csv").write_text("x,y,z\n0,0,0\n2,0,4\n2,2,4\n0,2,0\n", encoding="utf-8")
    run("contour", "plane.csv", "--plane", "x", "y", "--value", "z", "--levels", "1", "-o", "lines.parquet")
    (line,) = geopandas.read_parquet(folder / "lines.parquet").geometry
    assert {x for x, _ in line.coords} == {0.5}
