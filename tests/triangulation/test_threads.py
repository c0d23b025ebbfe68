"""Several threads with one triangulation: queries beside queries, and errors instead of a query beside a change."""

import copy
import pickle
import threading
import time

import numpy as np
import pytest

from stereodel import check_delaunay
from stereodel.graphs import gabriel_graph
from stereodel.interpolation import LinearInterpolator
from tests import sets
from tests.spaces import BOTH, SPACES

USES = {
    "find_simplex": lambda t: t.find_simplex(t_queries(t)),
    "nearest": lambda t: t.nearest(t_queries(t)),
    "k nearest": lambda t: t.nearest(t_queries(t), k=3),
    "insert": lambda t: t.insert(t_queries(t)[None]),
    "remove": lambda t: t.remove([0]),
    "points": lambda t: t.points,
    "simplices": lambda t: t.simplices,
    "neighbors": lambda t: t.neighbors,
    "duplicates": lambda t: t.duplicates,
    "dimension": lambda t: t.dimension,
    "inconclusive": lambda t: t.inconclusive,
    "edges": lambda t: t.edges,
    "convex_hull": lambda t: t.convex_hull,
    "circumcenters": lambda t: t.circumcenters,
    "len": len,
    "repr": repr,
    "copy": copy.copy,
    "pickle": pickle.dumps,
    "diagram": lambda t: space_of_class(t).voronoi(t),
    "graph": gabriel_graph,
    "interpolator": lambda t: LinearInterpolator(t, np.zeros(40)),
}


def space_of_class(triangulation):
    return next(space for space in SPACES if isinstance(triangulation, space.delaunay))


def t_queries(triangulation):
    return np.full(space_of_class(triangulation).width, 0.5)


def points_of(space, size, seed=0):
    return space.random(np.random.default_rng(seed), size)


@pytest.mark.parametrize("use", USES)
@BOTH
def test_what_comes_upon_a_change_is_refused(space, use):
    triangulation = space.delaunay(points_of(space, 40))
    if use in {"edges", "circumcenters"}:
        USES[use](triangulation)  # known already: refused all the same
    with triangulation._turn, pytest.raises(RuntimeError, match="another thread is changing this triangulation"):
        USES[use](triangulation)
    USES[use](triangulation)
    assert len(triangulation.points) == 40 + (use == "insert") - (use == "remove")
    check_delaunay(triangulation)


class TakenUnseen:
    """A lock that another thread takes just after one looked."""

    def __init__(self):
        lock = threading.Lock()
        self.acquire, self.release = lock.acquire, lock.release

    def __enter__(self):
        self.acquire()

    def __exit__(self, *_):
        self.release()

    def locked(self):
        return False


@pytest.mark.parametrize("change", ["insert", "remove"])
@BOTH
def test_of_two_changes_at_the_same_moment_one_is_refused(space, change):
    """The second does not wait, even if nobody was there when it looked."""
    triangulation = space.delaunay(points_of(space, 40))
    triangulation._turn = TakenUnseen()
    refused = []

    def second():
        try:
            USES[change](triangulation)
        except RuntimeError as error:
            refused.append(str(error))

    changer = threading.Thread(target=second)
    with triangulation._turn:
        changer.start()
        changer.join(timeout=5)
        waits = changer.is_alive()
    changer.join()
    assert not waits
    assert len(refused) == 1
    assert "another thread is changing this triangulation" in refused[0]
    assert len(triangulation.points) == 40
    USES[change](triangulation)  # refused, not broken
    check_delaunay(triangulation)


@BOTH
def test_a_long_change_refuses_at_once(space):
    few, many = points_of(space, 200), points_of(space, 60_000, seed=1)
    triangulation = space.delaunay(few)
    changer = threading.Thread(target=triangulation.insert, args=(many,))
    changer.start()
    refused, longest = 0, 0.0
    while changer.is_alive():
        before = time.perf_counter()
        try:
            triangulation.nearest(many[0])
        except RuntimeError:
            refused += 1
            longest = max(longest, time.perf_counter() - before)
    changer.join()
    assert refused > 0
    assert longest < 5.0  # not a wait for the end of the change, on a slow machine either
    assert len(triangulation.points) == 60_200


