"""HATS: catalogues as the hats library lays them out are read pixel by pixel; rows are aligned with their files."""

import shutil
import warnings
from functools import partial

import duckdb
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel import SphericalVoronoi
from stereodel.interpolation import NaturalNeighborInterpolator
from stereodel.partitioned.files import read
from stereodel.partitioned.hats import catalogue, hats_source, is_catalogue, path_of, pixels
from stereodel.sphere import lonlat_to_xyz
from tests.partitioned.answers import executed, serially

ROWS = 3000


quiet = partial(warnings.catch_warnings, action="ignore")
"""The hats library and those it uses warn of one another."""


@pytest.fixture(scope="module")
def table():
    """Points that are dense about one place, so that pixels are of several orders."""
    rng = np.random.default_rng(17)
    lon = np.concatenate([rng.uniform(0, 360, ROWS // 2), rng.normal(130, 4, ROWS // 2)]) % 360
    sines = np.concatenate([rng.uniform(-1, 1, ROWS // 2), np.sin(np.radians(rng.normal(-20, 4, ROWS // 2)))])
    identifiers = rng.permutation(ROWS) * 7 + 2**60
    return pd.DataFrame({"source_id": identifiers, "ra": lon, "dec": np.degrees(np.arcsin(sines))})


@pytest.fixture(scope="module")
def hats():
    """Imported where it is needed: it takes seconds."""
    with quiet():
        import hats
    return hats


@pytest.fixture(scope="module")
def collection(hats, table, tmp_path_factory):
    """A collection by the writers of the hats library: the catalogue, and a margin that is described alone."""
    folder = tmp_path_factory.mktemp("hats") / "sky"
    from hats.catalog import PartitionInfo, TableProperties
    from hats.catalog.dataset.collection_properties import CollectionProperties
    from hats.io.paths import pixel_catalog_file
    from hats.pixel_math import HealpixPixel, generate_alignment, generate_histogram
    from hats.pixel_math.healpix_pixel_function import sort_pixels
    from hats.pixel_math.healpix_shim import radec2pix

    aligned = generate_alignment(generate_histogram(table, 4), highest_order=4, threshold=700)
    found = [HealpixPixel(*place[:2]) for place in aligned[radec2pix(4, table["ra"], table["dec"])]]
    pixels = list(sort_pixels(list(set(found))))
    for pixel in pixels:
        path = pixel_catalog_file(folder / "sky", pixel)
        path.parent.mkdir(parents=True, exist_ok=True)
        table[[each == pixel for each in found]].to_parquet(path, index=False)
    PartitionInfo.from_healpix(pixels).write_to_file(catalog_path=folder / "sky")
    told = {"ra_column": "ra", "dec_column": "dec", "total_rows": ROWS}
    TableProperties(catalog_name="sky", catalog_type="object", **told).to_properties_file(folder / "sky")
    margin = TableProperties(
        catalog_name="sky_3600arcs", catalog_type="margin", primary_catalog="sky", margin_threshold=3600.0, **told
    )
    (folder / margin.catalog_name).mkdir()
    margin.to_properties_file(folder / margin.catalog_name)
    CollectionProperties(
        name="sky", hats_primary_table_url="sky", all_margins=[margin.catalog_name], default_margin=margin.catalog_name
    ).to_properties_file(folder)
    return folder


@pytest.fixture
def copied(collection, tmp_path):
    """The catalogue alone, where it can be changed."""
    return shutil.copytree(collection / "sky", tmp_path / "sky")


def source_of(folder):
    return hats_source(folder, None, "sphere", "spherical")


@pytest.mark.thorough
def test_points_are_those_of_the_table_in_the_order_of_pixels(hats, collection, table):
    source = source_of(collection)
    assert source.compact
    assert all("sky/dataset" in file.path for file in source.files)  # not the margin
    assert source.columns.names == ("ra", "dec")
    ours = pixels(catalogue(collection)[0])
    assert len({order for order, _ in ours}) > 2
    with quiet():
        theirs = hats.read_hats(collection / "sky").get_healpix_pixels()
    assert ours == [(p.order, p.pixel) for p in theirs]
    found, expected = [], []
    for file, pixel in zip(source.files, ours, strict=True):
        assert file.name == path_of(*pixel).as_posix()
        found += read(file, source.columns, 0, file.rows)
        expected.append(pq.ParquetFile(file.path).read(columns=["source_id"])["source_id"].to_numpy())
    by_id = table.set_index("source_id").loc[np.concatenate(expected)]
    assert np.array_equal(np.concatenate(found), lonlat_to_xyz(by_id[["ra", "dec"]].to_numpy()))
    assert sum(file.rows for file in source.files) == ROWS


@pytest.fixture(scope="module")
def run(collection, tmp_path_factory):
    """Pixels are the partitions."""
    told = []
    out = tmp_path_factory.mktemp("out")
    run = serially(collection, out, keep=["source_id"], progress=lambda name, *_: told.append(name))
    assert run.statistics["compact"]
    assert "spread" not in told
    return run


@pytest.mark.thorough
def test_rows_are_joined_by_the_column_that_is_kept(collection, table, run):
    """Each star has its own cell, that of all points at once; a file has the rows of its pixel, in order."""
    stars, cells = (f"'{folder}/dataset/*/*/*.parquet'" for folder in (collection / "sky", run.folder / "rows"))
    joined = f"SELECT source_id, ra, area, degree FROM {stars} JOIN {cells} USING (source_id)"
    with duckdb.connect() as base:
        found = base.sql(joined).df().set_index("source_id").loc[table["source_id"]]
    diagram = SphericalVoronoi.from_lonlat(table[["ra", "dec"]].to_numpy())
    assert found["ra"].tolist() == table["ra"].tolist()
    assert found["area"].tolist() == pytest.approx(diagram.areas().tolist(), rel=1e-11)
    assert found["degree"].tolist() == np.diff(diagram.region_offsets).tolist()
    for file in source_of(collection).files:
        told = pq.ParquetFile(run.folder / "rows" / file.name).read()
        assert told.column_names == ["source_id", "area", "degree", "nearest", "distance", "kept"]
        assert told["source_id"] == pq.ParquetFile(file.path).read()["source_id"]


@pytest.mark.thorough
def test_pixels_that_are_folders_of_files(copied, run, tmp_path):
    whole = source_of(copied)
    for file in whole.files:
        table, path = pq.ParquetFile(file.path).read(), copied / file.name
        path.unlink()
        folder = path.with_suffix("")
        folder.mkdir()
        pq.write_table(table.slice(0, 10), folder / "part0.parquet")
        pq.write_table(table.slice(10), folder / "part1.parquet")
        (folder / "_SUCCESS").touch()
    properties = copied / "hats.properties"
    properties.write_text(properties.read_text().replace("npix_suffix=.parquet", "npix_suffix=/"))
    source = source_of(copied)
    assert len(source.files) == 2 * len(whole.files)
    assert source.files[1].name == whole.files[0].name.removesuffix(".parquet") + "/part1.parquet"
    again = serially(copied, tmp_path / "out", keep=["source_id"])
    assert again.rows().to_table() == run.rows().to_table()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#HATS catalog\n! another\n\nhats_col_ra=RA\n  hats_col_dec = DEC \n", {}),
        ("hats_col_ra=RA\r\nhats_col_dec=DEC\r\nobs_title=a = b\r\n", {"obs_title": "a = b"}),
    ],
)
def test_properties(tmp_path, text, expected):
    (tmp_path / "hats.properties").write_bytes(text.encode())
    (tmp_path / "partition_info.csv").write_text("Norder,Npix\n")
    assert catalogue(tmp_path) == (tmp_path, {"hats_col_ra": "RA", "hats_col_dec": "DEC"} | expected)
    assert pixels(tmp_path) == []


def test_a_catalogue_that_is_made_by_hand(tmp_path):
    """By day, as to import hats takes seconds; rows are those of plain Parquet."""
    sky, out = tmp_path / "sky", tmp_path / "out"
    sky.mkdir()
    (sky / "hats.properties").write_text("hats_col_ra=ra\nhats_col_dec=dec\n")
    (sky / "partition_info.csv").write_text("Norder,Npix\n1,0\n1,1\n")
    lonlat = np.array([[[350.0, 5], [340, 10]], [[80, 15], [90, 20]]])
    for number, places in enumerate(lonlat):
        path = sky / path_of(1, number)
        path.parent.mkdir(parents=True, exist_ok=True)
        names = [f"{number}a", f"{number}b"]
        pq.write_table(pa.table({"ra": places[:, 0], "dec": places[:, 1], "star": names}), path)
    source = source_of(sky)
    found = [np.concatenate(list(read(file, source.columns, 0, file.rows))) for file in source.files]
    assert np.array_equal(found, lonlat_to_xyz(lonlat))
    run = serially(sky, out, rows=["area"], keep=["star"])
    plain = serially(sky, tmp_path / "plain", kind="parquet", columns=["ra", "dec"], rows=["area"])
    expected = {"star": ["0a", "0b", "1a", "1b"], "area": plain.rows().to_table()["area"].to_pylist()}
    assert run.rows().to_table().to_pydict() == expected
    rows = sorted(path.relative_to(out / "rows") for path in (out / "rows").rglob("*") if path.is_file())
    assert rows == [path_of(1, number) for number in (0, 1)]


@pytest.mark.thorough
def test_what_is_a_catalogue(collection, copied, tmp_path):
    """With the older name of its properties, too."""
    expected = source_of(copied).files
    (copied / "hats.properties").unlink()
    assert source_of(copied).files == expected
    assert is_catalogue(str(collection))
    assert is_catalogue(collection / "sky")
    assert not is_catalogue(tmp_path)
    assert not is_catalogue([collection])


@pytest.mark.thorough
def test_a_catalogue_of_targets(collection, tmp_path, table):
    lonlat = np.random.default_rng(3).uniform([-180, -90], [180, 90], (500, 2))
    heights = lonlat[:, 1] ** 2
    columns = {"lon": lonlat[:, 0], "lat": lonlat[:, 1], "height": heights}
    pq.write_table(pa.table(columns), tmp_path / "points.parquet")
    same = {"jobs": 1, "partition": 200}
    run = serially(tmp_path / "points.parquet", tmp_path / "out", index=True, **same)
    found = executed(
        run.interpolate, collection, tmp_path / "heights", "height", method="natural", keep=["source_id"], **same
    )
    told = found.rows().to_table().to_pandas().set_index("source_id")["height"]
    function = NaturalNeighborInterpolator.from_lonlat(lonlat, heights)
    expected = function(lonlat=table[["ra", "dec"]].to_numpy())
    assert np.array_equal(told.loc[table["source_id"]].to_numpy(), expected)
    assert found.statistics["compact"]


WRONG = {
    "hats_nrows is 5, but its files hold 3000 rows": ("hats.properties", f"hats_nrows={ROWS}", "hats_nrows=5"),
    "hats_col_dec is missing": ("hats.properties", "hats_col_dec=dec\n", ""),
    "columns has 'de', which is not one of": ("hats.properties", "hats_col_dec=dec\n", "hats_col_dec=de\n"),
    "line 2: Norder and Npix must be whole numbers": ("partition_info.csv", "Npix\n", "Npix\n0,x\n"),
    "there is no such file, but partition_info.csv has": ("partition_info.csv", "Npix\n", "Npix\n1,47\n"),
}


@pytest.mark.thorough
@pytest.mark.parametrize("message", WRONG)
def test_what_is_wrong_with_a_catalogue(copied, message):
    name, old, new = WRONG[message]
    text = (copied / name).read_text()
    assert old in text
    (copied / name).write_text(text.replace(old, new))
    with pytest.raises((ValueError, FileNotFoundError), match=message):
        source_of(copied)


@pytest.mark.thorough
def test_what_a_catalogue_cannot_be(collection, tmp_path):
    margin = next(path for path in collection.iterdir() if path.name.startswith("sky_"))
    (tmp_path / "alone").mkdir()
    shutil.copy(collection / "collection.properties", tmp_path / "alone")
    for source, surface, message in [
        (margin, "sphere", "is a catalogue of type 'margin', not of points"),
        (tmp_path, "sphere", r"there is no hats\.properties, so it is no HATS catalogue"),
        (tmp_path / "alone", "sphere", "hats_primary_table_url is 'sky', no catalogue beside it"),
        ([collection], "sphere", "source is a list of 1, but a HATS catalogue is one folder"),
        (collection, "plane", "surface is 'plane', but a HATS catalogue is on the sphere"),
    ]:
        with pytest.raises(ValueError, match=message):
            hats_source(source, None, surface, "spherical")
