"""`stereodel.spatial.Delaunay`: attribute by attribute against SciPy, and where SciPy has no answer."""

import numpy as np
import pytest
import scipy.spatial
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial._qhull import _get_barycentric_transforms

from stereodel import PlanarDelaunay, check_delaunay, orient2d
from stereodel.spatial import Delaunay
from stereodel.spatial.barycentric import transforms
from tests import sets
from tests.spatial.oracle import SMALL_SETS, as_sets, random_points


@pytest.fixture(scope="module", params=[(1.0, 0.0), (1e-3, 7.0), (1e6, -3e5)], ids=["unit", "far", "large"])
def pair(request):
    points = random_points(300, 1, *request.param)
    return Delaunay(points), scipy.spatial.Delaunay(points)


def test_same_triangles_and_neighbors(pair):
    ours, theirs = pair
    assert as_sets(ours.simplices) == as_sets(theirs.simplices)
    number = {frozenset(row): i for i, row in enumerate(ours.simplices.tolist())}
    match = np.array([number[frozenset(row)] for row in theirs.simplices.tolist()])
    corner = (ours.simplices[match][:, None, :] == theirs.simplices[:, :, None]).argmax(axis=2)
    expected = np.where(theirs.neighbors < 0, -1, match[theirs.neighbors])
    np.testing.assert_array_equal(np.take_along_axis(ours.neighbors[match], corner, axis=1), expected)
    check_delaunay(ours.points, ours.simplices)


def test_same_paraboloid(pair):
    ours, theirs = pair
    np.testing.assert_allclose(
        [ours.paraboloid_scale, ours.paraboloid_shift], [theirs.paraboloid_scale, theirs.paraboloid_shift], rtol=1e-12
    )
    np.testing.assert_allclose(ours.lift_points(ours.points), theirs.lift_points(theirs.points), rtol=1e-12, atol=1e-9)


def test_equations_hold_the_lifted_corners_and_see_other_points_above(pair):
    ours, _ = pair
    heights = np.abs(ours.lift_points(ours.points)).max()
    distances = ours.plane_distance(ours.points)
    own = np.take_along_axis(distances.T, ours.simplices, axis=1)
    assert np.abs(own).max() < 1e-14 * heights
    assert distances.max() < 1e-14 * heights
    np.testing.assert_allclose(np.linalg.norm(ours.equations[:, :3], axis=1), 1.0, rtol=1e-14)
    assert (ours.equations[:, 2] < 0).all()


def test_same_hull_vertices_and_bounds(pair):
    ours, theirs = pair
    assert as_sets(ours.convex_hull) == as_sets(theirs.convex_hull)
    indptr, indices = ours.vertex_neighbor_vertices
    their_indptr, their_indices = theirs.vertex_neighbor_vertices
    np.testing.assert_array_equal(indptr, their_indptr)
    for k in range(ours.npoints):
        assert indices[indptr[k] : indptr[k + 1]].tolist() == sorted(their_indices[indptr[k] : indptr[k + 1]])
    assert (ours.simplices[ours.vertex_to_simplex] == np.arange(ours.npoints)[:, None]).any(axis=1).all()
    for name in ("ndim", "npoints", "nsimplex", "furthest_site"):
        assert getattr(ours, name) == getattr(theirs, name)
    for name in ("points", "min_bound", "max_bound", "good", "coplanar"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))


def test_arrays_can_be_written_to_and_keep_what_is_written():
    tri = Delaunay(random_points())
    tri.simplices.sort()
    assert (np.diff(tri.simplices) > 0).all()
    long = np.ptp(tri.points[tri.simplices], axis=1).max(axis=1) > 0.2
    tri.simplices = tri.simplices[~long]
    assert len(tri.simplices) == (~long).sum()


def test_transforms_are_missing_where_scipys_are(rng):
    corners = rng.normal(size=(3000, 3, 2)) * [1.0, 7.0]
    share, aside = rng.random((3000, 1)), 10.0 ** rng.uniform(-13.5, -10.5, (3000, 1))
    corners[:, 2] = share * corners[:, 0] + (1 - share) * corners[:, 1] + aside * rng.normal(size=(3000, 2))
    rows = np.arange(9000, dtype=np.int32).reshape(-1, 3)
    theirs = _get_barycentric_transforms(corners.reshape(-1, 2), rows, np.finfo(float).eps)
    ours = transforms(corners)
    missing = np.isnan(ours[:, 0, 0])
    assert 500 < missing.sum() < 2500
    assert (missing != np.isnan(theirs[:, 0, 0])).sum() <= 15  # SciPy's condition number comes from a rounded inverse
    both = ~missing & ~np.isnan(theirs[:, 0, 0])
    np.testing.assert_allclose(ours[both], theirs[both], rtol=0.02)


def test_planes_of_slivers_point_down(rng):
    """Also where the area, which is exactly positive, is zero or negative as rounded."""
    ends = rng.random((4000, 2, 2)) * [[1, 1], [30, 30]]
    share = rng.random((4000, 1, 1))
    corners = np.concatenate([ends, share * ends[:, :1] + (1 - share) * ends[:, 1:]], axis=1)
    corners = corners[orient2d(*corners.transpose(1, 0, 2)) > 0]
    d, e = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert (d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0] < 0).any()
    tri = Delaunay([], qhull_options="")
    tri._corners = corners
    equations = tri.equations
    assert np.isfinite(equations).all()
    assert (equations[:, 2] <= 0).all()


