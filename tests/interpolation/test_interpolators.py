"""Nearest, linear and smooth interpolation: what they reproduce, where they are continuous, awkward input."""

import copy
import pickle

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, Rotation
from stereodel.interpolation import LinearInterpolator, NearestInterpolator, SmoothInterpolator, estimate_gradients
from tests import exact, sets
from tests.exact import cross, dot, mp
from tests.interpolation.known import KINDS, known, slopes
from tests.sets import unit
from tests.strategies import GRID_DIRECTIONS

INNER_METHODS = [KINDS[name] for name in ("linear", "smooth", "natural")]  # defined within the hull
METHODS = [NearestInterpolator, *INNER_METHODS]


def rms(x):
    return np.sqrt(np.mean(np.square(x)))


@pytest.mark.parametrize("method", METHODS)
def test_values_at_the_points_are_met_to_the_last_bit(method, make_points, rng):
    points = make_points(rng, 300)
    values = known(points)
    assert np.array_equal(method(points, values)(points), values)


@pytest.mark.parametrize("method", METHODS)
def test_constants_are_reproduced_exactly(method, make_points, rng):
    points = make_points(rng, 100)
    function = method(points, np.full(100, 0.1))
    inside = make_points(rng, 200)
    assert set(function(inside)[function.triangulation.find_simplex(inside) >= 0]) == {0.1}
    assert np.nanmax(np.abs(function.gradient(inside))) < 1e-12


@pytest.mark.parametrize("method", METHODS)
def test_shapes_follow_queries_and_values(method, make_points, rng):
    points = make_points(rng, 30)
    values = rng.random((30, 2, 4))
    function = method(points, values)
    queries = make_points(rng, 15).reshape(3, 5, -1)
    assert function(queries).shape == (3, 5, 2, 4)
    assert function.gradient(queries).shape == (3, 5, 2, 4, points.shape[1])
    assert function(queries[0, 0]).shape == (2, 4)
    single = method(points, values[:, 1, 2])
    assert np.allclose(single(queries), function(queries)[..., 1, 2], rtol=0, atol=1e-12, equal_nan=True)
    slopes = function.gradient(queries)[..., 1, 2, :]
    assert np.allclose(single.gradient(queries), slopes, rtol=0, atol=1e-10, equal_nan=True)
    assert single(queries[0, 0]).shape == ()


def test_linear_functions_of_the_plane(rng):
    points = rng.random((500, 2))
    queries = 0.2 + 0.6 * rng.random((200, 2))
    for method in INNER_METHODS:
        function = method(points, points @ [2.0, -3.0])
        assert np.allclose(function(queries), queries @ [2.0, -3.0], rtol=0, atol=1e-14)
        assert np.allclose(function.gradient(queries), [2.0, -3.0], rtol=0, atol=1e-10)


def test_gradients_of_degree_one_harmonics_are_exact(rng):
    points = unit(rng.normal(size=(300, 3)))
    axis = np.array([1.0, -2.0, 0.5])
    values = points @ axis
    assert np.allclose(estimate_gradients(points, values), axis - points * values[:, None], rtol=0, atol=1e-10)


@pytest.mark.parametrize("method", INNER_METHODS)
def test_gradient_agrees_with_differences(method, make_points, rng):
    step = 1e-6
    points = make_points(rng, 400)
    function = method(points, np.stack([known(points), rng.random(400)], axis=1))
    queries = make_points(rng, 300)
    queries = 0.2 + 0.6 * queries if points.shape[1] == 2 else unit(queries)
    located = function.triangulation.find_simplex
    around = [located(queries + s * step * e) for e in np.eye(queries.shape[1]) for s in (-1, 1)]
    inner = np.all(np.array(around) == located(queries), axis=0)  # a difference across an edge tells of two triangles
    expected = slopes(function, queries[inner], step)
    assert np.count_nonzero(inner) > 250
    assert np.allclose(function.gradient(queries[inner]), expected, rtol=1e-6, atol=1e-6)
    if points.shape[1] == 3:
        products = np.einsum("qki,qi->qk", function.gradient(queries), queries)
        assert np.abs(products).max() < 1e-11


