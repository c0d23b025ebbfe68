"""Weights as a sparse matrix, and those of natural neighbours against areas, exact and of diagrams."""

from fractions import Fraction

import numpy as np
import pytest
import scipy.sparse
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, SphericalDelaunay, SphericalVoronoi
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator, NearestInterpolator, Weights
from tests.exact import area, fractions, nearer

FUNCTIONS = [(kind, {}) for kind in (LinearInterpolator, NearestInterpolator, NaturalNeighborInterpolator)]
FUNCTIONS += [(kind, {"extrapolate": "nearest"}) for kind in (LinearInterpolator, NaturalNeighborInterpolator)]
every_function = pytest.mark.parametrize(("function", "options"), FUNCTIONS)


def scene(dimension, rng, n=200):
    """Points, on the sphere mostly of one side so that some queries are outside, values with a NaN, and queries."""
    points = rng.normal(size=(n, dimension)) + ([0, 0] if dimension == 2 else [0, 0, 2])
    values = rng.normal(size=(n, 2, 3))
    values[40, 0] = np.nan
    # Points, middles of edges, and places all over.
    edges = (PlanarDelaunay if dimension == 2 else SphericalDelaunay)(points).edges[:60]
    queries = np.concatenate([rng.normal(size=(880, dimension)), points[:60], points[edges].mean(axis=1)])
    return points, values, queries.reshape(10, 100, dimension)


@every_function
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("equal", [False, True])
def test_products_are_the_values_of_the_interpolator(function, options, dimension, equal, rng):
    """To the last bit, with NaN where it has them; equal points share the weight of their place."""
    points, values, queries = scene(dimension, rng)
    if equal:
        points[50:61] = points[[*range(10), 0]]
    interpolator = function(points, values, **options)
    weights = interpolator.weights(queries)
    expected = interpolator(queries)
    assert np.allclose(weights @ values, expected, rtol=0, atol=1e-14 if equal else 0, equal_nan=True)
    assert 0 < np.isnan(expected).mean() < 0.9
    assert weights.shape == (10, 100)
    assert (weights.data >= 0).all()
    sums = np.bincount(weights.rows, weights.data, 1000)
    assert np.allclose(sums[np.diff(weights.indptr) > 0], 1, rtol=0, atol=1e-15)
    if equal:
        of_one_place = [weights.to_scipy()[:, [k]].toarray() for k in (0, 50, 60)]
        assert of_one_place[0].max() > 0
        assert all(np.array_equal(column, of_one_place[0]) for column in of_one_place)


@pytest.mark.parametrize("axis", [0, 1, 2, -1, -3])
def test_the_axis_of_the_points_may_be_any(axis, rng):
    points, _, queries = scene(2, rng)
    weights = NaturalNeighborInterpolator(points, np.zeros(200), extrapolate="nearest").weights(queries)
    values = rng.normal(size=(200, 4, 5))
    moved = np.moveaxis(values, 0, axis)
    found = weights.apply(moved, axis=axis)
    first = axis % 3
    assert found.shape == moved.shape[:first] + (10, 100) + moved.shape[first + 1 :]
    assert np.array_equal(np.moveaxis(found, (first, first + 1), (0, 1)), weights @ values)


def test_a_file_of_something_else_is_refused(tmp_path, rng):
    points, _, queries = scene(2, rng)
    weights = NaturalNeighborInterpolator(points, np.zeros(200)).weights(queries)
    weights.save(tmp_path / "a.npz")
    parts = dict(np.load(tmp_path / "a.npz"))
    for wrong in (
        {"src_grid_dims": [3]},
        {"col": parts["col"][1:]},
        {"dst_grid_dims": [7]},
        {"row": parts["row"][1:]},
        {},
    ):
        np.savez(tmp_path / "a.npz", **(parts | wrong if wrong else {"a": 1}))
        said = "do not fit together" if wrong else r"a\.npz is not a file of weights, it lacks row, col, S"
        with pytest.raises(ValueError, match=said):
            Weights.load(tmp_path / "a.npz")
    for name in ("weights", "weights.zip"):
        for door in (weights.save, Weights.load):
            with pytest.raises(ValueError, match=r"ending of path is '.*', but must be one of '\.npz', '\.nc'"):
                door(tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]


