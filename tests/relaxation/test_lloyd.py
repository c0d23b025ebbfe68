"""Lloyd relaxation against exact polygons, known states, and what must never happen."""

from fractions import Fraction
from math import factorial

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, Rotation, SphericalDelaunay, check_delaunay
from stereodel.relaxation import lloyd
from stereodel.relaxation.cell_triangles import MIDPOINTS, RADON, flat_nodes
from tests.exact import fractions, nearer
from tests.examples import examples
from tests.strategies import GRID_DIRECTIONS

SQUARE = (0, 0, 8, 8)
ROUNDING = 1e-12
GRID_POINT = st.tuples(st.integers(0, 8), st.integers(0, 8))


def exact_step(points, polygon):
    """Energy and centroids by cutting the polygon with all bisectors; the first of equal points has the cell."""
    places = fractions(points)
    energy, centroids = Fraction(0), []
    for k, p in enumerate(places):
        cell = [] if p in places[:k] else fractions(polygon)
        for q in set(places) - {p}:
            cell = nearer(cell, p, q)
        area, first = Fraction(0), [Fraction(0), Fraction(0)]
        around = [(x - p[0], y - p[1]) for x, y in cell]
        for (x, y), (u, v) in zip(around, around[1:] + around[:1], strict=True):
            double = x * v - y * u
            area += double / 2
            first = [first[0] + double * (x + u) / 6, first[1] + double * (y + v) / 6]
            energy += double * (x * x + y * y + u * u + v * v + x * u + y * v) / 12
        centroids.append([float(p[i] + (first[i] / area if area else 0)) for i in range(2)])
    return float(energy), centroids


def never_grows(relaxed):
    return (np.diff(relaxed.energies) <= ROUNDING * relaxed.energies[0]).all()


@pytest.mark.parametrize("polygon", [[(0, 0), (8, 0), (8, 8), (0, 8)], [(0, 0), (18, 0), (0, 18)]])
@given(points=st.lists(GRID_POINT, min_size=1, max_size=9))
def test_a_step_is_the_exact_one(polygon, points):
    relaxed = lloyd(points, steps=1, bounds=SQUARE if len(polygon) == 4 else polygon)
    energy, centroids = exact_step(points, polygon)
    assert relaxed.energies[0] == pytest.approx(energy, rel=ROUNDING)
    assert relaxed.points == pytest.approx(np.array(centroids), abs=1e-11)
    assert relaxed.moves[0] == pytest.approx(np.hypot(*(np.array(centroids) - points).T).max(), abs=1e-11)


@pytest.mark.parametrize("factor", [1.0, 1.9])
@pytest.mark.parametrize("bounds", [SQUARE, None], ids=["plane", "sphere"])
@given(data=st.data())
@examples(0.5)
def test_energy_never_grows(bounds, factor, data):
    points = data.draw(st.lists(GRID_DIRECTIONS if bounds is None else GRID_POINT, min_size=1, max_size=12))
    relaxed = lloyd(points, steps=12, bounds=bounds, factor=factor)
    assert never_grows(relaxed)
    if bounds is None:
        assert np.linalg.norm(relaxed.points, axis=1) == pytest.approx(1.0)
    check_delaunay((SphericalDelaunay if bounds is None else PlanarDelaunay)(relaxed.points))


@pytest.mark.parametrize("spread", [1.0, 1e-3, 1e-9, 1e-12])
def test_clusters_spread_over_the_sphere(rng, spread):
    relaxed = lloyd(np.array([0.6, 0.0, 0.8]) + spread * rng.normal(size=(40, 3)), steps=60)
    assert never_grows(relaxed)
    # Forty caps of equal area have this energy; no cells have less.
    height = 2 / 40
    least = 40 * 2 * np.pi * height**2
    assert least < relaxed.energies[-1] < 1.2 * least < relaxed.energies[0]


@pytest.mark.parametrize(
    ("points", "energy"),
    [
        ([[0, 0, 2]], 8 * np.pi),
        ([[0, 0, 1], [0, 0, -1]], 4 * np.pi),
        (np.vstack([np.eye(3), -np.eye(3)]), 8 * np.pi - 2 * 6 * 4 * np.arctan(np.sqrt(0.5)) / np.sqrt(2)),
    ],
)
def test_states_that_stay(points, energy):
    """On the sphere ∫ x over a face of the cube is half the sum of four arcs' lengths times normals."""
    relaxed = lloyd(points, steps=3)
    assert relaxed.points == pytest.approx(np.array(points) / np.linalg.norm(points, axis=1)[:, None])
    assert relaxed.energies == pytest.approx(energy)


def test_any_two_points_become_opposite():
    relaxed = lloyd([[1, 0, 0], [1, 0.1, 0]], steps=4)
    assert relaxed.points[0] == pytest.approx(-relaxed.points[1])
    assert relaxed.energies[-1] == pytest.approx(4 * np.pi)


