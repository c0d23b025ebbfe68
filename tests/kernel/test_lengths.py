"""The kernel's comparison of lengths and diametral circles against exact numbers."""

from fractions import Fraction

import numpy as np
import pytest

from stereodel import _kernel
from stereodel import _kernel_probe as probe
from stereodel.predicates.integers import sign, sign_of_roots
from stereodel.predicates.rays import ray

SPREADS = [1.0, 1e-4, 1e-8, 1e-12, 1e-15]


def dot(a, b):
    return sum(x * y for x, y in zip(a[:3], b[:3], strict=True))


def lengths_plane(a, b, c, d):
    return sign(
        sum((x - y) ** 2 for x, y in zip(a, b, strict=True)) - sum((x - y) ** 2 for x, y in zip(c, d, strict=True))
    )


def diametral_plane(a, b, p):
    return sign((a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]))


def lengths_sphere(a, b, c, d):
    return sign_of_roots(((dot(c, d), a[3] * b[3]), (-dot(a, b), c[3] * d[3])))


def diametral_sphere(a, b, p):
    return sign_of_roots(((1, a[3] * b[3] * p[3]), (dot(a, b), p[3]), (-dot(p, a), b[3]), (-dot(p, b), a[3])))


def prove(points, seed=0, rows=300):
    """Rows of random numbers, some of them twice in a row."""
    numbers = np.random.default_rng(seed).integers(0, len(points), size=(rows, 4)).astype(np.int32)
    on_sphere = points.shape[1] == 3
    exact = [ray(p) if on_sphere else tuple(map(Fraction, p)) for p in points.tolist()]
    lengths = _kernel.sphere.compare_lengths if on_sphere else _kernel.plane.compare_lengths
    diametral = _kernel.sphere.diametral if on_sphere else _kernel.plane.diametral
    oracles = (lengths_sphere, diametral_sphere) if on_sphere else (lengths_plane, diametral_plane)
    wanted = [oracles[0](*(exact[k] for k in row)) for row in numbers.tolist()]
    assert lengths(points, numbers).tolist() == wanted
    wanted = [oracles[1](*(exact[k] for k in row[:3])) for row in numbers.tolist()]
    assert diametral(points, np.ascontiguousarray(numbers[:, :3])).tolist() == wanted


def normalised(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


@pytest.mark.parametrize("spread", SPREADS)
def test_clusters_in_the_plane(spread):
    rng = np.random.default_rng(1)
    prove(np.array([0.3, 0.7]) + spread * rng.normal(size=(40, 2)))


@pytest.mark.parametrize("spread", SPREADS)
def test_clusters_on_the_sphere(spread):
    rng = np.random.default_rng(2)
    points = normalised(np.array([0.3, 0.7, -0.2]) + spread * rng.normal(size=(40, 3)))
    assert probe.all_unit(points)
    prove(points)
    prove(points * (1 + 0.6 * 2.0**-49 * rng.choice([-1, 1], size=(40, 1))))
    prove(points * rng.uniform(0.5, 1e6, size=(40, 1)))


@pytest.mark.parametrize("width", [2, 3])
def test_ties(width):
    rng = np.random.default_rng(3)
    points = rng.integers(-3, 4, size=(60, width)).astype(float)
    points = points[points.any(axis=1)]
    prove(points)
    prove(points * 0.1)
    prove(points * 2.0**-200)
    if width == 3:
        prove(normalised(points))


@pytest.mark.parametrize("exponent", [-1074, -540, -500, 300, 500])
def test_extreme_coordinates(exponent):
    rng = np.random.default_rng(4)
    points = np.ldexp(rng.integers(-9, 10, size=(40, 3)).astype(float), exponent)
    prove(points[:, :2].copy())
    prove(points[points.any(axis=1)])


def test_nearly_right_angles():
    """Third points on the diametral circle, rounded."""
    rng = np.random.default_rng(5)
    angle = rng.uniform(0, 2 * np.pi, size=60)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    points = np.concatenate([circle, -circle])
    numbers = np.column_stack([np.arange(60), np.arange(60, 120), rng.permutation(60)]).astype(np.int32)
    exact = [tuple(map(Fraction, p)) for p in points.tolist()]
    wanted = [diametral_plane(*(exact[k] for k in row)) for row in numbers.tolist()]
    assert _kernel.plane.diametral(points, numbers).tolist() == wanted
    assert len(set(wanted)) > 1
    lifted = normalised(np.column_stack([points * 1e-3, np.ones(120)]))
    rays = [ray(p) for p in lifted.tolist()]
    wanted = [diametral_sphere(*(rays[k] for k in row)) for row in numbers.tolist()]
    assert _kernel.sphere.diametral(lifted, numbers).tolist() == wanted
    assert len(set(wanted)) > 1


def test_opposite_directions_have_every_point_on_their_circle():
    points = np.array([[1.0, 2, 3], [-2, -4, -6], [0, 1, 5], [7, 0, 0]])
    assert _kernel.sphere.diametral(points, np.array([[0, 1, 2], [0, 1, 3]], dtype=np.int32)).tolist() == [0, 0]


@pytest.mark.parametrize("size", [1e-14, 1e-16, 1e-40, 1e-200])
def test_beside_an_axis(size):
    """Directions far closer than 1e-16, many of them mirror images: chords in doubles tell nothing."""
    steps = np.array([[i, j] for i in range(-2, 3) for j in range(-2, 3)])
    prove(np.column_stack([size * steps, np.ones(25)]))
    prove(np.column_stack([size * steps, np.full(25, 3.0)]), seed=1)
