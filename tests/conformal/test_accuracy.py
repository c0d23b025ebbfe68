"""The accuracy contract of conformal maps, against 80-digit arithmetic.

A result is right when it is, up to 4·2⁻⁵², the exact image of a point within 4·2⁻⁵² rad of the given one. The maps are
conformal and their scale is nearly constant over such a disc, so this asks for |result − exact| ≤ (1 + scale)·4·2⁻⁵².
Evaluating a map as it is stored must do better: a few roundings, however large the scale is.
"""

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel.conformal import MoebiusMap, bubble_to_bubble, fisheye, flight
from stereodel.sphere import Rotation, SphereCircle, lonlat_to_xyz
from tests.exact import ACCURACY, angle, direction, distance, dot, mp, rotate, unit
from tests.examples import examples
from tests.strategies import DIRECTIONS, LONLAT, ROTATIONS, decades, maps

UNIT = mpmath.mpf(2) ** -53
NEXT = mpmath.mpf(2) ** -73  # rad: what the kernel's rotations lose of a small distance from the focus

MAGNIFICATIONS = st.one_of(decades(-9, 9), st.sampled_from([1e-9, 1.0, 4.0, 20.0, 1e9]))
MAPS = maps(MAGNIFICATIONS)
LARGE_MAPS = maps(st.one_of(decades(-49, 49), st.sampled_from([1.0, 1e-16, 1e16, 1e20, 1e34])))
NEARNESS = st.sampled_from([1.0, 1e-3, 1e-8, 1e-9, 1e-12, 1e-15, 0.0])
LENGTHS = st.sampled_from([1.0, 0.7, 3e7, 1e300, 1e-300, 2.0**-1022, 1.7e-308])


def exact_fisheye(focus, magnification, v):
    """The closed formula Ξ = 2 arctan(S tan(χ/2)), v and the focus being unit vectors."""
    s, c = mpmath.mpf(float(magnification)), dot(v, focus)
    total = (1 + c) + s * s * (1 - c)
    along = ((1 + c) - s * s * (1 - c)) / total
    return [2 * s / total * (x - c * f) + along * f for x, f in zip(v, focus, strict=True)]


def exact_map(conformal, v):
    inner = rotate(conformal.right.quaternion, v)
    return rotate(conformal.left.quaternion, exact_fisheye(mp([0, 0, 1]), conformal.magnification, inner))


def near_point(point, side, nearness, offset):
    vector = side * point + nearness * np.array(offset)
    return vector if np.linalg.norm(vector) > 1e-6 else point


@given(MAPS, st.sampled_from([1, -1]), NEARNESS, DIRECTIONS, LENGTHS)
def test_the_stored_map_is_off_by_a_few_roundings(conformal, side, nearness, offset, length):
    vector = length * near_point(conformal.focus, side, nearness, offset)
    truth = exact_map(conformal, unit(vector))
    scale = exact_scale(conformal, vector)
    assert distance(conformal(vector), truth) <= min(13 * UNIT + scale * NEXT, 6 * UNIT * (1 + scale))


def exact_scale(conformal, vector):
    c, s = rotate(conformal.right.quaternion, unit(vector))[2], mpmath.mpf(conformal.magnification)
    return 2 * s / ((1 + c) + s * s * (1 - c))


@pytest.mark.parametrize("smallest", [5e-324, 3e-320, 1e-310])
@pytest.mark.parametrize("magnification", [1e-9, 1.0, 20.0])
def test_subnormal_directions(smallest, magnification):
    lens = fisheye((20.0, 30.0), magnification=magnification)
    rows = np.array([[3, -2, 1], [0, 0, 1], [-1, 0, 0], [7, 5, -4]])
    assert (lens(smallest * rows) == lens(np.round(smallest / 5e-324) * rows)).all()
    assert (lens.scale_factor(smallest * rows) == lens.scale_factor(np.round(smallest / 5e-324) * rows)).all()
    mixed = np.concatenate([smallest * rows, 2e307 * rows, rows])
    assert (lens(mixed) == np.concatenate([lens(part) for part in np.split(mixed, 3)])).all()