def test_turning_the_sphere_turns_the_result():
    points = np.random.default_rng(2).normal(size=(30, 3))
    turn = Rotation.about([1, 2, 3], 77.0)
    one, other = lloyd(points, steps=5), lloyd(turn(points), steps=5)
    assert other.points == pytest.approx(turn(one.points), abs=1e-11)
    assert other.energies == pytest.approx(one.energies)


def test_density_in_the_plane():
    """One cell of weight x: the mean of x is 2/3."""
    relaxed = lloyd([[0.1, 0.9]], steps=2, density=lambda xy: xy[:, 0], bounds=(0, 0, 1, 1))
    assert relaxed.points == pytest.approx(np.array([[2 / 3, 1 / 2]]))
    assert relaxed.energies[-1] == pytest.approx((1 / 4 - 2 / 9) + 1 / 24)


def test_density_on_the_sphere():
    relaxed = lloyd([[1, 2, 0]], steps=2, density=lambda xyz: 1 + xyz[:, 2])
    assert relaxed.points == pytest.approx(np.array([[0, 0, 1]]), abs=1e-6)
    # ∫ (1 + z) 2 (1 − z) = 8π − 2 · 4π/3
    assert relaxed.energies[-1] == pytest.approx(8 * np.pi - 8 * np.pi / 3, rel=1e-6)


@pytest.mark.parametrize("bounds", [None, (0, 0, 1, 1)])
def test_constant_density_is_that_of_none(rng, bounds):
    """Of any size, from the smallest of doubles to the largest."""
    points = rng.random((60, 2)) if bounds else rng.normal(size=(60, 3))
    one = lloyd(points, steps=4, bounds=bounds)
    for size in (5e-324, 1e-320, 1e-165, 3.0, 1e155, 1e308):
        other = lloyd(points, steps=4, bounds=bounds, density=lambda places, size=size: np.full(len(places), size))
        assert other.points == pytest.approx(one.points, abs=1e-6), size
        assert other.energies == pytest.approx(size * one.energies, rel=1e-6, abs=1e-321), size


@pytest.mark.parametrize("bounds", [None, (-2, -2, 2, 2)])
def test_densities_of_different_size_move_every_point(rng, bounds):
    """Each cell has the centroid of its own density, however small that is beside the others'."""
    points = rng.normal(size=(40, 3)) / 3 if bounds is None else rng.random((40, 2))
    densities = [lambda x, a=a: a * 10 ** (300 * x[:, 0].clip(-1, 1)) for a in (1, 1e5)]
    steep = [lloyd(points, steps=1, bounds=bounds, density=density) for density in densities]
    assert steep[0].points == pytest.approx(steep[1].points, abs=1e-9)
    assert np.isfinite(steep[0].points).all()


def test_cells_without_weight_stay():
    points = [[0.25, 0.5], [0.75, 0.5]]
    relaxed = lloyd(points, steps=3, density=lambda xy: np.where(xy[:, 0] < 0.25, 1.0, 0.0), bounds=(0, 0, 1, 1))
    assert relaxed.points[1].tolist() == points[1]
    nothing = lloyd([[0, 0, 1], [1, 0, 0]], steps=1, density=lambda xyz: 0 * xyz[:, 0])
    assert nothing.moves.tolist() == [0]


@pytest.mark.parametrize("width", [2, 3])
def test_no_points_and_no_steps(width):
    bounds = SQUARE if width == 2 else None
    none = lloyd(np.zeros((0, width)), steps=2, bounds=bounds)
    assert none.points.shape == (0, width)
    assert none.energies.tolist() == [0, 0]  # the first step moves nothing
    points = np.full((1, width), 2.0)
    still = lloyd(points, steps=0, bounds=bounds)
    assert still.points == pytest.approx(points if width == 2 else points / np.sqrt(12))
    assert (len(still.energies), len(still.moves), still.converged) == (1, 0, False)


def test_stops_when_nothing_moves_far():
    points = np.random.default_rng(7).random((5, 2))
    relaxed = lloyd(points, steps=1000, bounds=(0, 0, 1, 1), tolerance=1e-5)
    assert relaxed.converged
    assert len(relaxed.moves) < 1000
    assert relaxed.moves[-1] <= 1e-5 < relaxed.moves[-2]
    assert len(relaxed.energies) == len(relaxed.moves) + 1


def test_takes_triangulations_and_changes_nothing():
    points = np.random.default_rng(8).random((9, 2))
    before = points.copy()
    relaxed = lloyd(PlanarDelaunay(points), bounds=(0, 0, 1, 1))
    assert np.array_equal(relaxed.points, lloyd(points, bounds=(0, 0, 1, 1)).points)
    assert np.array_equal(points, before)
    assert not any(array.flags.writeable for array in (relaxed.points, relaxed.energies, relaxed.moves))


