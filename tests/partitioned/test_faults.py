"""What goes wrong: told once and clearly, with nothing half; what was interrupted goes on."""

import errno
import os
import shutil
import signal
from functools import partial

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel._tasks.crew import Crew
from stereodel._tasks.kept import locked
from stereodel.partitioned import Execution
from stereodel.partitioned import run as running
from tests.disks import small_disk
from tests.partitioned.answers import PASSES, differences, in_memory, meanwhile, rows_of, serially, stop, write_points
from tests.sets import LONLAT, XYZ
from tests.tiers import by_day


def killed_once(marker, name, function, task):
    """What the function returns; the first process that calls it for that pass is ended by the system."""
    if function.args[1] == name and not marker.exists():
        marker.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return function(task)


@pytest.mark.parametrize("name", by_day(PASSES, "solve"))
def test_a_worker_that_is_killed(tmp_path, points, name, monkeypatch):
    """The processes of our own are replaced, and what the dead one did is done again."""
    marker = tmp_path / "killed"
    each = Crew.each
    monkeypatch.setattr(
        Crew, "each", lambda self, work, tasks: each(self, partial(killed_once, marker, name, work), tasks)
    )
    points.check(jobs=None, partition=100)
    assert marker.exists()


@pytest.mark.parametrize("name", ["partition", "limit", "jobs"])
def test_what_cannot_be_executed(name):
    with pytest.raises(ValueError, match=f"{name} is 0, but must be at least 1"):
        Execution(**{name: 0})
    with pytest.raises(TypeError, match=f"{name} must be one integer, got 1.5"):
        Execution(**{name: 1.5})


def test_two_runs_on_one_folder(points):
    points.out.mkdir()
    with locked(points.out), pytest.raises(RuntimeError, match="another run writes to"):
        points.run()
    points.check()


@pytest.mark.parametrize("size", by_day([300, 2000, 5000], 2000))
def test_a_full_disk(points, size):
    """An OSError; nothing is half written; with room again the run goes on."""
    with small_disk(size), pytest.raises(OSError) as full:
        points.run()
    assert full.value.errno == errno.EFBIG  # where a full disk has ENOSPC
    assert not list(points.out.rglob("*.tmp"))
    points.check()


def interrupted(points, name, done):
    """A run that ends when so many tasks of a pass are done."""
    with pytest.raises(KeyboardInterrupt):
        points.run(progress=meanwhile(name, done, stop))


@pytest.mark.parametrize(
    ("name", "room"),
    [*((name, None) for name in PASSES), ("spread", "spread"), ("collect", "points"), ("solve", "stars")],
)
def test_a_run_that_was_interrupted_goes_on(points, name, room):
    """A shard that was cut short meanwhile is made again, as what it was made of is there."""
    interrupted(points, name, 4)
    if room:
        os.truncate(min((points.out / "scratch").glob(f"*/{room}/*.*")), 100)
    begun = {}
    points.check(progress=lambda name, done, of: begun.setdefault(name, done))
    assert begun[name] >= (0 if room else 4)
    assert list(begun) == list(PASSES)[PASSES.index(name) :]


def contents(folder):
    """Files with their bytes and times."""
    return {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.rglob("*.parquet")}


def test_a_run_that_ended_is_not_run_again(points):
    """Nor does a run change its inputs."""
    inputs, first = contents(points.folder), points.run()
    made, calls = contents(points.out), []
    again = points.run(progress=lambda *told: calls.append(told))
    assert (again.statistics, calls) == (first.statistics, [])
    assert (contents(points.out), contents(points.folder)) == (made, inputs)


HAS_CHANGED = "is new, missing or has changed since"
NOTICED = [
    ({"partition": 61}, None, "partition was 60, and is 61"),
    ({"rows": ("area",)}, None, r"rows was \('area', 'degree', .*\), and is \('area',\)"),
    ({"triangles": False}, None, "triangles was True, and is False"),
    ({}, lambda path: os.utime(path, ns=(1, 1)), rf".*002\.parquet {HAS_CHANGED}"),
    ({}, lambda path: path.rename(path.with_name("009.parquet")), rf".*002\.parquet {HAS_CHANGED}"),
    ({}, lambda path: shutil.copy(path, path.with_name("009.parquet")), rf".*009\.parquet {HAS_CHANGED}"),
]