@given(LONLAT, MAGNIFICATIONS, st.sampled_from([1, -1]), NEARNESS, DIRECTIONS)
def test_fisheye_at_the_focus_that_was_given(focus, magnification, side, nearness, offset):
    direction = lonlat_to_xyz(focus)
    lens = fisheye(focus, magnification=magnification)
    vector = near_point(direction, side, nearness, offset)
    truth = exact_fisheye(unit(direction), magnification, unit(vector))
    assert distance(lens(vector), truth) <= ACCURACY * (1 + mpmath.mpf(float(lens.scale_factor(vector))))


@given(MAPS, st.sampled_from([1, -1]), NEARNESS, DIRECTIONS)
def test_inverse_is_exact(conformal, side, nearness, offset):
    inverse = conformal.inverse()
    vector = near_point(inverse.focus, side, nearness, offset)
    v = unit(vector)
    with mpmath.workdps(120):
        assert distance(exact_map(conformal, exact_map(inverse, v)), v) < mpmath.mpf(10) ** -55


@given(MAPS, st.sampled_from([1, -1]), NEARNESS, DIRECTIONS)
def test_scale_factor(conformal, side, nearness, offset):
    vector = near_point(conformal.focus, side, nearness, offset)
    truth, got = exact_scale(conformal, vector), mpmath.mpf(float(conformal.scale_factor(vector)))
    # Next to the focus the scale changes by at most S times itself in a radian, next to the antipode by 1/S.
    slope = max(conformal.magnification, 1 / conformal.magnification)
    assert abs(got / truth - 1) < mpmath.mpf(2) ** -48 + slope * NEXT


@pytest.mark.parametrize("magnification", [1e-9, 1e-3, 20.0, 1e9])
def test_next_to_focus_and_antipode_with_relative_accuracy(magnification):
    # About the pole the rotations are exact, so the small parts must be right to their own last digits.
    lens = fisheye((0.0, 90.0), magnification=magnification)
    for size in (1e-12, 1e-30, 1e-200):
        for z in (1.0, -1.0):
            got = lens([size, 0.0, z])
            half = magnification if z > 0 else 1 / magnification
            assert got[0] == pytest.approx(float(2 * half * size / (2 + 0.5 * (half * size) ** 2)), rel=1e-9)
            assert np.sign(got[2]) == z


@given(MAPS, LONLAT)
def test_places_in_degrees(conformal, place):
    lon, lat = conformal.lonlat(place)
    assert -180 <= lon < 180
    assert -90 <= lat <= 90
    start = direction(*place)
    scale = exact_scale(conformal, [float(v) for v in start])
    assert distance(direction(lon, lat), exact_map(conformal, start)) <= 18 * UNIT * (1 + scale) * (1 + 2**-20)


def test_places_of_the_identity_stay():
    identity = MoebiusMap.identity()
    corners = np.array([(lon, lat) for lon in range(-180, 180, 45) for lat in range(-90, 91, 45)], dtype=float)
    moved = identity.lonlat(corners)
    inner = np.abs(corners[:, 1]) < 90
    assert np.abs(moved - corners)[inner].max() <= 2e-14
    assert (np.abs(moved[~inner, 1]) == 90).all()
    assert (moved[np.abs(corners).max(axis=1) == 0] == 0).all()
    assert (identity.lonlat([(180.0, 0.0), (540.0, 0.0), (-180.0, 0.0)]) == [-180.0, 0.0]).all()
    tiny = np.array([(1e-300, -1e-300), (1e-9, 1e-12)])
    assert identity.lonlat(tiny) == pytest.approx(tiny, rel=1e-15)
    assert (np.signbit(identity.lonlat([(-0.0, -0.0)])) == 0).all()


