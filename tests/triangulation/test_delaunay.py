"""Triangulations of plane and sphere: each ends in check_delaunay, and is that of the readable engine."""

import copy
import itertools
import json
import os
import pickle
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay
from stereodel.predicates import in_bubble, incircle
from stereodel.triangulation.hull_insertion import spanning_points
from stereodel.triangulation.topology import neighbors_of
from tests import sets
from tests.spaces import BOTH, PLANE, SPHERE, asked, readable, rows, space_of

FIXTURES = sorted((Path(__file__).parent.parent / "fixtures" / "delaunator").glob("*.json"))
POLES = list(itertools.product(range(3), (-1, 1)))
GRID = sets.grid(7, 6)
EQUATOR = np.array([[s * x, r * y, 0] for x, y in ((3, 4), (4, 3), (12, 5)) for s in (1, -1) for r in (1, -1)]) / 1.0
# Exact rotations: signed permutations of the axes with determinant 1.
TURNS = {
    width: [
        np.array(m)
        for p in itertools.permutations(np.eye(width))
        for s in itertools.product((1, -1), repeat=width)
        if np.linalg.det(m := np.array(p) * np.array(s)[:, None]) > 0
    ]
    for width in (2, 3)
}


def by_kernel(points, workers=1, pole=(0, -1)):
    points = np.ascontiguousarray(points, dtype=float)
    options = () if points.shape[1] == 2 else (True, *pole)
    return space_of(points).kernel.triangulate(points, workers, *options)


def assert_as_the_readable_engine(points, poles=POLES[:1]):
    """At both doors, from any pole."""
    space = space_of(points)
    points = space.array(points)
    reference, triangulation = readable(points), space.triangulated(points)
    assert rows(triangulation.simplices) == reference.simplices.tolist()
    for pole in poles if space is SPHERE else poles[:1]:
        simplices, neighbors, duplicates, dimension, _ = by_kernel(points, 1, pole)
        assert dimension == triangulation.dimension == reference.dimension
        assert duplicates.tolist() == triangulation.duplicates.tolist() == reference.duplicates.tolist()
        assert rows(simplices) == reference.simplices.tolist()
        assert np.array_equal(neighbors, neighbors_of(simplices))
    return triangulation


def assert_shuffled_the_same(triangulation, order, pole=POLES[0]):
    points = triangulation.points
    kept = np.arange(len(points))
    kept[triangulation.duplicates[:, 0]] = triangulation.duplicates[:, 1]
    shuffled = by_kernel(points[order], pole=pole)[0]
    assert rows(shuffled, kept[order]) == rows(triangulation.simplices)


@pytest.mark.parametrize("one", sets.of())
def test_of_every_set_from_every_pole_in_any_order(rng, one):
    points = one.drawn(min(one.size, 150)) if "grows" in one.traits else one.points
    triangulation = assert_as_the_readable_engine(points, POLES)
    for pole in POLES:
        assert_shuffled_the_same(triangulation, rng.permutation(len(points)), pole)


@BOTH
@pytest.mark.parametrize("unit", [False, True])
@pytest.mark.parametrize("spread", [1e-3, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14, 1e-15])
def test_clusters(rng, space, spread, unit):
    """Hulls of rounded vectors lose points below 1e-8; rays lose none. Alone, and seen from elsewhere."""
    cluster = space.cluster(rng, spread, 120)
    triangulation = assert_as_the_readable_engine(sets.unit(cluster) if unit else cluster, POLES[::5])
    if not unit and space is SPHERE:
        assert len(triangulation.duplicates) == 0
        assert triangulation.closing.any()
        among = assert_as_the_readable_engine(np.vstack([cluster, rng.normal(size=(60, 3))]))
        assert not among.closing.any()


@BOTH
@given(data=st.data())
def test_small_integers(space, data):
    """Duplicates, collinear, opposite and cocircular points together, in any order."""
    points = data.draw(space.points(3, max_size=14))
    triangulation = assert_as_the_readable_engine(points, [data.draw(st.sampled_from(POLES))])
    assert_shuffled_the_same(triangulation, np.array(data.draw(st.permutations(range(len(points)))), dtype=int))


