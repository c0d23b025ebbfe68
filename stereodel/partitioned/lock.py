"""A lock of a folder: one run at a time; the system takes it away from a process that ends, however it ends."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

NAME: Final = ".lock"
"""Name of the file in the folder, which stays there: another run may be about to open it."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other runs, on this machine or another one that shares the folder, from it.

    Raises RuntimeError where a run holds it.
    """
    with (folder / NAME).open("a+b") as file:
        try:
            _lock(file.fileno())
        except OSError as error:
            raise RuntimeError(f"another run writes to {folder}; wait for it, or take another folder") from error
        yield


def _lock(descriptor: int) -> None:
    """Lock a file or raise an OSError; closing it unlocks it."""
    if os.name == "nt":
        import msvcrt

        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined, unused-ignore]
    else:
        import fcntl

        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