ANY_MAGNIFICATION = decades(-100, 100).filter(lambda s: 1e-100 <= s <= 1e100)
TINY_ROTATIONS = st.tuples(*[st.sampled_from([1.0, 1e-8, -1e-150, 5e-324, 0.0, 0.3])] * 4).filter(any).map(Rotation)


@given(st.builds(MoebiusMap, st.one_of(ROTATIONS, TINY_ROTATIONS), ANY_MAGNIFICATION, ROTATIONS))
def test_a_map_and_its_inverse_are_the_identity(conformal):
    for both in (conformal @ conformal.inverse(), conformal.inverse() @ conformal):
        assert both.magnification == 1.0
        w, *axis = (both.left @ both.right).quaternion
        assert np.abs(axis).max() <= 4 * 2.0**-52 * abs(w)


@given(LARGE_MAPS, LARGE_MAPS, st.sampled_from([1, -1]), NEARNESS, DIRECTIONS)
def test_composition_of_any_magnification(first, second, side, nearness, offset):
    both = second @ first
    with mpmath.workdps(450):
        for focus in (first.focus, both.focus):
            v = unit(near_point(focus, side, nearness, offset))
            # As stored: the kernel's own roundings next to the focus are tested above.
            gap = distance(exact_map(both, v), exact_map(second, exact_map(first, v)))
            assert gap <= ACCURACY * (1 + largest_scale(both, v))


@given(ROTATIONS, ROTATIONS, st.floats(0, 80), st.floats(0, 1))
def test_what_nearly_undoes_a_strong_map(left, right, decades, part):
    """The small rest of two magnifications is right, not only a rest of none: M(S)⁻¹ M(S (1 + δ)) has 1 + δ."""
    size = 10.0**decades
    strong = MoebiusMap(left, size, right)
    other = MoebiusMap(left, min(size * (1 + part), 1e100), right)
    rest = strong.inverse() @ other
    assert rest.magnification == pytest.approx(other.magnification / size, rel=4 * 2.0**-52)
    assert distance(rest.focus, unit(other.focus)) < 1e-15 / max(rest.magnification - 1, 1e-16)


@given(ROTATIONS, ROTATIONS, st.floats(-80, 80))
@example(Rotation((1.0, 1.0, 0.0, 0.0)), Rotation((1.0, 1.0, 0.0, 0.0)), 34.0)
def test_powers_of_any_magnification(left, right, decades):
    conformal = MoebiusMap(left, 10.0**decades, right)
    slack = (8 + 3 * abs(decades)) * 2.0**-52  # the rounding of the exponent, 2⁻⁵² of ln S, and what is around
    assert conformal.power(1.0).is_close(conformal, tolerance=slack)
    assert conformal.power(-1.0).is_close(conformal.inverse(), tolerance=slack)
    half = conformal.power(0.5)
    grown = half.biquaternion.norm().hi / np.sqrt(conformal.biquaternion.norm().hi)
    # Relative to the map: of a parabolic one with a large S the stored half may have the identity for its square.
    assert conformal.is_close(half @ half, tolerance=2 * slack * max(1.0, float(grown)))


@given(LONLAT, LONLAT, st.floats(0, 90), st.floats(0, 90), st.floats(0, 1))
@example((0.0, 0.0), (0.0, 0.0), 70.0, 70.0, 0.5)
def test_flights_of_any_magnification(start, end, first, last, t):
    """The geodesic of hyperbolic space, in 200 digits; a point of it is (sinh η f, cosh η)."""
    path = flight(start, end, magnification=10.0**first, arrival=10.0**last)
    with mpmath.workdps(200):
        f, g = (unit(lens.focus) for lens in (path.start, path.end))
        a, b = (mpmath.log(mpmath.mpf(lens.magnification)) for lens in (path.start, path.end))
        inner = mpmath.cosh(a) * mpmath.cosh(b) - mpmath.sinh(a) * mpmath.sinh(b) * sum(map(mpmath.fmul, f, g))
        d = mpmath.acosh(max(inner, 1))
        assert abs(path.length - d) <= 1e-13 * (1 + d)
        before, after = (
            (mpmath.sinh((1 - t) * d) / mpmath.sinh(d), mpmath.sinh(t * d) / mpmath.sinh(d)) if d else (1 - t, t)
        )
        vector = [before * mpmath.sinh(a) * x + after * mpmath.sinh(b) * y for x, y in zip(f, g, strict=True)]
        size = mpmath.sqrt(sum(x * x for x in vector))
        here = path(t)
        eta = mpmath.log(mpmath.mpf(here.magnification))
        # d is rounded to a double, and so is t d; what that is off moves along the path. The heights a and η are
        # doubles too, each off by 2⁻⁵³ of it.
        assert abs(eta - mpmath.asinh(size)) <= 1e-14 * (1 + d) + 2.0**-52 * max(a, b)
        if size > 1e-3:
            assert distance(here.focus, [x / size for x in vector]) <= 1e-13 * (1 + d) * (1 + 1 / size)