@BOTH
@given(data=st.data())
def test_any_doubles(space, data):
    place = st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * space.width)
    space.triangulated(space.array(data.draw(st.lists(place.filter(any), max_size=8))))


def firm_edges(triangulation, names):
    """Edges that are not diagonals of a cocircular polygon."""
    points, simplices, neighbors = triangulation.points, triangulation.simplices, triangulation.neighbors
    sign = incircle if points.shape[1] == 2 else in_bubble
    firm = set()
    for t, k in itertools.product(range(len(simplices)), range(3)):
        other, edge = neighbors[t, k], np.delete(simplices[t], k)
        # The other triangle's corners are those of the edge and the one wanted.
        if other < 0 or sign(*points[simplices[t]], points[simplices[other].sum() - edge.sum()]):
            firm.add(frozenset(names[edge].tolist()))
    return firm


@BOTH
@given(data=st.data())
def test_exact_rotations_keep_all_but_diagonals(space, data):
    points = data.draw(space.points(3, min_size=3, max_size=10))
    names, turn = space.names(points), data.draw(st.sampled_from(TURNS[space.width]))
    assert firm_edges(space.triangulated(points @ turn), names) == firm_edges(space.triangulated(points), names)


@BOTH
@given(data=st.data())
def test_repetition_and_length_change_no_simplex(space, data):
    points = data.draw(space.points(3, min_size=3, max_size=8))
    repeated = data.draw(st.lists(st.integers(0, len(points) - 1), max_size=6))
    twice = np.vstack([points, points[repeated]])
    if space is PLANE:
        factors = 2.0 ** data.draw(st.integers(-900, 900))
    else:
        factor = st.sampled_from([1.0, 3.0, 2.0**-1070, 2.0**900])
        factors = np.array(data.draw(st.lists(factor, min_size=len(twice), max_size=len(twice))))[:, None]
    assert rows(space.triangulated(twice * factors).simplices) == rows(space.triangulated(points).simplices)


@pytest.mark.parametrize("path", FIXTURES, ids=lambda p: p.stem)
def test_hard_fixtures(path):
    points = np.array(json.loads(path.read_text(encoding="utf-8")), dtype=float)
    assert PLANE.triangulated(points).dimension == 2


def test_the_nearest_doubles_are_different_points():
    base = np.array([0.6, 0.64, 0.48])
    points = np.array([base + np.spacing(base) * np.array(s) for s in itertools.product((-1, 0, 1), repeat=3)])
    assert len(SPHERE.triangulated(np.vstack([points, -points])).duplicates) == 0


def test_closing_facets_of_a_cap(rng):
    cap = [0, 0, 1] + 0.3 * rng.normal(size=(50, 3)) * [1, 1, 0]
    triangulation = SPHERE.triangulated(cap)
    assert np.array_equal(triangulation.closing, np.linalg.det(cap[triangulation.simplices]) <= 0)
    hull = triangulation.convex_hull
    assert len(hull) == triangulation.closing.sum() + 2
    assert sorted(hull[:, 0]) == sorted(hull[:, 1])
    for u, v in hull.tolist():  # all points lie to the left
        assert (cap @ np.cross(cap[u], cap[v]) > -1e-15).all()


def test_a_facet_through_the_centre_is_closing():
    triangulation = SPHERE.triangulated(np.vstack([EQUATOR, [[0, 0, 1]]]))
    assert triangulation.closing.sum() == len(EQUATOR) - 2
    assert len(triangulation.convex_hull) == len(EQUATOR)
    small_circle = SPHERE.triangulated(sets.sphere("small circle").points)
    assert small_circle.closing.sum() == 5 - 2 == len(small_circle) / 2
    three = SPHERE.triangulated(np.eye(3))
    assert three.simplices.tolist() == [[0, 1, 2], [0, 2, 1]]
    assert three.closing.tolist() == [False, True]
    assert three.neighbors.tolist() == [[1, 1, 1], [0, 0, 0]]


