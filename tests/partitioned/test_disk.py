"""What is on the disk counts, not what tasks say: whatever is deleted, changed or cut meanwhile, no run ends on it."""

import os
import random
import shutil
from collections import Counter
from functools import partial

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel.partitioned import Run, files, rounds, stars
from stereodel.partitioned import passes as passes_of
from tests.partitioned import answers
from tests.partitioned.answers import PASSES, executed, meanwhile, stop
from tests.tiers import by_day


def harmed(folder, pattern, harm=os.unlink):
    """A function that harms files of a folder."""

    def action():
        found = sorted(folder.glob(pattern))
        assert found, pattern
        for path in found:
            harm(path)

    return action


def flip(path, place=-1):
    """Change a byte of a file that has any, which keeps its size."""
    content = bytearray(path.read_bytes())
    if not content.endswith(b"\n"):
        content[place] ^= 1
    path.write_bytes(content)


# What a run made

AGAIN = [
    ("spread", "spread/1.points"),
    ("collect", "points/1.blocks"),
    ("solve", "stars/1.rows"),
    ("solve", "results/triangles/*.parquet"),
    ("solve", "results/triangles/[12].parquet"),
    ("align", "results/rows/00[01].parquet"),
]


@pytest.mark.parametrize(("name", "pattern"), AGAIN)
def test_what_is_deleted_while_its_pass_runs_is_made_again(points, name, pattern):
    done = []
    actions = harmed(points.out, f"scratch/*/{pattern}"), lambda: done.append(name)
    points.check(progress=meanwhile(name, 4, lambda: [action() for action in actions]))
    assert done


DELETED = [
    ("spread", 2, "splits"),
    ("collect", 2, "spread/2.points"),
    ("solve", 2, "points/*.points"),
    ("solve", 2, "blocks/lows"),
    ("align", 2, "stars/*.rows"),
    ("align", 2, "results/triangles/1.parquet"),
    ("align", 2, "results/triangles/*.parquet"),
]
CHANGED = [
    ("spread", 3, "splits"),
    ("spread", 5, "spread/*.starts"),
    *(("collect", 2, f"spread/{name}") for name in ("starts", "*.points", "*.numbers")),
    ("collect", 10, "points/*.blocks"),
    *(("solve", 2, f"points/*.{name}") for name in ("points", "numbers")),
    *(
        ("solve", 2, f"blocks/{name}")
        for name in ("lows", "highs", "part", "first", "last", "points", "numbers", "sums")
    ),
    ("solve", 10, "stars/*.starts"),
    *(("align", 2, f"stars/{name}") for name in ("*.rows", "starts", "tasks")),
]
DELETED = [(*when, os.unlink, "deleted") for when in DELETED]
CHANGED = [(*when, flip, "changed") for when in CHANGED]


@pytest.mark.parametrize(("name", "done", "pattern", "harm", "how"), by_day(DELETED + CHANGED, *DELETED, *CHANGED[::4]))
def test_what_is_harmed_after_its_pass(points, name, done, pattern, harm, how):
    """The error names the file and the way out, which is one; CRC-32 tells, whether a shard is read whole or not."""
    action = harmed(points.out, f"scratch/*/{pattern}", harm)
    for progress in (meanwhile(name, done, action), None)[: 2 if how == "deleted" else 1]:
        with pytest.raises(ValueError, match=rf".* was {how} after it was written; begin anew with resume=False"):
            points.run(progress=progress)
    assert not (points.out / "run.json").exists()
    points.check(resume=False)


def test_scratch_that_can_be_made_again(points):
    action = harmed(points.out, "scratch/*/spread/starts")
    with pytest.raises(ValueError, match=r"spread/starts was deleted after it was written"):
        points.run(progress=meanwhile("collect", 2, action))
    points.check()


