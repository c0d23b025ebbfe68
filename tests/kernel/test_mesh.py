"""The kernel's meshes under insertion and removal, against the paper's insertion from scratch, and proved Delaunay."""

import itertools
import subprocess
import sys
import threading
import time
from collections import namedtuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel, check_delaunay
from stereodel.triangulation.topology import neighbors_of
from tests import sets
from tests.examples import examples
from tests.spaces import BOTH, SPHERE, canonical, readable, space_of
from tests.threads import at_once, begun, until


def start(points, by_readable=False):
    """A mesh, of the readable engine's triangles or of the kernel's own."""
    space, points = space_of(points), np.ascontiguousarray(points, dtype=float)
    if by_readable:
        engine = readable(points)
        pairs = engine.duplicates[np.argsort(engine.duplicates[:, 0])]
        return space.kernel.Mesh(points, engine.simplices, neighbors_of(engine.simplices), pairs)
    return space.kernel.Mesh(points, *space.kernel.triangulate(points)[:3])


def prove(mesh, points):
    """That a mesh is a valid Delaunay triangulation of points; its simplices in canonical order."""
    changes, own, simplices, neighbors, duplicates, dimension, _ = mesh.read()
    assert changes == mesh.changes
    assert mesh.size == len(points)
    assert np.array_equal(own, points)
    assert dimension == 2
    assert (simplices[:, 0] < simplices[:, 1:].T).all()
    check_delaunay(points, simplices, duplicates=duplicates, neighbors=neighbors)
    return canonical(simplices)


State = namedtuple("State", ("changes", "points", "simplices", "neighbors", "duplicates", "dimension", "inconclusive"))


def state(mesh):
    return State(*mesh.read())


def prove_equal(mesh, points, by_readable=True):
    """That a mesh is the triangulation of points that the readable engine, or the kernel from scratch, builds."""
    if by_readable:
        engine = readable(points)
        simplices, duplicates = engine.simplices, engine.duplicates[np.argsort(engine.duplicates[:, 0])]
    else:
        simplices, _, duplicates, _, _ = space_of(points).kernel.triangulate(points)
    assert (state(mesh).dimension < 2) == (len(simplices) == 0)
    if len(simplices):
        assert np.array_equal(prove(mesh, points), canonical(simplices))
    assert np.array_equal(state(mesh).duplicates, duplicates)


def insert(mesh, points, added):
    assert mesh.insert(np.ascontiguousarray(added)) == len(points)
    return np.vstack([points, added])


def remove(mesh, points, indices):
    """Remove points from a mesh; the points that are left."""
    stays = np.ones(len(points), dtype=bool)
    stays[indices] = False
    number = mesh.remove(np.array(indices, dtype=np.int32))
    assert number.tolist() == np.where(stays, np.cumsum(stays) - 1, -1).tolist()
    return points[stays]


def spanning(points):
    return len(readable(points).simplices) > 0


@BOTH
@given(data=st.data())
@examples(0.6)
def test_changes_of_small_integers_in_turn(space, data):
    points = data.draw(space.points(3, min_size=4, max_size=14).filter(spanning))
    mesh = start(points, by_readable=True)
    for _ in range(3):
        points = insert(mesh, points, data.draw(space.points(3, max_size=6)))
        indices = st.integers(0, max(len(points) - 1, 0))
        points = remove(mesh, points, data.draw(st.lists(indices, max_size=8)) if len(points) else [])
        prove_equal(mesh, points)
        if state(mesh).dimension < 2:
            break


