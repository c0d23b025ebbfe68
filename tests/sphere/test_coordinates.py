"""Longitude and latitude to directions and back: every bit, against 80 digits; sine and cosine of degrees."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel._double_double import DoubleDouble, stack, unit
from stereodel.sphere import lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.degrees import angle_degrees, sin_cos_degrees
from tests.exact import direction

LON = st.floats(-540, 540)
LAT = st.floats(-90, 90)


@given(LON, LAT)
def test_components_are_correctly_rounded(lon, lat):
    # Correct rounding is what makes the bits the same on every machine.
    x = lonlat_to_xyz([lon, lat])
    for got, want in zip(x, direction(lon, lat), strict=True):
        if abs(want) > 1e-50:  # 80 digits have no exact zero at multiples of 90°
            assert abs(got - want) <= mpmath.mpf(np.spacing(abs(got))) / 2 * (1 + mpmath.mpf(2) ** -40)


HARD = [
    *[(-158.541201, 61.288068), (-92.647732, -34.149795), (177.26967, -13.213355)],
    *[(89.749361, -12.513244), (74.66785, -59.837665), (128.940741, -5.78789)],
    *[(-157.882427, 51.384385), (160.248339, -14.323696), (-161.715084, 85.167008)],
]
"""Three with x, three with y, three with z so close to the middle of two doubles that the first stage rounds wrong."""


def angles_of_all_kinds(rng, count):
    """Anywhere, on and beside the steps of the kernel's table and half-way between them, tiny."""
    steps = rng.integers(-2048, 2049, count) * (45 / 512)
    kinds = [
        rng.uniform(-360, 360, count),
        steps,
        np.nextafter(steps, rng.choice([-np.inf, np.inf], count)),
        steps * (1 + rng.uniform(-1e-9, 1e-9, count)),
        rng.uniform(-1, 1, count) * 10.0 ** rng.uniform(-323, 0, count),
        rng.choice([0.0, -0.0, 5e-324, 2.0**-400, np.nextafter(2.0**-400, 0)], count),
    ]
    return np.choose(rng.integers(0, len(kinds), count), kinds)


def test_both_stages_of_the_kernel_round_alike(rng):
    uniform = np.stack([rng.uniform(-180, 180, 200_000), rng.uniform(-90, 90, 200_000)], axis=-1)
    lon, lat = angles_of_all_kinds(rng, 100_000), angles_of_all_kinds(rng, 100_000)
    for lonlat in (np.array(HARD), uniform, np.stack([lon, np.where(np.abs(lat) > 90, lat / 4, lat)], axis=-1)):
        (sin_lon, cos_lon), (sin_lat, cos_lat) = (sin_cos_degrees(lonlat[:, k]) for k in range(2))
        accurate = stack([cos_lat * cos_lon, cos_lat * sin_lon, sin_lat]).round() + 0.0
        assert lonlat_to_xyz(lonlat).tobytes() == accurate.tobytes()


def test_multiples_of_90_are_exact_and_never_minus_zero():
    grid = [[lon, lat] for lon in range(-720, 721, 90) for lat in (-90, 0, 90)]
    x = lonlat_to_xyz(grid)
    assert set(np.unique(x)) == {-1.0, 0.0, 1.0}
    assert not np.signbit(x[x == 0]).any()
    assert (np.abs(x).sum(axis=1) == 1).all()


@given(st.integers(-180 * 32, 180 * 32), st.integers(-90 * 32, 90 * 32))
def test_mirror_symmetry_is_exact(lon, lat):
    lon, lat = lon / 32, lat / 32
    x, y, z = lonlat_to_xyz([lon, lat])
    assert lonlat_to_xyz([-lon, lat]).tolist() == [x, -y, z]
    assert lonlat_to_xyz([lon, -lat]).tolist() == [x, y, -z]
    assert lonlat_to_xyz([180 - lon, lat]).tolist() == [-x, y, z]
    assert lonlat_to_xyz([90 - lon, lat]).tolist() == [y, x, z]


