"""A million points of each kind, certified: `make test-large`."""

from functools import partial
from itertools import product

import numpy as np
import pytest

from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay, check_delaunay
from tests import sets
from tests.spaces import canonical

SIZE = 1_000_000

pytestmark = pytest.mark.large


def fibonacci():
    k = np.arange(SIZE) + 0.5
    z, angle = 1 - 2 * k / SIZE, np.pi * (1 + 5**0.5) * k
    r = np.sqrt(1 - z * z)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle), z])


def clusters(dimension, spread):
    rng = np.random.default_rng(1)
    centers = sets.unit(rng.normal(size=(100, dimension)))
    return centers[rng.integers(100, size=SIZE)] + spread * rng.normal(size=(SIZE, dimension))


OWN = {
    "Fibonacci lattice": fibonacci,
    "small circle": lambda: np.insert(sets.plane("rounded circle").drawn(SIZE), 2, 0.5, axis=1),
    "millimetres far away": lambda: np.round(np.random.default_rng(2).random((SIZE, 2)) * 1e3, 3) + [5e5, 5e6],
}
for d, size in product((2, 3), (1e-3, 1e-6, 1e-9)):
    OWN[f"{d} clusters of {size}"] = partial(clusters, d, size)
SETS = [
    *(pytest.param(make, id=name) for name, make in OWN.items()),
    *(
        pytest.param(lambda one=one: one.drawn(SIZE), id=str(one))
        for one in sets.ALL.values()
        if "grows" in one.traits
        and not one.traits & {"sizes", "flat"}
        and not one.name.startswith(("airports", "needles", "circle and", "line and"))  # or one star has all points
    ),
]


@pytest.mark.parametrize("make", SETS)
def test_a_million_of_any_kind(make):
    points = make()
    cls = PlanarDelaunay if points.shape[1] == 2 else SphericalDelaunay
    triangulation = cls(points)
    if cls is SphericalDelaunay:
        assert len(triangulation) == 2 * (len(points) - len(triangulation.duplicates)) - 4
    check_delaunay(triangulation)
    assert np.array_equal(cls(points, workers=1).simplices, triangulation.simplices)


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
