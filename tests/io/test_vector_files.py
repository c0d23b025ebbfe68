"""Files of GDAL's formats: cut files are errors or all rows, layers are found, and GDAL's words are heard."""

import gzip
import re
import sqlite3
import warnings
import zipfile
from contextlib import closing

import geopandas
import numpy as np
import pandas as pd
import pyogrio
import pytest

from stereodel.io import DataWarning, read_points
from stereodel.io.reading import shapes_of
from tests.tiers import by_day

ROWS = 60
CUTS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 0.999)
DRIVERS = dict.fromkeys((".shp", ".shp.zip"), "ESRI Shapefile") | dict.fromkeys((".kml", ".kmz"), "LIBKML")
DRIVERS |= {".fgb": "FlatGeobuf", ".geojson": "GeoJSON", ".parquet": None}
DRIVERS |= {f".{name.lower()}": name for name in ("GML", "GPKG", "GPX", "XLSX", "ODS")}
TABLES_ALONE = (".xlsx", ".ods")
TABLE = pd.DataFrame(
    {"name": [f"näme {k}" for k in range(ROWS)], "lon": np.arange(ROWS) * 3.0, "lat": np.linspace(-80, 80, ROWS)}
)


def frame(areas=False):
    geometry = geopandas.GeoSeries.from_xy(TABLE["lon"], TABLE["lat"])
    return geopandas.GeoDataFrame(TABLE[["name"]], geometry=geometry.buffer(0.2) if areas else geometry, crs=4326)


def written(path, ending, areas=False):
    """The file and those that belong to it."""
    if ending in TABLES_ALONE:
        pyogrio.write_dataframe(TABLE, path, driver=DRIVERS[ending])
    elif ending == ".parquet":
        frame(areas).to_parquet(path)
    else:
        frame(areas).to_file(path, driver=DRIVERS[ending], layer="waypoints" if ending == ".gpx" else None)
    return sorted(path.parent.glob(f"{path.name.split('.')[0]}.*"))


def rows_of(path, areas):
    return len(shapes_of(path).polygon_feature) if areas else len(read_points(path))


CUT = [(ending, False) for ending in DRIVERS]
CUT += [(ending, True) for ending in DRIVERS if ending not in (*TABLES_ALONE, ".gpx")]


@pytest.mark.parametrize(("ending", "areas"), by_day(CUT, (".gml", False), (".shp", True), (".fgb", False)))
def test_a_cut_file_is_an_error_or_has_all_rows(tmp_path, ending, areas):
    path = tmp_path / f"whole{ending}"
    files = [part for part in written(path, ending, areas) if part.suffix not in (".cpg", ".prj", ".xsd")]
    assert rows_of(path, areas) == ROWS
    for part in files:
        content, refused = part.read_bytes(), 0
        for share in CUTS:
            part.write_bytes(content[: int(len(content) * share)])
            for made in tmp_path.glob("*.gfs"):
                made.unlink()
            try:
                assert rows_of(path, areas) == ROWS, share
            except (ValueError, OSError):
                refused += 1
        assert refused > len(CUTS) / 2
        part.write_bytes(content)


def test_what_is_cut_is_named(tmp_path):
    for ending in (".gml", ".fgb", ".gml.gz"):
        plain = ".".join(ending.split(".")[:2])
        written(tmp_path / f"whole{plain}", plain)
        cut = (tmp_path / f"whole{plain}").read_bytes()[: 4000 if plain == ".gml" else 2500]
        path = tmp_path / f"cut{ending}"
        path.write_bytes(gzip.compress(cut) if ending.endswith(".gz") else cut)
        with pytest.raises(ValueError, match=r"damaged: (unclosed token|no element found|0 of its 60 rows)"):
            read_points(path)
        with path.open("rb") as stream, pytest.raises(ValueError, match="damaged: "):
            read_points(stream)
        with pytest.raises(ValueError, match=f"^{re.escape(str(path))}: the file is damaged: "):
            shapes_of(path)


def test_a_database_with_a_changed_definition(tmp_path):
    written(tmp_path / "a.gpkg", ".gpkg")
    whole = (tmp_path / "a.gpkg").read_bytes()
    (tmp_path / "a.gpkg").write_bytes(whole.replace(b"pixel_y_size DOUBLE", b"pixel_y_size DOUB\xccE"))
    with pytest.raises(ValueError, match=r"a\.gpkg: the database is damaged: "):
        read_points(tmp_path / "a.gpkg")


