"""Files of strangers: unpacked within limits, and given to GDAL where they refer to no other file and no host.

GDAL goes by content, not by name, and knows formats that are nothing but references, such as virtual ones and services.
So the format is recognised here first, and every other is refused. What is packed, by gzip, bzip2 or zip, is unpacked
in pieces and within the limits of `stereodel.constants`.
"""

from __future__ import annotations

import bz2
import gzip
import io
import os
import re
import sqlite3
import struct
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import closing, contextmanager, nullcontext
from functools import cached_property, reduce
from pathlib import Path
from shutil import copyfileobj
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Any, Final
from zipfile import BadZipFile, ZipFile

from stereodel._arrays import as_choice
from stereodel._extras import optional
from stereodel.constants import MOST_COLUMNS, MOST_MEMBERS, UNPACKED_RATIO, UNPACKED_SIZE
from stereodel.io.formats import FileFormat, FormatName, Source
from stereodel.io.formats.names import listed

ZIP: Final = b"PK\x03\x04"
MARKS: Final[dict[bytes, Callable[..., Any]]] = {b"\x1f\x8b": gzip.open, b"BZh": bz2.open}  # what unpacks them
PIECE: Final = 1 << 20  # bytes that are unpacked at a time
# What unpacking raises for damaged, encrypted and unknown contents.
DAMAGED: Final = (OSError, EOFError, zlib.error, BadZipFile, NotImplementedError, RuntimeError, struct.error)
PACKED: Final = (".gz", ".bz2")  # extensions of compressed files
HEAD: Final = 1 << 20  # bytes from which a format is recognised; GDAL looks at fewer
# Marks of formats of GDAL that are references, by which it knows them wherever they stand in the head.
REFERRING: Final = re.compile(rb"<OGR\w*DataSource|gdal_streamed_alg", re.IGNORECASE)
# The name of the first element of an XML file, without its prefix.
ROOT: Final = re.compile(
    rb"(?>\s+|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^\[>]*+(?:\[.*?\])?\s*>)*+<(?:[\w.-]+:)?([\w.-]+)", re.DOTALL
)
ROOTS: Final = {b"kml": "kml", b"gpx": "gpx", b"FeatureCollection": "gml"}
# First bytes of the binary formats, and before them names of first elements of XML.
BINARY: Final = {b"SQLite format 3\0": "gpkg", b"fgb": "fgb", b"\x00\x00\x27\x0a": "shp", ZIP: "zip"}
MAIN: Final = (".shp", ".gpkg", ".sqlite", ".fgb", ".kml", ".gml", ".gpx")  # files in archives that are read
BESIDE: Final = (".shx", ".dbf", ".prj", ".cpg")  # endings of the other files of a shapefile
NAMED: Final = (".xlsx", ".ods", ".kmz")  # endings of formats that are zip archives themselves
CELL: Final = re.compile(rb"\br\s*=\s*[\"']([A-Za-z]{1,3})[0-9]")  # the column in the name of a cell of a spreadsheet
TEXT: Final = re.compile(rb"<si\b.*?</si>", re.DOTALL)
# The texts of a spreadsheet, and the number of its text in a cell.
OF_TEXT: Final = re.compile(rb"\bt\s*=\s*[\"']s[\"'][^<]*<v[^>]*>\s*([0-9]{1,9})")
SCHEMAS: Final = "GML_DOWNLOAD_SCHEMA"

# Virtual tables of SQLite that are indices. Others of GDAL and SpatiaLite are files and hosts.
INDEX: Final = re.compile(
    r'CREATE VIRTUAL TABLE (?:"[^"]*"|\w+) USING "?(?:rtree|fts\d)"?\s*\(.*', re.DOTALL | re.IGNORECASE
)
# A file somewhere else, by its path, in the text of a coordinate system.
GRID: Final = re.compile(
    rb'(?:PARAMETERFILE\["[^"]{0,255}",\s*"|PROJ4_GRIDS",\s*"|grids=|\+init=)[^"\s]{0,255}[/\\~]', re.IGNORECASE
)
INCLUDED: Final = re.compile(rb"<[\w.:-]*(?:include|redefine)\b")  # what makes one schema of XML part of another
# Tables whose rows are not stored: virtual ones, and views that may have no end or that GDAL reads for the layers.
MADE: Final = "sql LIKE '%VIRTUAL%TABLE%USING%' OR type = 'view' AND (sql LIKE '%RECURSIVE%' OR name LIKE 'gpkg_%')"
STORED: Final = "type = 'table' AND name IN ('gpkg_spatial_ref_sys', 'spatial_ref_sys')"  # tables of coordinate systems

