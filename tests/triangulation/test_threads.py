"""Several threads with one triangulation: queries beside queries, and what waits for a change."""

import copy
import pickle
import threading
from functools import partial

import numpy as np
import pytest

from stereodel import check_delaunay
from stereodel.graphs import gabriel_graph
from stereodel.interpolation import LinearInterpolator
from stereodel.triangulation import delaunay
from tests import sets
from tests.spaces import BOTH, SPACES
from tests.threads import at_once, begun, until

KEPT = ("points", "simplices", "neighbors", "duplicates", "edges", "convex_hull", "circumcenters")
QUERIES = {name: lambda t, name=name: getattr(t, name) for name in KEPT} | {
    "find_simplex": lambda t: t.find_simplex(t_queries(t)),
    "nearest": lambda t: t.nearest(t_queries(t)),
    "k nearest": lambda t: t.nearest(t_queries(t), k=3),
    "dimension": lambda t: t.dimension,
    "inconclusive": lambda t: t.inconclusive,
    "len": len,
    "repr": repr,
    "copy": copy.copy,
    "pickle": pickle.dumps,
    "diagram": lambda t: space_of_class(t).voronoi(t),
    "graph": gabriel_graph,
    "interpolator": lambda t: LinearInterpolator(t, np.zeros(40_050)),
}


def space_of_class(triangulation):
    return next(space for space in SPACES if isinstance(triangulation, space.delaunay))


def t_queries(triangulation):
    return np.full(space_of_class(triangulation).width, 0.5)


def points_of(space, size, seed=0):
    return space.random(np.random.default_rng(seed), size)


@pytest.fixture
def in_change(monkeypatch):
    """A triangulation of 50 points into which another thread is inserting 40 000, of a grid, and that thread."""

    def start(space):
        monkeypatch.setattr(delaunay, "REBUILD_INSERTING", 0)
        triangulation = space.delaunay(points_of(space, 40))
        triangulation.insert(points_of(space, 10, seed=2))
        for name in KEPT:
            getattr(triangulation, name)  # known of the state before
        many = space.on_grid(sets.grid(200, 200))  # ties, which take long
        return triangulation, begun(lambda: triangulation.insert(many), triangulation._mesh)

    return start


@BOTH
def test_queries_that_come_upon_a_change_wait_for_it(space, in_change):
    """And are told of what came of it, all of them."""
    triangulation, changer = in_change(space)
    found = {}
    at_once(*(lambda n=name: found.__setitem__(n, QUERIES[n](triangulation)) for name in QUERIES))
    changer.join(60)
    now = space.delaunay(triangulation.points)
    assert len(now.points) == 40_050
    for name in KEPT:
        if name != "neighbors":  # numbers of rows, whose order may differ
            assert np.array_equal(in_order(found[name]), in_order(getattr(now, name)))
    check_delaunay(now.points, found["simplices"], neighbors=found["neighbors"])
    assert found["nearest"] == now.nearest(t_queries(now))
    assert found["len"] == len(now)
    assert "(40050 points" in found["repr"]
    assert len(found["copy"].points) == len(pickle.loads(found["pickle"]).points) == 40_050
    assert len(found["diagram"].points) == 40_050


@BOTH
def test_changes_that_come_upon_a_change_wait_for_it(space, in_change):
    triangulation, changer = in_change(space)
    more = points_of(space, 3, seed=7)
    numbers = []
    at_once(lambda: numbers.append(triangulation.insert(more)), lambda: triangulation.remove([0, 1]))
    changer.join(60)
    assert numbers[0].tolist() in ([40_050, 40_051, 40_052], [40_048, 40_049, 40_050])
    assert np.array_equal(triangulation.points[-3:], more)
    assert len(triangulation.points) == 40_051
    assert np.array_equal(triangulation.edges, space.delaunay(triangulation.points).edges)