@pytest.mark.parametrize("one", [case for case in sets.of(without=("flat",)) if len(case.values[0].drawn(40)) < 70])
def test_every_set_comes_and_goes(rng, one):
    """Half of the points inserted, then removed a few at a time, to the last triangle."""
    points = rng.permutation(one.drawn(40))
    first = next(k for k in range(len(points) // 2, len(points) + 1) if spanning(points[:k]))
    mesh = start(points[:first], by_readable=True)
    points = insert(mesh, points[:first], points[first:])
    prove_equal(mesh, points)
    while len(points) > 3 and state(mesh).dimension == 2:
        points = remove(mesh, points, rng.permutation(len(points))[: max(1, len(points) // 4)])
        prove_equal(mesh, points)


@BOTH
def test_a_pole_with_thousands_of_neighbors(space):
    ring = 3000
    angle = np.sort(np.random.default_rng(7).random(ring)) * 2 * np.pi
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    points = np.vstack([[[0.01, 0.02]], circle])
    if space is SPHERE:
        lifted = np.column_stack([points, np.append(1.0, np.full(ring, 5.0))])
        points = np.vstack([lifted, [[0.0, 0.0, -1.0]]])
    mesh = start(points)
    assert (state(mesh).simplices == 0).any(axis=1).sum() > 0.9 * ring
    rest = remove(mesh, points, [0])
    prove_equal(mesh, rest, by_readable=False)
    prove_equal(mesh, insert(mesh, rest, points[:1]), by_readable=False)


def test_the_last_point_beside_a_line_and_a_great_circle():
    points = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0], [1, 1]])
    mesh = start(points)
    points = remove(mesh, points, [4])
    assert state(mesh).dimension < 2
    assert [array.shape for array in mesh.read()[2:4]] == [(0, 3), (0, 3)]
    points = remove(mesh, points, [1])
    assert state(mesh).dimension == 1
    insert(mesh, points, points)
    assert state(mesh).duplicates.tolist() == [[3, 0], [4, 1], [5, 2]]
    prove_equal(mesh, insert(mesh, np.vstack([points, points]), np.array([[1.0, 1]])))
    mesh = start(sets.sphere("rim and poles").points)
    remove(mesh, sets.sphere("rim and poles").points, [5, 6])
    assert state(mesh).dimension < 2


def test_finer_points_and_other_lengths_than_before(rng):
    """What doubles tell of integers they do not of those inserted, which lie on a circle but for their rounding."""
    circle = 5 * sets.on_circle(rng, 80)
    coarse = np.array([[9.0, 9], [-9, 9], [0, -9]])
    mesh = start(coarse)
    prove_equal(mesh, insert(mesh, coarse, circle))
    unit = sets.directions(rng, 30)
    mesh = start(unit)
    prove_equal(mesh, insert(mesh, unit, sets.directions(rng, 30) * 10.0 ** rng.integers(-3, 3, size=(30, 1))))


@BOTH
def test_many_points_into_few(rng, space):
    """More than one round of insertion; removal of most of them again."""
    points = space.random(rng, 9010)
    points[5000:5100] = points[:100]
    mesh = start(points[:10])
    insert(mesh, points[:10], points[10:])
    assert len(state(mesh).duplicates) == 100
    prove_equal(mesh, points, by_readable=False)
    prove_equal(mesh, remove(mesh, points, rng.permutation(9010)[:8700]), by_readable=False)


@BOTH
def test_duplicates_of_one_batch_keep_the_lowest(rng, space):
    points, distinct = space.random(rng, 50), space.random(rng, 2000)
    distinct[:, 0] = np.where(rng.random(2000) < 0.3, 0.0, distinct[:, 0])
    added = np.repeat(distinct, 3, axis=0)[rng.permutation(6000)]
    added[rng.random(6000) < 0.5, 0] *= -1  # also −0 beside 0
    mesh = start(points)
    both = insert(mesh, points, added)
    assert np.array_equal(state(mesh).duplicates, space.kernel.triangulate(both)[2])


def test_equal_directions_of_different_length(rng):
    """A third of 3 v is not v in doubles; the directions are still the same."""
    points = rng.integers(-(2**50), 2**50, size=(20, 3)).astype(float)
    mesh = start(points)
    both = insert(mesh, points, np.vstack([7 * points, points * 2.0**-300, points[:5]])[rng.permutation(45)])
    prove_equal(mesh, both)
    prove_equal(mesh, remove(mesh, both, list(range(12))))
    assert len(state(mesh).duplicates) == 45 - 12


# As Python holds them ------------------------------------------------------------------------------------------------


def test_tests_left_open_are_counted():
    grid = sets.grid(4, 4)
    mesh = start(grid[:6])
    assert set(state(mesh).inconclusive.values()) == {0}
    mesh.insert(grid[6:].copy())
    assert state(mesh).inconclusive.keys() == {"filter", "double_double", "exact"}
    assert state(mesh).inconclusive["filter"] >= state(mesh).inconclusive["exact"] > 0
    assert state(start(sets.AXES)).inconclusive.keys() >= {"curvature", "exact"}


def test_rows_are_given_in_any_rotation():
    points = np.random.default_rng(15).random((30, 2))
    simplices, neighbors = _kernel.plane.triangulate(points)[:2]
    mesh = _kernel.plane.Mesh(points, np.roll(simplices, 1, axis=1), np.roll(neighbors, 1, axis=1))
    assert np.array_equal(state(mesh).simplices, simplices)
    assert np.array_equal(state(mesh).neighbors, neighbors)


@BOTH
def test_a_state_stays_what_it_was(rng, space):
    """All who ask share its arrays, which nobody can write to; changes make new ones."""
    mesh = start(space.random(rng, 20))
    first, again = mesh.read(), mesh.read()
    assert all(a.ctypes.data == b.ctypes.data for a, b in zip(first[1:4], again[1:4], strict=True))
    assert not any(array.flags.writeable for array in first[1:5])
    before = [array.copy() for array in first[1:5]]
    mesh.insert(space.random(rng, 20))
    mesh.remove(np.arange(10, dtype=np.int32))
    del mesh, again
    assert all(np.array_equal(a, b) for a, b in zip(first[1:5], before, strict=True))


@BOTH
def test_changes_anew_and_of_what_is_there(space):
    """Whether all are triangulated anew is decided by numbers, and seen by the tests left open before."""
    points = space.on_grid(sets.grid(12, 12))
    for anew in (0, 3):
        mesh = start(points)
        both = insert(mesh, points, points[:100] + 7.5) if anew == 0 else np.vstack([points, points[:100] + 7.5])
        if anew:
            assert mesh.insert(points[:100] + 7.5, 1, anew) == len(points)
        prove_equal(mesh, both, by_readable=False)
        fresh = space.kernel.triangulate(both)[4]
        assert (state(mesh).inconclusive == fresh) == (anew > 0)
        gone = np.arange(0, len(both), 2, dtype=np.int32)
        mesh.remove(gone, 1, anew)
        prove_equal(mesh, np.delete(both, gone, axis=0), by_readable=False)


# Several threads ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seconds", [0.5, pytest.param(2.0, marks=pytest.mark.thorough)])
@BOTH
def test_readers_beside_a_writer(rng, space, seconds):
    """Each state that was read is one that the writer made, whole, and none comes before an older one."""
    mesh = start(space.random(rng, 300))
    made, seen = {0: state(mesh).points.copy()}, [{} for _ in range(4)]
    numbers = itertools.count(1)

    def write():
        points = made[mesh.changes]
        if len(points) < 330:
            added = space.random(rng, int(rng.integers(1, 30)))
            made[next(numbers)] = np.vstack([points, added])
            mesh.insert(added, 1, 3)
        else:
            gone = rng.permutation(len(points))[: int(rng.integers(1, 60))].astype(np.int32)
            made[next(numbers)] = np.delete(points, gone, axis=0)
            mesh.remove(gone, 1, 6)

    def reader(own):
        def read():
            before = mesh.changes
            state = mesh.read()
            assert before <= state[0] <= mesh.changes
            assert len(state[1]) == len(made[state[0]])
            own[state[0]] = state

        return until(seconds, read)

    at_once(until(seconds, write), *map(reader, seen))
    assert mesh.changes == len(made) - 1 > 10  # no reader keeps the writer out
    assert min(map(len, seen)) > 3  # nor the other way round
    for own in seen:
        for number, (_, points, simplices, neighbors, duplicates, _, _) in list(own.items())[::-1][:20]:
            assert np.array_equal(points, made[number])
            check_delaunay(points, simplices, duplicates=duplicates, neighbors=neighbors)


@BOTH
def test_writers_wait_for_each_other(rng, space):
    blocks = space.random(rng, 8 * 600).reshape(8, 600, -1)
    mesh = start(space.random(rng, 500))
    first = {}
    at_once(*(lambda k=k: first.__setitem__(k, mesh.insert(blocks[k], 1, 3 * (k % 2))) for k in range(8)))
    points = state(mesh).points
    assert sorted(first.values()) == list(range(500, 5300, 600))
    assert mesh.changes == 8
    for k, begin in first.items():
        assert np.array_equal(points[begin : begin + 600], blocks[k])
    prove_equal(mesh, points, by_readable=False)


USES = {
    "changes": lambda mesh: mesh.changes,
    "size": lambda mesh: mesh.size,
    "read": lambda mesh: mesh.read(),
    "insert": lambda mesh: mesh.insert(np.full((1, 2), 0.5)),
    "remove": lambda mesh: mesh.remove(np.zeros(1, dtype=np.int32)),
}


@pytest.mark.parametrize("use", USES)
def test_who_waits_does_not_hold_the_interpreter(use):
    """While one thread changes the mesh and another waits for it, a third goes on; what was asked comes after."""
    points = np.random.default_rng(19).permutation(sets.grid(400, 400))  # ties, which take long
    turns = 0
    for _ in range(5):  # a busy machine may let nobody have a turn before the change has ended
        mesh, waited = start(points[:100]), []
        changer = begun(lambda mesh=mesh: mesh.insert(points[100:]), mesh)

        def wait(mesh=mesh, waited=waited):
            USES[use](mesh)
            waited.append(mesh.changes)

        waiter = threading.Thread(target=wait)
        waiter.start()
        while changer.is_alive() and waiter.is_alive():
            turns += 1
            time.sleep(0)
        changer.join(60)
        waiter.join(60)
        assert waited == [1 + (use in {"insert", "remove"})]
        if turns > 20:
            break
    assert turns > 20


@pytest.mark.skipif(sys.platform == "win32", reason="no timers there")
def test_a_handler_of_a_signal_may_ask_the_mesh_that_is_being_changed():
    """It runs in the thread that makes the change, and waits for it; an exception of its own ends a wait."""
    program = """
import signal, threading
import numpy as np
from stereodel import _kernel

points = np.random.default_rng(0).random((400_000, 2))
mesh = _kernel.plane.Mesh(points[:100], *_kernel.plane.triangulate(points[:100])[:3])
found = []
signal.signal(signal.SIGALRM, lambda *_: found.append((mesh.changes, mesh.insert(points[:1]), len(mesh.read()[1]))))
signal.setitimer(signal.ITIMER_REAL, 0.02)
mesh.insert(points[100:])
assert found == [(1, 400_000, 400_001)], found

changer = threading.Thread(target=mesh.insert, args=(np.random.default_rng(1).random((1_200_000, 2)) + 2,))
signal.signal(signal.SIGALRM, signal.default_int_handler)
changer.start()
signal.setitimer(signal.ITIMER_REAL, 0.05)
try:
    while changer.is_alive():
        mesh.read()
except KeyboardInterrupt:
    assert changer.is_alive()
    changer.join()
    assert mesh.size == 1_600_001
    print("interrupted")
"""
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.split() == ["interrupted"]
