"""Results in a folder: of more points than memory holds, in partitions, by processes of this machine or by Dask."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stereodel._extras import optional
from stereodel._interrupts import stop_if_interrupted
from stereodel.cli.application import reporting, say
from stereodel.cli.failures import NothingToDoError, naming_options

if TYPE_CHECKING:
    from stereodel.sphere.latitudes import Latitude

KEPT = "interrupted; what is done is kept, and the same command goes on from there"


def is_folder(out: str) -> bool:
    """Whether results go to a folder: its name ends in a slash, or it is there."""
    return out.endswith(("/", "\\")) or Path(out).is_dir()


@dataclass(frozen=True)
class Work:
    """Cells of points in files, to be written to a folder.

    points: files, folders or patterns, or a HATS catalogue.
    lon, lat: columns, both or none.
    plane: columns of the plane.
    partition: points of a partition.
    shapes: whether cells are written as polygons.
    keep: columns to write beside the results.
    overwrite: whether the results of an earlier command are replaced.
    """

    points: list[str]
    out: str
    lon: str | None
    lat: str | None
    plane: tuple[str, str] | None
    latitude: Latitude
    partition: int | None
    shapes: bool
    keep: list[str]
    overwrite: bool

    def __post_init__(self) -> None:
        if "-" in self.points:
            raise ValueError(f"results in the folder {self.out} are of files, not of stdin")
        if (self.lon is None) != (self.lat is None):
            raise ValueError("--lon and --lat are given together where results are in a folder")

    def run(self, scheduler: str | None) -> None:
        """Compute; errors are reported in the words of the command line."""
        from stereodel.partitioned import Execution, triangulate

        columns = self.plane or (self.lon and self.lat and (self.lon, self.lat)) or None
        names = {"columns": "--plane" if self.plane else "--lon", "keep": "--keep", "resume": "--overwrite"}
        with reporting() as progress, workers(scheduler) as executor, naming_options(**names):
            try:
                run = triangulate(
                    self.points[0] if len(self.points) == 1 else self.points,
                    self.out,
                    columns=columns,
                    surface="plane" if self.plane else "sphere",
                    latitude=self.latitude,
                    keep=self.keep,
                    triangles=False,
                    cells=self.shapes,
                    execution=Execution(
                        self.partition or Execution.partition,
                        executor=executor,
                        resume=not self.overwrite,
                        progress=progress,
                    ),
                )
            except KeyboardInterrupt:
                raise KeyboardInterrupt(KEPT) from None
            except (RuntimeError, TypeError) as error:  # another run holds the folder; a column has no numbers
                raise ValueError(str(error)) from error
        stop_if_interrupted()
        if not run.statistics["points"]:
            raise NothingToDoError(f"{', '.join(self.points)}: there are no points")
        kind = "" if self.plane else f", with {self.latitude} latitudes"
        found = run.statistics
        say(f"{self.out}: cells of {found['points']} points, in {found['partitions']} partitions{kind}")


@contextmanager
def workers(scheduler: str | None) -> Iterator[Executor | None]:
    """Workers of a scheduler of Dask; None, for processes of this machine, without an address.

    Raises ImportError without Dask (the extra ``dask``).
    Raises ValueError where no scheduler answers.
    """
    if scheduler is None:
        yield None
        return
    library = distributed()
    try:
        client = library.Client(scheduler, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ValueError(f"--scheduler is {scheduler!r}, where none answers: {error}") from error
    with client:
        yield client.get_executor(pure=False, retries=0)


def distributed() -> Any:
    """Dask's library of schedulers and workers."""
    return optional("distributed", "dask")
