"""Claims P8 and P9: the stereographic projection against 80 digits; gnomonic and orthographic ones, and conics."""

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel.projections import Gnomonic, Orthographic, PlaneCircle, PlaneLine, Stereographic
from stereodel.sphere import SphereArc, SphereCircle, angular_distance, lonlat_to_xyz
from tests.exact import ACCURACY, distance, dot, mp, unit
from tests.strategies import DIRECTIONS, LONLAT

SYMMETRIC = [(0.0, -90.0), (0.0, 90.0), (33.0, 90.0), (0.0, 0.0), (180.0, 0.0), (-12.3, 45.6)]
CENTERS = LONLAT | st.sampled_from(SYMMETRIC)
PLANES = st.sampled_from(["tangent", "equatorial"])
EXPONENTS = st.sampled_from([0, -3, -7, -9, -12, -14, -15])


def exact_frame(center):
    lon, lat = (mpmath.mpf(float(v)) / 180 for v in center)
    sin, cos = mpmath.sinpi, mpmath.cospi  # exact at multiples of 90°
    return [
        [-sin(lon), cos(lon), mpmath.mpf(0)],
        [-sin(lat) * cos(lon), -sin(lat) * sin(lon), cos(lat)],
        [cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)],
    ]


def exact_forward(projection, v):
    e, n, c = (dot(row, unit(v)) for row in exact_frame(projection.center))
    factor = projection.radius * (2 if projection.plane == "tangent" else 1) / (1 + c)
    return [e * factor, n * factor]


def exact_inverse(projection, xy):
    factor = projection.radius * (2 if projection.plane == "tangent" else 1)
    x, y = (v / mpmath.mpf(factor) for v in mp(xy))
    square = x * x + y * y
    local = [2 * x / (1 + square), 2 * y / (1 + square), (1 - square) / (1 + square)]
    return [dot(local, column) for column in zip(*exact_frame(projection.center), strict=True)]


def near(center, side, offset, exponent):
    """A vector 10**exponent rad or so from the centre or its antipode."""
    return side * lonlat_to_xyz(center) + 10.0**exponent * np.array(offset)


@given(CENTERS, PLANES, st.sampled_from([1, -1]), DIRECTIONS, EXPONENTS, st.floats(1e-3, 1e3))
def test_forward_is_the_exact_image(center, plane, side, offset, exponent, radius):
    projection = Stereographic(center, radius=radius, plane=plane)
    vector = near(center, side, offset, exponent)
    axis = lonlat_to_xyz(center)
    gap = np.linalg.norm(np.cross(vector, axis)) / max(np.linalg.norm(vector), 1e-300)
    if gap < 1e-15:
        return
    got, truth = projection.forward(vector), exact_forward(projection, mp(vector))
    size = mpmath.sqrt(truth[0] ** 2 + truth[1] ** 2)
    # A point within 4·2⁻⁵² rad may stand for the given one; only where that is not needed is the test without it.
    scale = mpmath.mpf(float(projection.scale_factor(vector)))
    backward = scale * ACCURACY if gap < 1e-13 else 0
    assert distance(got, truth) <= ACCURACY * size + backward


@given(CENTERS, PLANES, st.floats(-300, 300), st.floats(0, 6.3), st.floats(1e-3, 1e3))
def test_inverse_is_the_exact_image(center, plane, power, angle, radius):
    projection = Stereographic(center, radius=radius, plane=plane)
    xy = 10.0**power * np.array([np.cos(angle), np.sin(angle)])
    assert distance(projection.inverse(xy), exact_inverse(projection, xy)) <= ACCURACY / 4


