"""Writing files: whole or not at all."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

NAME_LENGTH: Final = 32
"""Letters of a file's name that its temporary name begins with; file systems have names of at most 255 bytes."""

ENDING: Final = ".tmp"
"""Of temporary names."""

NEW: Final = os.O_CREAT | os.O_EXCL | os.O_WRONLY | getattr(os, "O_NOFOLLOW", 0)
"""How a file is opened that must not be there."""


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a temporary name to write to; move it into place at the end, remove it after an error.

    The temporary file lies in the folder of the target and is made before it is given, under a name that nobody can
    foresee, so that nothing that was laid there is written to. The target keeps its mode. A link is followed, as a
    shell's ``>`` follows it: the file that it leads to is replaced. What is no file, such as a pipe or a device, is not
    replaced but written to, at the end. What the system says of the temporary file it says of the target.

    Examples
    --------
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


@contextmanager
def said_of(target: str | os.PathLike[str], folder: str | None = None) -> Iterator[None]:
    """What the system says of temporary files, those in a folder too, or of none by name, it says of the target."""
    try:
        yield
    except OSError as error:
        named = "" if error.filename is None else os.fsdecode(error.filename)
        ours = named.endswith(ENDING) or (folder is not None and Path(named).is_relative_to(folder))
        if error.errno is not None and (not named or ours):
            error.filename, error.filename2 = str(target), None
        raise


@contextmanager
def _streamed(target: Path) -> Iterator[Path]:
    """A file elsewhere, whose bytes go to the target at the end."""
    with TemporaryDirectory() as folder:
        whole = Path(folder, f"{target.name}{ENDING}")
        yield whole
        with whole.open("rb") as source, target.open("wb") as sink:
            shutil.copyfileobj(source, sink)


@contextmanager
def _beside(kept: Path) -> Iterator[Path]:
    """A file beside the target, which takes its place at the end."""
    temporary = kept.with_name(f".{kept.name[:NAME_LENGTH]}.{secrets.token_hex(8)}{ENDING}")
    os.close(os.open(temporary, NEW, 0o666))
    try:
        if kept.exists():
            shutil.copymode(kept, temporary)
        yield temporary
        os.replace(temporary, kept)
    finally:
        temporary.unlink(missing_ok=True)