_settings = Lock()


def unpacked(content: bytes) -> bytes:
    """What gzip or bzip2 packed; other bytes as they are."""
    opened = next((opened for mark, opened in MARKS.items() if content.startswith(mark)), None)
    if opened is None:
        return content
    result = bytearray()
    try:
        with opened(io.BytesIO(content)) as stream:
            while piece := stream.read(PIECE):
                result += piece
                check_size(len(result), len(content))
    except DAMAGED as error:
        raise ValueError(f"the compressed file is damaged: {error}") from error
    return bytes(result)


class SourceFile:
    """A source of rows: its format, and its bytes, read on demand."""

    def __init__(
        self, source: Source, formats: Mapping[FormatName, FileFormat], kind: FormatName | None = None
    ) -> None:
        self._source, self._formats = source, formats
        self.path = Path(source) if isinstance(source, str | os.PathLike) else None
        self.kind: FormatName = as_choice(kind or self._found(), tuple(formats), "format")

    def _found(self) -> FormatName:
        """The format from the extension of the path, ignoring that of compression, else from the first bytes."""
        kinds = {ending: kind for kind, known in self._formats.items() for ending in known.endings}
        if self.path is not None and self.path.is_dir():
            return "vector"
        endings = [ending.lower() for ending in self.path.suffixes[-2:]] if self.path is not None else []
        known = [ending for ending in endings if ending not in PACKED]
        return kinds.get(known[-1] if known else "") or kinds[self._ending]

    @cached_property
    def content(self) -> bytes:
        """The decompressed bytes."""
        content = self._source.read() if self.path is None else self.path.read_bytes()  # type: ignore[union-attr]
        return content.encode() if isinstance(content, str) else unpacked(content)

    @contextmanager
    def on_disk(self) -> Iterator[Path]:
        """Where GDAL finds the file, as it needs the extension of its format and any companion files."""
        if self.path is not None and self.path.suffix.lower() not in PACKED:
            if not self.path.is_dir():  # as some formats are
                self.path.open("rb").close()  # the system's own message says best why it cannot be read
            yield self.path
            return
        with TemporaryDirectory() as folder:
            within = Path(self.path.stem).suffix if self.path is not None else ""
            named = Path(folder, f"points{within or self._ending}")
            named.write_bytes(self.content)
            yield named

    @property
    def _ending(self) -> str:
        """The extension that matches the first bytes; XML may be KML or GPX, a zip archive a spreadsheet."""
        start = self.content[:64].lstrip(b"\xef\xbb\xbf \t\r\n")
        marks = {mark: ending for known in self._formats.values() for mark, ending in known.marks.items()}
        found = next((ending for mark, ending in marks.items() if start.startswith(mark)), ".csv")
        if found == ".zip" and b"xl/workbook.xml" in self.content:
            return ".xlsx"
        if found == ".zip" and b"opendocument.spreadsheet" in self.content[:100]:
            return ".ods"
        return ".gpx" if found == ".kml" and b"<gpx" in self.content[:1000] else found


@contextmanager
def _archive(path: Path) -> Iterator[ZipFile]:
    """A zip archive with members whose number and size stay within the limits."""
    try:
        with ZipFile(path) as archive:
            members = archive.infolist()
            if len(members) > MOST_MEMBERS:
                raise ValueError(f"the archive has {len(members)} members; {MOST_MEMBERS} are the most")
            check_size(sum(member.file_size for member in members), path.stat().st_size)
            yield archive
    except DAMAGED as error:
        raise ValueError(f"the archive is damaged: {error}") from error


def check_size(size: int, packed: int) -> None:
    """A ValueError for a file of `packed` bytes that holds far more, `size`."""
    most = max(UNPACKED_SIZE, UNPACKED_RATIO * packed)
    if size > most:
        said = f"the file would unpack to more than {most} bytes, {UNPACKED_RATIO} times its size"
        raise ValueError(f"{said}; if you trust it, unpack it first, or save it in another format")


