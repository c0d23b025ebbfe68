"""PlanarDelaunay: every triangulation ends in check_delaunay."""

import copy
import itertools
import json
import pickle
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import scipy.spatial
from hypothesis import given
from hypothesis import strategies as st

from stereodel.predicates import incircle
from stereodel.triangulation import PlanarDelaunay, check_delaunay
from stereodel.triangulation.topology import canonical

FIXTURES = sorted((Path(__file__).parent.parent / "fixtures" / "delaunator").glob("*.json"))
GRID_POINT = st.tuples(st.integers(-4, 4), st.integers(-4, 4))
FINITE = st.floats(allow_nan=False, allow_infinity=False)
GRID = np.array(list(itertools.product(range(7), range(6))), dtype=float)
CIRCLE = np.array([[s * x, r * y] for x, y in ((3, 4), (4, 3), (0, 5), (5, 0)) for s in (1, -1) for r in (1, -1)]) / 1.0
# Signed permutations of the axes that keep orientation: the quarter turns.
TURNS = [np.array(m, dtype=float) for m in ([[1, 0], [0, 1]], [[0, 1], [-1, 0]], [[-1, 0], [0, -1]], [[0, -1], [1, 0]])]


def checked(points, **options):
    triangulation = PlanarDelaunay(points, **options)
    check_delaunay(triangulation)
    return triangulation


def rows(simplices, names=None):
    simplices = np.asarray(simplices) if names is None else np.asarray(names)[simplices]
    return canonical(simplices.reshape(-1, 3)).tolist()


def names_of_points(points):
    """One number for each different point, the same in any order of input."""
    return np.unique(np.asarray(points) + 0.0, axis=0, return_inverse=True)[1].ravel()


def firm_edges(triangulation):
    """Edges, as coordinates, that are not diagonals of a cocircular polygon."""
    points, simplices, neighbors = triangulation.points, triangulation.simplices, triangulation.neighbors
    firm = set()
    for t, k in itertools.product(range(len(simplices)), range(3)):
        other = neighbors[t, k]
        opposite = simplices[other][~np.isin(simplices[other], simplices[t])]
        if other < 0 or incircle(*points[simplices[t]], points[opposite[0]]):
            firm.add(frozenset(tuple(points[v].tolist()) for v in np.delete(simplices[t], k)))
    return firm


def test_random_points_against_scipy():
    points = np.random.default_rng(0).random((2000, 2))
    triangulation = checked(points)
    assert rows(triangulation.simplices) == rows(scipy.spatial.Delaunay(points).simplices)
    hull = scipy.spatial.ConvexHull(points)
    assert {frozenset(e) for e in triangulation.convex_hull.tolist()} == {frozenset(e) for e in hull.simplices.tolist()}


@pytest.mark.parametrize("path", FIXTURES, ids=lambda p: p.stem)
def test_hard_fixtures(path):
    points = np.array(json.loads(path.read_text(encoding="utf-8")), dtype=float)
    triangulation = checked(points)
    assert triangulation.dimension == 2


@given(st.lists(GRID_POINT, max_size=14))
def test_small_grids(points):
    """Duplicates, collinear and cocircular points together."""
    checked(points)


@given(st.lists(st.tuples(FINITE, FINITE), max_size=8))
def test_any_doubles(points):
    checked(points)


@given(st.lists(GRID_POINT, min_size=3, max_size=14), st.randoms(use_true_random=False))
def test_the_order_of_input_does_not_matter(points, random):
    shuffled = random.sample(points, len(points))
    first, second = checked(points), checked(shuffled)
    assert rows(first.simplices, names_of_points(points)) == rows(second.simplices, names_of_points(shuffled))


@pytest.mark.parametrize("points", [GRID, CIRCLE, GRID * 0.1, np.vstack([CIRCLE, GRID])], ids=str)
def test_ten_shuffles(points):
    rng = np.random.default_rng(7)
    expected = rows(checked(points).simplices, names_of_points(points))
    for _ in range(10):
        shuffled = rng.permutation(points)
        assert rows(PlanarDelaunay(shuffled).simplices, names_of_points(shuffled)) == expected


@given(st.lists(GRID_POINT, min_size=3, max_size=12), st.sampled_from(TURNS))
def test_quarter_turns_keep_all_but_diagonals(points, turn):
    points = np.array(points, dtype=float)
    turned = checked(points @ turn)
    back = {frozenset(tuple((np.array(p) @ turn.T + 0.0).tolist()) for p in edge) for edge in firm_edges(turned)}
    assert back == firm_edges(checked(points + 0.0))


@given(st.lists(GRID_POINT, min_size=3, max_size=10), st.integers(-900, 900))
def test_powers_of_two_keep_everything(points, exponent):
    points = np.array(points, dtype=float)
    assert rows(checked(points * 2.0**exponent).simplices) == rows(checked(points).simplices)


