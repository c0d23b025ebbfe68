"""What tasks leave in a folder: files, and a note of each task that is done. What counts is what lies there."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stereodel._tasks.whole_files import write_whole

Note = dict[str, Any]
"""What there was to say when something was done, and the sizes of the files that were written, by ``files``."""


@dataclass(frozen=True)
class Kept:
    """A folder of notes, by names of what was done, or of a pass and the number of a task of it.

    A note is written when the files are, in one move. It counts only while these are there with the same sizes.
    Their paths are absolute or begin in the folder.
    """

    folder: Path

    def path(self, name: str, task: int | None = None) -> Path:
        """The file of a note."""
        return self.folder / (f"{name}.json" if task is None else f"{name}/{task}.json")

    def note(self, name: str, task: int | None = None) -> Note | None:
        """What was said; None if it is not done, or what is left of it is not there as it was."""
        try:
            note: Note = json.loads(self.path(name, task).read_text(encoding="utf-8"))
            whole = all((self.folder / file).stat().st_size == size for file, size in note["files"].items())
        except (FileNotFoundError, ValueError):
            return None
        return note if whole else None

    def keep(
        self, name: str, content: Mapping[str, Any], files: Iterable[str | Path] = (), *, task: int | None = None
    ) -> Note:
        """Note that something is done: what there is to say of it, and the files that it wrote."""
        note = {**content, "files": {str(file): (self.folder / file).stat().st_size for file in files}}
        note |= {} if task is None else {"task": task}
        save_json(self.path(name, task), note)
        return note

    def once(self, name: str, do: Callable[[], Mapping[str, Any]]) -> Note:
        """What was said when something was done; it is done now if it was not, and leaves no files."""
        note = self.note(name)
        return self.keep(name, do()) if note is None else note


def save_json(path: Path, value: Mapping[str, Any]) -> None:
    """A document, which appears when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, json.dumps(value))


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other runs, on this machine or another one that shares the folder, from it.

    The system takes the lock away from a process that ends, however it ends; its file stays, as another run may be
    about to open it. Raises RuntimeError where a run holds it.
    """
    with (folder / ".lock").open("a+b") as file:
        try:
            if os.name == "nt":
                import msvcrt

                msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined, unused-ignore]
            else:
                import fcntl

                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise RuntimeError(f"another run writes to {folder}; wait for it, or take another folder") from error
        yield
