"""A million points of each kind, certified: `make test-large`."""

import numpy as np
import pytest

from stereodel import lonlat_to_xyz
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay, check_delaunay
from stereodel.triangulation.topology import canonical

SIZE = 1_000_000

pytestmark = pytest.mark.large


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def clusters(dimension, spread):
    rng = np.random.default_rng(1)
    centers = unit(rng.normal(size=(100, dimension)))
    return centers[rng.integers(100, size=SIZE)] + spread * rng.normal(size=(SIZE, dimension))


def grid(rows, columns):
    return np.stack(np.meshgrid(np.arange(rows), np.arange(columns)), axis=-1).reshape(-1, 2).astype(float)


def fibonacci():
    k = np.arange(SIZE) + 0.5
    z, angle = 1 - 2 * k / SIZE, np.pi * (1 + 5**0.5) * k
    r = np.sqrt(1 - z * z)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle), z])


def graticule():
    lon, lat = np.meshgrid(np.linspace(-180, 180, 1415), np.linspace(-90, 90, 708))
    return lonlat_to_xyz(np.column_stack([lon.ravel(), lat.ravel()]))


def circle(dimension):
    angle = np.linspace(0, 2 * np.pi, SIZE, endpoint=False)
    points = np.column_stack([np.cos(angle), np.sin(angle), np.full(SIZE, 0.5)])
    return points[:, :2].copy() if dimension == 2 else points


def cube_faces():
    side = np.arange(-204, 205) * 2.0
    a, b = (x.ravel() for x in np.meshgrid(side, side))
    c = np.full(len(a), 409.0)
    return np.vstack([np.column_stack(f) for s in (c, -c) for f in ((a, b, s), (b, s, a), (s, a, b))])


PLANE = {
    "uniform": lambda: np.random.default_rng(0).random((SIZE, 2)),
    "clusters of 1e-3": lambda: clusters(2, 1e-3),
    "clusters of 1e-6": lambda: clusters(2, 1e-6),
    "integer grid": lambda: grid(1000, 1000),
    "grid of tenths, slanting": lambda: grid(1000, 1000) @ [[0.3, 0.4], [-0.4, 0.3]],
    "circle": lambda: circle(2),
    "millimetres far away": lambda: (
        np.round(np.random.default_rng(2).random((SIZE, 2)) * 1e3, 3) + [500_000, 5_000_000]
    ),
}
SPHERE = {
    "uniform": lambda: np.random.default_rng(0).normal(size=(SIZE, 3)),
    "clusters of 1e-3": lambda: clusters(3, 1e-3),
    "clusters of 1e-6": lambda: clusters(3, 1e-6),
    "clusters of 1e-9": lambda: clusters(3, 1e-9),
    "one city": lambda: np.vstack(
        [unit(np.ones((1, 3))) + 1e-7 * np.random.default_rng(3).normal(size=(SIZE, 3)), np.eye(3)]
    ),
    "Fibonacci lattice": fibonacci,
    "graticule": graticule,
    "circle": lambda: circle(3),
    "faces of a cube": cube_faces,
}


@pytest.mark.parametrize("name", PLANE)
def test_plane(name):
    points = PLANE[name]()
    triangulation = PlanarDelaunay(points)
    check_delaunay(triangulation)
    assert np.array_equal(PlanarDelaunay(points, workers=1).simplices, triangulation.simplices)


@pytest.mark.parametrize("name", SPHERE)
def test_sphere(name):
    points = SPHERE[name]()
    triangulation = SphericalDelaunay(points)
    assert len(triangulation) == 2 * (len(points) - len(triangulation.duplicates)) - 4
    check_delaunay(triangulation)
    assert np.array_equal(SphericalDelaunay(points, workers=1).simplices, triangulation.simplices)


@pytest.mark.parametrize(("cls", "width"), [(PlanarDelaunay, 2), (SphericalDelaunay, 3)])
def test_a_tenth_comes_and_goes(cls, width):
    points = np.random.default_rng(4).normal(size=(SIZE, width))
    more = np.random.default_rng(5).normal(size=(SIZE // 10, width))
    triangulation = cls(points)
    before = canonical(triangulation.simplices)
    new = triangulation.insert(more)
    assert np.array_equal(canonical(triangulation.simplices), canonical(cls(np.vstack([points, more])).simplices))
    triangulation.remove(new)
    assert np.array_equal(canonical(triangulation.simplices), before)
