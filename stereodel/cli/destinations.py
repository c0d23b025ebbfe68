"""Where results go: a file whose extension names the format, or stdout. Nothing is written before all is ready."""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Destination:
    """A file, or stdout when `name` is "-"; `kind` is its format, such as "csv"."""

    name: str
    kind: str

    @classmethod
    def of(cls, name: str, kind: str | None, allowed: tuple[str, ...]) -> Destination:
        """The destination that the options --out and --format name, refused before the work if it cannot do."""
        if name != "-" and kind is not None:
            raise ValueError(f"--format is for stdout (--out -); the format of {name} is told by its extension")
        chosen = (kind or allowed[0]) if name == "-" else Path(name).suffix
        chosen = chosen.lower().removeprefix(".")
        if chosen not in allowed:
            raise ValueError(f"{name}: cannot write {chosen or 'a file without extension'}; choose {_listed(allowed)}")
        if name != "-" and not Path(name).resolve().parent.is_dir():
            raise ValueError(f"{name}: there is no folder {Path(name).parent}")
        if Path(name).is_dir():
            raise ValueError(f"{name}: is a folder")
        return cls(name, chosen)

    def write(self, save: Callable[[Path], object]) -> None:
        """Let `save` write the file; for stdout a temporary one, which is then copied."""
        if self.name != "-":
            save(Path(self.name))
            return
        with tempfile.TemporaryDirectory() as folder:
            whole = Path(folder, f"stdout.{self.kind}")
            save(whole)
            with whole.open("rb") as source:
                shutil.copyfileobj(source, sys.stdout.buffer)
            sys.stdout.buffer.flush()


def _listed(kinds: tuple[str, ...]) -> str:
    return ", ".join(f".{kind}" for kind in kinds)