def edge_points(triangulation, rng):
    """Points on edges, and unit vectors across these edges, at some distance from the hull."""
    simplices, neighbors = triangulation.simplices, triangulation.neighbors
    rows = np.flatnonzero(neighbors[:, 0] >= 0)[:200]
    a, b = (triangulation.points[simplices[rows, k]] for k in (1, 2))
    t = rng.uniform(0.05, 0.95, size=(len(rows), 1))
    on = a + t * (b - a)
    across = unit(triangulation.points[simplices[rows, 0]] - on)
    return on, across


def test_smooth_is_once_differentiable_across_edges(make_points, rng):
    """Random values and gradients: value and gradient jump by no more than the distance of the two sides explains."""
    points = make_points(rng, 300)
    points = unit(points) if points.shape[1] == 3 else points
    function = SmoothInterpolator(points, rng.random(300), gradients=rng.normal(size=points.shape))
    on, across = edge_points(function.triangulation, rng)
    values, gradients = [], []
    for distance in (1e-5, 1e-7, 1e-9):
        sides = [on + s * distance * across for s in (-1, 1)]
        size = np.abs(function.gradient(sides[0])).max(axis=1)
        values.append(np.max(np.abs(function(sides[1]) - function(sides[0])) / size))
        jump = np.abs(function.gradient(sides[1]) - function.gradient(sides[0])).max(axis=1)
        gradients.append(np.median(jump / size))
    assert values[0] < 1e-4
    assert values[2] < 1e-8
    assert gradients[0] < 1e-2
    assert gradients[2] < 1e-6


@pytest.mark.parametrize("distance", [1e-4, 1e-8, 1e-12, 1e-30])
def test_smooth_has_the_given_gradients_at_the_points(distance, make_points, rng):
    points = make_points(rng, 100)
    points = unit(points) if points.shape[1] == 3 else points - points.mean(axis=0)
    points[0] = [0.0, 0.0, 1.0][-points.shape[1] :] if points.shape[1] == 3 else [0.0, 0.0]
    given = rng.normal(size=points.shape)
    function = SmoothInterpolator(points, rng.random(100), gradients=given)
    directions = np.zeros((50, points.shape[1]))
    directions[:, :2] = unit(rng.normal(size=(50, 2)))
    near = function.gradient(points[0] + distance * directions)
    assert np.allclose(near, function.gradients[0], rtol=0, atol=1e4 * distance + 1e-9)
    assert np.allclose(function.gradient(points[0]), function.gradients[0], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("method", "order", "of_gradient"),
    [(LinearInterpolator, 2, 1), (SmoothInterpolator, 3, 2), (KINDS["natural"], 2, 1)],
)
def test_order_of_convergence(method, order, of_gradient, make_points):
    """Errors over points of four times the density: half the distance, so a factor of 2 to the order."""
    errors, gradient_errors = [], []
    for n in (2000, 8000):
        rng = np.random.default_rng(n)
        points = make_points(rng, n)
        queries = make_points(rng, 2000)
        queries = unit(queries) if points.shape[1] == 3 else 0.1 + 0.8 * queries
        function = method(points, known(points))
        errors.append(rms(function(queries) - known(queries)))
        gradient_errors.append(rms(function.gradient(queries) - slopes(known, queries, 1e-5)))
    assert np.log2(errors[0] / errors[1]) > order - 0.5
    assert np.log2(gradient_errors[0] / gradient_errors[1]) > of_gradient - 0.4


@pytest.mark.parametrize("method", METHODS)
def test_rotation_carries_values_and_gradients_along(method, rng):
    points, values, queries = rng.normal(size=(100, 3)), rng.random(100), rng.normal(size=(50, 3))
    turn = Rotation.about([1.0, 2.0, -1.0], 77.0)
    before, after = method(points, values), method(turn(points), values)
    assert np.allclose(after(turn(queries)), before(queries), rtol=0, atol=1e-11)
    turned = turn(np.eye(3)).T @ before.gradient(queries)[..., None]
    assert np.allclose(after.gradient(turn(queries)), turned[..., 0], rtol=0, atol=1e-8)