@pytest.mark.parametrize("scale", [1e150, 1e-150, 2.0**-1070, 1e300])
def test_huge_and_tiny_coordinates(scale):
    rng = np.random.default_rng(1)
    triangulation = checked(rng.integers(-9, 9, size=(60, 2)) * scale)
    assert len(triangulation) > 50
    checked(np.vstack([rng.random((30, 2)), rng.random((30, 2)) * scale]))


def test_near_ties_cost_exact_tests_and_nothing_else():
    """A slanting grid of tenths: doubles, so that its squares are near-ties, decided as they are."""
    near = checked(GRID @ [[0.3, 0.4], [-0.4, 0.3]]).inconclusive
    assert near["filter"] > near["exact"] >= 0
    assert near["filter"] >= 30
    assert checked(np.random.default_rng(0).random((200, 2))).inconclusive["exact"] == 0
    assert checked(GRID).inconclusive["exact"] >= 30


def test_contract_of_the_arrays():
    points = np.random.default_rng(3).random((40, 2))
    triangulation = checked(points)
    assert triangulation.points is not points
    assert triangulation.simplices.dtype == triangulation.neighbors.dtype == triangulation.edges.dtype == np.int32
    names = ("points", "simplices", "neighbors", "edges", "convex_hull", "circumcenters", "duplicates")
    assert not any(getattr(triangulation, name).flags.writeable for name in names)
    assert (triangulation.simplices.argmin(axis=1) == 0).all()
    assert len(triangulation.edges) == 40 + len(triangulation) - 1  # Euler
    assert (triangulation.edges[:, 0] < triangulation.edges[:, 1]).all()
    assert sorted(triangulation.convex_hull[:, 0]) == sorted(triangulation.convex_hull[:, 1])
    points[:] = 0
    assert triangulation.points.any()
    assert "40 points" in repr(triangulation)
    assert len(triangulation) == len(triangulation.simplices)


def test_neighbors_on_demand():
    eager, lazy = PlanarDelaunay(GRID), PlanarDelaunay(GRID, neighbors=False)
    assert eager._rows[1] is not None
    assert lazy._rows[1] is None
    assert np.array_equal(eager.neighbors, lazy.neighbors)


def test_circumcenters_are_equally_far():
    points = np.random.default_rng(4).random((50, 2))
    triangulation = checked(points)
    for center, corners in zip(triangulation.circumcenters, points[triangulation.simplices], strict=True):
        distances = np.linalg.norm(corners - center, axis=1)
        np.testing.assert_allclose(distances, distances[0], rtol=1e-12)


def test_threads_change_nothing():
    for workers in (1, 2, np.int64(5), None):
        assert checked(GRID, workers=workers).simplices.tolist() == PlanarDelaunay(GRID, workers=1).simplices.tolist()
    with pytest.raises(ValueError, match="workers is 0"):
        PlanarDelaunay(GRID, workers=0)
    with pytest.raises(TypeError, match="workers"):
        PlanarDelaunay(GRID, workers=1.5)


@pytest.mark.parametrize(
    ("points", "dimension"),
    [
        ([], -1),
        ([[1, 2]], 0),
        ([[1, 2], [1, 2]], 0),
        ([[1, 2], [3, 4]], 1),
        ([[0, 0], [1, 1], [2, 2], [-7, -7]], 1),
        ([[0, 0], [1, 1], [2, 2 + 1e-15]], 2),
    ],
)
def test_small_and_flat_sets(points, dimension):
    triangulation = checked(points)
    assert triangulation.dimension == dimension
    count = 1 if dimension == 2 else 0
    shapes = [(count, 3), (count, 3), (3 * count, 2), (3 * count, 2), (count, 2)]
    names = ("simplices", "neighbors", "edges", "convex_hull", "circumcenters")
    assert [getattr(triangulation, name).shape for name in names] == shapes


def test_duplicates_keep_the_lowest_index():
    triangulation = checked([[0, 0], [1, 0], [-0.0, 0], [0, 1], [1, 0], [0, 0]])
    assert triangulation.duplicates.tolist() == [[2, 0], [4, 1], [5, 0]]
    assert triangulation.simplices.tolist() == [[0, 1, 3]]


@given(st.lists(GRID_POINT, min_size=3, max_size=8), st.lists(st.integers(0, 7), max_size=6))
def test_duplication_changes_no_simplex(points, repeated):
    twice = points + [points[k % len(points)] for k in repeated]
    assert rows(checked(twice).simplices) == rows(checked(points).simplices)


@pytest.mark.parametrize(
    "convert",
    [
        lambda p: p.tolist(),
        lambda p: p.astype(int).tolist(),
        lambda p: p.astype(np.float32),
        np.asfortranarray,
        lambda p: np.repeat(p, 2, axis=0)[::2],
        lambda p: [[Fraction(x) for x in row] for row in p.tolist()],
        np.ma.masked_array,
    ],
)
def test_accepted_input(convert):
    given_points = convert(GRID)
    before = copy.deepcopy(given_points)
    assert checked(given_points).simplices.tolist() == PlanarDelaunay(GRID).simplices.tolist()
    assert np.array_equal(np.asarray(before, dtype=float), np.asarray(given_points, dtype=float))


