"""HATS catalogues: Parquet in pixels of HEALPix, with files that describe them (IVOA note "HATS", version 1.0).

    hats.properties               what the catalogue is; older ones call it properties
    partition_info.csv            its pixels
    dataset/Norder=k/Dir=d/Npix=n.parquet    the rows of pixel n of order k; a folder of files where so said

A collection is a folder of several catalogues; its primary one is read. Its pixels are the partitions.
"""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Self

from stereodel.partitioned.places import Places, Surface, find_places
from stereodel.partitioned.sources import Given, PointFile, Source, opened
from stereodel.sphere.latitudes import Latitude

PROPERTIES: Final = ("hats.properties", "properties")
"""Names of the file that describes a catalogue, the newer one first."""

COLLECTION: Final = "collection.properties"

PIXELS: Final = "partition_info.csv"

DATASET: Final = "dataset"

KINDS: Final = ("object", "source")
"""Of catalogues whose rows are points of their own; a margin repeats those of other pixels."""

FOLDER_SIZE: Final = 10_000
"""Pixels that share a folder ``Dir``."""


@dataclass(frozen=True, order=True)
class Pixel:
    """A pixel of HEALPix in the NESTED scheme.

    >>> Pixel(5, 10_417).path(".parquet").as_posix()
    'dataset/Norder=5/Dir=10000/Npix=10417.parquet'
    """

    order: int
    number: int

    def path(self, suffix: str) -> Path:
        """Where its rows are, from the folder of the catalogue: a file, or a folder of files if the suffix is "/"."""
        folder = self.number // FOLDER_SIZE * FOLDER_SIZE
        return Path(DATASET, f"Norder={self.order}", f"Dir={folder}", f"Npix={self.number}{suffix.rstrip('/')}")

    @classmethod
    def of_path(cls, path: Path) -> Self | None:
        """The pixel whose rows are at a path, or in a folder; None for other files."""
        found = re.search(r"Norder=(\d+)/Dir=\d+/Npix=(\d+)", path.as_posix())
        return None if found is None else cls(int(found[1]), int(found[2]))


@dataclass(frozen=True, eq=False)
class Catalogue:
    """A HATS catalogue on disk.

    folder: where ``hats.properties`` and ``dataset`` are.
    properties: as the file has them.
    pixels: in the order of ``partition_info.csv``, which is that of the rows.
    """

    folder: Path
    properties: Mapping[str, str]
    pixels: tuple[Pixel, ...]

    @classmethod
    def read(cls, folder: Path) -> Self:
        """The catalogue in a folder, or the primary one of a collection.

        Raises ValueError for a folder that is none, a catalogue of another kind than points, such as a margin, and one
        without the columns of its points.
        """
        if not _described(folder) and (folder / COLLECTION).is_file():
            primary = _properties(folder / COLLECTION).get("hats_primary_table_url", "")
            if not primary or not _described(folder / primary):
                raise ValueError(
                    f"{folder / COLLECTION}: hats_primary_table_url is {primary!r}, no catalogue beside it"
                )
            return cls.read(folder / primary)
        described = _described(folder)
        if described is None:
            raise ValueError(f"{folder}: there is no hats.properties, so it is no HATS catalogue")
        properties = _properties(described)
        kind = properties.get("dataproduct_type", "object")
        if kind not in KINDS:
            raise ValueError(f"{described}: is a catalogue of type {kind!r}, not of points; give the one that it is of")
        for name in ("hats_col_ra", "hats_col_dec"):
            if not properties.get(name):
                raise ValueError(f"{described}: {name} is missing; it names the column of the coordinate")
        return cls(folder, properties, tuple(_pixels(folder)))

    @property
    def columns(self) -> tuple[str, str]:
        """The columns of right ascension and declination, degrees."""
        return self.properties["hats_col_ra"], self.properties["hats_col_dec"]

    @property
    def suffix(self) -> str:
        """The ending of pixels' names; "/" where each is a folder of files."""
        return self.properties.get("hats_npix_suffix") or ".parquet"

    def files(self) -> list[Path]:
        """The files of all pixels, those of a pixel by name: from the catalogue's folder.

        Raises FileNotFoundError where a pixel's is not there, as in a catalogue that was copied in part.
        """
        return [path.relative_to(self.folder) for pixel in self.pixels for path in self._files_of(pixel)]

    def _files_of(self, pixel: Pixel) -> Sequence[Path]:
        path = self.folder / pixel.path(self.suffix)
        if path.is_dir():
            found = sorted(each for each in path.rglob("*") if each.is_file() and each.name[0] not in "._")
        else:
            found = [path] if path.is_file() else []
        if not found:
            raise FileNotFoundError(
                f"{path}: there is no such file, but {PIXELS} has that pixel; the catalogue is incomplete"
            )
        return found


