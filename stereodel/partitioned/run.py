"""Running: triangulations of points in files, and what they leave."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import as_choice, as_count
from stereodel._docs import shared
from stereodel._extras import optional
from stereodel._tasks.kept import Note
from stereodel.constants import AREA_SUM_ERROR
from stereodel.io.formats.names import listed
from stereodel.partitioned import questions
from stereodel.partitioned.files import SURFACES, FilesGiven, Surface, names_of, opened
from stereodel.partitioned.passes import NONE, Execution, Passes, Results, execute, totals
from stereodel.partitioned.plan import ROWS, Plan, Question, source_of
from stereodel.partitioned.questions import Answers
from stereodel.partitioned.rounds import Index
from stereodel.partitioned.stars import solve
from stereodel.sphere.latitudes import KINDS as LATITUDES
from stereodel.sphere.latitudes import Latitude

Method = Literal["linear", "natural"]
Row = Literal["area", "degree", "nearest", "distance", "kept"]

DEFAULTS: Final = Execution()


@dataclass(frozen=True)
class Run(Results):
    """What a triangulation in partitions left in a folder; nothing is loaded until it is asked for.

    Parameters
    ----------
    folder : path-like
        Which `triangulate` wrote.

    Attributes
    ----------
    statistics : dict
        ``surface``, ``points``, ``distinct`` ones, ``triangles`` and ``euler``, their number by Euler's formula,
        ``area`` of all cells that have one, ``compact`` (whether files served as partitions), ``partitions``,
        ``rounds`` (the most of one), ``read`` (points in all triangulations), ``largest`` (points of the largest),
        ``cpu`` (seconds of all workers in them).
    partitions : list of dict
        The same of each partition that has points, by its number, ``part``.

    Raises
    ------
    FileNotFoundError
        If no run ended there.
    """

    def triangles(self) -> Any:
        """Triangles by the numbers of their points: a dataset of pyarrow with a, b, c, closing."""
        return self._dataset("triangles")

    def cells(self) -> Any:
        """Cells, if they were asked for: a dataset of pyarrow with point, area and geometry, well-known binary."""
        return self._dataset("cells")

    @shared(**questions.FAMILY)
    def nearest(
        self,
        targets: FilesGiven,
        out: str | os.PathLike[str],
        *,
        k: int | None = None,
        columns: Sequence[str] | None = None,
        kind: str = "auto",
        keep: Sequence[str] = (),
        execution: Execution = DEFAULTS,
    ) -> Answers:
        """Nearest points at targets in files, exactly as `SphericalDelaunay.nearest` of all points at once.

        Parameters
        ----------
        {targets}
        k : int, optional
            Number of points, 1 to the number of all points; by default only the nearest, without lists.
        {options}

        Returns
        -------
        {returns}
            Their columns are ``nearest``, the number of the nearest point, and ``distance`` (radians on the sphere);
            with `k` lists of so many in the order of distances, equally near ones in the order of their numbers.

        Raises
        ------
        {raises}

        Examples
        --------
        >>> import tempfile, pyarrow, pyarrow.parquet
        >>> from stereodel.partitioned import triangulate
        >>> octahedron = {"lon": [0.0, 90, 180, -90, 0, 0], "lat": [0.0, 0, 0, 0, 90, -90]}
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     pyarrow.parquet.write_table(pyarrow.table(octahedron), f"{folder}/points.parquet")
        ...     pyarrow.parquet.write_table(pyarrow.table({"lon": [20.0], "lat": [80.0]}), f"{folder}/targets.parquet")
        ...     run = triangulate(f"{folder}/points.parquet", f"{folder}/out", index=True)
        ...     found = run.nearest(f"{folder}/targets.parquet", f"{folder}/nearest", k=3)
        ...     print(found.rows().to_table()["nearest"].to_pylist())
        [[4, 0, 1]]
        """
        plan = questions.indexed(self.folder)
        if not plan.size:
            raise ValueError("nearest needs at least one point; this run has none")
        count = None if k is None else as_count(k, "k", high=plan.size)
        question = Question(str(self.folder.absolute()), plan.digest, "nearest", k=count)
        return questions.ask(question, ("nearest", "distance"), targets, out, columns, kind, keep, execution)

    @shared(**questions.FAMILY)
    def interpolate(
        self,
        targets: FilesGiven,
        out: str | os.PathLike[str],
        values: str | Sequence[str],
        *,
        method: Method = "linear",
        columns: Sequence[str] | None = None,
        kind: str = "auto",
        keep: Sequence[str] = (),
        execution: Execution = DEFAULTS,
    ) -> Answers:
        """Values at targets in files, as by the interpolators of all points at once.

        Parameters
        ----------
        {targets}
        values : str or sequence of str
            Columns of the files of points, which must be there as they were; NaN or null where missing.
        method : {"linear", "natural"}
            `LinearInterpolator` or `NaturalNeighborInterpolator`.
        {options}

        Returns
        -------
        {returns}
            Their columns have the names of the values; NaN outside all triangles but at points, and where a missing
            value takes part.

        Raises
        ------
        {raises}

        Notes
        -----
        Values are those in memory, bitwise. One case is apart: at a target exactly on an edge or at a point, linear
        values are those of one of the triangles there, in memory the one of lowest index, here perhaps another. On
        an edge the two differ by rounding alone, at a point not at all, but one may be NaN where a value is missing.
        Natural values on an edge begin their sum at one of these triangles: the last digits may differ.

        Beside the targets, `scratch` takes 8 bytes a point and column.

        Examples
        --------
        >>> import tempfile, pyarrow, pyarrow.parquet
        >>> from stereodel.partitioned import triangulate
        >>> square = {"x": [0.0, 4, 0, 4], "y": [0.0, 0, 4, 4], "height": [0.0, 4, 8, 12]}
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     pyarrow.parquet.write_table(pyarrow.table(square), f"{folder}/points.parquet")
        ...     pyarrow.parquet.write_table(pyarrow.table({"x": [1.0, 5], "y": [2.0, 0]}), f"{folder}/targets.parquet")
        ...     run = triangulate(f"{folder}/points.parquet", f"{folder}/out", surface="plane", index=True)
        ...     found = run.interpolate(f"{folder}/targets.parquet", f"{folder}/heights", "height")
        ...     print(found.rows().to_table()["height"].to_pylist())
        [5.0, nan]
        """
        plan = questions.indexed(self.folder)
        chosen = as_choice(method, tuple(questions.INTERPOLATORS), "method")
        names = names_of(values)
        if not names:
            raise ValueError("values is empty; name one or more columns of the files of points")
        for file in plan.files:
            file.check()
            there = opened(file.path).schema_arrow.names
            missing = [name for name in names if name not in there]
            if missing:
                where = f"columns {listed(there)} of {file.path}"
                raise ValueError(f"values has {missing[0]!r}, which is not one of the {where}")
        flat = not self.statistics["triangles"]
        question = Question(str(self.folder.absolute()), plan.digest, chosen, values=names, flat=flat)
        return questions.ask(question, names, targets, out, columns, kind, keep, execution)


def triangulate(
    source: FilesGiven,
    out: str | os.PathLike[str],
    *,
    columns: Sequence[str] | None = None,
    surface: Surface = "sphere",
    latitude: Latitude = "spherical",
    kind: str = "auto",
    rows: Sequence[Row] = ("area", "degree", "nearest", "distance", "kept"),
    keep: Sequence[str] = (),
    triangles: bool = True,
    cells: bool = False,
    index: bool = False,
    execution: Execution = DEFAULTS,
) -> Run:
    """Triangulate points in files, more of them than memory holds: exactly as all at once, whatever the partitions.

    Parameters
    ----------
    source : path-like or sequence of path-like
        Parquet or GeoParquet: a file, a folder with files at any depth, a pattern such as ``points/*.parquet``, or a
        list. Points are numbered from 0 in the order of the names of files, or of the list. Or the folder of a HATS
        catalogue, or of a collection of them, whose points are numbered in the order of its pixels.
    out : path-like
        A folder for the results, which is made.
    columns : sequence of str, optional
        Names of the columns: (longitude, latitude) in degrees or (x, y, z), a direction; (x, y) in the plane; or one
        of geometries. By default the geometries of GeoParquet, else as `stereodel.io.read_points` finds them, or x,
        y, z.
    surface : {"sphere", "plane"}
    latitude : {"spherical", "geodetic", "authalic"}
        As in `stereodel.lonlat_to_xyz`.
    kind : {"auto", "parquet", "hats"}
        What the source is; by default that is found out.
    rows : sequence of {"area", "degree", "nearest", "distance", "kept"}
        Results for each point: the area of its Voronoi cell (steradians; in the plane infinite for unbounded ones), the
        number of its sides, the number of the nearest other point (the lowest one of several, -1 if there is none) and
        its distance (radians on the sphere), and the point that is kept in its place: itself, or for duplicates the
        lowest number of equal points. Areas and degrees of other duplicates are 0.
    keep : sequence of str
        Columns of the input that stand before those of the rows, such as one that identifies points, by which rows and
        input are joined.
    triangles : bool
        Whether triangles are written.
    cells : bool
        Whether cells are written as polygons in GeoParquet, which takes the extra ``geo``; as those of
        `stereodel.io.to_geodataframe`.
    index : bool
        Whether the points are kept in their partitions, for `Run.nearest` and `Run.interpolate`: at most 35 bytes each.
    execution : Execution, optional
        Partitions and memory, processes or a cluster, scratch, resuming and progress.

    Returns
    -------
    Run
        Files of `out`: ``rows/`` has a file for each file of the source, with the same name, number and order of rows;
        ``triangles/`` one for each partition, whose columns a, b, c are numbers of points, the lowest first,
        counterclockwise, and ``closing`` as in `stereodel.SphericalDelaunay`; ``cells/`` one, too, with the ``point``
        and ``area`` of each polygon; ``files.parquet`` says which numbers the points of each file have, and what it
        was like.

    Raises
    ------
    ValueError
        If a row is not a point, naming file, row and value; for columns that are not there; where a run in `out` was
        begun with other files or arguments; where a file that is read changes meanwhile; where files in `out` or
        `scratch` were deleted or changed, naming one of them.
    TypeError
        For coordinates of another type than numbers: booleans, times, text, bytes; naming file and column.
    MemoryError
        Where a star has more points than `Execution.limit`, naming partition and point.
    RuntimeError
        Where another run writes to `out`.
    OSError
        Where files cannot be read or written.
    ImportError
        Without pyarrow (the extra ``partitioned``).

    Notes
    -----
    Triangles, areas, degrees and nearest points are those of `stereodel.SphericalDelaunay` or
    `stereodel.PlanarDelaunay` of all points, bitwise, ties and duplicates included, for any partitions,
    executor and number of workers. At the end the number of triangles is compared with Euler's formula, and the sum of
    areas with that of the sphere; then the files of results with the plan. They are moved into `out` when all are
    right, ``run.json`` last.

    Examples
    --------
    >>> import tempfile, pyarrow, pyarrow.parquet
    >>> from stereodel.partitioned import triangulate
    >>> octahedron = {"lon": [0.0, 90, 180, -90, 0, 0], "lat": [0.0, 0, 0, 0, 90, -90]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     pyarrow.parquet.write_table(pyarrow.table(octahedron), f"{folder}/points.parquet")
    ...     run = triangulate(f"{folder}/points.parquet", f"{folder}/out")
    ...     print(run.statistics["triangles"], run.rows().to_table()["degree"].to_pylist())
    8 [4, 4, 4, 4, 4, 4]
    """
    if cells:
        for module in ("pyarrow", "shapely", "pyproj"):
            optional(module, "geo")
    optional("pyarrow", "partitioned")
    as_choice(surface, SURFACES, "surface")
    as_choice(latitude, LATITUDES, "latitude")
    wanted = names_of(rows) or ()
    for name in wanted:
        as_choice(name, tuple(ROWS), "rows")
    found = source_of(source, kind, columns, surface, latitude, keep, ROWS)
    plan = Plan.of(
        found,
        partition=execution.partition,
        rows=tuple(name for name in ROWS if name in wanted),
        triangles=bool(triangles),
        cells=bool(cells),
        index=bool(index),
    )
    return Run(execute(_stars, found, plan, out, execution))


def _stars(passes: Passes, parts: list[int]) -> tuple[dict[str, Any], list[Note]]:
    """Triangles, cells and results for all points."""
    store, plan, notes = passes.store, passes.store.plan, []
    if parts:
        store.notes.once("index", lambda: Index.build(store, parts))
        notes = passes.do("solve", solve, parts, limit=passes.limit)
        if plan.rows and store.notes.note("align") is None:
            store.gather("stars", parts)
        if not plan.index:
            store.drop("points", "blocks")
    elif plan.triangles:
        none = {name: np.empty(0, dtype=np.int64) for name in "abc"} | {"closing": np.empty(0, dtype=np.bool_)}
        store.write_table(store.folder("triangles") / f"{NONE['part']}.parquet", none)
    statistics = _statistics(plan, notes)
    # No input lets these differ.
    triangles, euler, area, whole = *(statistics[name] for name in ("triangles", "euler", "area")), 4 * np.pi
    if triangles != euler:
        raise RuntimeError(f"there are {triangles} triangles, but {euler} by Euler's formula")
    if plan.columns.surface == "sphere" and plan.size and abs(area - whole) > AREA_SUM_ERROR * whole:
        raise RuntimeError(f"the areas of all cells add up to {area}, but the sphere's is {whole}")
    return statistics, notes


def _statistics(plan: Plan, notes: Sequence[Note]) -> dict[str, Any]:
    """Numbers of the whole run."""
    names = ("dropped", "triangles", "edges", "area")
    dropped, triangles, edges, area = (sum(note[name] for note in notes) for name in names)
    distinct = plan.size - dropped
    euler = 2 * distinct - (4 if plan.columns.surface == "sphere" else 2 + edges)
    return {
        "surface": plan.columns.surface,
        "points": plan.size,
        "distinct": distinct,
        "triangles": triangles,
        "euler": euler if triangles else 0,
        "area": area,
        **totals(notes),
    }
