"""The kernel's meshes under insertion and removal, against the paper's insertion from scratch, and proved Delaunay."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import HullInsertion, _kernel, check_delaunay
from stereodel.triangulation.topology import canonical, neighbors_of

PLANE, SPHERE = 2, 3
BOTH = pytest.mark.parametrize("width", [PLANE, SPHERE])
MESHES = {PLANE: _kernel.plane.Mesh, SPHERE: _kernel.sphere.Mesh}
TRIANGULATE = {PLANE: _kernel.plane.triangulate, SPHERE: _kernel.sphere.triangulate}


@dataclass
class Oracle:
    """What a triangulation from scratch gives."""

    points: np.ndarray
    simplices: np.ndarray
    duplicates: np.ndarray

    @classmethod
    def of(cls, points):
        points = np.array(points, dtype=float)
        hull = HullInsertion(points, spatial=True)
        hull.run()
        return cls(points, hull.simplices, hull.duplicates[np.argsort(hull.duplicates[:, 0])])

    def mesh(self):
        return MESHES[self.points.shape[1]](self.points, self.simplices, neighbors_of(self.simplices), self.duplicates)


def start(points):
    """A mesh, by the kernel's own construction: for sets that are too large for the oracle."""
    simplices, neighbors, duplicates, _, _ = TRIANGULATE[points.shape[1]](points)
    return MESHES[points.shape[1]](points, simplices, neighbors, duplicates)


def prove(mesh, points):
    """That a mesh is a valid Delaunay triangulation of points; its simplices in canonical order."""
    simplices, neighbors = mesh.arrays()
    assert mesh.size == len(points)
    assert (simplices[:, 0] < simplices[:, 1:].T).all()
    check_delaunay(points, simplices, duplicates=mesh.duplicates, neighbors=neighbors)
    return canonical(simplices)


def prove_equal(mesh, points):
    """That a mesh is the triangulation that the oracle builds."""
    oracle = Oracle.of(points)
    if len(oracle.simplices) == 0:
        assert mesh.is_flat
    else:
        assert not mesh.is_flat
        assert np.array_equal(prove(mesh, points), oracle.simplices)
    assert np.array_equal(mesh.duplicates, oracle.duplicates)


def prove_rebuilt(mesh, points):
    """That a mesh is the triangulation that the kernel builds."""
    simplices, _, duplicates, _, _ = TRIANGULATE[points.shape[1]](points)
    assert np.array_equal(prove(mesh, points), canonical(simplices))
    assert np.array_equal(mesh.duplicates, duplicates)


def remove(mesh, points, indices):
    """Remove points from a mesh; the points that are left."""
    stays = np.ones(len(points), dtype=bool)
    stays[indices] = False
    number = mesh.remove(np.array(indices, dtype=np.int32))
    assert number.tolist() == np.where(stays, np.cumsum(stays) - 1, -1).tolist()
    return points[stays]


def spanning(points):
    return len(Oracle.of(points).simplices) > 0


def directions(rng, size):
    return rng.normal(size=(size, SPHERE))


def random_points(width, rng, size):
    return rng.random((size, PLANE)) if width == PLANE else directions(rng, size)


def small_points(width, limit, **sizes):
    """Small integers: cocircular, collinear and equal ones; on the sphere also of different lengths."""
    point = st.tuples(*[st.integers(-limit, limit)] * width).filter(lambda p: width == PLANE or any(p))
    return st.lists(point, **sizes).map(lambda rows: np.array(rows, dtype=float).reshape(-1, width))


@BOTH
@given(data=st.data())
def test_insertion_of_small_integers(width, data):
    first = data.draw(small_points(width, 3, min_size=3, max_size=12).filter(spanning))
    oracle = Oracle.of(first)
    mesh, points = oracle.mesh(), first
    for added in data.draw(st.lists(small_points(width, 3, max_size=6), max_size=3)):
        pairs = mesh.insert(added)
        assert pairs.tolist() == [pair for pair in mesh.duplicates.tolist() if pair[0] >= len(points)]
        points = np.vstack([points, added])
    prove_equal(mesh, points)


@BOTH
@given(data=st.data())
def test_removal_of_small_integers(width, data):
    points = data.draw(small_points(width, 2, min_size=3, max_size=24).filter(spanning))
    mesh = Oracle.of(points).mesh()
    for _ in range(2):
        indices = data.draw(st.lists(st.integers(0, len(points) - 1), max_size=8)) if len(points) else []
        points = remove(mesh, points, indices)
        if mesh.is_flat:
            break
    prove_equal(mesh, points)


