"""HATS: catalogues that LSDB writes are read pixel by pixel, and LSDB reads and joins the second one."""

import shutil
import warnings
from contextlib import contextmanager

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel import SphericalVoronoi
from stereodel.interpolation import NaturalNeighborInterpolator
from stereodel.partitioned import triangulate
from stereodel.partitioned.hats import Catalogue, Pixel, hats_source, is_catalogue
from stereodel.partitioned.sources import read
from stereodel.sphere import lonlat_to_xyz

ROWS = 3000


@contextmanager
def quiet():
    """LSDB and its libraries warn of one another."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


@pytest.fixture(scope="module")
def lsdb():
    """Imported where it is needed: it takes seconds."""
    with quiet():
        import dask
        import lsdb
    with dask.config.set(scheduler="synchronous"):
        yield lsdb


@pytest.fixture(scope="module")
def table():
    """Points that are dense about one place, so that pixels are of several orders."""
    rng = np.random.default_rng(17)
    lon = np.concatenate([rng.uniform(0, 360, ROWS // 2), rng.normal(130, 4, ROWS // 2)]) % 360
    sines = np.concatenate([rng.uniform(-1, 1, ROWS // 2), np.sin(np.radians(rng.normal(-20, 4, ROWS // 2)))])
    identifiers = rng.permutation(ROWS) * 7 + 2**60
    return pd.DataFrame({"source_id": identifiers, "ra": lon, "dec": np.degrees(np.arcsin(sines))})


@pytest.fixture(scope="module")
def collection(lsdb, table, tmp_path_factory):
    """A collection as LSDB writes it: the catalogue and its margin."""
    folder = tmp_path_factory.mktemp("hats") / "sky"
    with quiet():
        catalogue = lsdb.from_dataframe(
            table,
            ra_column="ra",
            dec_column="dec",
            catalog_name="sky",
            lowest_order=0,
            highest_order=4,
            partition_rows=700,
            moc_max_order=4,
            margin_threshold=3600.0,
        )
        catalogue.write_catalog(folder, catalog_name="sky")
    return folder


@pytest.fixture
def copied(collection, tmp_path):
    """The catalogue alone, where it can be changed."""
    return shutil.copytree(collection / "sky", tmp_path / "sky")


def source_of(folder):
    return hats_source(folder, None, "sphere", "spherical")


@pytest.fixture
def opened(lsdb):
    """A function: what LSDB makes of a folder."""

    def opened(folder):
        with quiet():
            return lsdb.open_catalog(folder)

    return opened


def computed(catalogue):
    with quiet():
        return pd.DataFrame(catalogue.compute(progress_bar=False))


@pytest.mark.thorough
def test_points_are_those_of_the_table_in_the_order_of_pixels(collection, opened, table):
    source = source_of(collection)
    assert source.compact
    assert all("sky/dataset" in file.path for file in source.files)  # not the margin
    assert source.places.names == ("ra", "dec")
    assert len({pixel.order for pixel in source.catalogue.pixels}) > 2
    pixels = opened(collection).get_healpix_pixels()
    assert [(pixel.order, pixel.number) for pixel in source.catalogue.pixels] == [(p.order, p.pixel) for p in pixels]
    found, expected = [], []
    for file, pixel in zip(source.files, source.catalogue.pixels, strict=True):
        assert file.name == pixel.path(".parquet").as_posix()
        found += read(file, source.places, 0, file.rows)
        expected.append(pq.ParquetFile(file.path).read(columns=["source_id"])["source_id"].to_numpy())
    by_id = table.set_index("source_id").loc[np.concatenate(expected)]
    assert np.array_equal(np.concatenate(found), lonlat_to_xyz(by_id[["ra", "dec"]].to_numpy()))
    assert sum(file.rows for file in source.files) == ROWS


@pytest.fixture(scope="module")
def run(collection, tmp_path_factory):
    """From the folder to the second catalogue: pixels of the first are the partitions."""
    told = []
    out = tmp_path_factory.mktemp("out")
    run = triangulate(collection, out, keep=["source_id"], jobs=1, progress=lambda name, *_: told.append(name))
    assert run.statistics["compact"]
    assert "spread" not in told
    return run


@pytest.mark.thorough
def test_lsdb_joins_the_second_catalogue_pixel_by_pixel(collection, opened, table, run):
    """And finds each star's own cell, which is that of all points at once."""
    first, second = opened(collection), opened(run.folder / "rows")
    assert second.get_healpix_pixels() == first.get_healpix_pixels()
    assert second.name == "sky_voronoi"
    with quiet():
        joined = first.join(second, "source_id", "source_id", suffixes=("", "_2"), suffix_method="overlapping_columns")
        extended = first.load_extension(run.folder / "sky_voronoi.properties")
    assert joined.get_healpix_pixels() == first.get_healpix_pixels()
    assert list(extended.columns) == ["source_id", "ra", "dec", "area", "degree", "nearest", "distance", "kept"]
    diagram = SphericalVoronoi.from_lonlat(table[["ra", "dec"]].to_numpy())
    for found in (computed(joined), computed(extended)):
        assert len(found) == ROWS
        found = found.set_index("source_id").loc[table["source_id"]]
        assert found["area"].tolist() == pytest.approx(diagram.areas().tolist(), rel=1e-11)
        assert found["degree"].tolist() == np.diff(diagram.region_offsets).tolist()


