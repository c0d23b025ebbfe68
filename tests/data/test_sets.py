"""The real sets: whole as stored, what their columns say, and that they can be triangulated; how they are stored."""

import dataclasses
import hashlib
import io
import lzma
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from stereodel import angular_distance, data, lonlat_to_xyz
from stereodel.data import stored
from tests.examples import examples
from tools.data_sets import dump

FOLDER = Path(stored.__file__).parent
OTHERS = {"countries_50m", "countries_110m", "blue_marble"}
"""Stored as lines that several sets share (tests/data/test_natural_earth.py), or as a picture (below)."""


def loaded(name):
    kind, _, resolution = name.partition("_")
    return getattr(data, kind)(*filter(None, [resolution]))


@pytest.mark.parametrize("name", data.sources())
def test_files_are_those_of_the_table(name):
    entry = data.sources()[name]
    packed = (FOLDER / entry["file"]).read_bytes()
    assert (len(packed), hashlib.sha256(packed).hexdigest()) == (entry["bytes"], entry["sha256"])
    assert entry["licence"]
    assert entry["source"]


def test_every_file_is_in_the_table_and_all_are_small():
    files = {path.name for path in FOLDER.iterdir() if path.suffix not in (".py", ".md", ".json", "")}
    assert files == {entry["file"] for entry in data.sources().values()}
    assert sum((FOLDER / name).stat().st_size for name in files) < 6e6


def test_another_file_is_refused(monkeypatch):
    wrong = {**stored.table()["stars"], "sha256": "0"}
    monkeypatch.setattr(stored, "table", lambda: {"stars": wrong})
    with pytest.raises(OSError, match=r"stars.npz.xz is not what its SHA-256 says; install stereodel again"):
        stored.load("stars")


@pytest.mark.parametrize("name", sorted(data.sources().keys() - OTHERS))
def test_columns_are_of_one_length_and_nobody_can_change_them(name):
    table = loaded(name)
    assert len(table.lonlat) == data.sources()[name]["rows"]
    for field in dataclasses.fields(table):
        column = getattr(table, field.name)
        assert not column.flags.writeable
        assert len(column) == len(table.lonlat) or hasattr(table, "__geo_interface__")
    assert loaded(name).lonlat is table.lonlat
    assert np.abs(table.lonlat[:, 1]).max() <= 90
    with pytest.raises(dataclasses.FrozenInstanceError):
        table.lonlat = None


def test_population():
    table = data.cities()
    assert table.population.min() == 0
    assert 4e9 < table.population.sum(dtype=np.int64) < 5e9
    tokyo = angular_distance(lonlat_to_xyz(table.lonlat), lonlat_to_xyz((139.69, 35.69))).argmin()
    assert 5e6 < table.population[tokyo] < 2e7


KNOWN = [
    (
        "airports",
        {"icao": "EGLL", "iata": "LHR", "name": "London Heathrow Airport", "country": "GB"},
        (-0.4619, 51.4706),
    ),
    ("airports", {"icao": "NZSP", "iata": "", "name": "South Pole Station Airport", "country": "AQ"}, (0.0, -90.0)),
    ("stars", {"hip": 11767, "magnitude": 2.1, "color_index": 0.6}, (37.946, 89.264)),  # Polaris
    ("stars", {"hip": 27989, "magnitude": 0.4, "color_index": 1.5}, (88.793, 7.407)),  # Betelgeuse
    ("stars", {"hip": 24436, "magnitude": 0.2, "color_index": 0.0}, (78.634, -8.202)),  # Rigel
]


@pytest.mark.parametrize(("name", "columns", "place"), KNOWN)
def test_a_known_row(name, columns, place):
    table, key = loaded(name), next(iter(columns))
    (row,) = np.flatnonzero(getattr(table, key) == columns[key])
    np.testing.assert_allclose(table.lonlat[row], place, atol=1e-3)
    for column, value in columns.items():
        tolerance = {"magnitude": 0.3, "color_index": 0.1}.get(column)
        assert getattr(table, column)[row] == (value if tolerance is None else pytest.approx(value, abs=tolerance))


def unpacked(columns):
    return dict(np.load(io.BytesIO(lzma.decompress(dump(columns)))))


@examples(0.4)
@given(st.lists(st.integers(-(2**31), 2**31 - 1), max_size=20))
def test_integers(values):
    found = stored.integers(unpacked({"n": np.array(values, dtype=np.int64)})["n"])
    assert found.dtype == np.int32
    assert found.tolist() == values


@examples(0.4)
@given(
    st.lists(st.text(st.characters(blacklist_characters="\n\0", blacklist_categories=["Cs"])), min_size=1, max_size=9)
)
def test_texts(values):
    assert stored.texts(unpacked({"t": values})["t"]).tolist() == values


@examples(0.4)
@given(st.lists(st.integers(-180 * 10**6, 180 * 10**6), min_size=1, max_size=20))
def test_decimals_are_what_their_text_says(values):
    written = [f"{'-' * (v < 0)}{abs(v) // 10**6}.{abs(v) % 10**6:06d}" for v in values]
    found = stored.decimals(unpacked({"n": np.array(values)})["n"], 6)
    assert found.tolist() == [float(text) for text in written]


def test_the_same_bytes_every_time():
    columns = {"n": np.arange(1000), "t": ["a", "ä"]}
    assert dump(columns) == dump(columns)


def test_the_picture_fits_the_map():
    """What is land and what is sea agree best where the picture is not moved at all."""
    lon, lat = np.arange(-178.0, 178.0), np.arange(-55.0, 60.0)
    land = shapely.geometry.shape(data.land())
    shapely.prepare(land)
    wanted = shapely.contains_xy(land, *np.meshgrid(lon, lat))

    def agreement(east, north):
        i = ((90 - lat - north) * 1024 / 180).astype(int)
        j = ((lon + east + 180) * 2048 / 360).astype(int)
        red, green, blue = np.moveaxis(data.blue_marble()[np.ix_(i, j)].astype(int), -1, 0)
        return np.mean((blue <= np.maximum(red, green)) == wanted)

    shares = {(east, north): agreement(east, north) for east in (-1, 0, 1) for north in (-1, 0, 1)}
    assert max(shares, key=shares.get) == (0, 0)
    assert shares[0, 0] > 0.95
