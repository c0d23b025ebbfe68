"""Views: a right-handed frame whose up is north, with exact zeros in symmetric positions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.curves.view import StereographicView, View
from stereodel.sphere import lonlat_to_xyz

views = st.builds(View, st.floats(-360, 360), st.floats(-90, 90), st.floats(-180, 180))


@given(views)
def test_matrix_is_a_rotation_that_looks_at_its_point(view):
    matrix = view.matrix
    assert np.allclose(matrix @ matrix.T, np.eye(3), rtol=0, atol=1e-15)
    assert np.linalg.det(matrix) > 0
    assert np.allclose(matrix[2], lonlat_to_xyz((view.lon, view.lat)), rtol=0, atol=0)


@given(st.floats(-180, 180), st.floats(-90, 90), st.floats(-1, 1))
def test_central_meridian_is_vertical_and_north_is_up(lon, lat, step):
    view = View(lon, lat)
    x, y = view.project(lonlat_to_xyz((lon, np.clip(lat + step, -90, 90))))
    assert abs(x) <= 1e-15
    assert View(0, lat).project(lonlat_to_xyz((0, lat)))[0] == 0
    assert np.sign(step) * y >= -1e-15


@pytest.mark.parametrize(
    ("lon", "lat", "expected"),
    [
        (0, 0, [[0, 1, 0], [0, 0, 1], [1, 0, 0]]),
        (0, 90, [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]),
        (0, -90, [[0, 1, 0], [1, 0, 0], [0, 0, -1]]),
        (90, 0, [[-1, 0, 0], [0, 0, 1], [0, 1, 0]]),
        (180, 90, [[0, -1, 0], [1, 0, 0], [0, 0, 1]]),
    ],
)
def test_symmetric_views_are_exact(lon, lat, expected):
    matrix = View(lon, lat).matrix
    assert np.array_equal(matrix, expected)
    assert not np.signbit(matrix[matrix == 0]).any()
    for pole in (90, -90):  # there up is the limit along the longitude
        assert np.allclose(View(33, pole).matrix, View(33, pole - np.copysign(1e-9, pole)).matrix, rtol=0, atol=1e-10)


def test_roll_turns_counterclockwise_and_depth_is_positive_on_the_near_side():
    assert View(0, 0, roll=90).project(lonlat_to_xyz((90, 0))).tolist() == [0.0, 1.0]
    assert View(20, 30).depth(lonlat_to_xyz([(20, 30), (200, -30), (110, 0)])) == pytest.approx([1, -1, 0], abs=1e-15)


@pytest.mark.parametrize("arguments", [(0, 91), (np.nan, 0), (0, 0, np.inf), ("a", 0)])
def test_bad_views_are_refused(arguments):
    with pytest.raises((ValueError, TypeError)):
        View(*arguments)


@given(
    extent=st.floats(1.0, 170.0),
    bearing=st.floats(0.0, 2 * np.pi),
    share=st.floats(0.0, 0.999),
)
def test_flat_maps_are_stereographic_projections_of_their_cap(extent, bearing, share):
    """Distances from the middle are tan(χ/2) over that of the edge, bearings stay, and the way back is the inverse."""
    chi = np.radians(share * extent)
    axes = np.array([np.sin(chi) * np.cos(bearing), np.sin(chi) * np.sin(bearing), np.cos(chi)])
    view = StereographicView(20.0, -35.0, angular_radius=extent)
    page = view.flattened(axes)
    reach = np.tan(chi / 2) / np.tan(np.radians(extent) / 2)
    np.testing.assert_allclose(page, reach * np.array([np.cos(bearing), np.sin(bearing)]), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(view.raised(page), axes, atol=1e-12)
    assert axes[2] >= view.edge


@pytest.mark.parametrize("view", [View(10.0, 50.0, 20.0), StereographicView(10.0, 50.0, 20.0, angular_radius=120.0)])
def test_what_is_outside_the_disc_has_no_place_on_the_sphere(view):
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.001, 0.0], [-0.8, -0.7]])
    axes = view.raised(points)
    assert np.isnan(axes).all(axis=1).tolist() == [False, False, True, True]
    np.testing.assert_allclose(axes[1, 2], view.edge, atol=1e-12)