SPANNING = [
    ([0], [[[1, 2]], [[1, 2], [1, 2]], [[0, 0, 5]], [[0, 0, 5], [0, 0, 1e-300]]]),
    ([0, 1], [[[1, 2], [3, 4]], [[0, 0], [1, 1], [2, 2], [-7, -7]], [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]]),
    ([0, 1], [[[1, 0, 0], [-1, 0, 0]], EQUATOR, EQUATOR @ sets.TILT, [[1, 2, 3], [2, 4, 7], [3, 6, 1], [0, 0, 1]]]),
    ([0, 1, 2], [[[0, 0], [1, 1], [2, 2 + 1e-15]]]),
    ([0, 1, 3], [[[1, 1], [2, 2], [3, 3], [1e-300, 0]]]),
    ([0, 1, 3], [[[0, 0], [0.1, 0.3], [0.2, 0.6], [0.3, 0.9]]]),  # 0.9 is not three times the double 0.3
    ([0, 2], [[[1, 0, 0], [-2, 0, 0], [0, 1, 0], [0, -1, 0]]]),
    ([0, 2, 3], [[[1, 0, 0], [-2, 0, 0], [0, 1, 0], [0, -1, 1e-300]]]),
]


@pytest.mark.parametrize(("spanning", "points"), [(spanning, one) for spanning, many in SPANNING for one in many])
def test_small_and_flat_sets(points, spanning):
    """The first points that span are told exactly; arrays have their shapes also where there are none."""
    space, points = space_of(points), np.array(points, dtype=float)
    for some, expected in ((points, spanning), (points[:0], [])):
        triangulation = space.triangulated(some)
        count = len(triangulation.simplices)
        shapes = [(count, 3), (count, 3), (count, space.width)]
        names = ("simplices", "neighbors", "circumcenters")
        assert [getattr(triangulation, name).shape for name in names] == shapes
        kept = np.setdiff1d(range(len(some)), triangulation.duplicates[:, 0]).tolist()
        assert spanning_points(asked(some), kept) == expected
        assert triangulation.dimension == len(expected) - 1
        assert (count > 0) == (triangulation.dimension == 2)
        assert count or len(triangulation.edges) == len(triangulation.convex_hull) == 0


def test_duplicates_keep_the_lowest_index():
    triangulation = PLANE.triangulated([[0, 0], [1, 0], [-0.0, 0], [0, 1], [1, 0], [0, 0]])
    assert triangulation.duplicates.tolist() == [[2, 0], [4, 1], [5, 0]]
    assert triangulation.simplices.tolist() == [[0, 1, 3]]
    points = np.array([[1, 2, 3], [2, 4, 6], [1, 2, 3 + 1e-15], [1, 0, 0], [5e-324, 0, -0.0], [0, 1, 0]])
    assert SPHERE.triangulated(points).duplicates.tolist() == [[1, 0], [4, 3]]


def test_near_ties_cost_exact_tests_and_nothing_else():
    """A slanting grid of tenths: doubles, so that its squares are near-ties, decided as they are."""
    near = PlanarDelaunay(GRID @ [[0.3, 0.4], [-0.4, 0.3]]).inconclusive
    assert near["filter"] > near["exact"] >= 0
    assert near["filter"] >= 30
    assert PlanarDelaunay(np.random.default_rng(0).random((200, 2))).inconclusive["exact"] == 0
    assert PlanarDelaunay(GRID).inconclusive["exact"] >= 30
    stages = ("filter", "curvature", "double_double", "exact")
    assert SphericalDelaunay(sets.sphere("random").points).inconclusive == dict.fromkeys(stages, 0)
    assert SphericalDelaunay(sets.CUBE).inconclusive["exact"] >= 6
    nearly = SphericalDelaunay(sets.sphere("graticule").points).inconclusive
    assert nearly["filter"] > nearly["exact"]


