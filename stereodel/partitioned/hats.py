"""HATS catalogues: Parquet in pixels of HEALPix, with files that describe them (IVOA note "HATS", version 1.0).

    hats.properties               what the catalogue is; older ones call it properties
    partition_info.csv            its pixels
    dataset/Norder=k/Dir=d/Npix=n.parquet    the rows of pixel n of order k; a folder of files where so said

A collection is a folder of several catalogues; its primary one is read. Its pixels are the partitions.
"""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import Final

from stereodel.partitioned.files import FilesGiven, PointColumns, PointFile, Source, Surface, find_columns, opened
from stereodel.sphere.latitudes import Latitude

COLLECTION: Final = "collection.properties"

PIXELS: Final = "partition_info.csv"

COORDINATES: Final = ("hats_col_ra", "hats_col_dec")
"""Properties that name the columns of right ascension and declination, in degrees."""


def path_of(order: int, number: int, suffix: str = ".parquet") -> Path:
    """Where the rows of a pixel are in a catalogue: a file, or a folder of files if the suffix is "/"."""
    folder = number // 10_000 * 10_000
    return Path("dataset", f"Norder={order}", f"Dir={folder}", f"Npix={number}{suffix.rstrip('/')}")


def catalogue(folder: Path) -> tuple[Path, dict[str, str]]:
    """Where ``hats.properties`` and ``dataset`` are, the primary ones of a collection, and the properties."""
    described = _described(folder)
    if described is None and (folder / COLLECTION).is_file():
        primary = _properties(folder / COLLECTION).get("hats_primary_table_url", "")
        if not primary or not _described(folder / primary):
            where = f"{folder / COLLECTION}: hats_primary_table_url is {primary!r}"
            raise ValueError(f"{where}, no catalogue beside it")
        return catalogue(folder / primary)
    if described is None:
        raise ValueError(f"{folder}: there is no hats.properties, so it is no HATS catalogue")
    properties = _properties(described)
    kind = properties.get("dataproduct_type", "object")
    if kind not in ("object", "source"):  # whose rows are points of their own; a margin repeats those of other pixels
        raise ValueError(f"{described}: is a catalogue of type {kind!r}, not of points; give the one that it is of")
    for name in COORDINATES:
        if not properties.get(name):
            raise ValueError(f"{described}: {name} is missing; it names the column of the coordinate")
    return folder, properties


def _files(folder: Path, suffix: str) -> list[PointFile]:
    """The files of all pixels, those of a pixel by name."""
    files = []
    for path in (folder / path_of(*pixel, suffix) for pixel in pixels(folder)):
        within = path.rglob("*") if path.is_dir() else [path]
        found = sorted(each for each in within if each.is_file() and each.name[0] not in "._")
        if not found:
            where = f"{path}: there is no such file, but {PIXELS} has that pixel"
            raise FileNotFoundError(f"{where}; the catalogue is incomplete")
        files += [PointFile.of(each, each.relative_to(folder).as_posix()) for each in found]
    return files


def hats_source(given: FilesGiven, names: tuple[str, ...] | None, surface: Surface, latitude: Latitude) -> Source:
    """A HATS catalogue or collection: its pixels in the order of ``partition_info.csv``."""
    if not isinstance(given, str | os.PathLike):
        raise ValueError(f"source is a list of {len(given)}, but a HATS catalogue is one folder")
    if surface != "sphere":
        raise ValueError(f"surface is {surface!r}, but a HATS catalogue is on the sphere")
    folder, properties = catalogue(Path(given))
    files = _files(folder, properties.get("hats_npix_suffix") or ".parquet")
    count, stated = sum(file.rows for file in files), properties.get("hats_nrows", "")
    if stated.isdecimal() and int(stated) != count:
        held = f"but its files hold {count} rows"
        raise ValueError(f"{given}: hats_nrows is {stated}, {held}; the catalogue is incomplete")
    chosen = names or tuple(properties[name] for name in COORDINATES)
    if not files:
        return Source((), PointColumns("lonlat", chosen, surface, latitude))
    columns = find_columns(opened(files[0].path).schema_arrow, chosen, surface, latitude)
    return Source(tuple(files), columns, compact=True)


def is_catalogue(given: FilesGiven) -> bool:
    """Whether what is given is the folder of a HATS catalogue, or of a collection of them."""
    if not isinstance(given, str | os.PathLike):
        return False
    return _described(Path(given)) is not None or Path(given, COLLECTION).is_file()


def _described(folder: Path) -> Path | None:
    """The file that describes the catalogue in a folder, if there is one; older ones have a shorter name."""
    names = ("hats.properties", "properties")
    return next((folder / name for name in names if (folder / name).is_file()), None)


def pixels(folder: Path) -> list[tuple[int, int]]:
    """Orders and numbers of the pixels that ``partition_info.csv`` lists, in its order, which is that of the rows."""
    path = folder / PIXELS
    with path.open(encoding="utf-8", newline="") as file:
        rows = csv.DictReader(file)
        try:
            return list(dict.fromkeys((int(row["Norder"]), int(row["Npix"])) for row in rows))
        except (KeyError, TypeError, ValueError):
            raise ValueError(f"{path}: line {rows.line_num}: Norder and Npix must be whole numbers") from None


def _properties(path: Path) -> dict[str, str]:
    """A file of properties: ``name=value`` in lines, comments behind # or !."""
    pairs = (line.partition("=") for line in path.read_text(encoding="utf-8").splitlines())
    return {name.strip(): value.strip() for name, _, value in pairs if name.lstrip()[:1] not in "#!"}