@pytest.mark.parametrize("seconds", [0.5, pytest.param(2.0, marks=pytest.mark.thorough)])
@BOTH
def test_queries_beside_changes(rng, space, seconds):
    """Whatever is asked is that of some state: what threads find of one state fits together, and fits its points."""
    triangulation = space.delaunay(points_of(space, 200))
    queries = points_of(space, 50, seed=5)
    changes, seen = [], []

    def change():
        before = len(triangulation.points)  # nobody else changes it
        first = triangulation.insert(space.random(rng, int(rng.integers(1, 90))))
        assert first[0] == before
        triangulation.remove(rng.permutation(before)[: len(first)])
        assert len(triangulation.points) == before
        changes.append(None)

    def ask():
        state = copy.copy(triangulation)
        assert triangulation.nearest(queries).max() < 290
        assert len(state.circumcenters) == len(state.simplices) == len(state.neighbors)
        assert len(state.edges) == state.vertex_neighbor_vertices[0][-1] // 2
        assert state.nearest(state.points).tolist() == list(range(len(state.points)))
        seen.append(state)

    at_once(*(until(seconds, work) for work in (change, ask, ask, ask)))
    assert len(changes) > 5
    assert len(seen) > 5
    for state in seen[-20:]:
        check_delaunay(state)
        assert np.array_equal(state.edges, space.delaunay(state.points).edges)


@BOTH
def test_what_follows_from_a_state_is_the_same_for_all_who_ask(space):
    triangulation = space.delaunay(points_of(space, 5000))
    triangulation.insert(points_of(space, 10, seed=1))
    triangulation.simplices  # noqa: B018  # the state is read
    found, barrier = [], threading.Barrier(8)

    def ask():
        barrier.wait()
        found.append((triangulation.edges, triangulation.circumcenters))

    at_once(*[ask] * 8)
    assert len({id(array) for pair in found for array in pair}) == 2


@BOTH
def test_a_state_that_is_late_is_not_believed(space):
    """As when a thread has read a state and stops, and leaves it behind when others have gone on."""
    triangulation = space.delaunay(points_of(space, 60))
    triangulation.insert(points_of(space, 2, seed=1))
    old = len(triangulation.points), triangulation._last
    triangulation.insert(points_of(space, 3, seed=2))
    assert len(triangulation.points) == old[0] + 3
    triangulation._last = old[1]
    assert len(triangulation.points) == old[0] + 3
    twin = copy.copy(triangulation)  # whose own changes begin anew
    for _ in range(3):
        twin.insert(points_of(space, 1, seed=3))
        assert np.array_equal(twin.edges, space.delaunay(twin.points).edges)


@BOTH
def test_two_changes_of_copies_at_a_time(space):
    start = points_of(space, 300)
    more = points_of(space, 40, seed=1)
    for _ in range(20):
        triangulation = space.delaunay(start)
        triangulation.insert(more[:1])
        twins = [copy.copy(triangulation) for _ in range(4)]
        at_once(*(partial(twin.insert, more[1 + 9 * k : 10 + 9 * k]) for k, twin in enumerate(twins)))
        for k, twin in enumerate(twins):
            points = np.vstack([start, more[:1], more[1 + 9 * k : 10 + 9 * k]])
            assert np.array_equal(twin.points, points)
            assert np.array_equal(twin.edges, space.delaunay(points).edges)


@BOTH
def test_arrays_cannot_be_set(space):
    triangulation = space.delaunay(points_of(space, 10))
    with pytest.raises(AttributeError, match="points"):
        triangulation.points = points_of(space, 5)
    triangulation.inconclusive["filter"] = -1
    assert triangulation.inconclusive["filter"] >= 0


def in_order(rows):
    return rows[np.lexsort(rows.T)]


@BOTH
def test_tests_left_open_are_remembered(space):
    """Neither a change that is refused nor one of the original after a copy alters how many there were."""
    points = space.on_grid(sets.grid(20, 20))
    first, second, third = (space.delaunay(points) for _ in range(3))
    for triangulation in (first, second, third):
        triangulation.insert(points_of(space, 3) + 9.5)
    wanted, twin = first.inconclusive, copy.copy(second)
    with pytest.raises(ValueError, match="out of range"):
        third._changing().remove(np.array([403], dtype=np.int32))
    assert third.inconclusive == wanted
    second.insert(points_of(space, 3, seed=1) + 9.5)
    assert twin.inconclusive == wanted
