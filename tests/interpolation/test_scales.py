"""Smooth interpolation of points of every scale: squares of their differences are no doubles."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay
from stereodel.interpolation import LinearInterpolator, SmoothInterpolator, estimate_gradients
from stereodel.interpolation.located import lengths
from tests.interpolation.known import KINDS

RNG = np.random.default_rng(0)
POINTS, QUERIES = RNG.random((60, 2)), 0.2 + 0.6 * RNG.random((40, 2))
VALUES = POINTS[:, 0] ** 2 - POINTS[:, 0] * POINTS[:, 1] + np.sin(3 * POINTS[:, 1])


@pytest.mark.parametrize("method", [KINDS[name] for name in ("smooth", "linear", "natural")])
@pytest.mark.parametrize("power", [-1000, -700, -530, -300, 300, 510, 700, 1000])
def test_powers_of_two_change_nothing(power, method):
    """All operations scale, so that the bits stay: gradients are those of scale 1 over the scale."""
    scale = 2.0**power
    plain, scaled = method(POINTS, VALUES), method(POINTS * scale, VALUES)
    assert np.array_equal(scaled(QUERIES * scale), plain(QUERIES))
    assert np.array_equal(scaled.gradient(QUERIES * scale) * scale, plain.gradient(QUERIES))
    if method is SmoothInterpolator:
        assert np.array_equal(scaled.gradients * scale, plain.gradients)


def quadratic(point):
    x, y = (Fraction(float(c)) for c in point)
    return 2 + x - 3 * y + x * x - 4 * x * y + 2 * y * y


SCALES = [1e-300, 1e-250, 1e-200, 1e-160, 1e-155, 1e-100, 1.0, 1e100, 1e150]


@pytest.mark.parametrize(("scale", "pairs"), [*((scale, 0.0) for scale in SCALES), (1.0, 1e-3), (1.0, 1e-9)])
def test_quadratic_polynomials_are_reproduced_at_every_scale(scale, pairs):
    """Estimated gradients are exact for them, and so is the smooth interpolant; also where some points nearly meet."""
    points, queries = POINTS * scale, QUERIES * scale
    if pairs:
        points = np.concatenate([points, points[::7] + pairs * np.random.default_rng(3).normal(size=points[::7].shape)])

    def exact(rows):
        return np.array([float(quadratic([Fraction(float(c)) / Fraction(scale) for c in row])) for row in rows])

    def slope(rows):
        x, y = (rows / scale).T
        return np.column_stack([1 + 2 * x - 4 * y, -3 - 4 * x + 4 * y])

    smooth = SmoothInterpolator(points, exact(points))
    assert np.abs(smooth(queries) - exact(queries)).max() < 1e-12
    assert np.abs(smooth.gradient(queries) * scale - slope(queries)).max() < 1e-11
    assert np.abs(smooth.gradients * scale - slope(points)).max() < 1e-8
    assert np.array_equal(smooth(points), smooth.values)


@pytest.mark.parametrize("size", [1e-8, 1e-30, 1e-100, 1e-155, 1e-160, 1e-200, 1e-300])
def test_directions_next_to_one_another_are_as_in_the_plane(size):
    """Around the pole directions can be as close as that; the sphere is flat there."""
    plane = SmoothInterpolator(POINTS, VALUES)
    lift = np.array([[size, 0, 0], [0, size, 0]])
    points, queries = (POINTS - 0.5) @ lift + [0, 0, 1.0], (QUERIES - 0.5) @ lift + [0, 0, 1.0]
    sphere = SmoothInterpolator(points, VALUES)
    assert np.abs(sphere(queries) - plane(QUERIES)).max() < 1e-7 * max(1.0, size * 1e8) if size > 1e-9 else 1e-13
    slope = sphere.gradient(queries) * size
    assert np.abs(slope[:, :2] - plane.gradient(QUERIES)).max() < (1e-6 if size > 1e-9 else 1e-11)
    assert np.abs(sphere.gradients[:, :2] * size - plane.gradients).max() < (1e-6 if size > 1e-9 else 1e-11)


def cluster(size, width):
    """Eight points about one of a set, and queries in the triangles between them and out to the others."""
    rng = np.random.default_rng(1)
    if width == 2:
        far = np.column_stack([np.cos(np.arange(9) * 0.7), np.sin(np.arange(9) * 0.7)])
        near = size * rng.normal(size=(8, 2))
    else:
        far = rng.normal(size=(30, 3))
        near = np.column_stack([size * rng.normal(size=(8, 2)), np.ones(8)])
    points = np.vstack([far, near])
    apart = rng.dirichlet(np.ones(3), size=200)
    corners = points[PlanarDelaunay(points).simplices] if width == 2 else None
    if corners is None:
        close = near[rng.integers(8, size=200)] * apart[:, :1] + near[rng.integers(8, size=200)] * (1 - apart[:, :1])
        return points, np.vstack([close, rng.normal(size=(200, 3))])
    return points, np.einsum("qk,qkd->qd", apart, corners[rng.integers(len(corners), size=200)])


@pytest.mark.parametrize(
    ("size", "width"), [*((10.0**-k, 2) for k in (6, 12, 20, 160, 200, 250)), *((10.0**-k, 3) for k in (20, 160, 200))]
)
def test_a_cluster_among_points_far_away(size, width):
    points, queries = cluster(size, width)
    values = np.random.default_rng(2).normal(size=len(points))
    steep = SmoothInterpolator(points, values)
    assert np.array_equal(steep(points), values)
    assert np.isfinite(steep.gradients).all()
    assert np.isfinite(steep(queries)).all()
    if width == 3:
        assert np.isfinite(steep.gradient(queries)).all()
        assert np.abs(SmoothInterpolator(points, np.full(len(points), 7.5))(queries) - 7.5).max() == 0.0
        return
    linear = points @ [2.0, -3.0]
    smooth = SmoothInterpolator(points, linear)
    assert np.abs(smooth.gradients - [2.0, -3.0]).max() < 1e-9
    assert np.abs(smooth(queries) - queries @ [2.0, -3.0]).max() < 1e-11
    given = SmoothInterpolator(points, linear, gradients=np.tile([2.0, -3.0], (len(points), 1)))
    assert np.abs(given(queries) - queries @ [2.0, -3.0]).max() < 1e-14  # also in needles to far points
    assert np.abs(LinearInterpolator(points, linear).gradient(queries) - [2.0, -3.0]).max() < 1e-9


def test_gradients_that_no_double_holds():
    values = 1e10 * VALUES
    gradients = estimate_gradients(POINTS * 1e-300, values)
    assert not np.isfinite(gradients).all(axis=1).any()
    assert np.isnan(SmoothInterpolator(POINTS * 1e-300, values)(QUERIES * 1e-300)).all()
    assert np.isfinite(LinearInterpolator(POINTS * 1e-300, values)(QUERIES * 1e-300)).all()


@given(st.lists(st.tuples(*[st.floats(-1e300, 1e300)] * 3), min_size=1, max_size=20))
def test_lengths_of_any_vectors(rows):
    for row, found in zip(rows, lengths(np.array(rows).T)[0], strict=True):
        with mpmath.workdps(700):
            exact = mpmath.sqrt(sum(mpmath.mpf(x) ** 2 for x in row))
            assert abs(found - exact) <= 4 * 2.0**-53 * exact + 5e-324
