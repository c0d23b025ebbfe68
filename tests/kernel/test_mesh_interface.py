"""The kernel's meshes as Python holds them: what they take and refuse, the arrays that they give, threads."""

import threading
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from stereodel import _kernel

PLANE, SPHERE = 2, 3
MESHES = {PLANE: _kernel.plane.Mesh, SPHERE: _kernel.sphere.Mesh}
TRIANGULATE = {PLANE: _kernel.plane.triangulate, SPHERE: _kernel.sphere.triangulate}


def triangulated(points):
    """What a mesh is made of."""
    simplices, neighbors, duplicates, _, _ = TRIANGULATE[points.shape[1]](points)
    return points, simplices, neighbors, duplicates


def start(points):
    return MESHES[points.shape[1]](*triangulated(points))


def test_tests_left_open_are_counted():
    grid = np.array([[x, y] for x in range(4) for y in range(4)], dtype=float)
    mesh = start(grid[:6])
    assert set(mesh.inconclusive.values()) == {0}
    mesh.insert(grid[6:])
    assert mesh.inconclusive.keys() == {"filter", "double_double", "exact"}
    assert mesh.inconclusive["filter"] >= mesh.inconclusive["exact"] > 0
    assert start(np.vstack([np.eye(3), -np.eye(3)])).inconclusive.keys() >= {"curvature", "exact"}


def test_rows_are_given_in_any_rotation():
    points, simplices, neighbors, _ = triangulated(np.random.default_rng(15).random((30, 2)))
    mesh = _kernel.plane.Mesh(points, np.roll(simplices, 1, axis=1), np.roll(neighbors, 1, axis=1))
    assert np.array_equal(mesh.arrays()[0], simplices)
    assert np.array_equal(mesh.arrays()[1], neighbors)


@pytest.mark.parametrize("width", [PLANE, SPHERE])
def test_arrays_are_new_each_time(width):
    rng = np.random.default_rng(16)
    mesh = start(rng.normal(size=(20, width)))
    first = mesh.arrays()
    before = [array.copy() for array in first]
    mesh.insert(rng.normal(size=(20, width)))
    assert all(np.array_equal(a, b) for a, b in zip(first, before, strict=True))


def test_wrong_input():
    points, simplices, neighbors, _ = triangulated(np.random.default_rng(18).random((20, 2)))
    empty = np.zeros((0, 3), dtype=np.int32)
    with pytest.raises(ValueError, match="needs triangles"):
        _kernel.plane.Mesh(points, empty, empty)
    with pytest.raises(ValueError, match="same length"):
        _kernel.plane.Mesh(points, simplices, neighbors[1:])
    for wrong in (simplices - 1, simplices + 1):
        with pytest.raises(ValueError, match="out of range"):
            _kernel.plane.Mesh(points, wrong, neighbors)
    for wrong in (neighbors - 1, neighbors + 1):
        with pytest.raises(ValueError, match="out of range"):
            _kernel.plane.Mesh(points, simplices, wrong)
    with pytest.raises(ValueError, match="dropped, kept"):
        _kernel.plane.Mesh(points, simplices, neighbors, np.array([[3, 20]], dtype=np.int32))
    with pytest.raises(ValueError, match="closed surface"):
        _kernel.sphere.Mesh(np.column_stack([points, np.ones(20)]), simplices, neighbors)
    mesh = _kernel.plane.Mesh(points, simplices, neighbors)
    for wrong in (-1, 20):
        with pytest.raises(ValueError, match="out of range"):
            mesh.remove(np.array([0, wrong], dtype=np.int32))
    assert mesh.size == 20
    assert np.array_equal(mesh.arrays()[0], simplices)
    assert np.array_equal(mesh.arrays()[1], neighbors)


def test_a_change_is_refused_to_others_and_so_is_what_they_ask():
    """While one thread changes the mesh the rest gets errors at once; of what was done nothing is half done."""
    rng = np.random.default_rng(19)
    points = rng.random((60_000, 2))
    mesh = start(points[:100])
    changer = threading.Thread(target=mesh.insert, args=(points[100:],))
    changer.start()
    refused = Counter()
    while changer.is_alive():
        for name, use in {
            "arrays": mesh.arrays,
            "duplicates": lambda: mesh.duplicates,
            "insert": lambda: mesh.insert(points[:1]),
            "remove": lambda: mesh.remove(np.zeros(1, dtype=np.int32)),
        }.items():
            if changer.is_alive() and mesh.changes:
                try:
                    use()
                except RuntimeError as error:
                    refused[name] += "another thread" in str(error)
    changer.join()
    assert min(refused[name] for name in ("arrays", "duplicates", "insert", "remove")) > 0
    check_delaunay_rows(mesh)


def check_delaunay_rows(mesh):
    """The mesh holds what its size says, whichever of the changes beside the long one came before or after it."""
    simplices, neighbors = mesh.arrays()
    edges = np.sort(np.concatenate([simplices[:, [0, 1]], simplices[:, [1, 2]], simplices[:, [2, 0]]]), axis=1)
    boundary = np.unique(edges, axis=0, return_counts=True)[1]
    vertices = mesh.size - len(mesh.duplicates)
    assert vertices - len(boundary) + len(simplices) == 1
    assert (neighbors < 0).sum() == (boundary == 1).sum()
    assert len(np.unique(simplices)) == vertices


def test_reads_wait_for_each_other():
    mesh = start(np.random.default_rng(20).random((50_000, 2)))
    expected = mesh.arrays()
    with ThreadPoolExecutor(8) as pool:
        for arrays in pool.map(lambda _: mesh.arrays(), range(32)):
            assert np.array_equal(arrays[0], expected[0])
            assert np.array_equal(arrays[1], expected[1])
    assert mesh.changes == 0
