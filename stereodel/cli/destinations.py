"""Output: a file whose extension gives the format, or stdout. Nothing is written before the result is complete."""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stereodel._arrays import Column
from stereodel._files import replacing, said_of
from stereodel._tasks.interrupts import stop_if_interrupted
from stereodel.cli.application import reporting
from stereodel.io import PointTable, write
from stereodel.io.formats.delimited import write_csv
from stereodel.io.maps.meshes_as_rows import Mesh

if TYPE_CHECKING:
    from stereodel.io.formats.map_rows import MapRows

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


def save(path: Path, rows: PointTable | MapRows | dict[str, Column]) -> None:
    """Write a table of points, the rows of a map in the format of the extension, or columns alone as CSV."""
    if isinstance(rows, dict):
        with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
            write_csv(rows, file)
        return
    with reporting(f"writing {len(rows)} rows") as shown:
        write(path, rows, progress=shown)


def save_mesh(path: Path, mesh: Mesh, latitude: str) -> None:
    """Write cells or triangles as a mesh or picture."""
    kind = path.suffix.lower().removeprefix(".")
    if kind in PICTURES:
        from stereodel.drawing import diagram_page

        diagram_page(mesh).save(path)
        return
    with reporting(f"writing {path.name}"):
        known: dict[str, Any] = {"latitude": latitude} if kind == "nc" else {}
        write(path, mesh, **known)
