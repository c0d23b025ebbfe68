"""Corners of hulls against what they must do: hold all points, turn left at each, or not exist; area and perimeter."""

from itertools import combinations

import numpy as np
import pytest
import scipy.spatial
from hypothesis import given
from hypothesis import strategies as st

from stereodel import SphericalDelaunay, orient2d, solid_angle
from stereodel.graphs import hull, hull_area, hull_perimeter
from tests import sets
from tests.exact import cross
from tests.examples import examples
from tests.reference import ray, turn_ray
from tests.spaces import BOTH, PLANE, SPHERE, dot


def corners(triangulation):
    found = hull(triangulation)
    assert found.dtype == np.int32
    assert not found.flags.writeable
    assert not set(found.tolist()) & set(triangulation.duplicates[:, 0].tolist())
    assert len(found) == 0 or found[0] == found.min()
    return found.tolist()


def prove_in_plane(points):
    triangulation = PLANE.triangulated(points)
    found, points = corners(triangulation), triangulation.points
    if triangulation.dimension < 2:
        ends = sorted(set(map(tuple, points.tolist())))
        assert {tuple(points[k]) for k in found} == {*ends[:1], *ends[-1:]}
        return
    for a, b, c in zip(found, np.roll(found, -1), np.roll(found, -2), strict=True):
        assert orient2d(points[a], points[b], points[c]) > 0
        assert (orient2d(points[a], points[b], points) >= 0).all()


def holds_centre(rays):
    """Whether the centre lies in the convex hull of directions: in a segment, triangle or tetrahedron of them."""

    def pair(a, b):
        return not any(cross(a[:3], b[:3])) and dot(a, b) < 0

    def triple(a, b, c):
        """Of a plane through the centre: all three turns the same way."""
        if turn_ray(a, b, c):
            return False
        products = [cross(a[:3], b[:3]), cross(b[:3], c[:3]), cross(c[:3], a[:3])]
        return all(dot(p, q) > 0 for p, q in combinations(products, 2))

    def quadruple(*four):
        """The centre is on the inner side of all faces."""
        sides = {(-1) ** k * turn_ray(*four[:k], *four[k + 1 :]) for k in range(4)}
        return sides in ({1}, {-1})

    tests = ((pair, 2), (triple, 3), (quadruple, 4))
    return any(test(*some) for test, size in tests for some in combinations(rays, size))


def prove_on_sphere(points):
    triangulation = SPHERE.triangulated(points)
    found = corners(triangulation)
    rays = [ray(p) for p in triangulation.points.tolist()]
    assert (found == []) == (len(rays) == 0 or holds_centre(sorted(set(rays))))
    for a, b, c in zip(found, np.roll(found, -1), np.roll(found, -2), strict=True):
        if len(found) > 2:
            assert turn_ray(rays[a], rays[b], rays[c]) > 0
            assert min(turn_ray(rays[a], rays[b], r) for r in rays) >= 0
    if len(found) == 2:
        a, b = (rays[k] for k in found)
        assert all(turn_ray(a, b, r) == 0 for r in rays)
        assert all(is_between(a, r, b) for r in rays)


def is_between(a, r, b):
    """On the short arc: not beyond either end, as seen along the axis."""
    axis = cross(a[:3], b[:3])
    normal = (*axis, sum(x * x for x in axis))
    return turn_ray(normal, a, r) >= 0 and turn_ray(normal, r, b) >= 0


def prove(points):
    return prove_in_plane(points) if points.shape[1] == 2 else prove_on_sphere(points)


@BOTH
@given(data=st.data())
@examples(0.6)
def test_small_integers(space, data):
    prove(data.draw(space.points(3, min_size=1, max_size=15 if space is PLANE else 9)))


@given(st.lists(SPHERE.places(2).filter(lambda p: p[2] > 0), min_size=1, max_size=12))
def test_within_a_hemisphere(points):
    prove(SPHERE.array(points))


@pytest.mark.parametrize("one", sets.of("few"))
def test_awkward_sets(one):
    prove(one.points)


@BOTH
@pytest.mark.parametrize("spread", [1e-3, 1e-12, 1e-15])
def test_cluster(space, spread):
    """A few ulps across, so that many points lie within sides."""
    prove(space.cluster(np.random.default_rng(6), spread, 25))


# Area and perimeter --------------------------------------------------------------------------------------------------


def test_measures_of_the_plane_are_those_of_scipy(rng):
    for size in (3, 10, 500):
        points = rng.normal(size=(size, 2)) + [3, -1]
        theirs = scipy.spatial.ConvexHull(points)
        assert hull_area(points) == pytest.approx(theirs.volume, rel=1e-12)
        assert hull_perimeter(points) == pytest.approx(theirs.area, rel=1e-12)


@pytest.mark.parametrize("angular_radius", [0.01, 30, 60, 89])
def test_a_polygon_of_many_corners_is_nearly_its_cap(angular_radius):
    """On the sphere: the area 2π(1 − cos r), the perimeter 360° sin r."""
    lon = np.arange(0, 360, 0.5)
    points = np.column_stack([lon, np.full_like(lon, 90 - angular_radius)])
    cap = np.radians(angular_radius)
    assert hull_area(lonlat=points) == pytest.approx(4 * np.pi * np.sin(cap / 2) ** 2, rel=1e-4)
    assert hull_perimeter(lonlat=points) == pytest.approx(360 * np.sin(cap), rel=1e-4)


def test_area_is_that_of_the_triangles():
    """Those that are not closing; and that of the corners alone."""
    points = np.random.default_rng(1).normal(size=(60, 3)) + [0, 0, 4]
    triangulation = SphericalDelaunay(points)
    inner = points[triangulation.simplices[~triangulation.closing]]
    expected = solid_angle(*np.moveaxis(inner, 1, 0)).sum()
    assert hull_area(triangulation) == pytest.approx(expected, rel=1e-13)
    assert hull_area(points[hull(triangulation)]) == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize("points", [[], [[1, 2]], [[0, 0], [3, 4], [0, 0]], [[0, 0], [3, 4], [6, 8]]])
def test_lines_of_the_plane_have_no_area(points):
    longest = max((np.hypot(*p) for p in points), default=0) if len(points) > 1 else 0
    assert hull_area(points) == 0
    assert hull_perimeter(points) == pytest.approx(2 * longest)


def test_arcs_have_no_area():
    arc = [[10, 0], [50, 0], [100, 0]]
    assert hull_area(lonlat=arc) == 0
    assert hull_perimeter(lonlat=arc) == pytest.approx(180)
