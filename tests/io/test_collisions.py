"""Columns whose names are taken: every writer keeps the place that was computed with, and loses nothing."""

import warnings

import geopandas
import numpy as np
import pytest

from stereodel import PlanarVoronoi, SphericalVoronoi
from stereodel.io import PointTable, read_points, write
from stereodel.io.formats.names import RenamedColumnWarning

LONLAT = np.array([[10.0, 48.4], [-78.5, -0.2], [135.8, 35.0], [115.9, -32.0]])
TAKEN = {
    "lon": [99.0, 98.0, 97.0, 96.0],
    "LAT": [88.0, 87.0, 86.0, 85.0],
    "area": [1, 2, 3, 4],
    "point": [5, 6, 7, 8],
    "geometry": ["a", "b", "c", "d"],
    "fid": [4, 4, 4, 4],
    "geom": [1, 1, 1, 2],
    "name": ["Ulm", "Quito", "Kyoto", "Perth"],
    "Name": ["U", "Q", "K", "P"],
}
FORMATS = ("csv", "geojson", "geojsonl", "parquet", "gpkg", "fgb")


def kept(columns):
    """What columns hold, whatever they are called: no name, no order, no type."""
    return sorted(sorted(map(plain, np.asarray(values).tolist())) for values in columns.values())


def plain(value):
    """A value as text, whole numbers without a fraction."""
    return f"{value:g}" if isinstance(value, int | float) else str(value)


def told(said):
    return [warning for warning in said if issubclass(warning.category, RenamedColumnWarning)]


@pytest.mark.parametrize("kind", FORMATS)
def test_tables_keep_their_places_and_columns(tmp_path, kind):
    path = tmp_path / f"table.{kind}"
    for columns in (TAKEN, *({name: values} for name, values in TAKEN.items() if kind in ("gpkg", "csv"))):
        table = PointTable(LONLAT, columns)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            write(path, table)
        found = read_points(path, **({"lon": "lon", "lat": "lat"} if kind == "csv" else {}))
        order = np.argsort(found.lonlat[:, 0])  # FlatGeobuf has its own
        assert np.array_equal(found.lonlat[order], LONLAT[np.argsort(LONLAT[:, 0])])
        assert kept(found.columns) == kept(table.columns)
        assert (not told(said)) == (list(found.columns) == list(columns))


@pytest.mark.parametrize("kind", FORMATS)
def test_cells_keep_everything(tmp_path, kind):
    path = tmp_path / f"cells.{kind}"
    diagram = SphericalVoronoi.from_lonlat(LONLAT)
    with pytest.warns(RenamedColumnWarning):
        write(path, diagram, columns=TAKEN)
    read = {"csv": lambda path: read_points(path).columns, "parquet": geopandas.read_parquet}
    found = read.get(kind, geopandas.read_file)(path)
    columns = {key: np.asarray(found[key]) for key in found if kind == "csv" or key != "geometry"}
    assert np.allclose(np.sort(columns["area"]), np.sort(diagram.areas()), rtol=1e-12)
    for values in TAKEN.values():
        assert sorted(map(plain, values)) in kept(columns)


def test_cells_of_the_plane_keep_their_coordinates(tmp_path):
    diagram = PlanarVoronoi([[0, 0], [4, 0], [0, 4], [4, 4.5]])
    with pytest.warns(RenamedColumnWarning, match="'x' is written as 'x_1' and 'area' as 'area_1'"):
        write(tmp_path / "cells.csv", diagram, columns={"x": [7, 7, 7, 7], "area": [8, 8, 8, 8]})
    found = (tmp_path / "cells.csv").read_text(encoding="utf-8").splitlines()
    assert found[0] == "x,y,area,x_1,area_1"
    assert found[2].startswith("4,0.0,")


def test_shapefiles_say_which_names_they_cut(tmp_path):
    table = PointTable(LONLAT, {"a_very_long_name": [1, 2, 3, 4], "a_very_long_name_too": [5, 6, 7, 8]})
    with pytest.warns(RenamedColumnWarning, match="as long as the format allows"):
        write(tmp_path / "table.shp", table)
    assert kept(read_points(tmp_path / "table.shp").columns) == kept(table.columns)
