"""`stereodel.spatial.SphericalVoronoi`: attribute by attribute against SciPy, and where SciPy has no answer."""

import numpy as np
import pytest
import scipy.spatial
from hypothesis import given
from hypothesis import strategies as st

import stereodel
from stereodel import check_delaunay
from stereodel.spatial import SphericalVoronoi
from tests import sets
from tests.spatial.oracle import cycle

SMALL = np.array([[3, 4, 12], [4, 3, 12], [5, 0, 12], [-3, 4, 12], [0, -5, 12], [-4, -3, 12]]) / 13
CIRCLES = {name: sets.unit(sets.sphere(name).points) for name in ("short circle", "arc", "half circle", "opposite")}


def sphere(n=100):
    return sets.sphere("unit").drawn(n)


@pytest.mark.parametrize("name", ["unit", "half"])
@pytest.mark.parametrize(("radius", "center"), [(1, None), (6371.0, None), (2.5, (1.0, -2.0, 3.0))])
def test_same_cells(radius, center, name):
    points = sets.sphere(name).drawn(100) * radius + (0 if center is None else np.array(center))
    ours = SphericalVoronoi(points, radius, center)
    theirs = scipy.spatial.SphericalVoronoi(points, radius, center)
    theirs.sort_vertices_of_regions()
    distance, match = scipy.spatial.cKDTree(ours.vertices).query(theirs.vertices)
    assert distance.max() < 1e-11 * radius
    assert len(np.unique(match)) == len(theirs.vertices) == len(ours.vertices) == 2 * len(points) - 4
    assert [cycle(region) for region in ours.regions] == [cycle([int(match[v]) for v in r]) for r in theirs.regions]
    np.testing.assert_allclose(ours.calculate_areas(), theirs.calculate_areas(), rtol=1e-10)
    np.testing.assert_array_equal(ours.center, theirs.center)
    np.testing.assert_array_equal(ours.points, theirs.points)
    assert ours.radius == theirs.radius
    check_delaunay(ours.points - ours.center, ours._simplices)


def test_each_vertex_is_the_center_of_its_triangle_and_regions_turn_counterclockwise():
    sv = SphericalVoronoi(sphere() * 3 + [1, 2, 3], 3, [1, 2, 3])
    corners = (sv.points[sv._simplices] - sv.center) / 3
    heights = np.einsum("mkj,mj->mk", corners, (sv.vertices - sv.center) / 3)
    assert np.ptp(heights, axis=1).max() < 1e-12
    for i, region in enumerate(sv.regions):
        assert all(i in sv._simplices[v] for v in region)
        around = sv.vertices[region] - sv.points[i]
        turns = np.cross(around, np.roll(around, -1, axis=0)) @ (sv.points[i] - sv.center)
        assert (turns > 0).all()
    before = [list(region) for region in sv.regions]
    sv.sort_vertices_of_regions()
    assert sv.regions == before


@pytest.mark.parametrize("points", [*CIRCLES.values(), SMALL, SMALL[:3]], ids=[*CIRCLES, "small", "three"])
def test_points_on_one_circle(points):
    points = 13 * points
    with pytest.raises(ValueError, match="Rank"):
        scipy.spatial.SphericalVoronoi(points, 13)
    sv = SphericalVoronoi(points, 13)
    exact = stereodel.SphericalVoronoi(points)
    np.testing.assert_array_equal(sv.vertices, 13 * exact.vertices)
    np.testing.assert_array_equal(sv.vertices[0], -sv.vertices[1])
    assert sv.regions == exact.regions
    assert sv.calculate_areas().sum() == pytest.approx(4 * np.pi * 169)
    assert all(sorted(region) == [0, 1] for region in sv.regions)
    check_delaunay(sv.points, sv._simplices)


def test_one_point_and_none():
    one = SphericalVoronoi([[0, 0, 2]], 2)
    assert (one.regions, one.vertices.shape, one.calculate_areas().tolist()) == ([[]], (0, 3), [16 * np.pi])
    none = SphericalVoronoi(np.zeros((0, 3)))
    assert (none.regions, none.vertices.shape, none.calculate_areas().shape) == ([], (0, 3), (0,))


@given(st.lists(st.tuples(*[st.integers(-2, 2)] * 3).filter(any), max_size=12), st.integers(1, 9))
def test_areas_fill_the_sphere(vectors, radius):
    points = np.reshape(vectors, (-1, 3)).astype(float)
    points *= radius / np.linalg.norm(points, axis=1, keepdims=True)
    sv = SphericalVoronoi(points, radius)
    if len(points):
        assert sv.calculate_areas().sum() == pytest.approx(4 * np.pi * radius**2)
        assert (np.abs(np.linalg.norm(sv.vertices, axis=1) - radius) < 1e-14 * radius).all()


def test_threshold_is_relative_to_the_radius():
    points = sphere() * 1000
    points[3] *= 1 + 2e-6
    with pytest.raises(ValueError, match=r"points\[3\]"):
        SphericalVoronoi(points, 1000)
    assert len(SphericalVoronoi(points, 1000, threshold=3e-6).vertices) == 196