@pytest.mark.parametrize("method", METHODS)
def test_lengths_of_directions_do_not_matter(method, rng):
    points, values, queries = rng.normal(size=(60, 3)), rng.random(60), rng.normal(size=(40, 3))
    function = method(points, values)
    stretched = method(points * rng.uniform(1e-3, 1e3, size=(60, 1)), values)
    assert np.allclose(stretched(queries * 1e100), function(queries), rtol=0, atol=1e-12)
    assert np.allclose(stretched.gradient(queries * 1e-100), function.gradient(queries), rtol=0, atol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_equal_points_have_the_mean_of_their_values(method, make_points, rng):
    points, values, queries = make_points(rng, 60), rng.random(60), make_points(rng, 40)
    twice = np.concatenate([points, points[:5], points[:5]])
    apart = np.concatenate([values, values[:5] + 3.0, values[:5] - 6.0])
    merged = method(twice, apart)
    meant = values.copy()
    meant[:5] -= 1.0
    assert np.allclose(merged(queries), method(points, meant)(queries), rtol=0, atol=1e-12, equal_nan=True)
    assert np.allclose(merged.values[60:65], meant[:5])
    same = method(twice, np.concatenate([values, values[:5], values[:5]]))
    assert np.array_equal(same(queries), method(points, values)(queries), equal_nan=True)
    gradients = estimate_gradients(twice, apart)
    assert np.array_equal(gradients[:5], gradients[60:65])


@pytest.mark.parametrize("method", [LinearInterpolator, SmoothInterpolator])
def test_a_value_that_is_not_known_stays_in_its_triangles(method, make_points, rng):
    points, values, queries = make_points(rng, 80), rng.random((80, 2)), make_points(rng, 400)
    holes = values.copy()
    holes[7, 0] = np.nan
    function = method(points, holes)
    triangles = function.triangulation.find_simplex(queries)
    touched = (function.triangulation.simplices[triangles] == 7).any(axis=1) | (triangles < 0)
    assert np.array_equal(np.isnan(function(queries)[:, 0]), touched)
    assert np.array_equal(np.isnan(function.gradient(queries)[:, 0, 0]), touched)
    complete = method(points, values)(queries)[:, 1]
    assert np.allclose(function(queries)[:, 1], complete, rtol=0, atol=1e-13, equal_nan=True)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("one", sets.of("flat", "few"))
def test_points_without_triangles(method, one):
    """The nearest point is known, and what is at points, and nothing between them."""
    points = one.points
    values = np.arange(float(len(points)))
    function, somewhere = method(points, values), [[1.0, 2.5, 3.25][: points.shape[1]]]
    assert np.isnan(estimate_gradients(points, values)).all()
    assert np.array_equal(function(points), function.values)
    if points.shape[1] == 3:
        assert np.array_equal(function(3.0 * points), function.values)
    if hasattr(function, "weights"):
        assert np.allclose(function.weights(points) @ values, function.values, rtol=0, atol=1e-14)
    if method is NearestInterpolator:
        assert np.isnan(function(somewhere)).all() == (len(points) == 0)
    else:
        assert np.isnan(function(somewhere)).all()
        assert np.isnan(function.gradient(somewhere)).all()
        assert np.array_equal(method(points, values, extrapolate="nearest")(points), function.values)


@pytest.mark.parametrize("method", INNER_METHODS)
@pytest.mark.parametrize("one", sets.named("sphere", "half", "three"))
def test_a_hemisphere_is_not_left(method, one, rng):
    points = one.points
    function = method(points, known(points))
    nearest = method(points, known(points), extrapolate="nearest")
    queries = rng.normal(size=(300, 3))
    outside = function.triangulation.find_simplex(queries) < 0
    assert 0 < np.count_nonzero(outside) < 300
    assert np.array_equal(np.isnan(function(queries)), outside)
    assert np.array_equal(nearest(queries)[~outside], function(queries)[~outside])
    assert np.array_equal(nearest(queries)[outside], NearestInterpolator(points, known(points))(queries)[outside])
    assert not nearest.gradient(queries[outside]).any()


@pytest.mark.parametrize("method", INNER_METHODS)
@pytest.mark.parametrize("spread", [1e-3, 1e-8, 1e-12])
def test_clusters_are_as_accurate_as_the_whole(method, spread, rng):
    """Values linear in the tangent plane of a cluster: doubles off the sphere by 1e-16, known by their directions."""
    frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points = frame[0] + spread * rng.uniform(-1, 1, size=(100, 2)) @ frame[1:]

    def linear(x):  # differences from the centre are exact
        return ((x - frame[0]) / spread) @ frame[1:].T @ [1.0, 2.0]

    function = method(points, linear(points))
    weights = rng.dirichlet([3, 3, 3], size=50)
    corners = function.triangulation.simplices[rng.integers(0, 90, size=50)]
    queries = np.einsum("qi,qij->qj", weights, points[corners])
    inside = function.triangulation.find_simplex(queries) >= 0
    assert np.allclose(function(queries)[inside], linear(queries)[inside], rtol=0, atol=10 * spread + 1e-11)
    slopes = function.gradient(queries[inside]) * spread @ frame[1:].T
    assert np.count_nonzero(inside) > 20
    assert np.allclose(slopes, [1.0, 2.0], rtol=0, atol=10 * spread + 1e-9)


def exact_weights(corners, query):
    """Barycentric coordinates of the ray or point in the plane triangle of unit vectors or points."""
    *corners, query = (exact.unit(p) if len(p) == 3 else [*mp(p), mpmath.mpf(1)] for p in (*corners, query))
    areas = [dot(query, cross(corners[k - 2], corners[k - 1])) for k in range(3)]
    return [float(area / sum(areas)) for area in areas]


@pytest.mark.parametrize("aspect", [1e-3, 1e-9, 1e-14])
def test_weights_in_thin_triangles(aspect, make_points, rng):
    """Corners near an oblique line or great circle, where areas cancel: as accurate as in any triangle."""
    held = 0
    for _ in range(40):
        ends = make_points(rng, 2)
        across = make_points(rng, 1)[0] - ends[0]
        corners = np.array([ends[0], ends[1], ends.mean(axis=0) + aspect * across])
        function = LinearInterpolator(corners, np.eye(3))
        query = rng.dirichlet([3, 3, 3]) @ corners
        if np.all(np.asarray(function.triangulation.find_simplex(query)) >= 0):
            held += 1
            assert np.allclose(function(query), exact_weights(corners, query), rtol=0, atol=1e-10)
    assert held > 10


@given(st.lists(GRID_DIRECTIONS, min_size=1, max_size=12), st.lists(GRID_DIRECTIONS, min_size=1, max_size=6))
def test_all_methods_take_any_directions(points, queries):
    values = np.arange(float(len(points)))
    for method in METHODS:
        function = method(points, values)
        result, slopes = function(queries), function.gradient(queries)
        held = np.asarray(function.triangulation.find_simplex(queries)) >= 0
        if method is NearestInterpolator:
            assert np.isfinite(result).all()
        else:
            on_line = np.cross(np.array(queries)[:, None], points).any(axis=2) == 0
            at_point = (on_line & (np.array(queries) @ np.transpose(points) > 0)).any(axis=1)
            assert np.array_equal(np.isfinite(result), held | at_point)
            assert np.isfinite(slopes[held & ~on_line.any(axis=1)]).all()


def test_later_changes_of_the_triangulation_do_not_matter(rng):
    points, values = rng.random((50, 2)), rng.random(50)
    triangulation = PlanarDelaunay(points)
    function = LinearInterpolator(triangulation, values)
    before = function([0.5, 0.5])
    triangulation.insert([[0.5, 0.5]])
    values[:] = 0.0
    assert function([0.5, 0.5]) == before
    for other in (copy.deepcopy(function), pickle.loads(pickle.dumps(function))):
        assert other([0.5, 0.5]) == before
    with pytest.raises(ValueError, match="read-only"):
        function.values[0] = 1.0


def test_neighbours_of_other_points_do_not_change_a_gradient(rng):
    """Points are fitted together, each with room for as many neighbours as the one with most, here a hub of 1500."""
    angle = np.linspace(0, 2 * np.pi, 1500, endpoint=False)
    wheel = [9.0, 0.0] + np.vstack([np.column_stack([np.cos(angle), np.sin(angle)]), [[0, 0]]])
    points, values = rng.random((1200, 2)), rng.random(1200)
    values[::40] = np.nan
    both = estimate_gradients(np.vstack([points, wheel]), np.append(values, wheel @ [2.0, -3.0]))
    inner = (np.abs(points - 0.5) < 0.3).all(axis=1)
    assert np.isfinite(both[:1200][inner & ~np.isnan(values)]).all()
    assert np.array_equal(both[:1200][inner], estimate_gradients(points, values)[inner], equal_nan=True)
    assert np.abs(both[-1] - [2.0, -3.0]).max() < 1e-7
