"""Packed files: gzip, bzip2 and zip, unpacked in pieces and within the limits of `stereodel.constants`."""

from __future__ import annotations

import bz2
import gzip
import io
import struct
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import copyfileobj
from typing import Any, Final
from zipfile import BadZipFile, ZipFile

from stereodel.constants import MOST_MEMBERS, UNPACKED_RATIO, UNPACKED_SIZE

ZIP: Final = b"PK\x03\x04"
MARKS: Final[dict[bytes, Callable[..., Any]]] = {b"\x1f\x8b": gzip.open, b"BZh": bz2.open}
"""First bytes of packed files, and what unpacks them."""

PIECE: Final = 1 << 20
"""Bytes that are unpacked at a time."""

DAMAGED: Final = (OSError, EOFError, zlib.error, BadZipFile, NotImplementedError, RuntimeError, struct.error)
"""What unpacking raises for damaged, encrypted and unknown contents."""


def unpacked(content: bytes) -> bytes:
    """What gzip or bzip2 packed; other bytes as they are."""
    opened = next((opened for mark, opened in MARKS.items() if content.startswith(mark)), None)
    if opened is None:
        return content
    pieces, size = [], 0
    try:
        with opened(io.BytesIO(content)) as stream:
            while piece := stream.read(PIECE):
                pieces.append(piece)
                size += len(piece)
                check_size(size, len(content))
    except DAMAGED as error:
        raise ValueError(f"the compressed file is damaged: {error}") from error
    return b"".join(pieces)


def extract(path: Path, folder: Path, endings: tuple[str, ...]) -> list[Path]:
    """Unpack the members of a zip archive that have one of these endings, and say where they are."""
    with _archive(path) as archive:
        names = [
            name for name in archive.namelist() if name.lower().endswith(endings) and not name.startswith("__MACOSX/")
        ]
        return [Path(archive.extract(name, folder)) for name in names]


def pack_anew(path: Path, target: Path) -> None:
    """Copy a zip archive member by member, so that its table of contents says what is in it, and without packing."""
    with _archive(path) as archive, ZipFile(target, "w") as copy:
        for member in archive.infolist():
            with archive.open(member) as source, copy.open(member.filename, "w") as into:
                copyfileobj(source, into, PIECE)


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
        raise ValueError(
            f"the file would unpack to more than {most} bytes, {UNPACKED_RATIO} times its size; "
            "if you trust it, unpack it first, or save it in another format"
        )
