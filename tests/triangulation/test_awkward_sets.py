"""Sets that were made to go wrong, drawn at random: everything that holds for all sets, checked on each."""

import numpy as np
import pytest

from stereodel import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, check_delaunay, lonlat_to_xyz
from stereodel.predicates.rays import ray


def small_integers(rng):
    size = rng.integers(1, 4)
    return rng.integers(-size, size + 1, size=(rng.integers(0, 14), 3)).astype(float)


def part_of_a_cube(rng):
    corners = np.array(np.meshgrid([-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0])).reshape(3, -1).T
    return corners[rng.permutation(8)[: rng.integers(0, 9)]]


def one_circle_and_others(rng):
    circle = np.array([[3, 4], [4, 3], [-3, 4], [-4, 3], [5, 0], [0, 5], [-5, 0], [0, -5], [3, -4], [4, -3]])
    chosen = circle[rng.permutation(10)[: rng.integers(1, 9)]]
    level = np.full(len(chosen), rng.choice([0, 0, 1, 12, -2]))
    return np.vstack([np.column_stack([chosen, level]), rng.integers(-2, 3, size=(rng.integers(0, 4), 3))]).astype(
        float
    )


def tight_cluster(rng):
    middle = rng.normal(size=3)
    points = middle / np.linalg.norm(middle) + 10.0 ** -rng.integers(1, 17) * rng.normal(size=(rng.integers(3, 20), 3))
    return np.vstack([points / np.linalg.norm(points, axis=1, keepdims=True), rng.normal(size=(rng.integers(0, 3), 3))])


def extreme_lengths(rng):
    points = rng.integers(-2, 3, size=(8, 3)).astype(float)
    return points * 10.0 ** rng.integers(-200, 200, size=(8, 1))


def subnormal_and_huge(rng):
    points = rng.integers(-2, 3, size=(rng.integers(3, 10), 3)).astype(float)
    return points * 10.0 ** float(rng.choice([-320, -300, 0, 150, 300]))


def beside_an_axis(rng):
    tiny = [[0, 0], [1e-300, 0], [0, 1e-300], [1e-300, 1e-300], [5e-324, 0]]
    points = [*([1.0, *pair] for pair in tiny), [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    return np.array(points)[rng.permutation(7)[: rng.integers(2, 8)]]


def part_of_a_graticule(rng):
    step = rng.choice([30, 45, 60, 90])
    grid = np.array(np.meshgrid(np.arange(-180, 181, step), np.arange(-90, 91, step))).reshape(2, -1).T
    return lonlat_to_xyz(grid[rng.random(len(grid)) < rng.random()])


KINDS = (
    small_integers,
    part_of_a_cube,
    one_circle_and_others,
    tight_cluster,
    extreme_lengths,
    subnormal_and_huge,
    beside_an_axis,
    part_of_a_graticule,
)


def rows(simplices):
    return sorted(tuple(np.roll(row, -int(np.argmin(row)))) for row in simplices.tolist())


def named(triangulation, name):
    return sorted(sorted(name(triangulation.points[i]) for i in row) for row in triangulation.simplices)


def directed(point):
    return ray(point.tolist())


def placed(point):
    return tuple((point + 0.0).tolist())


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_on_the_sphere(kind, seed):
    rng = np.random.default_rng(seed)
    points = kind(rng).reshape(-1, 3)
    points = points[points.any(axis=1)]
    triangulation = SphericalDelaunay(points)
    check_delaunay(triangulation)
    assert len(triangulation.simplices) in (0, 2 * (len(points) - len(triangulation.duplicates)) - 4)
    shuffled = SphericalDelaunay(points[rng.permutation(len(points))])
    assert named(shuffled, directed) == named(triangulation, directed)
    diagram = SphericalVoronoi(triangulation)
    assert rows(diagram.delaunay().simplices) == rows(triangulation.simplices)
    if len(points):
        assert np.isclose(diagram.areas().sum(), 4 * np.pi, rtol=1e-13)
        nearest = triangulation.nearest(points)
        assert [directed(points[i]) for i in nearest] == [directed(p) for p in points]


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_in_the_plane(kind, seed):
    rng = np.random.default_rng(seed)
    points = kind(rng).reshape(-1, 3)[:, :2]
    triangulation = PlanarDelaunay(points)
    check_delaunay(triangulation)
    shuffled = PlanarDelaunay(points[rng.permutation(len(points))])
    assert named(shuffled, placed) == named(triangulation, placed)
    diagram = PlanarVoronoi(triangulation)
    assert rows(diagram.delaunay().simplices) == rows(triangulation.simplices)
    assert len(diagram.regions) == len(points)
    if triangulation.dimension == 2:
        assert (triangulation.find_simplex(points) >= 0).all()


@pytest.mark.parametrize("size", [1e-3, 1e-8, 1e-13, 1e-150, 1e-300])
def test_the_cells_of_three_points_are_lunes_however_close_they_are(size):
    points = np.array([[1.0, size, 0.0], [1.0, -size, 0.0], [1.0, 0.0, 2 * size]])
    areas = SphericalVoronoi(points).areas()
    # Lunes between the bisectors: the angles at the axis are what the sides of the triangle leave, twice each.
    angles = np.array([np.pi - np.arctan(2.0), np.pi - np.arctan(2.0), 2 * np.arctan(2.0)])
    assert np.allclose(areas, 2 * angles, rtol=1e-5 if size > 1e-4 else 1e-13)


@pytest.mark.parametrize("size", [1e-14, 1e-120, 1e-200, 5e-324])
def test_two_points_share_a_cell_evenly_however_close_they_are(size):
    wide = [[1.0, 1e-6, 1e-6], [1.0, -1e-6, 1e-6], [1.0, 0.0, -1e-6], [-1.0, 0.0, 0.0]]
    diagram = SphericalVoronoi([[1.0, size, 0.0], [1.0, -size, 0.0], *wide])
    areas = diagram.areas()
    assert np.allclose(areas[:2], 1.125e-12, rtol=1e-7)  # the triangle of the bisectors, cut in half
    assert np.isclose(areas.sum(), 4 * np.pi, rtol=1e-14)
    middle = diagram.centroids()[:2]
    assert np.allclose(middle[:, 1], [5e-7, -5e-7], rtol=1e-7)


def test_three_points_of_no_distance_have_centroids():
    points = np.array([[1.0, 1e-300, 0.0], [1.0, -1e-300, 0.0], [1.0, 0.0, 2e-300]])
    near = SphericalVoronoi(points).centroids()
    far = SphericalVoronoi(np.where(np.abs(points) < 1e-200, points * 1e290, points)).centroids()
    assert np.allclose(near, far, atol=1e-9)