def test_read_only_input():
    points = GRID.copy()
    points.setflags(write=False)
    checked(points)


@pytest.mark.parametrize(
    ("bad", "error", "message"),
    [
        ([[0, 0], [1, np.nan]], ValueError, r"points\[1, 1\] is nan"),
        ([[0, np.inf]], ValueError, r"points\[0, 1\] is inf"),
        ([[1j, 0]], TypeError, "points must hold real numbers, not complex128"),
        (["ab"], TypeError, "points must hold real numbers"),
        ([[1, 2, 3]], ValueError, r"points must have shape \(n, 2\), got \(1, 3\)"),
        ([1, 2], ValueError, r"points must have shape \(n, 2\), got \(2,\)"),
        (np.ma.masked_equal([[1.0, 2.0]], 2), ValueError, r"points\[0, 1\] is masked"),
    ],
)
def test_refused_input(bad, error, message):
    with pytest.raises(error, match=message):
        PlanarDelaunay(bad)


@given(st.lists(GRID_POINT, max_size=10), st.lists(GRID_POINT, max_size=6))
def test_insert_equals_a_fresh_build(assert_same, old, new):
    triangulation = PlanarDelaunay(old)
    before = triangulation.simplices
    kept = before.tolist()
    assert triangulation.insert(new).tolist() == list(range(len(old), len(old) + len(new)))
    assert_same(triangulation, checked(old + new))
    assert before.tolist() == kept


def test_nothing_of_the_old_state_outlives_a_change(assert_same):
    triangulation = PlanarDelaunay(GRID[:20])
    names = ("neighbors", "edges", "convex_hull", "circumcenters")
    for change in (lambda: triangulation.insert(GRID[20:] + 0.25), lambda: triangulation.remove([0, 1, 7])):
        _ = (
            [getattr(triangulation, name) for name in names],
            triangulation.nearest(GRID),
            triangulation.find_simplex(GRID),
        )
        change()
        fresh = checked(triangulation.points)
        assert_same(triangulation, fresh)
        assert np.array_equal(triangulation.nearest(GRID), fresh.nearest(GRID))
        assert np.array_equal(triangulation.find_simplex(GRID) < 0, fresh.find_simplex(GRID) < 0)


@given(st.lists(GRID_POINT, min_size=1, max_size=12), st.data())
def test_remove_equals_a_fresh_build(assert_same, points, data):
    indices = data.draw(st.lists(st.integers(0, len(points) - 1), max_size=6))
    triangulation = PlanarDelaunay(points)
    names = triangulation.remove(indices)
    stay = [k for k in range(len(points)) if k not in indices]
    assert names.tolist() == [stay.index(k) if k in stay else -1 for k in range(len(points))]
    assert_same(triangulation, checked([points[k] for k in stay]))


def test_insert_then_remove_is_nothing(assert_same):
    triangulation = PlanarDelaunay(GRID)
    triangulation.remove(triangulation.insert(np.random.default_rng(1).random((20, 2)) * 5))
    assert_same(triangulation, PlanarDelaunay(GRID))


def test_a_removed_point_gives_way_to_its_duplicate():
    triangulation = PlanarDelaunay([[0, 0], [1, 0], [0, 1], [0, 0]])
    assert triangulation.remove([0]).tolist() == [-1, 0, 1, 2]
    assert triangulation.simplices.tolist() == [[0, 1, 2]]
    assert triangulation.duplicates.shape == (0, 2)


def test_refused_changes_change_nothing():
    triangulation = PlanarDelaunay(GRID)
    for bad in ([42], [-1], [[0]], [0.5]):
        with pytest.raises((ValueError, TypeError), match="indices"):
            triangulation.remove(bad)
    with pytest.raises(ValueError, match="points"):
        triangulation.insert([[0, np.nan]])
    assert triangulation.simplices.tolist() == PlanarDelaunay(GRID).simplices.tolist()


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda t: pickle.loads(pickle.dumps(t))])
def test_copies_are_independent(duplicate):
    triangulation = PlanarDelaunay(GRID)
    other = duplicate(triangulation)
    other.insert([[0.5, 0.5]])
    triangulation.insert([[2.5, 2.5], [9, 9]])
    check_delaunay(other)
    check_delaunay(triangulation)
    assert len(other.points) + 1 == len(triangulation.points)


def test_simplices_known_from_elsewhere(assert_same):
    """What the Voronoi diagram's way back uses."""
    direct = PlanarDelaunay(GRID)
    known = PlanarDelaunay._from_simplices(direct.points, direct.simplices[::-1].copy(), direct.duplicates)
    assert_same(known, direct)
    known.insert([[0.25, 0.5]])
    check_delaunay(known)