@contextmanager
def self_contained(path: Path) -> Iterator[Path]:
    """Where GDAL reads a file, if its format is known and refers to nothing; else ValueError."""
    with TemporaryDirectory() as folder:
        inner = Path(folder)
        if path.is_dir():
            kind = _kind_of_folder(path)
        elif (kind := _kind_of(path)) == "zip":
            path, kind = _of_archive(path, inner)
        elif path.suffix.lower() in NAMED:
            # GDAL takes the ending for the format, or the format for damaged.
            raise ValueError(f"the file is not what its name ends in, {path.suffix}; rename it")
        if "!" in str(path.absolute()):
            raise ValueError("the path has an exclamation mark, which stands for archives in GDAL; rename it")
        with _without_schemas() if kind == "gml" else nullcontext():
            source = _apart(path, inner / "apart") if kind == "gml" else path.absolute()
            try:
                yield source
            except ValueError as error:  # without the folder that GDAL names
                raise ValueError(str(error).replace(f"{source.parent}{os.sep}", "")) from error


def _apart(path: Path, folder: Path) -> Path:
    """A GML file and its companions by links, as GDAL writes the columns that it finds into a file beside."""
    folder.mkdir()
    try:
        for part in filter(Path.is_file, (path, path.with_suffix(".xsd"), path.with_suffix(".gfs"))):
            (folder / part.name).symlink_to(part.absolute())
    except OSError:  # Windows lets few users make links
        return path.absolute()
    return folder / path.name


def check_crs(crs: Any) -> None:
    """A ValueError if a coordinate system that stands in a file names another file by its path."""
    text = crs if isinstance(crs, str | bytes) else "" if crs is None else crs.to_wkt()
    if GRID.search(text if isinstance(text, bytes) else text.encode("utf-8", "replace")):
        raise ValueError("the coordinate system of the file names another file by its path, which is not opened")


def _kind_of(path: Path) -> str:
    """The format of a file, by its first bytes."""
    with path.open("rb") as file:
        head = file.read(HEAD)
    kind = next((kind for mark, kind in BINARY.items() if head.startswith(mark)), None)
    if root := ROOT.match(head.removeprefix(b"\xef\xbb\xbf")):
        kind = ROOTS.get(root[1], "gml" if b"opengis.net/gml" in head else None)
    if kind is None or REFERRING.search(head):
        raise ValueError("the file is damaged, or of a format that is not read; write it as GeoPackage, say")
    if kind == "gpkg":
        _check_tables(path)
    elif kind in ("shp", "fgb", "gml"):
        beside = path.with_suffix(".prj")
        check_crs(beside.read_bytes()[:HEAD] if kind == "shp" and beside.is_file() else head)
    schema = path.with_suffix(".xsd")
    if kind == "gml" and schema.is_file() and INCLUDED.search(schema.read_bytes()):
        raise ValueError(f"the schema beside it, {schema.name}, includes another file, which is not opened")
    return kind


def _kind_of_folder(path: Path) -> str:
    """The format of a folder: a file geodatabase, or shapefiles."""
    if path.suffix.lower() != ".gdb" and not any(path.glob("*.shp")):
        raise ValueError("the folder is of a format that is not read: neither a file geodatabase nor shapefiles")
    for part in path.glob("*.prj"):
        check_crs(part.read_bytes()[:HEAD])
    return "folder"


def _check_tables(path: Path) -> None:
    """A ValueError for a database with a table that is kept elsewhere."""
    with _base(path) as base:
        tables = base.execute(f"SELECT name, sql FROM sqlite_master WHERE {MADE}").fetchall()
        for (name,) in base.execute(f"SELECT name FROM sqlite_master WHERE {STORED}").fetchall():
            check_crs(" ".join(map(str, base.execute(f"SELECT * FROM {name}").fetchall())))
    for name, sql in tables:
        if not INDEX.fullmatch(sql):
            raise ValueError(f"the table {name!r} is not stored in the file, but made, and could be any other file")