@every_function
@pytest.mark.parametrize("kind", [".npz", ".nc"])
def test_a_file_of_any_kind_gives_back_every_bit(function, options, kind, tmp_path, rng):
    points, values, queries = scene(3, rng)
    for asked in (queries, queries[0, 0], queries[:0]):
        weights = function(points, values, **options).weights(asked)
        weights.save(tmp_path / f"weights{kind}")
        again = Weights.load(tmp_path / f"weights{kind}")
        for name in ("indptr", "columns", "data"):
            assert np.array_equal(getattr(again, name), getattr(weights, name))
        assert (again.shape, again.size, repr(again)) == (weights.shape, weights.size, repr(weights))
        assert np.array_equal(again @ values, weights @ values, equal_nan=True)


def read_weights(path, n_in, n_out):
    """The matrix of a file of weights, as xESMF reads it: row and col count from one."""
    with xr.open_dataset(path) as dataset:
        entries = dataset["S"].values, (dataset["row"].values - 1, dataset["col"].values - 1)
    return scipy.sparse.coo_matrix(entries, shape=(n_out, n_in))


@every_function
def test_matrices_of_scipy_and_of_files(function, options, tmp_path, rng):
    """To the bit the same; products are the interpolated values up to the rounding of the sum."""
    points, values, queries = scene(3, rng)
    weights = function(points, np.zeros(200), **options).weights(queries)
    weights.save(tmp_path / "weights.nc")
    matrix, held = weights.to_scipy(), np.diff(weights.indptr) > 0
    assert np.array_equal(read_weights(tmp_path / "weights.nc", 200, 1000).toarray(), matrix.toarray())
    rows, columns = matrix.nonzero()
    assert set(zip(rows, columns, strict=True)) <= set(zip(weights.rows, weights.columns, strict=True))
    field = values[:, 1, 1]
    assert np.allclose((matrix @ field)[held], (weights @ field).ravel()[held], rtol=0, atol=1e-14)
    assert not (matrix @ field)[~held].any()
    matrix.data[:] = 0
    assert weights.data.max() > 0


@every_function
def test_files_are_those_of_xesmf(function, options, tmp_path, rng):
    """On a lattice, where weights and values have few digits, the product is the interpolated value to the bit."""
    lattice = np.stack(np.meshgrid(np.arange(8.0), np.arange(8.0)), axis=-1).reshape(-1, 2)
    linear = function is not NaturalNeighborInterpolator
    queries = rng.integers(-4, 68, size=(30, 20, 2)) / (8 if linear else 1)
    interpolator = function(lattice, rng.integers(0, 99, size=64), **options)
    interpolator.weights(queries).save(tmp_path / "weights.nc")
    matrix, expected = read_weights(tmp_path / "weights.nc", 64, 600), interpolator(queries).ravel()
    with xr.open_dataset(tmp_path / "weights.nc") as dataset:
        held = dataset["frac_b"].values == 1
        assert (dataset.sizes["n_a"], dataset["dst_grid_dims"].values.tolist()) == (64, [20, 30])
    assert np.array_equal((matrix @ interpolator.values)[held].ravel(), expected[held])
    assert np.array_equal(held, np.isfinite(expected))
    assert held.any()


def test_entries_of_others_come_in_any_order(rng):
    """As ESMF writes them; what does not interpolate, or lacks something, is refused."""
    points, _, queries = scene(3, rng)
    dataset = LinearInterpolator(points, np.zeros(200)).weights(queries).to_xarray()
    shuffled = dataset.isel(n_s=rng.permutation(dataset.sizes["n_s"])).drop_vars(["frac_a", "frac_b"])
    again = Weights.from_xarray(shuffled)
    values = rng.normal(size=200)
    assert np.allclose(again @ values, Weights.from_xarray(dataset) @ values, rtol=0, atol=1e-15, equal_nan=True)
    with pytest.raises(ValueError, match="the dataset is not a file of weights, it lacks src_grid_dims, dst_grid_dims"):
        Weights.from_xarray(dataset[["row", "col", "S"]])
    for name, by in (("row", -1), ("row", 1), ("col", -1), ("col", 199)):
        with pytest.raises(ValueError, match="do not fit together"):
            Weights.from_xarray(dataset.assign({name: dataset[name] + by}))
    row = int(dataset.row[0])
    with pytest.raises(ValueError, match=rf"row {row} sum to 0\.5, not to one as for interpolation; scipy\.sparse"):
        Weights.from_xarray(dataset.assign(S=dataset.S / 2))


def test_masked_values_are_not_known(rng):
    points, _, queries = scene(2, rng)
    values = np.ma.masked_less(rng.integers(-3, 9, size=200), 0)
    known = values.astype(float).filled(np.nan)
    linear = LinearInterpolator(points, values)
    assert np.array_equal(linear.values, known, equal_nan=True)
    weights = linear.weights(queries)
    assert np.array_equal(weights @ values, weights @ known, equal_nan=True)
    assert np.isfinite(weights @ values).any()