@BOTH
@given(data=st.data())
def test_changes_in_turn(width, data):
    points = data.draw(small_points(width, 4, min_size=6, max_size=12).filter(spanning))
    mesh = Oracle.of(points).mesh()
    for _ in range(3):
        added = data.draw(small_points(width, 4, max_size=6))
        mesh.insert(added)
        points = np.vstack([points, added])
        points = remove(mesh, points, data.draw(st.lists(st.integers(0, len(points) - 1), max_size=6)))
        prove_equal(mesh, points)
        if mesh.is_flat:
            break


@BOTH
@pytest.mark.parametrize("at_once", [False, True])
def test_removal_of_all_but_three(width, at_once):
    rng = np.random.default_rng(5)
    points = random_points(width, rng, 40)
    mesh = Oracle.of(points).mesh()
    if at_once:
        points = remove(mesh, points, rng.permutation(40)[:37])
        prove_equal(mesh, points)
    else:
        while len(points) > 3:
            points = remove(mesh, points, [rng.integers(len(points))])
            prove_equal(mesh, points)
    remove(mesh, points, [1])
    assert mesh.is_flat
    assert mesh.size == 2


@BOTH
def test_a_grid_comes_and_goes(width):
    """Every removal meets ties, points within the sides of the hull and whole rows of collinear neighbours."""
    rng = np.random.default_rng(6)
    grid = np.stack(np.meshgrid(np.arange(7.0), np.arange(6.0)), axis=-1).reshape(-1, 2)
    points = grid if width == PLANE else np.column_stack([grid - 2.5, np.full(len(grid), 4.0)])
    order = rng.permutation(len(points))
    oracle = Oracle.of(points[order[:10]])
    mesh = oracle.mesh()
    mesh.insert(np.ascontiguousarray(points[order[10:]]))
    points = points[order]
    prove_equal(mesh, points)
    while len(points) > 5:
        points = remove(mesh, points, rng.permutation(len(points))[:4])
        prove_equal(mesh, points)
        if mesh.is_flat:
            break


def test_the_last_point_beside_a_line():
    points = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0], [1, 1]])
    mesh = Oracle.of(points).mesh()
    points = remove(mesh, points, [4])
    assert mesh.is_flat
    assert [array.shape for array in mesh.arrays()] == [(0, 3), (0, 3)]
    with pytest.raises(ValueError, match="anew"):
        mesh.insert(points)
    assert mesh.remove(np.array([1], dtype=np.int32)).tolist() == [0, -1, 1, 2]


def test_what_remains_on_a_great_circle_is_flat():
    circle = np.array([[1.0, 0, 0], [1, 1, 0], [-1, 2, 0], [-1, -1, 0], [0, 0, 1], [0, 0, -1]])
    mesh = Oracle.of(circle).mesh()
    remove(mesh, circle, [4, 5])
    assert mesh.is_flat
    assert mesh.size == 4


@pytest.mark.parametrize(("width", "ring"), [(PLANE, 3000), (SPHERE, 3000)])
def test_a_pole_with_thousands_of_neighbors(width, ring):
    rng = np.random.default_rng(7)
    angle = np.sort(rng.random(ring)) * 2 * np.pi
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    if width == PLANE:
        points = np.vstack([[[0.01, 0.02]], circle])
    else:
        points = np.vstack([[[0.01, 0.02, 1.0]], np.column_stack([circle, np.full(ring, 5.0)]), [[0.0, 0.0, -1.0]]])
    mesh = start(points)
    degree = (mesh.arrays()[0] == 0).any(axis=1).sum()
    assert degree > 0.9 * ring
    rest = remove(mesh, points, [0])
    prove_rebuilt(mesh, rest)
    mesh.insert(points[:1])
    prove_rebuilt(mesh, np.vstack([rest, points[:1]]))