@pytest.mark.parametrize(
    ("file", "harm", "how"),
    [
        ("triangles/0.parquet", os.unlink, "deleted"),
        ("rows/003.parquet", os.unlink, "deleted"),
        ("cells/2.parquet", os.unlink, "deleted"),
        ("plan.json", os.unlink, "deleted"),
        ("plan.json", lambda path: path.write_text("{"), "cut short or changed"),
    ],
)
def test_what_is_harmed_between_two_calls(points, file, harm, how):
    options = {"cells": True} if file.startswith("cells") else {}
    run = points.run(**options)
    if options:
        assert run.cells().count_rows() == sum(each["cells"] for each in run.partitions) > 500
    harmed(run.folder, file, harm)()
    if file != "plan.json":
        with pytest.raises(FileNotFoundError, match=file):
            getattr(run, file.split("/")[0])().to_table()
    with pytest.raises(ValueError, match=f"{file} was {how} after it was written; begin anew"):
        points.run(**options)
    points.check(resume=False)


def test_results_of_another_run(points):
    """A file of the same name and number of rows, which another run wrote; one that no run of this plan has."""
    run = points.run()
    other = points.run("other", rows=("area", "degree", "nearest", "kept"))
    shutil.copy(other.folder / "triangles" / "0.parquet", run.folder / "triangles" / "99.parquet")
    assert run.triangles().count_rows() == len(points.truth[0])  # parts of the report, not what lies there
    with pytest.raises(ValueError, match=r"99\.parquet is not of the run that wrote the files beside it"):
        points.run()
    (run.folder / "triangles" / "99.parquet").unlink()
    shutil.copy(other.folder / "triangles" / "0.parquet", run.folder / "triangles")
    with pytest.raises(ValueError, match=r"triangles/0\.parquet was changed after it was written"):
        points.run()


def test_the_plan_that_is_deleted_while_it_runs_is_written_again(points):
    action = harmed(points.out, "plan.json")
    points.check(progress=meanwhile("solve", 3, action))
    points.check()


def test_a_deletion_that_was_interrupted(points, monkeypatch):
    """A run that begins anew deletes the report first and the plan last; what is left then is deleted by the next."""
    points.run()
    removed = []

    def interrupted(path, **options):
        removed.append(path)
        if path.name == "triangles":
            raise KeyboardInterrupt
        rmtree(path, **options)

    rmtree = shutil.rmtree
    with monkeypatch.context() as patch:
        patch.setattr("shutil.rmtree", interrupted)
        with pytest.raises(KeyboardInterrupt):
            points.run(resume=False)
    assert (points.out / "triangles").exists()
    assert not (points.out / "run.json").exists()
    points.check()


@pytest.mark.parametrize("after", by_day(range(4), 0, 2))
def test_results_whose_moving_was_interrupted(points, monkeypatch, after):
    """They are moved when all are there; the report is the last, so that a folder that has it is whole."""
    replace, moved = os.replace, []

    def interrupted(source, target):
        if "results" in str(source) and str(target).count("/") == str(points.out).count("/") + 1:
            if len(moved) == after:
                raise KeyboardInterrupt
            moved.append(target)
        replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr("os.replace", interrupted)
        with pytest.raises(KeyboardInterrupt):
            points.run()
    assert not (points.out / "run.json").exists()
    points.check()


def test_a_byte_of_the_index_that_is_changed(tmp_path, points):
    run = points.run(index=True)
    harmed(run.folder, "index/points/*.points", partial(flip, place=-100))()
    with pytest.raises(ValueError, match=r"index/points/\d+\.points was changed after it was written"):
        run.nearest(points.folder, tmp_path / "found", keep="id")


# Sources


def cut(path):
    pq.write_table(pq.read_table(path).slice(0, 10), path)


def lengthen(path):
    pq.write_table(pa.concat_tables([pq.read_table(path)] * 2), path)


def move(path):
    """Other rows, as many."""
    table = pq.read_table(path)
    pq.write_table(table.set_column(0, "lon", pa.array(table["lon"].to_numpy() / 2)), path)


def overwrite(path):
    """As many bytes, in the same file."""
    content = path.read_bytes()
    path.write_bytes(content[:200] + bytes(8) + content[208:])