def circle_of(bubble):
    """Unit normal and angular radius, as the stored numbers define them."""
    return unit(bubble.normal), mpmath.atan2(mpmath.mpf(bubble.radius), mpmath.mpf(bubble.offset))


def largest_scale(conformal, v):
    """Of a map within what a stored point may be off."""
    s = mpmath.mpf(conformal.magnification)
    chi = angle(rotate(conformal.right.quaternion, v), mp([0, 0, 1]))
    chi = max(chi - ACCURACY, 0) if s > 1 else min(chi + ACCURACY, mpmath.pi)
    return s / (mpmath.cos(chi / 2) ** 2 + s * s * mpmath.sin(chi / 2) ** 2)


def check_bubbles(conformal, source, point, target):
    """A point of the source goes to the centre of the target, and the rim to the rim, as far as a stored map can."""
    center, radius = circle_of(target)
    v = unit(point)
    assert angle(exact_map(conformal, v), center) <= 2 * ACCURACY * (1 + largest_scale(conformal, v))
    for rim in source.sample(3):
        v = unit(rim)
        gap = angle(exact_map(conformal, v), center) - radius
        assert abs(gap) <= 2 * ACCURACY * (1 + largest_scale(conformal, v))


BUBBLE_SIZES = decades(-12.9, 1.9)
BUBBLES = st.builds(SphereCircle.around, LONLAT, st.one_of(BUBBLE_SIZES, BUBBLE_SIZES.map(lambda a: 180 - a)))


@given(BUBBLES, BUBBLES, st.floats(0, 360))
@examples(0.2)
def test_bubbles_down_to_points(source, target, turn):
    if min(source.radius, target.radius) <= 8 * 2.0**-52:
        with pytest.raises(ValueError, match="cannot be told from a point"):
            bubble_to_bubble(source, target, turn=turn)
    else:
        check_bubbles(bubble_to_bubble(source, target, turn=turn), source, source.normal, target)


@given(LONLAT, st.floats(-11, 1.9), LONLAT, st.floats(1, 179), st.floats(0, 360), st.floats(-17, 0))
@examples(0.2)
def test_points_next_to_the_rim(center, decades, other, radius, bearing, depth):
    """A point that lies inside by more than rounding goes where it should; one that does not is refused."""
    source, target = SphereCircle.around(center, 10.0**decades), SphereCircle.around(other, radius)
    start = source.sample(1)[0]
    edge = Rotation.about(source.normal, bearing)(start)
    alpha = np.arctan2(source.radius, source.offset)
    point = Rotation.about(np.cross(edge, source.normal), np.degrees(10.0**depth * alpha))(edge)
    n, rim = circle_of(source)
    inside = rim - angle(unit(point), n)
    if inside <= 1.9 * ACCURACY:
        with pytest.raises(ValueError, match=r"source_point must lie strictly inside .* by more than"):
            bubble_to_bubble(source, target, source_point=point)
    elif inside >= 2.1 * ACCURACY:
        check_bubbles(bubble_to_bubble(source, target, source_point=point), source, point, target)