@pytest.mark.parametrize("factor", [0.5, 1.5, 1.9])
@given(points=st.lists(GRID_DIRECTIONS, min_size=2, max_size=12))
@example(points=[(-1, 0, 1), (-1, 0, 1), (-1, 0, 1), (2, 2, 1)])  # four close to a great circle: ridges of 1e-17
def test_a_factor_takes_that_part_of_the_way_on_the_sphere(factor, points):
    """The same great circle."""
    full, part = lloyd(points, steps=1), lloyd(points, steps=1, factor=factor)
    assert part.moves[0] == pytest.approx(factor * full.moves[0], abs=1e-6)
    start = np.array(points) / np.linalg.norm(points, axis=1, keepdims=True)
    assert np.allclose(np.einsum("ni,ni->n", np.cross(start, full.points), part.points), 0, rtol=0, atol=1e-12)
    assert np.allclose(np.linalg.norm(part.points, axis=1), 1, rtol=0, atol=1e-15)


@pytest.mark.parametrize("factor", [0.5, 1.5, 1.9])
@given(points=st.lists(GRID_POINT, min_size=1, max_size=9))
@examples(0.5)
def test_a_factor_takes_that_part_of_the_way_in_the_plane_and_stays_within_the_bounds(factor, points):
    full, part = lloyd(points, steps=1, bounds=SQUARE), lloyd(points, steps=1, bounds=SQUARE, factor=factor)
    wanted = np.array(points) + factor * (full.points - points)
    outside = ((wanted < 0) | (wanted > 8)).any(axis=1)
    assert np.allclose(part.points, np.where(outside[:, None], full.points, wanted), rtol=0, atol=1e-12)


def test_a_callback_hears_of_each_step():
    heard, points = [], np.random.default_rng(1).random((20, 2))
    relaxed = lloyd(points, steps=7, bounds=(0, 0, 1, 1), callback=heard.append)
    assert [progress.step for progress in heard] == list(range(1, 8))
    assert [progress.energy for progress in heard] == relaxed.energies[1:].tolist()
    assert [progress.move for progress in heard] == relaxed.moves.tolist()

    def stop(progress):
        if progress.step == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        lloyd(points, bounds=(0, 0, 1, 1), callback=stop)


def test_quality_of_a_dodecahedron():
    """Twelve cells with five sides and equal areas."""
    golden = (1 + 5**0.5) / 2
    corners = [np.roll([0, a, b * golden], k) for a in (-1, 1) for b in (-1, 1) for k in range(3)]
    relaxed = lloyd(corners, steps=1, tolerance=1e-9)
    quality = relaxed.quality()
    assert quality.neighbors == {5: 12}
    assert quality.defects == 12
    assert quality.area_ratio == pytest.approx(1, abs=1e-12)
    assert relaxed.converged


def test_quality_within_bounds():
    """Two cells, three and five squares large; and those of a grid."""
    relaxed = lloyd([[0.5, 1], [2.5, 1]], steps=0, bounds=(0, 0, 4, 2))
    assert relaxed.bounds.tolist() == [[0, 0], [4, 0], [4, 2], [0, 2]]
    assert relaxed.quality().area_ratio == pytest.approx(5 / 3, abs=1e-12)
    grid = np.stack(np.meshgrid(np.arange(5.0), np.arange(5.0)), axis=-1).reshape(-1, 2) + 0.5
    quality = lloyd(grid, steps=0, bounds=(0, 0, 5, 5)).quality()
    assert quality.area_ratio == pytest.approx(1, abs=1e-12)
    assert sum(quality.neighbors.values()) == 9
    assert quality.defects == 9 - quality.neighbors.get(6, 0)


def test_quality_without_cells_and_with_equal_points():
    assert lloyd(np.zeros((0, 3)), steps=1).quality().area_ratio == 1
    assert lloyd([[1, 0, 0], [1, 0, 0]], steps=0).quality().area_ratio == 1


@pytest.mark.parametrize(("rule", "degree"), [(MIDPOINTS, 2), (RADON, 5)])
def test_degree_of_rules(rule, degree):
    """∫ xⁱyʲ over the triangle (0, 0), (1, 0), (0, 1) is i! j!/(i + j + 2)!."""

    def error(i, j):
        nodes, weights = flat_nodes(np.array([[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]), rule)
        exact = factorial(i) * factorial(j) / factorial(i + j + 2)
        return (weights * nodes[..., 0] ** i * nodes[..., 1] ** j).sum() / exact - 1

    assert max(abs(error(i, k - i)) for k in range(degree + 1) for i in range(k + 1)) < 1e-14
    assert max(abs(error(i, degree + 1 - i)) for i in range(degree + 2)) > 1e-4
