"""The validator's own predicates against fractions and 800-digit roots, nearly and exactly degenerate."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mpf, workdps

from stereodel.triangulation.validate_signs import PlaneSigns, SphereSigns, _nearly_unit, ray_integers
from tests import sets
from tests.exact import fractions, unit, volume
from tests.reference import incircle_integer, orient2d_integer, sign
from tests.spaces import SPHERE

ULP = 2.0**-52


def bubble_oracle(quadruple):
    """Four roots of integers of 2000 bits that differ at all differ within 800 digits."""
    with workdps(800):
        value = volume(*map(unit, np.asarray(quadruple, dtype=float).tolist()))
        return 0 if abs(value) < mpf(10) ** -600 else sign(value)


def turn_oracle(triple):
    return orient2d_integer(*fractions(triple))


def circle_oracle(quadruple):
    return incircle_integer(*fractions(quadruple))


def bubble(quadruple):
    return int(SphereSigns(np.asarray(quadruple, dtype=float)).bubble(np.array([[0, 1, 2, 3]]))[0])


@given(st.lists(st.integers(-2, 2), min_size=8, max_size=8), st.sampled_from([0.5, 3.0, 1e6]), st.integers(-900, 900))
def test_plane_near_a_square(noise, offset, exponent):
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float) + offset
    points = np.ldexp(square + np.reshape(noise, (4, 2)) * ULP * offset, exponent)
    signs = PlaneSigns(points)
    assert signs.turn(np.array([[0, 1, 3]]))[0] == turn_oracle(points[[0, 1, 3]])
    assert signs.circle(np.array([[0, 1, 2, 3]]))[0] == circle_oracle(points)


def test_plane_where_products_underflow(rng):
    """Products on both sides of 2⁻¹⁰⁷⁵, of differences that are rounded: 0 or the least double, by chance."""
    factor = 1 + rng.random((4000, 2))
    a = rng.integers(-(2**10), 2**10, size=(4000, 2)) * 2.0**-600
    b = factor * 2.0**-537.5 * (1 + rng.integers(-2, 3, size=(4000, 2)) * ULP)
    c = (2.0**-537.5 / factor)[:, ::-1]
    points = np.stack([a, b, c], axis=1)
    signs = PlaneSigns(points.reshape(-1, 2)).turn(np.arange(12000).reshape(-1, 3))
    assert signs.tolist() == [turn_oracle(triple) for triple in points.tolist()]


@given(st.integers(-3, 3), st.integers(-3, 3), st.sampled_from([1e-3, 1.0, 1e308, 5e-324]))
def test_plane_nearly_collinear(i, j, scale):
    points = np.array([[0.5, 0.5], [12.0, 12.0], [24.0 + i * 8 * ULP, 24.0 + j * 8 * ULP]]) / 32 * scale
    assert PlaneSigns(points).turn(np.array([[0, 1, 2]]))[0] == turn_oracle(points)


@pytest.mark.parametrize("exponent", [-530, -266, 0, 250])
def test_plane_within_the_last_digits(rng, exponent):
    """The third point of a line and the fourth of a circle, rounded: where the plain determinants guess."""
    turns, circles = np.empty((400, 3, 2)), np.empty((400, 4, 2))
    turns[:, :2], t = rng.random((400, 2, 2)) * [[1], [30]], rng.random((400, 1))
    turns[:, 2] = turns[:, 0] + t * (turns[:, 1] - turns[:, 0])
    angle = rng.random((400, 4)) * 2 * np.pi
    circles[:] = 0.3 + 0.1 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    turns, circles = np.ldexp(turns, exponent), np.ldexp(circles, exponent)
    found = PlaneSigns(turns.reshape(-1, 2)).turn(np.arange(1200).reshape(-1, 3))
    assert found.tolist() == [turn_oracle(triple) for triple in turns.tolist()]
    found = PlaneSigns(circles.reshape(-1, 2)).circle(np.arange(1600).reshape(-1, 4))
    assert found.tolist() == [circle_oracle(quadruple) for quadruple in circles.tolist()]


@pytest.mark.parametrize("size", [1e-9, 1e-12, 1e-13, 1e-14, 3e-15])
@pytest.mark.parametrize("is_unit", [True, False])
def test_filter_never_contradicts_the_integers(rng, size, is_unit):
    points = np.array([0.36, 0.48, 0.8]) + size * rng.normal(size=(20000, 3))
    points = sets.unit(points)
    points *= rng.choice([1 - 2 * ULP, 1.0, 1 + 2 * ULP] if is_unit else [0.3, 7.0, 11.0], size=(20000, 1))
    signs, rows = SphereSigns(points), np.arange(20000).reshape(-1, 4)
    value, bound = signs._bubble_filter(rows)
    settled = np.abs(value) > bound
    assert settled.mean() > (0.9 if size > 1e-14 else 0.2)
    assert (np.sign(value[settled]) == signs._bubble_integers(rows[settled])).all()


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15])
@pytest.mark.parametrize("is_unit", [True, False])
def test_bubble_in_clusters(rng, size, is_unit):
    for _ in range(25):
        points = rng.normal(size=3) + size * rng.normal(size=(4, 3))
        points = sets.unit(points)
        if not is_unit:
            points *= np.exp(rng.normal(size=(4, 1)) * 3)
        assert bubble(points) == bubble_oracle(points)


@given(st.lists(st.integers(-1, 1), min_size=12, max_size=12), st.integers(0, 3))
def test_bubble_near_a_face_of_the_cube(noise, lengths):
    face = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]], dtype=float)
    scales = np.array([[1.0], [3.0], [2.0**-1000], [5e300]]) if lengths == 3 else 1.0
    points = (face + np.reshape(noise, (4, 3)) * ULP) * scales
    assert bubble(points) == bubble_oracle(points)


@given(st.lists(SPHERE.places(2), min_size=4, max_size=4))
def test_bubble_of_small_integers(quadruple):
    """Half of these sets hold equal, antipodal or cocircular directions."""
    assert bubble(quadruple) == bubble_oracle(quadruple)


def test_progress_is_the_order_along_the_projection():
    """Projected from the south pole the rays (2x, 2y, 1 − x² − y²) are (x, y): lines x = const have the tangent y."""
    xy = np.array([[0.0, 3], [1, -1], [1, 4], [-2, 2]])
    points = np.vstack([np.column_stack([2 * xy, 1 - (xy**2).sum(axis=1)]), [[0, 0, -1]]])
    steps = SphereSigns(points).progress(np.array([[0, 1], [1, 2], [2, 3]]), 4, np.array([0, 1, 0], dtype=object))
    assert abs(steps[0]) == 1
    assert steps.tolist() == [steps[0], 0, -steps[0]]


def test_facing_is_the_normal_of_a_great_circle_triangle():
    points = np.array([[3.0, 4, 0], [-4, 3, 0], [4, 3, 0], [-3, -4, 0], [-1, 0, 0], [1, 0, 0]])
    rows = np.array([[2, 0, 1], [0, 2, 1], [0, 1, 3], [5, 2, 4], [5, 2, 3]])
    assert SphereSigns(points).facing(rows).tolist() == [[0, 0, 1], [0, 0, -1], [0, 0, 1], [0, 0, 1], [0, 0, 1]]


def test_scaled_vectors_keep_their_direction_exactly():
    points = np.random.default_rng(0).normal(size=(50, 3)) * [1, 1e-5, 1e5]
    high, low = _nearly_unit(points)
    assert np.linalg.norm(high, axis=1) == pytest.approx(1, abs=8 * ULP)
    for p, h, r in zip(points, high, low, strict=True):
        p, v = [Fraction(x) for x in p], [Fraction(x) + Fraction(y) for x, y in zip(h, r, strict=True)]
        assert all(p[k] * v[k - 1] == p[k - 1] * v[k] for k in range(3))


def test_ray_integers_keep_directions_down_to_the_subnormals():
    points = np.array([[5e-324, 0, 1e-323], [1e308, -5e307, 0], [0.75, 0.5, -0.25]])
    assert ray_integers(points)[[0, 2]].tolist() == [[1, 0, 2], [3, 2, -1]]
    x, y, z = ray_integers(points)[1]
    assert Fraction(x, y) == Fraction(1e308) / Fraction(-5e307)
    assert z == 0