@pytest.mark.parametrize("lat", [90.0, -90.0])
def test_next_to_the_pole_and_its_antipode(lat):
    projection = Stereographic((0.0, lat))
    for size in (1e-12, 1e-100, 1e-300):
        vector = np.array([size, 0.3 * size, np.sign(lat)])
        for side in (1, -1):
            v = vector * [1, 1, side]
            got = projection.forward(v)
            with mpmath.workdps(700):
                truth = exact_forward(projection, mp(v))
                assert distance(got, truth) <= ACCURACY * mpmath.sqrt(truth[0] ** 2 + truth[1] ** 2)
            back = projection.inverse(got)
            assert back[:2] == pytest.approx(v[:2], rel=1e-15)
            assert back[2] == v[2]


def test_antipode_is_nan_and_only_the_antipode():
    projection = Stereographic((0.0, 90.0))
    assert np.isnan(projection.forward([0, 0, -3])).all()
    assert np.isnan(projection.scale_factor([0, 0, -3]))
    assert projection.forward([1e-150, 0, -1])[1] == -4e150
    assert np.isinf(projection.forward([1e-310, 0, -1])[1])
    assert projection.forward([0, 0, 1]).tolist() == [0, 0]


@given(CENTERS, DIRECTIONS, st.floats(0.1, 10))
def test_p8_equatorial_plane_differs_by_a_factor_2(center, vector, radius):
    tangent = Stereographic(center, radius=radius)
    equatorial = Stereographic(center, radius=radius, plane="equatorial")
    if angular_distance(vector, -lonlat_to_xyz(center)) > 1e-6:
        # Exactly, but for the rounding of subnormal results.
        assert np.abs(tangent.forward(vector) - 2 * equatorial.forward(vector)).max() < 1e-300
        assert tangent.scale_factor(vector) == 2 * equatorial.scale_factor(vector)


@given(CENTERS, DIRECTIONS)
def test_p8_scale_is_the_derivative_and_the_same_in_all_directions(center, vector):
    projection = Stereographic(center, radius=1.5)
    v = np.array(vector) / np.linalg.norm(vector)
    if angular_distance(v, -lonlat_to_xyz(center)) < 1:
        return
    step = mpmath.mpf(10) ** -20
    frame = np.linalg.svd(v[None])[2][1:]
    point, moved = unit(v), []
    for along in map(mp, frame):
        ahead = [x + step * d for x, d in zip(point, along, strict=True)]
        ends = zip(exact_forward(projection, ahead), exact_forward(projection, point), strict=True)
        moved.append([(a - b) / step for a, b in ends])
    scale = float(projection.scale_factor(v))
    jacobian = np.array(moved, dtype=float).T
    # Conformal: a multiple of a rotation, and orientation as seen from outside.
    assert np.abs(jacobian.T @ jacobian - scale**2 * np.eye(2)).max() < 1e-13 * scale**2
    assert np.sign(np.linalg.det(jacobian)) == np.sign(np.linalg.det([*frame, v]))


@given(CENTERS, CENTERS, st.floats(0.01, 179.9))
def test_p8_circles_to_circles(center, middle, radius):
    projection, circle = Stereographic(center, radius=0.75), SphereCircle.around(middle, radius)
    image, points = projection.image_of(circle), circle.sample(12)
    gap = angular_distance(points, -lonlat_to_xyz(center)).min()
    if isinstance(image, PlaneLine) or gap < 1e-3:
        return
    plane = projection.forward(points)
    size = np.abs(plane).max() + image.radius
    # Stored points are off by an ulp, and the scale grows with the square of the plane distance.
    assert np.abs(np.hypot(*(plane - image.center).T) - image.radius).max() < 1e-14 * (1 + size) ** 2
    inside = projection.forward(circle.center)
    if angular_distance(circle.center, -lonlat_to_xyz(center)) > 1e-3:
        assert (np.hypot(*(inside - image.center)) > image.radius) == image.outside
    assert image.outside == bool(circle.contains(-lonlat_to_xyz(center)))


