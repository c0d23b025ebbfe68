"""Partitions say what one triangulation of all points says, to the last bit: on hard sets, however they are split."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.partitioned import spread, stars
from tests import sets
from tests.examples import examples
from tests.partitioned.answers import PASSES, differences, in_memory, rows_of, serially, surface_of, write_points
from tests.sets import LONLAT, XY, XYZ

SIZE = 500
QUICK = ["sphere random", "sphere copied", "sphere whole numbers", "sphere great circle", "sphere circle and a pole"]
QUICK += ["sphere none", "plane lattice", "plane line and one"]


def of_any(few=True):
    """Each set in any number of partitions, those of few points in four; by day some in four, one in sixteen."""
    for one in sets.ALL.values():
        for parts in (1, 4, 16, 64) if "grows" in one.traits else (4,) if few else ():
            by_day = (str(one) in QUICK and parts == 4) or (str(one) == "sphere random" and parts == 16)
            marks = () if by_day else pytest.mark.thorough
            yield pytest.param(one, parts, marks=marks, id=f"{one} in {parts}")


@pytest.fixture(scope="module")
def answers():
    """Of the sets in memory, each computed once."""
    found = {}

    def answer(one, size):
        if (one, size) not in found:
            rows = one.rows(size)
            found[one, size] = one.columns, rows, in_memory(one.columns, rows)
        return found[one, size]

    return answer


def check(folder, columns, rows, parts, files=5, truth=None, **options):
    write_points(folder / "points", columns, rows, files)
    size = max(1, -(-len(rows) // parts))
    options |= {"columns": columns, "surface": surface_of(columns), "partition": size}
    try:
        run = serially(folder / "points", folder / "out", **options)
    except RuntimeError as error:
        pytest.fail(f"the run notices itself: {error}")
    assert differences(run, truth or in_memory(columns, rows)) == []
    assert not (folder / "out" / "scratch").exists()
    return run


@pytest.mark.parametrize(("one", "parts"), list(of_any()))
def test_every_set_in_any_number_of_partitions(tmp_path, answers, one, parts):
    columns, rows, truth = answers(one, min(SIZE, one.size) if "sizes" in one.traits else SIZE)
    run = check(tmp_path, columns, rows, parts, truth=truth)
    assert run.statistics["points"] == len(rows)
    assert run.statistics["triangles"] == run.statistics["euler"] == len(truth[0])


@pytest.mark.large
@pytest.mark.parametrize(("one", "parts"), list(of_any(few=False)))
def test_every_large_set(tmp_path, answers, one, parts):
    """The pole of a circle has a star of all points."""
    size = 16_000 if "circle and" in one.name or one.name == "line and one" else 100_000
    columns, rows, truth = answers(one, min(size, one.size) if "sizes" in one.traits else size)
    check(tmp_path, columns, rows, parts, truth=truth)


@examples(0.1)
@given(
    one=st.sampled_from([sets.sphere(name) for name in ("random", "copied", "airports", "whole numbers")])
    | st.just(sets.plane("lattice")),
    cuts=st.lists(st.integers(0, 250), max_size=6),
    partition=st.integers(12, 250),
    block=st.sampled_from([1, 7, 256]),
    share=st.integers(20, 500),
    compact=st.booleans(),
    halo=st.booleans(),
)
def test_any_split_gives_the_same(tmp_path_factory, one, cuts, partition, block, share, compact, halo):
    """Files of any sizes, empty ones too, as partitions or spread, with blocks and tasks of any size, without halo."""
    columns, rows = one.columns, one.rows(250)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("stereodel.partitioned.plan.BLOCK", block)
        patch.setattr("stereodel.partitioned.plan.LEAST_SHARE", 1)
        patch.setattr("stereodel.partitioned.plan.LARGEST_SHARE", share)
        patch.setattr(spread, "is_compact", lambda *_: compact)
        patch.setattr(stars, "REACH", stars.REACH if halo else -1.0)
        files = sorted(min(cut, len(rows)) for cut in cuts)
        check(tmp_path_factory.mktemp("split"), columns, rows, -(-len(rows) // partition), files)


def test_a_circle_through_the_corner_of_a_block_is_open(tmp_path, monkeypatch):
    """Its tie is decided with the point there, though nothing else had that block read."""
    monkeypatch.setattr(stars, "REACH", -1.0)
    rows = sets.plane("lattice").rows(250)
    check(tmp_path, XY, rows, 40)


def test_compact_files_are_the_partitions(tmp_path):
    """Points by octants, in files: nothing is spread, and fewer points are read than by files at random."""
    columns, rows = rows_of("random", 4000)
    octant = (rows > 0) @ [1, 2, 4]
    order = np.argsort(octant, kind="stable")
    ends = np.cumsum(np.bincount(octant))[:-1]
    passes = set()
    run = check(tmp_path, columns, rows[order], 8, ends, progress=lambda name, *_: passes.add(name))
    assert run.statistics["compact"]
    assert passes == {"sample", "collect", "solve", "align"}


def test_files_in_another_order_are_spread(tmp_path):
    columns, rows = rows_of("random", 4000)
    calls = []
    run = check(tmp_path, columns, rows, 8, progress=lambda *told: calls.append(told))
    assert not run.statistics["compact"]
    assert list(dict.fromkeys(name for name, _, _ in calls)) == list(PASSES)
    last = {name: (done, of) for name, done, of in calls}
    assert all(done == of > 0 for done, of in last.values())


@pytest.mark.parametrize(("columns", "name"), [(LONLAT, "airports"), (XYZ, "random"), (XY, "random")])
def test_columns_that_are_wanted_alone(tmp_path, columns, name):
    _, rows = rows_of(name, 300, surface_of(columns))
    write_points(tmp_path / "points", columns, rows)
    options = {"surface": surface_of(columns), "rows": ("nearest", "degree"), "triangles": False, "partition": 50}
    run = serially(tmp_path / "points", tmp_path / "out", **options)
    table = run.rows().to_table()
    assert table.column_names == ["degree", "nearest"]
    assert not (tmp_path / "out" / "triangles").exists()
    told = in_memory(columns, rows)[1]
    assert all(np.array_equal(table[name].to_numpy(), told[name]) for name in table.column_names)