HARMS = [cut, lengthen, move, overwrite, os.unlink]
TIMES = [(name, done) for name in PASSES for done in (0, 2)]
BY_DAY = [(*when, harm) for when, harm in zip(TIMES[::2], HARMS, strict=True)]
"""Each harm, and each pass."""


@pytest.mark.parametrize(("name", "done", "harm"), by_day([(*when, harm) for when in TIMES for harm in HARMS], *BY_DAY))
def test_a_source_that_changes_while_it_is_read(tmp_path, points, name, done, harm):
    """Whenever that is, it is an error: files are looked at before and after each reading, and at the end."""
    file = points.folder / "003.parquet"
    kept = tmp_path / "kept.parquet"
    shutil.copy2(file, kept)
    with pytest.raises((ValueError, FileNotFoundError), match=r"003\.parquet"):
        points.run(progress=meanwhile(name, done, partial(harm, file)))
    with pytest.raises(FileNotFoundError, match="no run ended there"):
        Run(points.out)
    shutil.copy2(kept, file)  # with its time: as it was
    points.check()


def test_a_source_with_fewer_rows_than_planned(points, monkeypatch):
    """Should its time stamp say nothing: no row is what happened to be in memory."""
    monkeypatch.setattr(files.PointFile, "check", lambda self: None)
    with pytest.raises(ValueError, match=r"003\.parquet .*have \d+ of \d+ rows"):
        points.run(progress=meanwhile("sample", 10, partial(cut, points.folder / "003.parquet")))


def test_the_source_of_values_that_changes(tmp_path, points):
    run = points.run(index=True)
    progress = meanwhile("collect", 1, partial(move, points.folder / "003.parquet"))
    with pytest.raises(ValueError, match=r"003\.parquet has changed since the run began"):
        executed(run.interpolate, points.folder, tmp_path / "found", "id", partition=60, progress=progress)


@pytest.mark.parametrize("number", by_day([12, 300], 12))
@pytest.mark.usefixtures("points")
def test_files_that_are_damaged(tmp_path, number):
    """Cut anywhere, or with bits of the footer changed: the points as they were, or an error that names the file."""
    chance, (columns, rows) = random.Random(5), answers.rows_of("airports", 60)
    folder = answers.write_points(tmp_path / "damaged", columns, rows, 2, row_group_size=10)
    file, truth, counts = folder / "001.parquet", answers.in_memory(columns, rows), Counter()
    content = file.read_bytes()
    footer = len(content) - 8 - int.from_bytes(content[-8:-4], "little")
    for _ in range(number):
        damaged = bytearray(content)
        if chance.random() < 0.3:
            damaged = damaged[: chance.randrange(len(content))]
        else:
            damaged[chance.randrange(footer, len(content))] ^= 1 << chance.randrange(8)
        file.write_bytes(damaged)
        try:
            found = answers.serially(folder, tmp_path / "out", partition=20, resume=False)
        except (ValueError, TypeError) as error:
            counts["named" if str(file) in str(error) else str(error)] += 1
        else:
            assert answers.differences(found, truth) == []
            counts["equal"] += 1
    assert counts.keys() == {"named", "equal"}


@pytest.mark.parametrize("checksum", [True, False])
def test_a_page_that_is_damaged(points, checksum):
    """The message has the file and the row group; files that have checksums are read with them."""
    path = points.folder / "003.parquet"
    if checksum:
        options = {"compression": "none", "use_dictionary": False}
        pq.write_table(pq.read_table(path), path, write_page_checksum=True, **options)
    number = 0 if checksum else 2
    column = pq.ParquetFile(path).metadata.row_group(number).column(0)
    first = 300 if checksum else column.dictionary_page_offset or column.data_page_offset
    content = bytearray(path.read_bytes())
    content[first : first + 8] = b"\xff" * 8
    path.write_bytes(content)
    message = rf"003\.parquet: row group {number} cannot be read: {'.*checksum' if checksum else ''}"
    with pytest.raises(ValueError, match=message):
        points.run()


