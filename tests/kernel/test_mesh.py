"""The kernel's meshes under insertion and removal, against the paper's insertion from scratch, and proved Delaunay."""

import threading
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel, check_delaunay
from stereodel.triangulation.topology import canonical, neighbors_of
from tests import sets
from tests.examples import examples
from tests.spaces import BOTH, SPHERE, readable, space_of


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
    simplices, neighbors = mesh.arrays()
    assert mesh.size == len(points)
    assert (simplices[:, 0] < simplices[:, 1:].T).all()
    check_delaunay(points, simplices, duplicates=mesh.duplicates, neighbors=neighbors)
    return canonical(simplices)


def prove_equal(mesh, points, by_readable=True):
    """That a mesh is the triangulation of points that the readable engine, or the kernel from scratch, builds."""
    if by_readable:
        engine = readable(points)
        simplices, duplicates = engine.simplices, engine.duplicates[np.argsort(engine.duplicates[:, 0])]
    else:
        simplices, _, duplicates, _, _ = space_of(points).kernel.triangulate(points)
    assert mesh.is_flat == (len(simplices) == 0)
    if len(simplices):
        assert np.array_equal(prove(mesh, points), canonical(simplices))
    assert np.array_equal(mesh.duplicates, duplicates)


def insert(mesh, points, added):
    pairs = mesh.insert(np.ascontiguousarray(added))
    assert pairs.tolist() == [pair for pair in mesh.duplicates.tolist() if pair[0] >= len(points)]
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
        if mesh.is_flat:
            break


@pytest.mark.parametrize("one", [case for case in sets.of(without=("flat",)) if len(case.values[0].drawn(40)) < 70])
def test_every_set_comes_and_goes(one):
    """Half of the points inserted, then removed a few at a time, to the last triangle."""
    rng = np.random.default_rng(6)
    points = rng.permutation(one.drawn(40))
    first = next(k for k in range(len(points) // 2, len(points) + 1) if spanning(points[:k]))
    mesh = start(points[:first], by_readable=True)
    points = insert(mesh, points[:first], points[first:])
    prove_equal(mesh, points)
    while len(points) > 3 and not mesh.is_flat:
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
    assert (mesh.arrays()[0] == 0).any(axis=1).sum() > 0.9 * ring
    rest = remove(mesh, points, [0])
    prove_equal(mesh, rest, by_readable=False)
    prove_equal(mesh, insert(mesh, rest, points[:1]), by_readable=False)


def test_the_last_point_beside_a_line_and_a_great_circle():
    points = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0], [1, 1]])
    mesh = start(points)
    points = remove(mesh, points, [4])
    assert mesh.is_flat
    assert [array.shape for array in mesh.arrays()] == [(0, 3), (0, 3)]
    with pytest.raises(ValueError, match="anew"):
        mesh.insert(points)
    assert mesh.remove(np.array([1], dtype=np.int32)).tolist() == [0, -1, 1, 2]
    mesh = start(sets.sphere("rim and poles").points)
    remove(mesh, sets.sphere("rim and poles").points, [5, 6])
    assert mesh.is_flat


def test_finer_points_and_other_lengths_than_before():
    """What doubles tell of integers they do not of those inserted, which lie on a circle but for their rounding."""
    rng = np.random.default_rng(20)
    circle = 5 * sets.on_circle(rng, 80)
    coarse = np.array([[9.0, 9], [-9, 9], [0, -9]])
    mesh = start(coarse)
    prove_equal(mesh, insert(mesh, coarse, circle))
    unit = sets.directions(rng, 30)
    mesh = start(unit)
    prove_equal(mesh, insert(mesh, unit, sets.directions(rng, 30) * 10.0 ** rng.integers(-3, 3, size=(30, 1))))


@BOTH
def test_many_points_into_few(space):
    """More than one round of insertion; removal of most of them again."""
    rng = np.random.default_rng(10)
    points = space.random(rng, 9010)
    points[5000:5100] = points[:100]
    mesh = start(points[:10])
    insert(mesh, points[:10], points[10:])
    assert len(mesh.duplicates) == 100
    prove_equal(mesh, points, by_readable=False)
    prove_equal(mesh, remove(mesh, points, rng.permutation(9010)[:8700]), by_readable=False)