@pytest.mark.thorough
def test_the_second_catalogue_is_one_for_hats(collection, run, tmp_path):
    """Its own check of files against each other, and the sky map of the first."""
    from hats.io.validation import is_valid_catalog

    rows = run.folder / "rows"
    with quiet():
        assert is_valid_catalog(rows, strict=True)
    assert (rows / "skymap.fits").read_bytes() == (collection / "sky" / "skymap.fits").read_bytes()
    assert source_of(rows).catalogue.pixels == source_of(collection).catalogue.pixels
    triangulate(collection, tmp_path / "out", jobs=1)
    assert not (tmp_path / "out" / "sky_voronoi.properties").exists()  # nothing identifies rows


@pytest.mark.thorough
def test_pixels_that_are_folders_of_files(copied, opened, run, tmp_path):
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
    triangulate(copied, tmp_path / "out", keep=["source_id"], jobs=1)
    found, expected = (
        computed(opened(out / "rows")).set_index("source_id")["area"] for out in (tmp_path / "out", run.folder)
    )
    assert found.loc[expected.index].tolist() == pytest.approx(expected.tolist(), rel=1e-11)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#HATS catalog\n! another\n\nhats_col_ra=RA\nhats_col_dec : DEC \n", {}),
        ("hats_col_ra RA\nhats_col_dec=\\\n   DEC\n", {}),
        (
            "  hats_col_ra = RA\nhats_col_dec=DEC\nbib_reference_url=https\\://a.b/c\\=d\n",
            {"bib_reference_url": "https://a.b/c=d"},
        ),
        ("hats_col_ra=RA\r\nhats_col_dec=DEC\r\nobs_title=a = b\r\n", {"obs_title": "a = b"}),
    ],
)
def test_properties_as_java_writes_them(tmp_path, text, expected):
    (tmp_path / "hats.properties").write_bytes(text.encode())
    catalogue = Catalogue.read(tmp_path)
    assert catalogue.properties == {"hats_col_ra": "RA", "hats_col_dec": "DEC"} | expected
    assert catalogue.pixels == ()


def test_a_catalogue_that_is_made_by_hand(tmp_path):
    """By day, as to import LSDB takes seconds."""
    (tmp_path / "hats.properties").write_text("hats_col_ra=ra\nhats_col_dec=dec\n")
    lonlat = np.array([[[350.0, 5], [340, 10]], [[80, 15], [90, 20]]])
    for number, places in enumerate(lonlat):
        path = tmp_path / Pixel(1, number).path(".parquet")
        path.parent.mkdir(parents=True, exist_ok=True)
        pq.write_table(pa.table({"ra": places[:, 0], "dec": places[:, 1]}), path)
    source = source_of(tmp_path)
    assert source.catalogue.pixels == (Pixel(1, 0), Pixel(1, 1))
    found = [np.concatenate(list(read(file, source.places, 0, file.rows))) for file in source.files]
    assert np.array_equal(found, lonlat_to_xyz(lonlat))


def test_pixels_share_folders_of_ten_thousand():
    assert Pixel(8, 123_456).path("/").as_posix() == "dataset/Norder=8/Dir=120000/Npix=123456"
    for pixel in (Pixel(0, 0), Pixel(8, 123_456), Pixel(29, 12 * 4**29 - 1)):
        assert Pixel.of_path(pixel.path(".snappy.parquet")) == pixel


@pytest.mark.thorough
def test_what_is_a_catalogue(collection, copied, tmp_path):
    """With the older name of its properties, and without its list of pixels, too."""
    expected = source_of(copied)
    (copied / "hats.properties").unlink()
    (copied / "partition_info.csv").unlink()
    found = source_of(copied)
    assert (found.catalogue.pixels, found.files) == (expected.catalogue.pixels, expected.files)
    assert is_catalogue(str(collection))
    assert is_catalogue(collection / "sky")
    assert not is_catalogue(tmp_path)
    assert not is_catalogue([collection])


@pytest.mark.thorough
def test_a_catalogue_of_targets(collection, opened, tmp_path, table):
    """Answers are a second catalogue, row by row, that LSDB reads."""
    lonlat = np.random.default_rng(3).uniform([-180, -90], [180, 90], (500, 2))
    heights = lonlat[:, 1] ** 2
    columns = {"lon": lonlat[:, 0], "lat": lonlat[:, 1], "height": heights}
    pq.write_table(pa.table(columns), tmp_path / "points.parquet")
    same = {"jobs": 1, "partition": 200}
    run = triangulate(tmp_path / "points.parquet", tmp_path / "out", index=True, **same)
    found = run.interpolate(collection, tmp_path / "heights", "height", method="natural", keep=["source_id"], **same)
    with quiet():
        told = opened(tmp_path / "heights" / "rows").compute().set_index("source_id")["height"]
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
