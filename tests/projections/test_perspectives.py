"""Gnomonic and orthographic projection: maps, scales and the conics of circles."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel.projections import Gnomonic, Orthographic
from stereodel.sphere import SphereCircle, angular_distance, lonlat_to_xyz
from tests.strategies import DIRECTIONS, LONLAT

VIEWS = st.sampled_from([Gnomonic, Orthographic])


def test_gnomonic_images_beyond_all_doubles():
    assert np.isnan(Gnomonic((0.0, 0.0)).forward([[5e-324, 0.0, 0.5], [5e-324, 0.5, 0.5]])).all()


@given(VIEWS, LONLAT, DIRECTIONS, st.floats(0.1, 10))
@example(Gnomonic, (0.0, 0.0), (5e-324, 0.0, 0.5), 1.0)
def test_radial_distance_and_round_trip(view, center, vector, radius):
    projection = view(center, radius=radius)
    chi = np.radians(angular_distance(vector, lonlat_to_xyz(center)))
    xy = projection.forward(vector)
    if chi > np.pi / 2 + 1e-9:
        assert np.isnan(xy).all()
        assert all(np.isnan(scale) for scale in projection.scale_factors(vector))
    elif chi < np.pi / 2 - 1e-6:
        function = np.tan if view is Gnomonic else np.sin
        assert np.hypot(*xy) == pytest.approx(radius * function(chi), rel=1e-9, abs=1e-15)
        back = projection.inverse(xy)
        assert angular_distance(back, vector) < (1e-13 if view is Gnomonic else 1e-7)
        radial, tangential = projection.scale_factors(vector)
        cos = np.cos(chi)
        expected = (1 / cos**2, 1 / cos) if view is Gnomonic else (cos, 1.0)
        assert (radial, tangential) == pytest.approx((radius * expected[0], radius * expected[1]), rel=1e-8)


def test_outside_the_domain():
    assert np.isnan(Gnomonic((0, 90)).forward([1, 0, 0])).all()
    assert Orthographic((0, 90)).forward([1, 0, 0]).tolist() == [0, -1]
    assert np.isnan(Orthographic((0, 90)).inverse([[1.0000001, 0], [1e300, 0]])).all()
    assert Orthographic((0, 90), radius=3).inverse([3, 0]).tolist() == [0, 1, 0]
    assert Gnomonic((0, 90)).inverse([1e300, 0]).tolist() == pytest.approx([0, 1, 0])


def parameters(points, conic):
    """The parameter of plane points on a conic, from its axes."""
    f, g = np.linalg.solve(conic.axes.T, (points - conic.center).T)
    return np.arctan2(g, f) if conic.kind == "ellipse" else np.arcsinh(g) if conic.kind == "hyperbola" else g


@given(VIEWS, LONLAT, LONLAT, st.floats(0.5, 179.5), st.floats(0.1, 10))
def test_circles_to_conics(view, center, middle, angular_radius, radius):
    projection, circle = view(center, radius=radius), SphereCircle.around(middle, angular_radius)
    conic = projection.image_of(circle)
    points = circle.sample(24)
    near = angular_distance(points, lonlat_to_xyz(center)) < 85
    if conic.kind == "empty":
        assert not near.any()
        assert np.isnan(conic.sample(0.5)).all()
        return
    tilt = abs(circle.normal @ lonlat_to_xyz(center))
    if not near.any() or tilt < 1e-3 or conic.kind in ("parabola", "segment"):
        return
    plane = projection.forward(points[near])
    homogeneous = np.concatenate([plane / radius, np.ones((len(plane), 1))], axis=1)
    scale = np.diag([radius, radius, 1.0])
    form = scale @ conic.matrix @ scale
    residual = np.einsum("ij,jk,ik->i", homogeneous, form, homogeneous)
    assert np.abs(residual).max() < 1e-13 * np.abs(form).max() * (homogeneous**2).sum(axis=1).max()
    if conic.kind != "line" and abs(np.linalg.det(conic.axes)) > 1e-4:
        # The axes reproduce the very points: the right branch, the right place.
        size = np.abs(conic.center).max() + np.abs(conic.axes).max() + np.abs(plane).max()
        assert np.abs(conic.sample(parameters(plane, conic)) - plane).max() < 1e-9 * size


def test_conic_kinds():
    view = Gnomonic((0.0, 90.0))
    kinds = {
        "ellipse": SphereCircle.around((0, 60), 20),
        "hyperbola": SphereCircle.around((0, 10), 20),
        "parabola": SphereCircle.around((0, 45), 45),
        "line": SphereCircle((0, 10), 0.0),
        "empty": SphereCircle.around((0, -60), 20),
    }
    for kind, circle in kinds.items():
        assert view.image_of(circle).kind == kind
    assert view.image_of(SphereCircle((0, 0, 1), 0.0)).kind == "empty"
    assert view.image_of(SphereCircle.around((0, -45), 45)).kind == "empty"
    assert view.image_of(kinds["hyperbola"].complement).kind == "hyperbola"
    ortho = Orthographic((0.0, 90.0))
    assert ortho.image_of(SphereCircle((1, 0, 0), 0.5)).kind == "segment"
    assert ortho.image_of(SphereCircle.around((0, 90), 30)).axes == pytest.approx(0.5 * np.array([[1, 0], [0, 1]]))


@pytest.mark.parametrize("name", ["parabola", "hyperbola", "line", "ellipse"])
@pytest.mark.parametrize("flip", [False, True])
def test_every_parameter_gives_a_point_of_the_circle(name, flip):
    view = Gnomonic((20.0, 30.0), radius=2.0)
    center, radius = {"parabola": (45, 45), "hyperbola": (80, 20), "line": (40, 90), "ellipse": (20, 40)}[name]
    circle = SphereCircle.around(view.inverse([2 * np.tan(np.radians(center)), 0.0]), radius)
    conic = view.image_of(circle.complement if flip else circle)
    assert conic.kind == name
    back = view.inverse(conic.sample(np.linspace(-2, 2, 9)))
    assert np.abs(back @ circle.normal - circle.offset).max() < 1e-14


@example((2.1403415096809546e-140,) * 2, (2.1403415096809546e-140,) * 2, 6.0)  # squares underflow
@given(LONLAT, LONLAT, st.floats(1, 179))
def test_orthographic_parameter_runs_with_the_circle(center, middle, radius):
    projection, circle = Orthographic(center), SphereCircle.around(middle, radius)
    conic = projection.image_of(circle)
    if conic.kind == "segment":
        return
    facing = circle.normal @ lonlat_to_xyz(center)
    assert np.linalg.det(conic.axes) == pytest.approx(facing * circle.radius**2, abs=1e-12)
    t = np.linspace(0, 2 * np.pi, 9)
    assert np.hypot(*conic.sample(t).T).max() <= 1 + 1e-15