@pytest.mark.parametrize(
    ("vector", "lonlat"),
    [
        ([0, 0, 5], (0, 90)),
        ([-0.0, -0.0, -5], (0, -90)),
        ([-1, 0, 0], (-180, 0)),
        ([-1, -0.0, 0], (-180, 0)),
        ([0, -1e300, 0], (-90, 0)),
        ([5e-324, 5e-324, 0], (45, 0)),
        ([3e-324, 0, 1], (0, 90)),
        ([0, 5e-324, -1], (90, -90)),
    ],
)
def test_special_directions(vector, lonlat):
    assert tuple(xyz_to_lonlat(vector)) == lonlat


@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(any), st.sampled_from([1.0, 1e-9, 1e-30, 1e-200]), st.integers(0, 2))
def test_places_are_within_an_ulp(vector, small, axis):
    v = np.array(vector)
    v[axis] *= small
    if 0 < np.abs(v[v != 0]).min(initial=1.0) < 1e-250 or not v.any():
        return
    x, y, z = (mpmath.mpf(float(c)) for c in v)
    lon, lat = mpmath.degrees(mpmath.atan2(y, x)), mpmath.degrees(mpmath.atan2(z, mpmath.hypot(x, y)))
    got = xyz_to_lonlat(v)
    assert abs(mpmath.mpf(float(got[1])) - lat) <= 0.51 * np.spacing(abs(got[1]))
    if abs(got[0]) < 180 and (x, y) != (0, 0):
        assert abs(mpmath.mpf(float(got[0])) - lon) <= 0.51 * np.spacing(abs(got[0]))


BESIDE = st.integers(-16, 16).map(lambda k: np.nextafter(45.0 * k, 1e3))


def exact(value: DoubleDouble, index=()):
    return mpmath.mpf(float(value.hi[index])) + mpmath.mpf(float(value.lo[index]))


@given(st.floats(-720, 720) | st.floats(-1e300, 1e300) | BESIDE)
def test_relative_error_below_2_to_minus_101(angle):
    sine, cosine = sin_cos_degrees(np.array(angle))
    turn = mpmath.mpf(float(np.fmod(angle, 360))) * mpmath.pi / 180
    for value, truth in ((sine, mpmath.sin(turn)), (cosine, mpmath.cos(turn))):
        # 80 digits leave an absolute error where the truth is 0.
        assert abs(exact(value) - truth) <= abs(truth) * mpmath.mpf(2) ** -101 + mpmath.mpf(10) ** -57


@given(st.floats(-179.999, 180).filter(lambda v: v == 0 or abs(v) > 1e-290), st.floats(1e-3, 1e3))
def test_angle_is_the_inverse(angle, length):
    sine, cosine = sin_cos_degrees(np.array(angle))
    assert abs(angle_degrees(sine * length, cosine * length) - angle) <= np.spacing(abs(angle))


@given(LON, LAT, st.one_of(st.just(1.0), st.floats(-8e-15, 8e-15).map(lambda x: 1 + x), st.floats(1e-290, 1e290)))
def test_directions_have_an_error_below_2_to_minus_102(lon, lat, length):
    """Of vectors of length 1 to rounding and of others: also beside one another, and with the same bits."""
    vector = lonlat_to_xyz([lon, lat]) * length
    found, among = unit(vector), unit(np.stack([[3.0, 4.0, 5.0], vector, [0.0, 0.6, 0.8]]))
    with mpmath.workdps(80):
        components = [mpmath.mpf(x) for x in vector.tolist()]
        size = mpmath.sqrt(sum(x * x for x in components))
        for k, x in enumerate(components):
            assert abs(exact(found, k) - x / size) < mpmath.mpf(2) ** -102
            assert abs(found.lo[k]) <= np.spacing(abs(found.hi[k])) / 2
    assert np.array_equal(among.hi[1], found.hi)
    assert np.array_equal(among.lo[1], found.lo)