@BOTH
def test_contract_of_the_arrays(space):
    points = space.random(np.random.default_rng(3), 40)
    triangulation = space.triangulated(points)
    assert triangulation.points is not points
    assert triangulation.simplices.dtype == triangulation.neighbors.dtype == triangulation.edges.dtype == np.int32
    names = ("points", "simplices", "neighbors", "edges", "convex_hull", "circumcenters", "duplicates")
    assert not any(getattr(triangulation, name).flags.writeable for name in names)
    assert (triangulation.simplices.argmin(axis=1) == 0).all()
    assert len(triangulation.edges) == 40 + len(triangulation) - (1 if space is PLANE else 2)  # Euler
    assert (triangulation.edges[:, 0] < triangulation.edges[:, 1]).all()
    assert sorted(triangulation.convex_hull[:, 0]) == sorted(triangulation.convex_hull[:, 1])
    for edges in (triangulation.edges, triangulation.convex_hull):
        assert edges.tolist() == sorted(edges.tolist())
    points[:] = 1
    assert len(np.unique(triangulation.points)) > 1
    assert "40 points" in repr(triangulation)
    assert len(triangulation) == len(triangulation.simplices)
    lazy = space.delaunay(triangulation.points, neighbors=False)
    assert triangulation._now().known_neighbors is not None
    assert lazy._now().known_neighbors is None
    assert np.array_equal(triangulation.neighbors, lazy.neighbors)


@BOTH
def test_neighbours_of_points_are_the_ends_of_edges(space):
    points = space.random(np.random.default_rng(1), 80)
    points[7] = points[3]
    triangulation = space.delaunay(points)
    indptr, indices = triangulation.vertex_neighbor_vertices
    assert indptr.dtype == indices.dtype == np.int32
    found = {(k, other) for k in range(80) for other in indices[indptr[k] : indptr[k + 1]].tolist()}
    edges = {tuple(edge) for edge in triangulation.edges.tolist()}
    assert found == edges | {(b, a) for a, b in edges}
    assert len(indices) == 2 * len(edges)
    assert indptr[8] == indptr[7]
    assert all((np.diff(indices[indptr[k] : indptr[k + 1]]) > 0).all() for k in range(80))
    assert not indices.flags.writeable
    triangulation.remove([0])
    assert len(triangulation.vertex_neighbor_vertices[0]) == 80


LARGER = {"plane": sets.plane("random"), "plane grid": sets.plane("lattice"), "sphere": sets.sphere("random")}
LARGER |= {"sphere clusters": sets.sphere("clusters"), "graticule": sets.sphere("graticule")}
THOROUGH = {"plane", "sphere clusters", "graticule"}


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.thorough if n in THOROUGH else ()) for n in LARGER])
def test_threads_change_nothing_not_even_the_rows(name):
    """Triangles that follow one another mostly touch: what makes everything after fast."""
    points = LARGER[name].drawn(50_000)
    one = by_kernel(points, 1)
    for workers in (2, 3, 7):
        for array, other in zip(one, by_kernel(points, workers), strict=True):
            assert np.array_equal(array, other) if isinstance(array, np.ndarray) else array == other
    check_delaunay(points, one[0])
    touch = (one[0][1:, :, None] == one[0][:-1, None, :]).any(axis=(1, 2))
    assert touch.mean() > 0.5


@pytest.mark.parametrize(
    "convert",
    [
        lambda p: p.astype(int).tolist(),
        lambda p: p.astype(np.float32),
        np.asfortranarray,
        lambda p: np.repeat(p, 2, axis=0)[::2],
        lambda p: [[Fraction(x) for x in row] for row in p.tolist()],
        np.ma.masked_array,
        lambda p: np.frombuffer(p.tobytes()).reshape(p.shape),  # read-only
    ],
)
def test_accepted_input(convert):
    given_points = convert(GRID)
    before = copy.deepcopy(given_points)
    assert PlanarDelaunay(given_points).simplices.tolist() == PlanarDelaunay(GRID).simplices.tolist()
    assert np.array_equal(np.asarray(before, dtype=float), np.asarray(given_points, dtype=float))


def in_lexicographic_order(triangulation):
    """The arrays that follow the rows of `simplices`, with these in lexicographic order."""
    order = np.lexsort(triangulation.simplices.T[::-1])
    number = np.append(np.argsort(order), -1)  # the last one for no neighbour
    arrays = {
        "simplices": triangulation.simplices[order],
        "neighbors": number[triangulation.neighbors[order]],
        "circumcenters": triangulation.circumcenters[order],
    }
    if hasattr(triangulation, "closing"):
        arrays["closing"] = triangulation.closing[order]
    return arrays