@BOTH
def test_duplicates_of_one_batch_keep_the_lowest(space):
    rng = np.random.default_rng(11)
    points, distinct = space.random(rng, 50), space.random(rng, 2000)
    distinct[:, 0] = np.where(rng.random(2000) < 0.3, 0.0, distinct[:, 0])
    added = np.repeat(distinct, 3, axis=0)[rng.permutation(6000)]
    added[rng.random(6000) < 0.5, 0] *= -1  # also −0 beside 0
    mesh = start(points)
    both = insert(mesh, points, added)
    assert np.array_equal(mesh.duplicates, space.kernel.triangulate(both)[2])


def test_equal_directions_of_different_length():
    """A third of 3 v is not v in doubles; the directions are still the same."""
    rng = np.random.default_rng(12)
    points = rng.integers(-(2**50), 2**50, size=(20, 3)).astype(float)
    mesh = start(points)
    both = insert(mesh, points, np.vstack([7 * points, points * 2.0**-300, points[:5]])[rng.permutation(45)])
    prove_equal(mesh, both)
    prove_equal(mesh, remove(mesh, both, list(range(12))))
    assert len(mesh.duplicates) == 45 - 12


# As Python holds them ------------------------------------------------------------------------------------------------


def test_tests_left_open_are_counted():
    grid = sets.grid(4, 4)
    mesh = start(grid[:6])
    assert set(mesh.inconclusive.values()) == {0}
    mesh.insert(grid[6:].copy())
    assert mesh.inconclusive.keys() == {"filter", "double_double", "exact"}
    assert mesh.inconclusive["filter"] >= mesh.inconclusive["exact"] > 0
    assert start(sets.AXES).inconclusive.keys() >= {"curvature", "exact"}


def test_rows_are_given_in_any_rotation():
    points = np.random.default_rng(15).random((30, 2))
    simplices, neighbors = _kernel.plane.triangulate(points)[:2]
    mesh = _kernel.plane.Mesh(points, np.roll(simplices, 1, axis=1), np.roll(neighbors, 1, axis=1))
    assert np.array_equal(mesh.arrays()[0], simplices)
    assert np.array_equal(mesh.arrays()[1], neighbors)


@BOTH
def test_arrays_are_new_each_time(space):
    rng = np.random.default_rng(16)
    mesh = start(space.random(rng, 20))
    first = mesh.arrays()
    before = [array.copy() for array in first]
    mesh.insert(space.random(rng, 20))
    assert all(np.array_equal(a, b) for a, b in zip(first, before, strict=True))


def test_duplicates_out_of_range_are_refused():
    points = np.random.default_rng(18).random((20, 2))
    simplices, neighbors = _kernel.plane.triangulate(points)[:2]
    with pytest.raises(ValueError, match="needs triangles"):
        _kernel.plane.Mesh(points, simplices[:0], neighbors[:0])
    with pytest.raises(ValueError, match="dropped, kept"):
        _kernel.plane.Mesh(points, simplices, neighbors, np.array([[3, 20]], dtype=np.int32))


def test_a_change_is_refused_to_others_and_so_is_what_they_ask():
    """While one thread changes the mesh the rest gets errors at once; of what was done nothing is half done."""
    points = np.random.default_rng(19).random((60_000, 2))
    mesh = start(points[:100])
    changer = threading.Thread(target=mesh.insert, args=(points[100:],))
    changer.start()
    uses = {
        "arrays": mesh.arrays,
        "duplicates": lambda: mesh.duplicates,
        "insert": lambda: mesh.insert(points[:1]),
        "remove": lambda: mesh.remove(np.zeros(1, dtype=np.int32)),
    }
    refused = Counter()
    while changer.is_alive():
        for name, use in uses.items():
            if changer.is_alive() and mesh.changes:
                try:
                    use()
                except RuntimeError as error:
                    refused[name] += "another thread" in str(error)
    changer.join()
    assert min(refused[name] for name in uses) > 0
    # The mesh holds what its size says, whichever of the changes beside the long one came before or after it.
    simplices, neighbors = mesh.arrays()
    edges = np.sort(np.concatenate([simplices[:, [0, 1]], simplices[:, [1, 2]], simplices[:, [2, 0]]]), axis=1)
    sides = np.unique(edges, axis=0, return_counts=True)[1]
    vertices = mesh.size - len(mesh.duplicates)
    assert vertices - len(sides) + len(simplices) == 1
    assert (neighbors < 0).sum() == (sides == 1).sum()
    assert len(np.unique(simplices)) == vertices