@given(CENTERS, DIRECTIONS)
def test_p8_great_circles_through_the_antipode_become_lines(center, vector):
    tangent = lonlat_to_xyz(center)
    if not 1e-3 < angular_distance(tangent, vector) < 180 - 1e-3:
        return
    projection = Stereographic(center)
    circle = SphereArc.great(tangent, vector).circle
    line = projection.image_of(circle)
    assert isinstance(line, PlaneLine)
    assert projection.forward(circle.center) @ line.normal > line.offset
    assert abs(line.offset) < 1e-14
    assert abs(line.direction @ line.normal) < 1e-16
    xy = projection.forward(vector)
    assert abs(xy @ line.normal) < 1e-11 * np.hypot(*xy)


def test_small_circle_through_the_antipode():
    circle = SphereCircle((0.6, 0.0, -0.8), 0.8)
    line = Stereographic((0.0, 90.0)).image_of(circle)
    assert isinstance(line, PlaneLine)
    # −n_z − d = 0 leaves 1.2·ξ_x = 1.6 in units of 2R; at the north pole −y points to longitude 0.
    assert line.point == pytest.approx([0, -8 / 3])
    assert line.offset == pytest.approx(8 / 3 * -1) or line.normal[1] < 0
    on_page = Stereographic((0.0, 90.0)).forward(circle.sample(5)[[1, 2, 3, 4]])
    assert np.abs(on_page @ line.normal - line.offset).max() < 1e-12


def test_tiny_circle_beside_the_antipode_is_no_line():
    # n_z + d is 1.5e-16 here, which is nothing for a great circle and much for this one.
    circle = SphereCircle((2e-8, 0.0, -1.0), 1.0, 1e-8)
    image = Stereographic((0.0, 90.0)).image_of(circle)
    assert isinstance(image, PlaneCircle)
    # The points at 1e-8 and 3e-8 from the antipode lie at 4e8 and 4e8/3.
    assert image.radius == pytest.approx(4e8 / 3, rel=1e-7)
    assert not image.outside


@pytest.mark.parametrize("radius", [1e-3, 1e-7, 1e-12])
def test_tiny_circles_stay_round(radius):
    circle = SphereCircle.around((10.0, 20.0), radius)
    image = Stereographic((10.0, 20.0)).image_of(circle)
    assert isinstance(image, PlaneCircle)
    assert image.radius == pytest.approx(2 * np.tan(np.radians(radius) / 2), rel=1e-14)
    assert np.abs(image.center).max() < 3e-16
    assert np.hypot(*(image.sample(5) - image.center).T) == pytest.approx(image.radius, rel=1e-3)


def test_p9_smaller_spheres_give_larger_caps():
    radii = [float(Stereographic((0, -90), radius=r).angular_radius(1.0)) for r in (4.0, 2.0, 1.0, 0.5)]
    assert radii == sorted(radii)
    assert radii[-1] == pytest.approx(90.0)
    projection = Stereographic((0, -90), radius=1.0)
    assert angular_distance(projection.inverse([1.0, 0.0]), [0, 0, -1]) == pytest.approx(radii[2])


@pytest.mark.parametrize("view", [Stereographic, Gnomonic, Orthographic])
def test_axes_are_east_and_north(view):
    east, north = view((30.0, 50.0)).forward(lonlat_to_xyz([[30.001, 50.0], [30.0, 50.001]]))
    assert east[0] > 0
    assert abs(east[1]) < 1e-8
    assert north[1] > 0
    assert abs(north[0]) < 1e-16
    # At a pole: the limit along the given longitude.
    for lat in (90, -90):
        limit = view((70.0, np.nextafter(lat, 0))).forward([0.3, 0.4, np.sign(lat)])
        assert view((70.0, lat)).forward([0.3, 0.4, np.sign(lat)]) == pytest.approx(limit, abs=1e-14)
    assert view((0.0, 0.0, -2.0)).forward([0, 1, -1]).tolist() == view((0, -90)).forward([0, 1, -1]).tolist()


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
    assert view.image_of(SphereCircle.around((0, -60), 20)).kind == "empty"
    assert view.image_of(SphereCircle((0, 0, 1), 0.0)).kind == "empty"
    assert view.image_of(SphereCircle.around((0, -45), 45)).kind == "empty"
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
