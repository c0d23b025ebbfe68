"""Answers at targets are those of all points in memory, to the last bit, however points and targets are split."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel import angular_distance, lonlat_to_xyz
from stereodel._spaces import space_of
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator
from stereodel.partitioned import Answers
from tests import sets
from tests.examples import examples
from tests.partitioned.answers import executed, mesh_of, rows_of, serially, surface_of, write_points
from tests.sets import LONLAT, XY, XYZ

SIZE = 200
KINDS = {"linear": LinearInterpolator, "natural": NaturalNeighborInterpolator}
QUICK = ["sphere random", "sphere copied", "sphere whole numbers", "plane lattice", "plane thin strip"]
FLAT = ["sphere circle and a pole", "sphere one", "plane line"]
SETS = [
    pytest.param(one, id=str(one), marks=() if str(one) in QUICK + FLAT else pytest.mark.thorough)
    for one in sets.ALL.values()
    if len(one.rows(SIZE)) and one.name not in ("components", "huge", "large and small", "largest")
]


@pytest.fixture
def rng():
    return np.random.default_rng(20261123)


@pytest.fixture(autouse=True)
def small(monkeypatch):
    """Blocks and lots of few points, of which some are far: so that rounds, and halves of lots, are many."""
    few = {"plan.BLOCK": 8, "questions.ROOM": 150, "rounds.SKELETON": 16, "rounds.LEAST_BUDGET": 8}
    for name, value in few.items():
        monkeypatch.setattr(f"stereodel.partitioned.{name}", value)


def targets_of(columns, rows, rng, count=20):
    """Near points, at points, between two of them, and far from all."""
    points = lonlat_to_xyz(rows) if columns == LONLAT else rows
    if len(columns) > 2 or columns == LONLAT:
        points = points / np.abs(points).max(axis=1)[:, None]
    some, others = points[rng.integers(0, len(points), (2, count // 4))]
    size = np.abs(some - others).max(axis=1)[:, None] * 10.0 ** rng.uniform(-3, -1, (len(some), 1))
    far = rng.normal(size=some.shape) * np.abs(points).max()
    found = np.concatenate([some + size * rng.normal(size=some.shape), some, (some + others) / 2, far])
    return rng.permutation(found[np.abs(found).max(axis=1) > 0])


def run_of(folder, columns, rows, values, parts):
    names = (*columns, "value", "other", "wrong")[: len(columns) + values.shape[1]]
    write_points(folder / "points", names, np.column_stack([rows, values]), 3)
    size = max(1, -(-len(rows) // parts))
    options = {"columns": columns, "surface": surface_of(columns), "rows": (), "triangles": False, "partition": size}
    return serially(folder / "points", folder / "out", index=True, **options)


def differences(found, mesh, values, targets):
    """Names of what differs from the answer in memory by a bit."""
    nearest, k = found["nearest"].rows().to_table(), min(7, len(mesh.points))
    right = mesh.nearest(targets, k=k)
    near, plane = mesh.points[right], targets.shape[1] == 2
    between = targets[:, None]
    away = np.hypot(*np.moveaxis(between - near, -1, 0)) if plane else np.radians(angular_distance(between, near))
    wrong = [] if np.array_equal(np.array(nearest["nearest"].to_pylist()), right) else ["nearest"]
    wrong += [] if np.array_equal(np.array(nearest["distance"].to_pylist()), away) else ["distance"]
    at_edge = on_edges(mesh, targets)
    for method, kind in KINDS.items():
        table, right = found[method].rows().to_table(), kind(mesh, values)(targets)
        answer = np.column_stack([table[name].to_numpy() for name in ("value", "other")])
        equal = (answer == right) | (np.isnan(answer) & np.isnan(right))
        # Of several triangles another one may answer, or be the first.
        lost = np.isnan(answer - right) & (method == "linear")
        equal |= at_edge & (np.isclose(answer, right, rtol=1e-12, atol=1e-12) | lost)
        wrong += [] if equal.all() else [method]
    return wrong


def on_edges(mesh, targets):
    """Whether each target lies on an edge of a triangle, or at a point, exactly; (m, 1)."""
    inside = np.asarray(mesh.find_simplex(targets))
    if not len(mesh.simplices):
        return np.zeros((len(targets), 1), bool)
    corners, space = mesh.points[mesh.simplices[inside]], space_of(mesh.points)
    signs = [space.turn(corners[:, k].copy(), corners[:, k - 1].copy(), targets) for k in range(3)]
    return ((inside >= 0) & ~np.all(signs, axis=0))[:, None]


def check(folder, columns, rows, parts, rng, lots=3):
    """Answers at targets, nearest and by both methods, from one folder of files."""
    values, targets = rng.normal(size=(len(rows), 2)), targets_of(columns, rows, rng)
    values[::29] = np.nan
    run = run_of(folder, columns, rows, values, parts)
    asking = write_points(folder / "targets", XY if targets.shape[1] == 2 else XYZ, targets, 3)
    same = {"jobs": 1, "partition": max(1, len(targets) // lots)}
    found = {"nearest": executed(run.nearest, asking, folder / "nearest", k=min(7, len(rows)), **same)}
    for method in KINDS:
        options = same | {"method": method}
        found[method] = executed(run.interpolate, asking, folder / method, ["value", "other"], **options)
    assert differences(found, mesh_of(columns, rows), values, targets) == []
    assert not any((each.folder / "scratch").exists() for each in found.values())


@pytest.mark.parametrize("one", SETS)
def test_every_set(tmp_path, one, rng):
    check(tmp_path, one.columns, one.rows(min(SIZE, one.size) if "sizes" in one.traits else SIZE), 5, rng)


@examples(0.04)
@given(
    name=st.sampled_from(QUICK),
    parts=st.integers(1, 12),
    lots=st.integers(1, 8),
    block=st.sampled_from([1, 7, 64]),
    room=st.sampled_from([1, 100, 10_000]),
    seed=st.integers(0, 2**32 - 1),
)
@example(name="sphere whole numbers", parts=1, lots=1, block=1, room=1, seed=409927)  # halfway between two points
def test_any_split_gives_the_same(tmp_path_factory, name, parts, lots, block, room, seed):
    space, _, kind = name.partition(" ")
    columns, rows = rows_of(kind, 120, space)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("stereodel.partitioned.plan.BLOCK", block)
        patch.setattr("stereodel.partitioned.questions.ROOM", room)
        patch.setattr("stereodel.partitioned.plan.LEAST_SHARE", 10)
        check(tmp_path_factory.mktemp("split"), columns, rows, parts, np.random.default_rng(seed), lots=lots)


@pytest.fixture
def octahedron(tmp_path):
    rows = np.concatenate([np.eye(3), -np.eye(3)])
    values = np.column_stack([np.arange(12.0).reshape(6, 2), np.full(6, np.inf)])
    return run_of(tmp_path / "octahedron", XYZ, rows, values, 2)


def test_the_nearest_point_alone_with_columns_that_are_kept(tmp_path, octahedron):
    """Numbers without lists; rows of an empty file, too; places by longitude and latitude."""
    folder = tmp_path / "targets"
    (folder / "deep").mkdir(parents=True)
    table = pa.table({"lon": [1.0, 91.0], "lat": [2.0, -3.0], "name": ["a", "b"]})
    pq.write_table(table.slice(0, 0), folder / "a.parquet")
    pq.write_table(table, folder / "deep" / "b.parquet")
    found = octahedron.nearest(folder, tmp_path / "out", keep=["name"])
    told = found.rows().to_table()
    assert told.column_names == ["name", "nearest", "distance"]
    assert told["name"].to_pylist() == ["a", "b"]
    assert told["nearest"].to_pylist() == [0, 1]
    assert pq.read_metadata(tmp_path / "out" / "rows" / "a.parquet").num_rows == 0
    assert pq.read_metadata(tmp_path / "out" / "rows" / "deep" / "b.parquet").num_rows == 2
    assert found.statistics["targets"] == 2
    assert Answers(tmp_path / "out").rows().to_table() == told


def test_no_target_and_no_point(tmp_path, octahedron):
    write_points(tmp_path / "none", XYZ, np.empty((0, 3)), 1)
    write_points(tmp_path / "one", XYZ, np.ones((1, 3)), 1)
    assert octahedron.nearest(tmp_path / "none", tmp_path / "a", k=2).rows().to_table().num_rows == 0
    assert octahedron.interpolate(tmp_path / "none", tmp_path / "b", "value").rows().to_table().num_rows == 0
    empty = run_of(tmp_path / "empty", XYZ, np.empty((0, 3)), np.empty((0, 2)), 1)
    assert np.isnan(empty.interpolate(tmp_path / "one", tmp_path / "c", "value").rows().to_table()["value"][0].as_py())
    with pytest.raises(ValueError, match="nearest needs at least one point; this run has none"):
        empty.nearest(tmp_path / "one", tmp_path / "d")


ASKED = [
    ("nearest", "wrong", {}, ValueError, r"000\.parquet: row 2: the x is missing"),
    ("nearest", "right", {"k": 7}, ValueError, "k is 7, but must be at most 6"),
    ("nearest", "right", {"limit": 1}, MemoryError, r"target 0 may need 3 points.* limit=1"),
    ("interpolate", "right", {"values": "value", "method": "smooth"}, ValueError, "method is 'smooth', but must be"),
    ("interpolate", "right", {"values": "height"}, ValueError, "values has 'height', which is not one of the columns"),
    ("interpolate", "right", {"values": []}, ValueError, "values is empty"),
    ("interpolate", "right", {"values": "x", "keep": ["x"]}, ValueError, "column 'x' cannot be kept"),
    ("interpolate", "right", {"values": "wrong"}, ValueError, r"000\.parquet: row 1: the wrong is inf"),
]


@pytest.mark.parametrize(("question", "targets", "options", "error", "message"), ASKED)
def test_what_cannot_be_asked(tmp_path, octahedron, question, targets, options, error, message):
    rows = np.array([[1.0, 2, 3], [np.nan, 1, 1]][: 1 + (targets == "wrong")])
    folder = write_points(tmp_path / "targets", XYZ, rows, 1)
    with pytest.raises(error, match=message):
        executed(getattr(octahedron, question), folder, tmp_path / "out", jobs=1, **options)


def test_points_that_changed_and_runs_without_an_index(tmp_path, octahedron):
    right = write_points(tmp_path / "right", XYZ, np.ones((1, 3)), 1)
    with pytest.raises(FileNotFoundError, match="triangulate them with index=True"):
        serially(right, tmp_path / "plain").nearest(right, tmp_path / "other")
    write_points(tmp_path / "octahedron" / "points", XYZ, np.ones((1, 3)), 1)
    with pytest.raises(ValueError, match=r"000\.parquet has changed since the run began"):
        octahedron.interpolate(right, tmp_path / "other", "value")


def test_other_questions_in_a_folder_are_noticed(tmp_path, octahedron):
    right = write_points(tmp_path / "right", XYZ, np.ones((1, 3)), 1)
    first = octahedron.nearest(right, tmp_path / "out", k=2).rows().to_table()
    assert octahedron.nearest(right, tmp_path / "out", k=2).rows().to_table() == first
    with pytest.raises(ValueError, match="a run of other files or arguments: question was"):
        octahedron.nearest(right, tmp_path / "out", k=3)
    assert executed(octahedron.nearest, right, tmp_path / "out", k=3, resume=False).rows().to_table() != first
