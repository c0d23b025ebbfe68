"""Grids of values, read back by the programs that they are for."""

import numpy as np
import pytest
import rasterio
import xarray as xr

from stereodel.io import Grid, PointTable, write
from stereodel.io.formats.names import RenamedColumnWarning


def filled(grid):
    """Values that tell their place: 1000 times the longitude and the latitude."""
    lon, lat = np.moveaxis(grid.lonlat, -1, 0)
    return Grid(grid.lon, grid.lat, {"place": 1000 * lon + lat, "lat2": lat**2}, {"place": "m"}, grid.centers)


GRIDS = {
    "nodes": Grid.regular(5),
    "cells": Grid.regular(0.75, centers=True),
    "box": Grid.regular(0.5, (-10, 35, 20, 60)),
    "box of cells": Grid.regular(0.5, (-10, 35, 20, 60), centers=True),
    "across 180": Grid.regular(2, (170, -10, -170, 10), centers=True),
}


@pytest.mark.parametrize("name", GRIDS)
@pytest.mark.parametrize("kind", ["tif", "nc"])
def test_gdal_finds_each_value_in_its_place(tmp_path, name, kind):
    grid = filled(GRIDS[name])
    path = tmp_path / f"grid.{kind}"
    write(path, grid)
    with rasterio.open(path if kind == "tif" else f"netcdf:{path}:place") as file:
        assert file.crs.to_epsg() == 4326
        assert file.units[0] == "m"
        assert np.isnan(file.nodata)
        values = file.read(1)
        rows, columns = np.indices(values.shape)
        lon, lat = file.xy(rows.ravel(), columns.ravel())
        assert np.allclose(values.ravel(), 1000 * np.array(lon) + lat, atol=1e-6)
        if kind == "tif":
            assert file.descriptions == ("place", "lat2")
            assert file.tags()["AREA_OR_POINT"] == ("Area" if grid.centers else "Point")
        if name == "cells":
            assert tuple(file.bounds) == (-180, -90, 180, 90)
        if name == "box of cells":
            assert tuple(file.bounds) == (-10, 35, 20, 60)


@pytest.mark.parametrize("name", GRIDS)
def test_xarray_reads_what_it_is_given(tmp_path, name):
    grid = filled(GRIDS[name])
    write(tmp_path / "grid.nc", grid)
    with xr.open_dataset(tmp_path / "grid.nc") as found:
        xr.testing.assert_identical(found.load(), grid.to_xarray())
        assert found["place"].attrs == {"long_name": "place", "grid_mapping": "crs", "units": "m"}
        assert found["lon"].attrs["standard_name"] == "longitude"
        assert ("lat_bnds" in found) == grid.centers


@pytest.mark.parametrize(
    ("lonlat", "spacing", "centers", "lon", "lat"),
    [
        ([[0, 0], [3, 1]], 2, False, (0, 4), (0, 2)),
        ([[3, 1]], 2, True, (3, 3), (1, 1)),
        ([[4, 2]], 2, True, (5, 5), (3, 3)),  # on an edge of cells: one is there nonetheless
        ([[4, 90]], 2, True, (5, 5), (89, 89)),
        ([[0, -90], [1, 90]], 7, False, (0, 7), (-90, 85)),  # no latitude beyond a pole
        (np.column_stack([range(-180, 181, 60), [0] * 7]), 60, False, (-180, 120), (0, 60)),  # no meridian twice
        (np.column_stack([range(-180, 181, 60), [1] * 7]), 60, True, (-150, 150), (30, 30)),
        ([[-180, 0], [180, 0], [0, 0]], 60, False, (0, 180), (0, 60)),
        ([[0, 0], [180, 0]], 90, False, (0, 180), (0, 90)),  # as wide across 180: not across
        ([[359, 0], [2, 0]], 1, False, (-1, 2), (0, 1)),
        ([[-120, 0], [-20, 0], [70, 0], [150, 0]], 10, False, (-20, 240), (0, 10)),  # 100 degrees are empty
        ([[-120, 0], [-40, 0], [40, 0], [150, 0]], 10, False, (150, 400), (0, 10)),
        ([[-120, 0], [-40, 0], [40, 0], [125, 0]], 10, False, (-120, 130), (0, 10)),  # 85 degrees are not enough
    ],
)
@pytest.mark.filterwarnings("ignore:the points lie on both sides")
def test_the_extent_of_points(lonlat, spacing, centers, lon, lat):
    grid = Grid.regular(spacing, of=PointTable(lonlat), centers=centers)
    assert (grid.lon[0], grid.lon[-1]) == lon
    assert (grid.lat[0], grid.lat[-1]) == lat


@pytest.mark.filterwarnings("ignore::stereodel.io.RenamedColumnWarning")
def test_a_plane_without_a_coordinate_system(tmp_path):
    table = PointTable([[-3.5, 200.0], [1.0, 203.0]], surface="plane")
    grid = Grid.regular(0.5, of=table)
    write(tmp_path / "grid.nc", Grid(grid.lon, grid.lat, {"x": grid.places[..., 0]}, surface="plane"))
    with xr.open_dataset(tmp_path / "grid.nc") as found:
        assert "crs" not in found
        assert found["x_1"].attrs == {"long_name": "x"}
        assert (found["x_1"] == found["x"]).all()
        assert found["x"].attrs["axis"] == "X"
    with pytest.raises(ValueError, match="the grid is one of a plane"):
        _ = grid.lonlat


def test_names_that_are_taken(tmp_path):
    grid = Grid([0, 1], [0, 1], {"lat": np.ones((2, 2)), "crs": np.zeros((2, 2))})
    with pytest.warns(RenamedColumnWarning, match="'lat' is written as 'lat_1' and 'crs' as 'crs_1'"):
        write(tmp_path / "grid.nc", grid)