@BOTH
def test_copies_go_their_own_ways(space):
    """A copy shares a mesh whose arrays nobody asked for; the one that changes first takes it."""
    start, more = points_of(space, 60), points_of(space, 8, seed=1)
    triangulation = space.delaunay(start)
    triangulation.insert(more[:2])
    twin, third = copy.copy(triangulation), copy.copy(triangulation)
    triangulation.insert(more[2:4])
    twin.remove([0, 61])
    for t, points in (
        (triangulation, np.vstack([start, more[:4]])),
        (twin, np.vstack([start[1:], more[:1]])),
        (third, np.vstack([start, more[:2]])),
    ):
        assert np.array_equal(t.points, points)
        assert np.array_equal(t.edges, space.delaunay(points).edges)
        assert t.dimension == 2
        assert len(t.duplicates) == 0
        assert sum(t.inconclusive.values()) >= 0
        check_delaunay(t)


@BOTH
def test_two_changes_of_copies_at_a_time(space):
    """Both copies want the mesh of one version: one gets it."""
    start = points_of(space, 300)
    more = points_of(space, 40, seed=1)
    for _ in range(20):
        triangulation = space.delaunay(start)
        triangulation.insert(more[:1])
        twins = [copy.copy(triangulation) for _ in range(4)]
        threads = [
            threading.Thread(target=twin.insert, args=(more[1 + 9 * k : 10 + 9 * k],)) for k, twin in enumerate(twins)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for k, twin in enumerate(twins):
            points = np.vstack([start, more[:1], more[1 + 9 * k : 10 + 9 * k]])
            assert np.array_equal(twin.points, points)
            assert np.array_equal(twin.edges, space.delaunay(points).edges)


@BOTH
def test_arrays_cannot_be_set(space):
    triangulation = space.delaunay(points_of(space, 10))
    with pytest.raises(AttributeError, match="points cannot be set"):
        triangulation.points = points_of(space, 5)
    triangulation.inconclusive["filter"] = -1
    assert triangulation.inconclusive["filter"] >= 0


@BOTH
def test_a_mesh_that_went_on_is_not_believed(space):
    """As when a query has taken hold of the mesh, and a change ends before it asks."""
    start, more = points_of(space, 60), points_of(space, 8, seed=1)
    triangulation = space.delaunay(start)
    triangulation.insert(more[:2])
    version = triangulation._present()
    mesh = version._mesh
    triangulation.insert(more[2:])
    triangulation.insert(more[2:3])  # a duplicate
    version.__dict__["_mesh"] = mesh
    expected = space.delaunay(version.points)
    assert np.array_equal(version.edges, expected.edges)
    assert np.array_equal(version.duplicates, expected.duplicates)
    assert version.inconclusive == expected.inconclusive


def in_order(rows):
    return rows[np.lexsort(rows.T)]


@BOTH
def test_a_copy_that_is_read_does_not_hinder_changes(space):
    """The original and the copy share the mesh: writing out its arrays takes a while."""
    triangulation = space.delaunay(points_of(space, 60_000))
    for turn in range(6):
        triangulation.insert(points_of(space, 3, seed=turn + 1))  # whose arrays are not written yet
        twin = copy.copy(triangulation)
        expected = space.delaunay(twin.points)
        found = []
        reader = threading.Thread(target=lambda: found.append((twin.simplices, twin.inconclusive)))  # noqa: B023
        reader.start()
        time.sleep(0.0003 * turn)
        triangulation.insert(points_of(space, 3, seed=turn + 100))
        reader.join(60)
        assert not reader.is_alive()
        assert np.array_equal(in_order(found[0][0]), in_order(expected.simplices))


@BOTH
def test_tests_left_open_are_remembered(space):
    """Neither a change that is given up nor one of the original after a copy alters how many there were."""
    points = space.on_grid(sets.grid(20, 20))
    first, second, third = (space.delaunay(points) for _ in range(3))
    for triangulation in (first, second, third):
        triangulation.insert(points_of(space, 3) + 9.5)
    wanted, twin = first.inconclusive, copy.copy(second)
    third.simplices  # noqa: B018  # from the mesh
    with pytest.raises(ZeroDivisionError):
        third._latest()._changed(lambda mesh: 1 / 0, third._latest()._chunks)
    assert third.inconclusive == wanted
    second.insert(points_of(space, 3, seed=1) + 9.5)
    assert twin.inconclusive == wanted