def test_one_place_and_none(rng):
    points, values, _ = scene(2, rng)
    linear = LinearInterpolator(points, values)
    assert np.array_equal(linear.weights([0.1, 0.2]) @ values, linear([0.1, 0.2]))
    assert linear.weights(np.zeros((0, 2))).apply(values).shape == (0, 2, 3)
    assert linear.weights([0, 0]).apply(np.zeros((24, 200)), axis=1).shape == (24,)
    assert np.isnan(NearestInterpolator(np.zeros((0, 2)), []).weights([[1, 2], [3, 4]]) @ []).all()


INNER_POINT = st.tuples(st.integers(-15, 15), st.integers(-15, 15)).map(lambda p: (p[0] / 8, p[1] / 8))
CORNERS = [(-4, -5), (5, -4), (4, 5), (-5, 4)]


def sibson(points, query):
    """Weights in rational arithmetic; the query must lie within the hull, and be none of the points."""
    exact, (at,) = fractions(points), fractions([query])
    far = Fraction(10) ** 9
    cell = [(-far, -far), (far, -far), (far, far), (-far, far)]
    for p in exact:
        cell = nearer(cell, at, p)
    areas = []
    for p in exact:
        part = cell
        for other in exact:
            part = nearer(part, p, other) if other != p else part
        areas.append(area(part))
    return [a / sum(areas) for a in areas]


@given(st.lists(st.tuples(st.integers(-4, 4), st.integers(-4, 4)), max_size=7, unique=True), INNER_POINT)
def test_weights_are_those_of_exact_areas(points, query):
    """Whole points, many on common circles, within four that keep the query's cell small."""
    points = CORNERS + [p for p in points if max(map(abs, p)) < 4 and p != query]
    found = NaturalNeighborInterpolator(points, np.eye(len(points)))(query)
    assert np.allclose(found, np.array([float(w) for w in sibson(points, query)]), rtol=0, atol=1e-13)


@pytest.mark.parametrize("shift", [0.0, 3.0])
@pytest.mark.parametrize("n", [4, 5, 12, 60])
def test_weights_on_the_sphere_are_the_change_of_the_diagram(n, shift, rng):
    """Areas of Voronoi cells before and after the query became a point; with a shift, of points of a hemisphere."""
    points = rng.normal(size=(n, 3)) + [0.0, 0.0, shift]
    function = NaturalNeighborInterpolator(points, np.eye(n))
    before = SphericalVoronoi(points).areas()
    asked = 0
    for query in rng.normal(size=(200, 3)) + [0.0, 0.0, shift]:
        if function.triangulation.find_simplex(query) >= 0 and asked < 20:
            asked += 1
            after = SphericalVoronoi(np.vstack([points, query])).areas()
            assert np.allclose(function(query), (before - after[:-1]) / after[-1], rtol=0, atol=1e-11)
    assert asked > 3


def test_linear_functions_of_the_plane_far_from_the_origin(rng):
    points = 1e3 + rng.random((200, 2))
    queries = 1e3 + 0.2 + 0.6 * rng.random((100, 2))
    function = NaturalNeighborInterpolator(points, points - 1e3)
    assert np.allclose(function(queries), queries - 1e3, rtol=0, atol=1e-12)
    assert np.allclose(function.gradient(queries), np.eye(2), rtol=0, atol=1e-9)


def test_linear_on_the_hull_of_the_plane():
    function = NaturalNeighborInterpolator([[0, 0], [4, 0], [4, 4], [0, 4], [2, 1]], [0.0, 1.0, 7.0, 3.0, 5.0])
    assert function([[3, 0], [4, 1], [0, 3]]).tolist() == [0.75, 2.5, 2.25]
    assert np.allclose(function([[3, 1e-9], [3, 1e-13], [3, 1e-18], [3, 1e-300]]), 0.75, rtol=0, atol=1e-6)
    assert np.isnan(function.gradient([[3, 0], [2, 1]])).all()
    assert np.isnan(function([3, -1e-300]))


def test_thin_hulls(rng):
    """Circles a million times as large as the set, at its nearly straight sides."""
    x = np.sort(rng.random(60))
    points = np.column_stack([x, 1e-7 * x * (1 - x)])
    points = np.vstack([points, np.column_stack([x, 0.01 + 1e-7 * rng.random(60)])])
    queries = np.column_stack([rng.uniform(0.2, 0.8, 100), rng.uniform(0.002, 0.008, 100)])
    function = NaturalNeighborInterpolator(points, points)
    assert np.allclose(function(queries), queries, rtol=0, atol=1e-8)