def test_shapefiles_with_a_cut_table(tmp_path):
    """GDAL reads no column where the header is cut."""
    frame().to_file(tmp_path / "a.shp")
    whole = (tmp_path / "a.dbf").read_bytes()
    for length in (0, 1, 20, 31, 50, 200, len(whole) // 2, len(whole) - 2):
        (tmp_path / "a.dbf").write_bytes(whole[:length])
        for path in (tmp_path / "a.shp", tmp_path):
            with pytest.raises(ValueError, match=r"a\.dbf is shorter than its header says"):
                read_points(path, format="vector")
    (tmp_path / "a.dbf").write_bytes(whole)
    (tmp_path / "b.dbf").write_bytes(b"cut")
    frame().to_file(tmp_path / "b.kml", driver="LIBKML")
    assert len(read_points(tmp_path / "a.shp")) == len(read_points(tmp_path / "b.kml")) == ROWS


@pytest.mark.parametrize(("kinds", "read"), [(76, True), (77, False), (300, False)])
def test_gpx_with_more_columns_than_gdal_reads(tmp_path, kinds, read):
    rows = "".join(f'<wpt lat="1" lon="2"><extensions><k{k}>1</k{k}></extensions></wpt>' for k in range(kinds))
    (tmp_path / "a.gpx").write_text(f'<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">{rows}</gpx>')
    if read:
        assert len(read_points(tmp_path / "a.gpx")) == kinds
    else:
        with pytest.raises(ValueError, match="no rows of GPX with 100 columns"):
            read_points(tmp_path / "a.gpx")


def test_a_folder_is_read_as_maps_are_and_no_other(tmp_path):
    written(tmp_path / "a.shp", ".shp")
    assert len(read_points(tmp_path)) == len(shapes_of(tmp_path).points) == ROWS
    (tmp_path / "none.csv").mkdir()
    with pytest.raises(ValueError, match="neither a file geodatabase nor shapefiles"):
        read_points(tmp_path / "none.csv")


def test_nothing_is_written_beside_a_file(tmp_path):
    """GDAL would write a.gfs, and go by it when a.gml is another file."""
    for ending in DRIVERS:
        folder = tmp_path / ending[1:].replace(".", "_")
        folder.mkdir()
        written(folder / f"a{ending}", ending)
        (folder / "a.xsd").unlink(missing_ok=True)
        before = sorted(folder.iterdir())
        assert len(read_points(folder / f"a{ending}")) == ROWS
        assert sorted(folder.iterdir()) == before


def test_damage_is_told_of_the_file_that_was_given(tmp_path):
    path = tmp_path / "a.kmz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("doc.kml", "<kml><Document><Placemark>")
    with pytest.raises(ValueError) as caught:
        read_points(path)
    assert str(caught.value).replace(str(path), "a.kmz").count("/") == 0


def test_sheets_and_layers_are_chosen_by_name(tmp_path):
    for ending, driver in ((".xlsx", "XLSX"), (".ods", "ODS"), (".gpkg", "GPKG")):
        path = tmp_path / f"two{ending}"
        pyogrio.write_dataframe(TABLE, path, layer="first", driver=driver)
        pyogrio.write_dataframe(TABLE.head(3), path, layer="Flughäfen", driver=driver, append=True)
        assert len(read_points(path, layer="Flughäfen")) == 3
        for reader in (read_points, shapes_of):
            with pytest.raises(ValueError, match="there are several layers, 'first', 'Flughäfen'; give a file with on"):
                reader(path)
        with pytest.raises(ValueError, match="layer is 'x', which is not one of 'first', 'Flughäfen'"):
            read_points(path, layer="x")
    frame().to_file(path, layer="places")  # tables beside them, such as styles, leave it the only one of the map
    assert len(read_points(path)) == ROWS
    assert len(read_points(path, layer="Flughäfen")) == 3


def test_layers_without_rows_are_left_out(tmp_path):
    frame().to_file(tmp_path / "waypoints.gpx", driver="GPX", layer="waypoints")
    assert read_points(tmp_path / "waypoints.gpx").lonlat.tolist() == TABLE[["lon", "lat"]].to_numpy().tolist()
    pyogrio.write_dataframe(TABLE.head(0), tmp_path / "sheets.xlsx", layer="notes", driver="XLSX")
    pyogrio.write_dataframe(TABLE, tmp_path / "sheets.xlsx", layer="data", driver="XLSX", append=True)
    assert len(read_points(tmp_path / "sheets.xlsx")) == ROWS


def test_words_of_gdal_are_errors_where_data_are_lost_and_heard_elsewhere(tmp_path, monkeypatch):
    written(tmp_path / "new.gpkg", ".gpkg")
    with closing(sqlite3.connect(tmp_path / "new.gpkg")) as base:
        base.execute("PRAGMA user_version=990000")
    with pytest.warns(DataWarning, match=r"GDAL says of the file: .* on 'new.gpkg' may only be partially supported"):
        assert len(read_points(tmp_path / "new.gpkg")) == ROWS
    read = pyogrio.read_dataframe

    def losing(*arguments, **options):
        warnings.warn("Value '1e400' of field 3 has been truncated to 24 characters.", RuntimeWarning, stacklevel=2)
        return read(*arguments, **options)

    written(tmp_path / "all.fgb", ".fgb")
    monkeypatch.setattr(pyogrio, "read_dataframe", losing)
    for reader in (read_points, shapes_of):
        with pytest.raises(ValueError, match="cannot be read without loss; GDAL says: Value '1e400' of field 3"):
            reader(tmp_path / "all.fgb")