def hats_source(given: Given, columns: Sequence[str] | None, surface: Surface, latitude: Latitude) -> Source:
    """A HATS catalogue or collection: its pixels in the order of ``partition_info.csv``.

    Raises ValueError if the folder is not a catalogue of points, has another number of rows than it states, or is for
    the plane.
    Raises FileNotFoundError for a pixel without its file.
    """
    if not isinstance(given, str | os.PathLike):
        raise ValueError(f"source is a list of {len(given)}, but a HATS catalogue is one folder")
    if surface != "sphere":
        raise ValueError(f"surface is {surface!r}, but a HATS catalogue is on the sphere")
    catalogue = Catalogue.read(Path(given))
    files = tuple(PointFile.of(catalogue.folder / path, path.as_posix()) for path in catalogue.files())
    count, told = sum(file.rows for file in files), catalogue.properties.get("hats_nrows", "")
    if told.isdecimal() and int(told) != count:
        raise ValueError(f"{given}: hats_nrows is {told}, but its files hold {count} rows; the catalogue is incomplete")
    names = catalogue.columns if columns is None else tuple(columns)
    if not files:
        return Source((), Places("lonlat", names, surface, latitude))
    places = find_places(opened(files[0].path).schema_arrow, names, surface, latitude)
    return Source(files, places, compact=True)


def is_catalogue(given: Given) -> bool:
    """Whether what is given is the folder of a HATS catalogue, or of a collection of them."""
    if not isinstance(given, str | os.PathLike):
        return False
    return _described(Path(given)) is not None or Path(given, COLLECTION).is_file()


def _described(folder: Path) -> Path | None:
    """The file that describes the catalogue in a folder, if there is one."""
    return next((folder / name for name in PROPERTIES if (folder / name).is_file()), None)


def _pixels(folder: Path) -> list[Pixel]:
    """The pixels that ``partition_info.csv`` lists; without it those that there are, in the order of the sky."""
    listed = folder / PIXELS
    if not listed.is_file():
        found = {Pixel.of_path(path.relative_to(folder)) for path in (folder / DATASET).glob("Norder=*/Dir=*/Npix=*")}
        return sorted((pixel for pixel in found if pixel is not None), key=_along_the_curve)
    with listed.open(encoding="utf-8", newline="") as file:
        rows = csv.DictReader(file)
        try:
            pixels = [Pixel(int(row["Norder"]), int(row["Npix"])) for row in rows]
        except (KeyError, TypeError, ValueError):
            raise ValueError(f"{listed}: line {rows.line_num}: Norder and Npix must be whole numbers") from None
    return list(dict.fromkeys(pixels))


def _along_the_curve(pixel: Pixel) -> tuple[int, int]:
    """Where a pixel begins among those of the highest order, as catalogues sort them."""
    return pixel.number << 2 * (29 - pixel.order), pixel.order


def _properties(path: Path) -> dict[str, str]:
    r"""A file of properties as Java has them: ``name=value`` in lines, comments behind # or !, escapes by \."""
    text = path.read_text(encoding="utf-8")
    lines = re.sub(r"\\\r?\n[ \t]*", "", text).splitlines()
    pairs = (
        re.match(r"\s*((?:\\.|[^\\:=\s])+)\s*[:=\s]\s*(.*?)\s*$", line)
        for line in lines
        if line.lstrip()[:1] not in "#!"
    )
    return {_plain(pair[1]): _plain(pair[2]) for pair in pairs if pair is not None}


def _plain(text: str) -> str:
    return re.sub(r"\\(.)", r"\1", text)