@pytest.mark.parametrize("spread", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_clusters_on_the_sphere(spread):
    rng = np.random.default_rng(8)
    center = directions(rng, 1)
    center /= np.linalg.norm(center)
    points = np.vstack([center + spread * directions(rng, 40), directions(rng, 4)])
    mesh = Oracle.of(points).mesh()
    added = center + spread * directions(rng, 30)
    mesh.insert(added)
    points = np.vstack([points, added])
    prove_equal(mesh, points)
    prove_equal(mesh, remove(mesh, points, rng.permutation(len(points))[:45]))


@BOTH
@pytest.mark.parametrize("size", [5e-324, 1e-300, 1e-150, 1e150, 1e300])
def test_coordinates_of_any_size(width, size):
    rng = np.random.default_rng(9)
    points = rng.integers(-9, 10, size=(40, width)) * size
    points = points[points.any(axis=1)]
    mesh = Oracle.of(points[:20]).mesh()
    mesh.insert(np.ascontiguousarray(points[20:]))
    prove_equal(mesh, points)
    prove_equal(mesh, remove(mesh, points, range(5, len(points), 2)))


def test_finer_points_than_before():
    """What doubles tell of integers they do not of those inserted, which lie on a circle but for their rounding."""
    angle = np.random.default_rng(20).random(80) * 2 * np.pi
    coarse = np.array([[9.0, 9], [-9, 9], [0, -9]])
    circle = 5 * np.column_stack([np.cos(angle), np.sin(angle)])
    mesh = Oracle.of(coarse).mesh()
    mesh.insert(circle)
    prove_equal(mesh, np.vstack([coarse, circle]))


def test_other_lengths_than_before():
    rng = np.random.default_rng(21)
    unit = directions(rng, 30)
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    added = directions(rng, 30) * 10.0 ** rng.integers(-3, 3, size=(30, 1))
    mesh = Oracle.of(unit).mesh()
    mesh.insert(added)
    prove_equal(mesh, np.vstack([unit, added]))


@BOTH
def test_many_points_into_few(width):
    """More than one round of insertion; removal of most of them again."""
    rng = np.random.default_rng(10)
    points = random_points(width, rng, 9010)
    points[5000:5100] = points[:100]
    mesh = start(points[:10])
    pairs = mesh.insert(points[10:])
    assert len(pairs) == 100
    prove_rebuilt(mesh, points)
    prove_rebuilt(mesh, remove(mesh, points, rng.permutation(9010)[:8700]))


@BOTH
def test_duplicates_of_one_batch_keep_the_lowest(width):
    rng = np.random.default_rng(11)
    points = random_points(width, rng, 50)
    distinct = random_points(width, rng, 2000)
    distinct[:, 0] = np.where(rng.random(2000) < 0.3, 0.0, distinct[:, 0])
    added = np.repeat(distinct, 3, axis=0)[rng.permutation(6000)]
    added[rng.random(6000) < 0.5, 0] *= -1  # also −0 beside 0
    mesh = Oracle.of(points).mesh()
    mesh.insert(added)
    expected = TRIANGULATE[width](np.vstack([points, added]))[2]
    assert np.array_equal(mesh.duplicates, expected)


def test_equal_points_of_the_plane():
    points = np.array([[0.0, 0], [4, 0], [0, 4], [-0.0, 0.0]])
    mesh = Oracle.of(points).mesh()
    assert mesh.insert(np.array([[1.0, 1], [0, -0.0], [1, 1]])).tolist() == [[5, 0], [6, 4]]
    assert mesh.remove(np.array([0, 3], dtype=np.int32)).tolist() == [-1, 0, 1, -1, 2, 3, 4]
    assert mesh.duplicates.tolist() == [[4, 2]]
    assert canonical(mesh.arrays()[0]).tolist() == [[0, 1, 2], [0, 2, 3], [1, 3, 2]]


def test_equal_directions_of_different_length():
    """A third of 3 v is not v in doubles; the directions are still the same."""
    rng = np.random.default_rng(12)
    points = rng.integers(-(2**50), 2**50, size=(20, 3)).astype(float)
    mesh = Oracle.of(points).mesh()
    added = np.vstack([7 * points, points * 2.0**-300, points[:5]])[rng.permutation(45)]
    mesh.insert(added)
    both = np.vstack([points, added])
    prove_equal(mesh, both)
    rest = remove(mesh, both, list(range(12)))
    prove_equal(mesh, rest)
    assert len(mesh.duplicates) == 45 - 12


@BOTH
def test_heirs_inherit_in_the_order_of_their_numbers(width):
    rng = np.random.default_rng(13)
    distinct = random_points(width, rng, 12)
    points = np.repeat(distinct, 4, axis=0)[rng.permutation(48)]
    mesh = Oracle.of(points).mesh()
    while len(points) > 6:
        points = remove(mesh, points, rng.permutation(len(points))[:5])
        prove_equal(mesh, points)
        if mesh.is_flat:
            break


@BOTH
def test_order_does_not_matter(width):
    """Ties are decided by the points: any order of insertion gives the same triangles."""
    rng = np.random.default_rng(14)
    points = np.unique(rng.integers(-2, 3, size=(60, width)).astype(float), axis=0)
    points = points[points.any(axis=1)]
    points = np.delete(points, Oracle.of(points).duplicates[:, 0], axis=0)
    found = set()
    for _ in range(5):
        order = rng.permutation(len(points))
        first = next(k for k in range(3, len(points)) if spanning(points[order[:k]]))
        mesh = Oracle.of(points[order[:first]]).mesh()
        mesh.insert(np.ascontiguousarray(points[order[first:]]))
        found.add(canonical(order[mesh.arrays()[0]]).tobytes())
    assert len(found) == 1
