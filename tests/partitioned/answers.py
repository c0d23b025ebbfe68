"""What partitions say, and what one triangulation in memory says of the same points."""

from dataclasses import fields

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import stereodel as sd
from stereodel.partitioned import Execution, triangulate
from tests import sets

PASSES = ("sample", "spread", "collect", "solve", "align")
"""Of a triangulation, in order; if the files are compact, nothing is spread."""

HOW = {field.name for field in fields(Execution)}


def executed(call, *given, **options):
    """What a call returns, with options of its own and of `Execution`."""
    own = {name: value for name, value in options.items() if name not in HOW}
    return call(*given, **own, execution=Execution(**{name: options[name] for name in options.keys() & HOW}))


def serially(*given, **options):
    """A run in this process, which is fastest for few points."""
    return executed(triangulate, *given, **{"jobs": 1} | options)


def write_points(folder, columns, rows, files=5, **options):
    """Rows in files, one after the other; a number of files, or where each of them ends."""
    folder.mkdir(parents=True, exist_ok=True)
    for k, piece in enumerate(np.array_split(rows, files)):
        table = pa.table({name: np.ascontiguousarray(piece[:, axis]) for axis, name in enumerate(columns)})
        pq.write_table(table, folder / f"{k:03}.parquet", **options)
    return folder


def rows_of(name, count, space="sphere"):
    """Columns and about so many rows of a set."""
    found = sets.ALL[space, name]
    return found.columns, found.rows(count)


def surface_of(columns):
    return "plane" if tuple(columns) == ("x", "y") else "sphere"


def mesh_of(columns, rows):
    if surface_of(columns) == "plane":
        return sd.PlanarDelaunay(rows)
    return sd.SphericalDelaunay(rows if len(columns) == 3 else sd.lonlat_to_xyz(rows))


def in_memory(columns, rows):
    """Sorted triangles with `closing`, and what is told of each point."""
    mesh = mesh_of(columns, rows)
    own, size = np.arange(len(mesh.points)), len(mesh.points)
    if isinstance(mesh, sd.PlanarDelaunay):
        diagram, closing = sd.PlanarVoronoi(mesh), np.zeros(len(mesh.simplices), bool)
    else:
        diagram, closing = sd.SphericalVoronoi(mesh), mesh.closing
    kept, nearest, distance = own.copy(), np.full(size, -1), np.full(size, np.inf)
    kept[mesh.duplicates[:, 0]] = mesh.duplicates[:, 1]
    if size > 1:
        found = mesh.nearest(mesh.points, k=2)
        nearest = np.where(found[:, 0] == own, found[:, 1], found[:, 0])
        a, b = mesh.points, mesh.points[nearest]
        distance = np.hypot(*(a - b).T) if a.shape[1] == 2 else np.radians(sd.angular_distance(a, b))
    told = {"area": diagram.areas(), "degree": np.diff(diagram.region_offsets), "nearest": nearest}
    told |= {"kept": kept, "distance": distance}
    return ordered(np.column_stack([mesh.simplices, closing])), told


def ordered(faces):
    return faces[np.lexsort(faces.T[::-1])]


def of_run(run):
    """The same of a run."""
    table = run.triangles().to_table()
    faces = np.column_stack([table[name].to_numpy() for name in ("a", "b", "c", "closing")])
    rows = run.rows().to_table()
    return ordered(faces), {name: rows[name].to_numpy() for name in rows.column_names}


class Points:
    """Points in files that are not compact, with one more column; the folder of results, and the answer in memory."""

    def __init__(self, place):
        columns, rows = rows_of("airports", 600)
        table = np.column_stack([rows, np.arange(len(rows))])
        self.folder = write_points(place / "points", (*columns, "id"), table, row_group_size=40)
        self.out, self.truth = place / "out", in_memory(columns, rows)

    def run(self, out="out", **options):
        return serially(self.folder, self.out.with_name(out), **{"partition": 60, "keep": ["id"]} | options)

    def check(self, out="out", **options):
        """A run ends with the answer in memory, each row in its place, and leaves nothing else in the folder."""
        run = self.run(out, **options)
        rows = run.rows().to_table()
        assert rows["id"].to_pylist() == list(range(len(rows)))
        assert differences(run, self.truth) == []
        assert clean(run.folder)


def differences(run, truth):
    """Names of what differs from the answer in memory, by a bit; distances have no equal there."""
    (faces, told), (right, values) = of_run(run), truth
    wrong = [] if np.array_equal(faces, right) else ["triangles"]
    wrong += [name for name in values if name != "distance" and not np.array_equal(told[name], values[name])]
    # Angles of points in double-double are right to 2^-98; those of the same direction are 0 exactly in partitions.
    least = 2.0**-98 if run.statistics["surface"] == "sphere" else 0.0
    near = np.allclose(told["distance"], values["distance"], rtol=1e-13, atol=least)
    return wrong if near else [*wrong, "distance"]


def clean(out):
    """Whether a folder has results alone, and no file of a process that was killed."""
    names = {path.name for path in out.iterdir()} - {"triangles"}
    return names == {".lock", "files.parquet", "plan.json", "rows", "run.json"} and not list(out.rglob("*.tmp"))


def meanwhile(name, done, action):
    """A function for `progress` that does something once, when so many tasks of a pass are done."""
    seen = []

    def progress(*state):
        if state[:2] == (name, done) and not seen:
            seen.append(state)
            action()

    return progress


def stop():
    raise KeyboardInterrupt