def test_transforms_of_any_size():
    for size in (1e-300, 1e-150, 1e150, 1e300):
        tri = Delaunay(np.array([[0, 0], [1, 0], [0, 1]]) * size)
        assert np.isfinite([tri.paraboloid_scale, tri.paraboloid_shift]).all()
        inverse = tri.transform[0, :2]
        corners = tri.points[tri.simplices[0]]
        np.testing.assert_allclose(inverse @ (corners[:2] - corners[2]).T, np.eye(2), atol=1e-12)


def test_coplanar_are_equal_points_and_no_others():
    points = random_points(20)
    tri = Delaunay(np.concatenate([points, points[:5], points[:5] + 1e-15]))
    assert tri.coplanar[:, 0].tolist() == list(range(20, 25))
    assert tri.coplanar[:, 2].tolist() == list(range(5))
    assert (tri.simplices[tri.coplanar[:, 1]] == tri.coplanar[:, 2:]).any(axis=1).all()
    np.testing.assert_array_equal(tri.vertex_to_simplex[20:25], tri.vertex_to_simplex[:5])
    check_delaunay(tri.points, tri.simplices)


def test_coplanar_points_are_listed_with_qc_alone():
    points = [[0, 0], [1, 0], [0, 1], [0, 0]]
    assert Delaunay(points, qhull_options="Qbb Qc Qz").coplanar.tolist() == [[3, 0, 0]]
    without = Delaunay(points, False, False, "Qbb Qz")
    assert without.coplanar.shape == (0, 3)
    assert without.vertex_to_simplex.tolist() == [0, 0, 0, -1]


@pytest.mark.parametrize("options", ["Qbb Qc Qz Q12", "Qc", "Qbb Qc Q14 Pp Qs"])
def test_options_mean_what_they_mean_to_qhull(options):
    points = random_points(50, 3, 2.0, 1.0)
    ours, theirs = Delaunay(points, qhull_options=options), scipy.spatial.Delaunay(points, qhull_options=options)
    assert ours.paraboloid_scale == pytest.approx(theirs.paraboloid_scale, rel=1e-14)
    assert ours.paraboloid_shift == pytest.approx(theirs.paraboloid_shift, rel=1e-14)


@given(SMALL_SETS, st.lists(SMALL_SETS, max_size=3))
def test_adding_points_gives_the_triangles_of_all_points(first, others):
    tri = Delaunay(first, incremental=True)
    before = tri.simplices, tri.simplices.copy()
    for k, more in enumerate(others):
        tri.add_points(np.reshape(more, (-1, 2)), restart=bool(k % 2))
    tri.close()
    points = np.concatenate([np.reshape(some, (-1, 2)) for some in (first, *others)])
    whole = PlanarDelaunay(points)
    np.testing.assert_array_equal(tri.points, points)
    assert as_sets(tri.simplices) == as_sets(whole.simplices)
    assert tri.coplanar[:, [0, 2]].tolist() == sorted(tri.coplanar[:, [0, 2]].tolist())
    assert as_sets(tri.coplanar[:, [0, 2]]) == as_sets(whole.duplicates)
    assert (tri.paraboloid_scale, tri.paraboloid_shift) == (1.0, 0.0)
    np.testing.assert_array_equal(*before)
    check_delaunay(tri.points, tri.simplices)


def test_points_are_added_in_incremental_mode_until_closed():
    with pytest.raises(RuntimeError, match="incremental mode not enabled or already closed"):
        Delaunay(random_points()).add_points([[2, 2]])
    tri = Delaunay(random_points(), incremental=True)
    with pytest.raises(ValueError, match=r"\(n, 2\)"):
        tri.add_points([2, 2])
    tri.add_points([[2, 2]])
    assert tri.npoints == 201
    assert tri.max_bound.tolist() == [2, 2]
    tri.close()
    tri.close()
    with pytest.raises(RuntimeError, match="already closed"):
        tri.add_points([[3, 3]])


@pytest.mark.parametrize("one", sets.of("plane", "flat", "few"))
def test_where_scipy_refuses_there_are_no_triangles(one):
    points = one.points
    with pytest.raises((scipy.spatial.QhullError, ValueError)):
        scipy.spatial.Delaunay(points)
    tri = Delaunay(points)
    assert tri.nsimplex == 0
    shapes = {"simplices": (0, 3), "neighbors": (0, 3), "convex_hull": (0, 2), "equations": (0, 4)}
    for name, shape in (shapes | {"transform": (0, 3, 2), "good": (0,)}).items():
        assert getattr(tri, name).shape == shape
    assert (tri.vertex_to_simplex == -1).all()
    assert tri.vertex_neighbor_vertices[0].tolist() == [0] * (tri.npoints + 1)
    assert tri.find_simplex([[0, 0], [1, 2]]).tolist() == [-1, -1]
    assert tri.plane_distance(np.zeros((5, 2))).shape == (5, 0)
