"""Atomic writing of files."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

from stereodel._extras import optional

ENDING: Final = ".tmp"
"""Suffix of temporary names."""


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Provide a temporary file to write to; move it into place at the end, remove it after an error.

    The temporary file is created in advance in the folder of the target, under an unpredictable name, so that no
    planted file is written to. The target keeps its mode. Links are followed, as by a shell's ``>``: the file that they
    lead to is replaced. Pipes, devices and other special files are not replaced but written to at the end. Errors of
    the system for the temporary file name the target.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     target = Path(folder, "note.txt")
    ...     with replacing(target) as temporary:
    ...         size = temporary.write_text("whole")
    ...     print(target.read_text(), len(list(Path(folder).iterdir())))
    whole 1
    """
    target = Path(path)
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(target))
    streamed = target.exists() and not target.is_file()
    kept = Path(os.path.realpath(target))
    with said_of(target), _streamed(target) if streamed else _beside(kept) as temporary:
        yield temporary


def write_whole(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write text, in UTF-8, or bytes by `replacing`."""
    with replacing(path) as temporary:
        temporary.write_bytes(content if isinstance(content, bytes) else content.encode())


def write_netcdf(dataset: Any, path: Path, *, form: str = "NETCDF4") -> None:
    """Write a dataset of xarray; what HDF5 says of files becomes an OSError."""
    optional("netCDF4", "grid")
    try:
        dataset.to_netcdf(path, engine="netcdf4", format=form)
    except RuntimeError as error:
        raise OSError(errno.EIO, f"the file cannot be written: {error}") from error


@contextmanager
def said_of(target: str | os.PathLike[str], folder: str | None = None) -> Iterator[None]:
    """Make errors of the system for temporary files, also in a folder or without a name, name the target."""
    try:
        yield
    except OSError as error:
        named = "" if error.filename is None else os.fsdecode(error.filename)
        ours = named.endswith(ENDING) or (folder is not None and Path(named).is_relative_to(folder))
        if error.errno is not None and (not named or ours):
            error.filename = str(target)
            del error.filename2  # set to None it would be shown
        raise


@contextmanager
def _streamed(target: Path) -> Iterator[Path]:
    """A file elsewhere, whose bytes are copied to the target at the end."""
    with TemporaryDirectory() as folder:
        whole = Path(folder, f"{target.name}{ENDING}")
        yield whole
        with whole.open("rb") as source, target.open("wb") as sink:
            shutil.copyfileobj(source, sink)


@contextmanager
def _beside(kept: Path) -> Iterator[Path]:
    """A file next to the target, which replaces it at the end."""
    temporary = kept.with_name(f".{kept.name[:32]}.{secrets.token_hex(8)}{ENDING}")  # names have at most 255 bytes
    os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY | getattr(os, "O_NOFOLLOW", 0), 0o666))
    try:
        if kept.exists():
            shutil.copymode(kept, temporary)
        yield temporary
        os.replace(temporary, kept)
    finally:
        temporary.unlink(missing_ok=True)
