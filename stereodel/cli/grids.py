"""Regular grids of longitude and latitude, and values on them as files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from stereodel import lonlat_to_xyz
from stereodel._arrays import FloatArray, as_scalar, as_steps
from stereodel._files import replacing
from stereodel.cli.options import Latitude, box_of
from stereodel.cli.sources import LONLAT
from stereodel.cli.tables import save_table

GRIDS = ("csv", "nc")


@dataclass(frozen=True, eq=False)
class Grid:
    """Longitudes (w,) from west to east, running on past 180, and latitudes (h,) from south to north."""

    lon: FloatArray
    lat: FloatArray

    @classmethod
    def of(cls, spacing: float, box: str | None) -> Grid:
        """The grid of the whole Earth, -180 without 180, or of a box "W,S,E,N" with its borders."""
        if box is None:
            steps = as_steps(180.0, spacing, "--grid")
            return cls(np.arange(-steps, steps) * 180.0 / steps, np.linspace(-90.0, 90.0, steps + 1))
        west, south, east, north = box_of(box, "--box")
        return cls(_steps(west, east, spacing), _steps(south, north, spacing))

    @property
    def lonlat(self) -> FloatArray:
        """All places (h·w, 2), west to east in rows from south to north."""
        lon, lat = np.meshgrid(self.lon, self.lat)
        return np.column_stack([lon.ravel(), lat.ravel()])

    def points(self, latitude: Latitude) -> FloatArray:
        """All places as unit vectors (h·w, 3)."""
        return lonlat_to_xyz(self.lonlat, latitude=latitude.value)


def save_grid(path: Path, grid: Grid, columns: dict[str, FloatArray]) -> None:
    """Write values (h·w,) by name, as a table or as NetCDF with CF attributes."""
    if path.suffix.lower() == ".csv":
        save_table(path, LONLAT, dict(zip(LONLAT, grid.lonlat.T, strict=True)) | columns)
        return
    from scipy.io import netcdf_file

    with replacing(path) as temporary, netcdf_file(temporary, "w", version=2) as file:
        file.Conventions = "CF-1.8"
        axes = (("lat", grid.lat, "degrees_north", "latitude"), ("lon", grid.lon, "degrees_east", "longitude"))
        for name, places, units, meaning in axes:
            file.createDimension(name, len(places))
            axis = file.createVariable(name, "f8", (name,))
            axis[:], axis.units, axis.standard_name = places, units, meaning
        for name, values in columns.items():
            variable = file.createVariable(name, "f8", ("lat", "lon"))
            variable[:], variable._FillValue = values.reshape(len(grid.lat), len(grid.lon)), np.nan


def _steps(low: float, high: float, spacing: float) -> FloatArray:
    """From low in steps of `spacing` up to high, high included where the steps reach it."""
    step = as_scalar(spacing, "--grid", low=0.0, high=high - low, open_low=True)
    # A border that the steps miss by rounding alone is reached.
    count = int(np.floor((high - low) / step + 1e-9))
    places: FloatArray = np.minimum(low + step * np.arange(count + 1), high)
    return places