WITH_PROCESSES = [
    ("collect", 2, "out/scratch/*/spread/starts", partial(os.truncate, length=70)),
    ("solve", 2, "out/scratch/*/points/*.points", partial(os.truncate, length=70)),
    ("align", 2, "out/scratch/*/results/triangles/3.parquet", os.unlink),
]


@pytest.mark.parametrize(("name", "done", "pattern", "harm"), by_day(WITH_PROCESSES, WITH_PROCESSES[2]))
def test_what_changes_under_processes(tmp_path, points, name, done, pattern, harm):
    """The same with processes, one of which the system may end as what it has mapped is cut short."""
    with pytest.raises((ValueError, FileNotFoundError), match=r"changed|deleted|cut short|No such file"):
        points.run(jobs=2, progress=meanwhile(name, done, harmed(tmp_path, pattern, harm)))
    points.check(jobs=2, resume=False)


HALFWAY = [(files, "_group", "*.parquet"), (rounds, "check", "0.points"), (stars.StarRounds, "decide", "blocks/*")]


@pytest.mark.parametrize(("owner", "name", "pattern"), HALFWAY)
def test_what_changes_while_a_task_reads_it(tmp_path, points, monkeypatch, owner, name, pattern):
    """Whatever the task errs with then, if it does: the error is that of the file, which a run that goes on finds."""
    once = getattr(owner, name)
    harm = harmed(tmp_path, f"**/{pattern}", lambda path: path.write_bytes(bytes(path.stat().st_size - 1)))
    with monkeypatch.context() as patch:
        patch.setattr(owner, name, lambda *given: [harm(), patch.undo(), once(*given)].pop())
        for match in (r"changed (after it was written|since the run began); begin anew", "changed|not a Parquet file"):
            with pytest.raises(ValueError, match=match):
                points.run()


def test_nothing_is_left_of_an_earlier_run_with_other_arguments(tmp_path, points):
    """Neither in the folder of results nor in scratch elsewhere, which runs of other folders may share."""
    scratch = tmp_path / "scratch"
    for partition in (60, 90):
        with pytest.raises(KeyboardInterrupt):
            points.run(scratch=scratch, partition=partition, resume=False, progress=meanwhile("solve", 2, stop))
        assert len(list(scratch.iterdir())) == 1
    for out in ("other", "out"):
        points.check(out, scratch=scratch, partition=90)
    assert list(scratch.iterdir()) == []


def test_late_tasks_of_a_run_that_is_dead(tmp_path, points, monkeypatch):
    """Workers of a cluster outlive their client: what they write still, after another run began, is not in its way."""
    late = []
    once = passes_of.Passes.do

    def dying(self, name, function, tasks, **options):
        if name == "solve":
            late.extend(partial(passes_of.do, function, name, self.store, task, **options) for task in tasks)
            raise KeyboardInterrupt
        return once(self, name, function, tasks, **options)

    with monkeypatch.context() as patch:
        patch.setattr(passes_of.Passes, "do", dying)
        with pytest.raises(KeyboardInterrupt):
            points.run(partition=60)
    kept = tmp_path / "kept"
    shutil.copytree(points.out / "scratch", kept)

    def write_late():
        shutil.copytree(kept, points.out / "scratch", dirs_exist_ok=True)
        for task in late:
            task()

    for when in (("collect", 1), ("solve", 1), ("align", 1)):
        points.check(partition=150, resume=False, progress=meanwhile(*when, write_late))


def test_what_is_not_there_is_said(points):
    run = points.run(rows=(), triangles=False, keep=())
    with pytest.raises(ValueError, match="has no rows: the run was not asked for rows="):
        run.rows()
    for read in (run.triangles, run.cells):
        with pytest.raises(ValueError, match="the run was not asked for "):
            read()
    run = points.run("other", keep="id", rows="area")  # names by themselves
    assert run.rows().schema.names == ["id", "area"]