@pytest.mark.parametrize(("options", "change", "message"), NOTICED)
def test_other_arguments_and_files_are_noticed(points, options, change, message):
    interrupted(points, "solve", 1)
    if change:
        change(points.folder / "002.parquet")
    with pytest.raises(ValueError, match=f"has a run of other files or arguments: {message}; take another folder"):
        points.run(**options)
    if not change:
        points.check()


@pytest.mark.parametrize(
    ("column", "value", "message"),
    [
        ("lat", np.nan, r"003\.parquet: row 7: the latitude is missing"),
        ("lon", np.inf, r"003\.parquet: row 7: the longitude is inf, but must be finite"),
        ("lat", 95.5, r"003\.parquet: row 7: latitude 95\.5 is outside \[-90, 90\]"),
        ("lat", None, r"003\.parquet: row 7: the latitude is missing"),
    ],
)
@pytest.mark.parametrize("partition", [30, 10_000])
def test_a_row_that_is_no_point(tmp_path, column, value, message, partition):
    """By file, row and value, whether the sample, the spreading or the partition meets it first."""
    _, rows = rows_of("airports", 300)
    folder = write_points(tmp_path / "points", LONLAT, rows)
    table = pq.read_table(folder / "003.parquet")
    values = table[column].to_pylist()
    values[6] = value
    table = table.set_column(table.column_names.index(column), column, pa.array(values, pa.float64()))
    pq.write_table(table, folder / "003.parquet", row_group_size=5)
    with pytest.raises(ValueError, match=message):
        serially(folder, tmp_path / "out", partition=partition)
    assert not list((tmp_path / "out").rglob("rows/*"))


def test_a_zero_vector(tmp_path):
    folder = write_points(tmp_path / "points", XYZ, np.array([[1.0, 0, 0], [0, 0, 0], [0, 1, 0]]), 1)
    with pytest.raises(ValueError, match=r"000\.parquet: row 2: is the zero vector, which has no direction"):
        serially(folder, tmp_path / "out")


@pytest.mark.parametrize(
    ("space", "name"), [("sphere", "circle and a pole"), ("sphere", "great circle"), ("plane", "line")]
)
def test_more_points_at_once_than_the_limit(tmp_path, space, name):
    """The pole of a circle has a star of all points, which no partition helps."""
    columns, rows = rows_of(name, 600, space)
    folder = write_points(tmp_path / "points", columns, rows)
    with pytest.raises(MemoryError, match=r"partition \d+: .*star.* points at once, more than limit=200; give"):
        serially(folder, tmp_path / "out", surface=space, partition=50, limit=200)
    run = serially(folder, tmp_path / "out", surface=space, partition=50)  # the limit is no part of the plan
    assert differences(run, in_memory(columns, rows)) == []


def test_results_are_not_among_the_points(tmp_path, points):
    """Nor by way of a link."""
    folder, link = points.folder, tmp_path / "link"
    (folder / "002.parquet").rename(folder / "a.parquet")
    os.symlink(folder, link)
    for source, out in [(folder, folder), (folder, link), (link, folder)]:
        with pytest.raises(ValueError, match="lies in out, the folder of results"):
            serially(source, out)


def test_a_folder_of_something_else_is_left_alone(points):
    (points.out / "rows").mkdir(parents=True)
    (points.out / "rows" / "mine.txt").write_text("mine")
    for resume in (True, False):
        with pytest.raises(ValueError, match="has 'rows', which is not of a run; take another folder"):
            points.run(resume=resume)
    assert (points.out / "rows" / "mine.txt").read_text() == "mine"


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"triangles": 10}, "there are 10 triangles, but 12 by Euler's formula"),
        ({"area": 12.5}, r"the areas of all cells add up to 12\.5, but the sphere's is 12\.566"),
    ],
)
def test_results_that_no_input_may_have(points, monkeypatch, wrong, message):
    """Triangles that are too few and areas that do not cover the sphere end the run, with nothing published."""
    right = running._statistics
    monkeypatch.setattr(running, "_statistics", lambda *given: right(*given) | {"euler": 12, "triangles": 12} | wrong)
    with pytest.raises(RuntimeError, match=message):
        points.run()
    assert not (points.out / "run.json").exists()
