"""Partitions say what one triangulation of all points says, to the last bit: on hard sets, however they are split."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stereodel.partitioned import passes
from stereodel.partitioned import run as running
from tests.partitioned.answers import differences, in_memory, serially, surface_of, write_points
from tests.partitioned.sets import LONLAT, SETS, XY, XYZ, rows_of

SIZE = 500


@pytest.fixture(scope="module")
def answers():
    """Of the sets in memory, each computed once."""
    found = {}

    def answer(name, size):
        if (name, size) not in found:
            columns, rows = rows_of(name, size)
            found[name, size] = columns, rows, in_memory(columns, rows)
        return found[name, size]

    return answer


def check(folder, columns, rows, truth, parts, files=5, **options):
    write_points(folder / "points", columns, rows, files)
    size = max(1, -(-len(rows) // parts))
    run = serially(
        folder / "points", folder / "out", columns=columns, surface=surface_of(columns), partition=size, **options
    )
    assert differences(run, truth) == []
    assert not (folder / "out" / "scratch").exists()
    return run


@pytest.mark.parametrize("parts", [1, 4, 16, 64])
@pytest.mark.parametrize("name", SETS)
def test_every_set_in_any_number_of_partitions(tmp_path, answers, name, parts):
    columns, rows, truth = answers(name, SIZE)
    run = check(tmp_path, columns, rows, truth, parts)
    assert run.statistics["points"] == len(rows)
    assert run.statistics["triangles"] == run.statistics["euler"] == len(truth[0])


@pytest.mark.large
@pytest.mark.parametrize("parts", [1, 4, 16, 64])
@pytest.mark.parametrize("name", SETS)
def test_every_large_set(tmp_path, answers, name, parts):
    sizes = {"great circle and a pole": 16_000, "great circle and both poles": 16_000, "plane: line and one": 16_000}
    columns, rows, truth = answers(name, sizes.get(name, 100_000))
    check(tmp_path, columns, rows, truth, parts)


@settings(max_examples=10)
@given(
    name=st.sampled_from(["uniform", "30 % duplicates", "airports", "integer directions", "plane: lattice"]),
    cuts=st.lists(st.integers(0, 250), max_size=6),
    partition=st.integers(12, 250),
    block=st.sampled_from([1, 7, 256]),
    share=st.integers(20, 500),
    compact=st.booleans(),
)
def test_any_split_gives_the_same(tmp_path_factory, name, cuts, partition, block, share, compact):
    """Files of any sizes, empty ones too, as partitions or spread, with blocks and tasks of any size."""
    columns, rows = rows_of(name, 250)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("stereodel.partitioned.plan.BLOCK", block)
        patch.setattr("stereodel.partitioned.plan.LEAST_SHARE", 1)
        patch.setattr("stereodel.partitioned.plan.LARGEST_SHARE", share)
        patch.setattr(passes, "is_compact", lambda *_: compact)
        check(
            tmp_path_factory.mktemp("split"),
            columns,
            rows,
            in_memory(columns, rows),
            -(-len(rows) // partition),
            sorted(min(cut, len(rows)) for cut in cuts),
        )


def test_compact_files_are_the_partitions(tmp_path):
    """Points by octants, in files: nothing is spread, and fewer points are read than by files at random."""
    columns, rows = rows_of("uniform", 4000)
    octant = (rows > 0) @ [1, 2, 4]
    order = np.argsort(octant, kind="stable")
    ends = np.cumsum(np.bincount(octant))[:-1]
    passes = set()
    run = check(
        tmp_path,
        columns,
        rows[order],
        in_memory(columns, rows[order]),
        8,
        ends,
        progress=lambda name, *_: passes.add(name),
    )
    assert run.statistics["compact"]
    assert passes == {"sample", "collect", "solve", "align"}


def test_files_in_another_order_are_spread(tmp_path):
    columns, rows = rows_of("uniform", 4000)
    calls = []
    run = check(tmp_path, columns, rows, in_memory(columns, rows), 8, progress=lambda *told: calls.append(told))
    assert not run.statistics["compact"]
    assert list(dict.fromkeys(name for name, _, _ in calls)) == list(running.PASSES)
    last = {name: (done, of) for name, done, of in calls}
    assert all(done == of > 0 for done, of in last.values())


@pytest.mark.parametrize(("columns", "name"), [(LONLAT, "airports"), (XYZ, "uniform"), (XY, "plane: uniform")])
def test_columns_that_are_wanted_alone(tmp_path, columns, name):
    _, rows = rows_of(name, 300)
    write_points(tmp_path / "points", columns, rows)
    run = serially(
        tmp_path / "points",
        tmp_path / "out",
        surface=surface_of(columns),
        rows=("nearest", "degree"),
        triangles=False,
        partition=50,
    )
    table = run.rows().to_table()
    assert table.column_names == ["degree", "nearest"]
    assert not (tmp_path / "out" / "triangles").exists()
    told = in_memory(columns, rows)[1]
    assert all(np.array_equal(table[name].to_numpy(), told[name]) for name in table.column_names)


def test_latitudes_of_the_ellipsoid(tmp_path):
    from stereodel import SphericalDelaunay, SphericalVoronoi

    _, rows = rows_of("airports", 200)
    write_points(tmp_path / "points", LONLAT, rows)
    run = serially(tmp_path / "points", tmp_path / "out", latitude="authalic", partition=60)
    areas = SphericalVoronoi(SphericalDelaunay.from_lonlat(rows, latitude="authalic")).areas()
    assert np.array_equal(run.rows().to_table()["area"].to_numpy(), areas)