def assert_same(first, second):
    """Two triangulations are the same but for the order of their rows, and valid."""
    check_delaunay(first)
    for name in ("points", "duplicates", "edges", "convex_hull"):
        assert np.array_equal(getattr(first, name), getattr(second, name)), name
    assert first.dimension == second.dimension
    ones, others = in_lexicographic_order(first), in_lexicographic_order(second)
    for name, array in ones.items():
        assert np.array_equal(array, others[name]), name


@BOTH
@given(data=st.data())
def test_insert_and_remove_equal_a_fresh_build(space, data):
    old, new = (data.draw(space.points(3, max_size=n)) for n in (10, 6))
    triangulation = space.delaunay(old)
    before = triangulation.simplices
    kept = before.tolist()
    assert triangulation.insert(new).tolist() == list(range(len(old), len(old) + len(new)))
    both = np.vstack([old, new])
    assert_same(triangulation, space.triangulated(both))
    assert before.tolist() == kept
    indices = data.draw(st.lists(st.integers(0, len(both) - 1), max_size=6)) if len(both) else []
    stay = [k for k in range(len(both)) if k not in indices]
    names = triangulation.remove(indices)
    assert names.tolist() == [stay.index(k) if k in stay else -1 for k in range(len(both))]
    assert_same(triangulation, space.triangulated(both[stay]))


@BOTH
def test_nothing_of_the_old_state_outlives_a_change(space):
    points = space.on_grid(GRID)
    triangulation = space.delaunay(points[:20])
    names = ("neighbors", "edges", "convex_hull", "circumcenters")
    more = points[20:] * [1.25, *[1] * (space.width - 1)]
    for change in (lambda: triangulation.insert(more), lambda: triangulation.remove([0, 1, 7])):
        for known in names:
            getattr(triangulation, known)
        triangulation.nearest(points)
        triangulation.find_simplex(points)
        change()
        fresh = space.triangulated(triangulation.points)
        assert_same(triangulation, fresh)
        assert np.array_equal(triangulation.nearest(points), fresh.nearest(points))
        assert np.array_equal(triangulation.find_simplex(points) < 0, fresh.find_simplex(points) < 0)


def test_refused_changes_change_nothing():
    triangulation = PlanarDelaunay(GRID)
    for bad in ([42], [-1], [[0]], [0.5]):
        with pytest.raises((ValueError, TypeError), match="indices"):
            triangulation.remove(bad)
    with pytest.raises(ValueError, match="points"):
        triangulation.insert([[0, np.nan]])
    assert triangulation.simplices.tolist() == PlanarDelaunay(GRID).simplices.tolist()


@BOTH
@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda t: pickle.loads(pickle.dumps(t))])
def test_copies_are_the_same_and_independent(rng, space, duplicate):
    triangulation = space.delaunay(space.random(rng, 200))
    triangulation.insert(space.random(rng, 50))
    triangulation.remove([3, 5, 201])
    other = duplicate(triangulation)
    assert repr(other) == repr(triangulation)
    assert other.inconclusive == triangulation.inconclusive
    for name in ("points", "simplices", "neighbors", "duplicates"):
        assert np.array_equal(getattr(other, name), getattr(triangulation, name))
        assert not getattr(other, name).flags.writeable
    other.remove([0])
    triangulation.insert(space.random(rng, 3))
    assert len(other.points) + 4 == len(triangulation.points)
    check_delaunay(other)
    check_delaunay(triangulation)


@pytest.mark.thorough
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of memory are Linux's")
@pytest.mark.skipif("libasan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer reserves terabytes")
def test_memory_that_cannot_be_had_is_an_error():
    program = """
import resource
import numpy as np
from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay
plane, sphere = np.random.default_rng(0).random((2_000_000, 2)), np.random.default_rng(0).normal(size=(2_000_000, 3))
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 150_000_000, resource.RLIM_INFINITY))
for cls, points in ((PlanarDelaunay, plane), (SphericalDelaunay, sphere)):
    for workers in (1, 2):
        try:
            cls(points, workers=workers)
        except MemoryError:
            print("no memory")
        check_delaunay(cls(points[:1000]))
"""
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=300)
    assert ran.stdout.split("\n")[:-1] == ["no memory"] * 4, ran.stderr
