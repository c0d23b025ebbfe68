"""Grids of values, read back by the programs that they are for."""

import numpy as np
import pytest
import rasterio
import xarray as xr

from stereodel.io import Grid, write
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


def test_missing_values(tmp_path):
    grid = Grid([0, 1], [0, 1], {"z": [[1.0, np.nan], [3.0, 4.0]]})
    for kind in ("csv", "nc", "tif"):
        write(tmp_path / f"grid.{kind}", grid)
    assert (tmp_path / "grid.csv").read_text(encoding="utf-8").splitlines()[1:3] == ["0,0,1", "1,0,"]
    with rasterio.open(tmp_path / "grid.tif") as file:
        assert file.read(1, masked=True).mask.tolist() == [[False, False], [False, True]]


def test_names_that_are_taken(tmp_path):
    grid = Grid([0, 1], [0, 1], {"lat": np.ones((2, 2)), "crs": np.zeros((2, 2))})
    with pytest.warns(RenamedColumnWarning, match="'lat' is written as 'lat_1' and 'crs' as 'crs_1'"):
        write(tmp_path / "grid.nc", grid)