@contextmanager
def _base(path: Path) -> Iterator[sqlite3.Connection]:
    """A database, only to be read; a ValueError where it is damaged."""
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro&immutable=1", uri=True)) as base:
            yield base
    except (sqlite3.Error, UnicodeError) as error:
        raise ValueError(f"the database is damaged: {error}") from error


def check_stored(path: Path, layers: Iterable[str]) -> None:
    """A ValueError for a layer of a database that is computed, and may be of any size."""
    with path.open("rb") if path.is_file() else nullcontext() as file:
        if file is None or BINARY.get(file.read(16)) != "gpkg":
            return
    with _base(path) as base:
        every = "SELECT lower(name), type, sql FROM sqlite_master WHERE type IN ('table', 'view')"
        known = {name: (kind, sql) for name, kind, sql in base.execute(every)}
    for layer in layers:
        kind, sql = known.get(layer.lower(), ("table", ""))
        if kind != "table" or re.search(r"\bAS\s*\(", sql, re.IGNORECASE):
            raise ValueError(f"the layer {layer!r} is not stored in the file, but computed; save it as a table")


def _of_archive(path: Path, folder: Path) -> tuple[Path, str]:
    """A zip archive as what GDAL reads: a copy without packing, or the one file that is in it, and its format."""
    if path.suffix.lower() in NAMED:
        copy = folder / f"{path.stem}{path.suffix.lower()}"
        # Member by member, so that the table of contents says what is in it.
        with _archive(path) as archive, ZipFile(copy, "w") as plain:
            for member in archive.infolist():
                with archive.open(member) as source, plain.open(member.filename, "w") as into:
                    copyfileobj(source, into, PIECE)
        _check_cells(copy, path.stat().st_size)
        return copy, "zip"
    with _archive(path) as archive:
        names = [name for name in archive.namelist() if not name.startswith("__MACOSX/")]
        files = [Path(archive.extract(name, folder)) for name in names if name.lower().endswith((*MAIN, *BESIDE))]
    found = [file for file in files if file.suffix.lower() in MAIN]
    kinds = {_kind_of(file) for file in found}
    if not found:
        raise ValueError(f"the archive holds no file that is read; such files end in {', '.join(MAIN)}")
    if len(found) > 1 and (kinds != {"shp"} or len({file.parent for file in found}) > 1):
        several = listed([file.name for file in found])
        raise ValueError(f"the archive holds several files, {several}; unpack one of them")
    if "zip" in kinds:
        raise ValueError("the archive holds another archive; unpack it first")
    return (found[0] if len(found) == 1 else found[0].parent), kinds.pop()


def _check_cells(path: Path, packed: int) -> None:
    """A ValueError for a spreadsheet (.xlsx) with far more empty cells than others: GDAL makes room for all of them.

    So it does for text that stands once and is the value of many cells.
    """
    with ZipFile(path) as archive:
        names, letters = archive.namelist(), 0
        texts = (archive.read(name) for name in names if name.endswith("sharedStrings.xml"))
        shared = [len(each) for text in texts for each in TEXT.findall(text)]
        for name in names:
            if "worksheets/" in name:
                sheet = archive.read(name)
                cells = CELL.findall(sheet)
                # The number of a column, 1 for A.
                numbers = (reduce(lambda number, letter: 26 * number + letter - 64, c.upper(), 0) for c in set(cells))
                width = max(numbers, default=0)
                if b"\0" in sheet or width * sheet.count(b"<row") > UNPACKED_RATIO * len(cells) + MOST_COLUMNS:
                    raise ValueError("the spreadsheet is nearly empty, with cells far apart; save it as CSV")
                counts = Counter(map(int, OF_TEXT.findall(sheet)))
                letters += sum(shared[number] * count for number, count in counts.items() if number < len(shared))
    check_size(letters, packed)


@contextmanager
def _without_schemas() -> Iterator[None]:
    """Keep GDAL from asking the host that GML names for its schema. Its settings are those of the whole process."""
    pyogrio = optional("pyogrio", "geo")
    with _settings:
        before = pyogrio.get_gdal_config_option(SCHEMAS)
        pyogrio.set_gdal_config_options({SCHEMAS: "NO"})
        try:
            yield
        finally:
            pyogrio.set_gdal_config_options({SCHEMAS: before})
