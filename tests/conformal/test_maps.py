"""Claims P16 to P19: what a fisheye does, and any bubble onto any other, point to point, uniquely up to a turn."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import MoebiusMap, Rotation, SphereArc, SphereCircle, angular_distance, bubble_to_bubble, fisheye
from stereodel.sphere import graticule, lonlat_to_xyz, meridian, parallel
from tests.conformal.test_moebius import turn_at
from tests.examples import examples
from tests.strategies import BETWEEN_POLES, decades

POINTS = np.random.default_rng(12).normal(size=(30, 3))


@given(BETWEEN_POLES, decades(-3, 3))
def test_p18_stretch_of_the_colatitude(focus, s):
    lens, center = fisheye(focus, magnification=s), lonlat_to_xyz(focus)
    chi = np.radians(angular_distance(POINTS, center))
    xi = np.radians(angular_distance(lens(POINTS), center))
    assert xi == pytest.approx(2 * np.arctan(s * np.tan(chi / 2)), rel=1e-11)
    # S tan((90° + φ)/2) = tan((90° + Φ)/2) with φ, Φ the latitudes towards the antipode.
    phi, capital_phi = chi - np.pi / 2, xi - np.pi / 2
    assert s * np.tan((np.pi / 2 + phi) / 2) == pytest.approx(np.tan((np.pi / 2 + capital_phi) / 2), rel=1e-10)


@pytest.mark.parametrize("s", [1.0, 4.0, 20.0])
def test_p19_graticule_stays_orthogonal(s):
    lens = fisheye((0.0, 40.0), magnification=s)
    lons, lats = range(-180, 180, 30), range(-75, 90, 15)
    meridians = {lon: lens.image_of(meridian(lon)).circle.normal for lon in lons}
    parallels = {lat: lens.image_of(parallel(lat)).circle.normal for lat in lats}
    for lon in lons:
        for lat in lats:
            point = lens(lonlat_to_xyz((lon, lat)))
            along = np.cross(meridians[lon], point), np.cross(parallels[lat], point)
            assert abs(np.dot(*along)) < 2e-13 * np.linalg.norm(along[0]) * np.linalg.norm(along[1])


@given(BETWEEN_POLES, st.floats(1.01, 1000))
def test_p19_scale_falls_away_from_the_focus(focus, s):
    arc = SphereArc.great(focus, -lonlat_to_xyz(focus) + [0.0, 0.1, 0.1])
    scale = fisheye(focus, magnification=s).scale_factor(arc.sample(20))
    assert (np.diff(scale) < 0).all()


@given(BETWEEN_POLES, BETWEEN_POLES, st.floats(1.5, 50))
def test_p19_geodesics_become_circles(focus, normal, s):
    lens, great = fisheye(focus, magnification=s), SphereCircle(normal, 0.0)
    image = lens.image_of(great)
    assert np.abs(lens(great.sample(9)) @ image.normal - image.offset).max() < 1e-13
    inclination = great.normal @ lonlat_to_xyz(focus)
    # Great through the focus stays great; any other does not.
    through = lens.image_of(SphereCircle(np.cross(lonlat_to_xyz(focus), [0.3, -0.5, 0.7]), 0.0))
    assert abs(through.offset) < 1e-13
    if abs(inclination) > 1e-6:
        assert abs(image.offset) > abs(inclination) * 1e-3
        assert np.sign(image.offset) == -np.sign(inclination)


@given(BETWEEN_POLES, st.floats(0.01, 179.9), BETWEEN_POLES, decades(-9, 9))
def test_circles_to_circles_with_their_interiors(focus, radius, middle, s):
    lens, circle = fisheye(focus, magnification=s), SphereCircle.around(middle, radius)
    image = lens.image_of(circle)
    points = lens(circle.sample(8))
    # Stored points are an ulp off the circle, and that is magnified.
    slack = 1e-15 * (1 + lens.scale_factor(circle.sample(8)).max())
    assert np.abs(points @ image.normal - image.offset).max() < slack
    assert image.contains(lens(circle.center)) or np.abs(lens(circle.center) @ image.normal - image.offset) < 1e-12
    back = lens.inverse().image_of(image)
    shift = 1e-13 * (1 + 1 / lens.scale_factor(circle.sample(8)).min())
    assert angular_distance(back.center, circle.center) < 60 * shift
    assert back.angular_radius == pytest.approx(radius, abs=60 * shift)
    other = lens.image_of(circle.complement).complement
    assert np.abs(other.normal - image.normal).max() < 4e-16
    assert (other.offset, other.radius) == pytest.approx((image.offset, image.radius), rel=1e-15, abs=1e-300)


@pytest.mark.parametrize("s", [1e-9, 1.0, 20.0, 1e3, 1e9])
@pytest.mark.parametrize("radius", [1e-12, 1e-9, 1e-3, 40.0])
def test_tiny_circles_next_to_the_focus(s, radius):
    lens = fisheye((0.0, 40.0), magnification=s)
    image = lens.image_of(SphereCircle.around((0.0, 40.0), radius))
    expected = 2 * np.degrees(np.arctan(s * np.tan(np.radians(radius) / 2)))
    # The centre is the focus up to an ulp: the image's radius may notice S times that.
    assert image.angular_radius == pytest.approx(expected, rel=1e-12, abs=1e-13)
    assert np.abs(image.center - lens.focus).max() < 1e-15 * (1 + s) or expected > 179


@given(BETWEEN_POLES, decades(0, 9), BETWEEN_POLES, BETWEEN_POLES)
@examples(0.2)
def test_arcs_to_arcs(focus, s, start, end):
    a, b = lonlat_to_xyz(start), lonlat_to_xyz(end)
    if not 1e-3 < angular_distance(a, b) < 179.9:
        return
    lens, arc = fisheye(focus, magnification=s), SphereArc.great(start, end)
    image = lens.image_of(arc)
    assert_arc_of(image, lens, arc)
    assert_arc_of(lens.inverse().image_of(arc), lens.inverse(), arc)


def assert_arc_of(image, conformal, arc):
    """The image has the images of the ends as its ends, and the images of points between them between them."""
    inner = arc.sample(7)
    slack = 1e-14 * (1 + conformal.scale_factor(inner))
    points = conformal(inner)
    center, u, v, sweep_rad = image.frame()
    assert (np.abs(points @ image.circle.normal - image.circle.offset) < slack).all()
    assert np.abs(center + u - points[0]).max() < slack[0]
    assert np.abs(center + np.cos(sweep_rad) * u + np.sin(sweep_rad) * v - points[-1]).max() < slack[-1] + slack[0]
    r = image.circle.radius
    angles = np.arctan2(points @ v, points @ u)[1:-1] % (2 * np.pi)
    clear = slack[1:-1] * 10 < r * np.minimum(angles, 2 * np.pi - angles)
    assert (angles[clear] <= sweep_rad + (slack[1:-1] / r)[clear]).all()


@pytest.mark.parametrize("s", [20.0, 1e4, 1e9])
def test_whole_graticule_under_large_magnification(s):
    lens = fisheye((0.0, 40.0), magnification=s)
    for arc in graticule(30.0):
        image = lens.image_of(arc)
        assert image.closed == arc.closed
        assert_arc_of(image, lens, arc)


def test_prime_meridian_stays_in_its_plane():
    image = fisheye((0.0, 40.0), magnification=20.0).image_of(meridian(0.0))
    assert image.circle.normal.tolist() == [0, -1, 0]
    assert image.circle.offset == 0
    assert image.start[1] == image.end[1] == 0


BUBBLES = st.builds(SphereCircle.around, BETWEEN_POLES, st.floats(0.5, 179.5))
PLACES = st.tuples(st.floats(0, 0.95), st.floats(0, 360))


def inside(bubble, place):
    """The point of a bubble at a fraction of its radius from the centre."""
    fraction, bearing = place
    start = bubble.sample(1)[0]
    edge = Rotation.about(bubble.center, bearing)(start)
    return Rotation.about(np.cross(bubble.center, edge), fraction * bubble.angular_radius)(bubble.center)


def same(a, b):
    return angular_distance(a.center, b.center) < 1e-9 and abs(a.angular_radius - b.angular_radius) < 1e-9


@given(BUBBLES, BUBBLES, PLACES, PLACES, st.floats(-360, 360))
@examples(0.2)
def test_p16_bubble_to_bubble_and_point_to_point(source, target, start, end, turn):
    p, q = inside(source, start), inside(target, end)
    conformal = bubble_to_bubble(source, target, p, q, turn=turn)
    assert same(conformal.image_of(source), target)
    assert angular_distance(conformal(p), q) < 1e-9
    assert same(conformal.inverse().image_of(target), source)


@given(BUBBLES, BUBBLES, PLACES, PLACES, st.floats(1, 359))
@examples(0.2)
def test_p16_the_turn_is_the_angle_at_the_target_point(source, target, start, end, turn):
    p, q = inside(source, start), inside(target, end)
    plain, turned = bubble_to_bubble(source, target, p, q), bubble_to_bubble(source, target, p, q, turn=turn)
    step = 1e-6 / float(plain.scale_factor(p))
    ahead = p + step * np.linalg.svd(p[None])[2][1]
    a, b = plain(ahead) - q, turned(ahead) - q
    angle = np.degrees(np.arctan2(np.dot(q, np.cross(a, b)), np.dot(a, b)))
    assert abs((angle - turn + 180) % 360 - 180) < 0.1


@given(BUBBLES, BUBBLES, PLACES, PLACES, st.floats(-180, 180))
@examples(0.2)
def test_p16_unique_up_to_the_turn(source, target, start, end, turn):
    # Another way to a map with the same properties differs by a turn about the point: a map of the target
    # bubble onto itself that fixes a point and turns by nothing is the identity.
    p, q = inside(source, start), inside(target, end)
    there = bubble_to_bubble(source, target, p, q, turn=turn)
    back = bubble_to_bubble(target, source, q, p, turn=-turn)
    loop = there @ back
    assert same(loop.image_of(target), target)
    angle = np.degrees(turn_at(loop, q))
    assert (bubble_to_bubble(target, target, q, q, turn=-angle) @ loop).is_close(MoebiusMap.identity(), tolerance=1e-4)


@given(BUBBLES, PLACES)
@examples(0.2)
def test_no_turn_onto_itself_is_the_identity(bubble, place):
    p = inside(bubble, place)
    assert bubble_to_bubble(bubble, bubble, p, p).is_close(MoebiusMap.identity(), tolerance=1e-12)


@given(BETWEEN_POLES, st.floats(1, 179), st.floats(1, 179))
@examples(0.2)
def test_centres_by_default_give_the_fisheye(center, first, second):
    a, b = SphereCircle.around(center, first), SphereCircle.around(center, second)
    size = np.tan(np.radians(second) / 2) / np.tan(np.radians(first) / 2)
    assert bubble_to_bubble(a, b).is_close(fisheye(center, magnification=size), tolerance=1e-12)


@given(BETWEEN_POLES, st.floats(1, 90), BETWEEN_POLES, st.floats(1, 90))
@examples(0.2)
def test_p17_scales_differ_by_at_most_1_to_2(source, chi0, target, xi0):
    bubble = SphereCircle.around(source, chi0)
    conformal = bubble_to_bubble(bubble, SphereCircle.around(target, xi0))
    radius = SphereArc.great(bubble.center, bubble.sample(1)[0]).sample(50)
    scale = conformal.scale_factor(radius)
    ratio = np.cos(np.radians(chi0) / 2) ** 2 / np.cos(np.radians(xi0) / 2) ** 2
    assert scale[0] / scale[-1] == pytest.approx(ratio, rel=1e-11)
    assert scale.max() / scale.min() == pytest.approx(max(ratio, 1 / ratio), rel=1e-9)
    assert scale.max() / scale.min() <= 2 * (1 + 1e-11)
