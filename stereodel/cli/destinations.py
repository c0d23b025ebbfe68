"""Output: a file whose extension gives the format, or stdout. Nothing is written before the result is complete."""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stereodel._files import said_of
from stereodel._tasks.interrupts import stop_if_interrupted
from stereodel.cli.application import reporting
from stereodel.io import write

TABLES = ("csv", "geojson", "geojsonl", "parquet", "gpkg", "fgb", "shp", "kml")
PICTURES = ("svg", "pdf")
MESHES = ("nc", "glb", "ply", "vtp", *PICTURES)


@dataclass(frozen=True)
class Destination:
    """A file, or stdout when `name` is "-"; `kind` is its format, such as "csv"."""

    name: str
    kind: str

    def write(self, save: Callable[[Path], object]) -> None:
        """Call `save` to write the file; for stdout, to write a temporary file, which is then copied."""
        stop_if_interrupted()
        if self.name != "-":
            save(Path(self.name))
            return
        with tempfile.TemporaryDirectory() as folder:
            whole = Path(folder, f"stdout.{self.kind}")
            with said_of("stdout", folder):
                save(whole)
            if sys.stdout is None:
                raise ValueError("stdout is closed; name a file with --out")
            try:
                with whole.open("rb") as source:
                    shutil.copyfileobj(source, sys.stdout.buffer)
                sys.stdout.buffer.flush()
            except OSError as error:
                error.filename = error.filename or "stdout"
                raise

    def put(self, thing: Any, **options: Any) -> None:
        """Write a table, rows of a map, columns, a grid or contours; a mesh also as a picture."""
        if self.kind in PICTURES:
            from stereodel.drawing import diagram_page

            self.write(diagram_page(thing).save)
            return
        with reporting(f"writing {self.name}") as shown:
            self.write(lambda path: write(path, thing, progress=shown, **options))
