"""The numbers at the door: what is taken, and taken exactly; any number of workers."""

import datetime as dt
from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, lonlat_to_xyz, xyz_to_lonlat
from stereodel._arrays import as_floats
from stereodel._numbers import as_doubles
from stereodel._tasks.threads import thread_count
from stereodel.conformal import fisheye
from stereodel.graphs import gabriel_graph
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator, SmoothInterpolator

ODD = 2**53 + 1  # the least whole number that is no double
THIRD = np.longdouble(1) / 3
LONG = np.finfo(np.longdouble).nmant > 52


def objects(*rows):
    return np.array(rows, dtype=object)


NO_NUMBERS = {
    "strings as objects": objects(["1", "2"], ["3", "4"]),
    "one string": objects([1.0, 2.0], [3.0, "4"]),
    "bytes": objects([b"1", b"2"]),
    "NumPy's strings": objects([np.str_("1"), 1.0]),
    "booleans as objects": objects([True, False]),
    "NumPy's booleans": objects([np.True_, 1.5]),
    "a boolean in a list": [[1.0, 2.0], [True, 3.0]],
    "a boolean among integers": [[1, 2], [3, True]],
    "a boolean as an array in a list": [[np.array(True), 1.0], [2.0, 3.0]],
    "NumPy's strings as arrays in a list": [[np.array("1", dtype=object), 1.0], [2.0, 3.0]],
    "time differences": np.array([[1, 2]], dtype="m8[s]"),
    "time differences as objects": objects([np.timedelta64(1, "s"), 1.0]),
    "Python's time differences": objects([dt.timedelta(1), 1.0]),
    "text columns": pd.DataFrame({"x": ["1", "2"], "y": ["3", "4"]}),
    "a text column": pd.DataFrame({"x": ["1", "2"], "y": [3.0, 4.0]}),
    "a column of booleans": pd.DataFrame({"x": [True, False], "y": [3.0, 4.0]}),
    "complex": objects([1j, 1.0]),
    "nothing": objects([None, 1.0]),
}
ROUNDED = {
    "negative": (np.array([[0, 1], [2, -ODD]]), "-9007199254740993"),
    "the largest": (np.array([[0, 1], [2, 2**64 - 1]], dtype=np.uint64), "18446744073709551615"),
    "arrays without dimensions": ([[0.5, 1.0], [np.array(2), np.array(ODD)]], "9007199254740993"),
    "beyond 64 bits": ([[0, 1], [2, 2**70 + 1]], "1180591620717411303425"),
    "beyond all doubles": ([[0, 1], [2, 10**309]], "1000"),
    "objects": (objects([0, 1], [2, np.int64(ODD)]), "9007199254740993"),
    "a table": (pd.DataFrame({"x": [0, 2], "y": [1, ODD]}), "9007199254740993"),
}
if LONG:  # on some machines a long double is a double
    ROUNDED |= {
        "long doubles": (np.array([[0, 1], [2, THIRD]]), "0.3333"),
        "long doubles as objects": (objects([0, 1], [2, THIRD]), "0.3333"),
        "long doubles in lists": ([[0, 1], [2, THIRD]], "0.3333"),
        "large long doubles": (np.array([[0, 1], [2, np.longdouble(2) ** 2000]]), "1.14"),
    }


@pytest.mark.parametrize("what", NO_NUMBERS)
def test_what_is_no_number_is_not_made_one(what):
    with pytest.raises(TypeError, match="points"):
        PlanarDelaunay(NO_NUMBERS[what])


@pytest.mark.parametrize("what", ROUNDED)
def test_what_no_double_equals_is_refused(what):
    values, shown = ROUNDED[what]
    with pytest.raises(ValueError, match=rf"points\[1, 1\] is {shown}.*, which no double equals; subtract an origin"):
        PlanarDelaunay(values)


SIGNED = st.one_of(st.integers(-(2**63), 2**63 - 1), st.integers(-(2**54), 2**54))


@pytest.mark.parametrize(("dtype", "integers"), [(np.int64, SIGNED), (np.uint64, st.integers(0, 2**64 - 1))])
@given(data=st.data())
def test_integers_are_taken_exactly_or_refused(dtype, integers, data):
    numbers = data.draw(st.lists(integers, min_size=1))
    exact = all(int(float(n)) == n for n in numbers)
    for given_numbers in (np.array(numbers, dtype=dtype), numbers, [*numbers, 0.5], np.array(numbers, dtype=object)):
        if exact:
            assert [int(x) for x in as_floats(given_numbers, "x")[: len(numbers)]] == numbers
        else:
            first = next(n for n in numbers if int(float(n)) != n)
            with pytest.raises(ValueError, match=rf"x\[{numbers.index(first)}\] is {first}, which no double equals"):
                as_floats(given_numbers, "x")


def test_what_doubles_hold_is_taken():
    for values, expected in [
        (np.array([2**60, -(2**63)]), [2.0**60, -(2.0**63)]),
        ([2**70, 1], [2.0**70, 1.0]),
        ([0, 1, 0.5, 1e300], [0.0, 1.0, 0.5, 1e300]),
        (np.array([0.1, 2.0**900], dtype=np.longdouble), [0.1, 2.0**900]),
        ([np.float32(0.1), 1], [float(np.float32(0.1)), 1.0]),
        ([[np.array(1.5), 2], [np.array(Fraction(1, 2), dtype=object), np.array(4)]], [[1.5, 2.0], [0.5, 4.0]]),
        ([np.arange(3.0), np.ones(3)], [[0.0, 1.0, 2.0], [1.0, 1.0, 1.0]]),
        (pd.DataFrame({"x": [1, 2], "y": [0.5, 1.5]}), [[1.0, 0.5], [2.0, 1.5]]),
        (np.zeros((0, 2), dtype=object), np.zeros((0, 2))),
        ([], []),
    ]:
        assert np.array_equal(as_floats(values, "x"), expected)
        assert as_floats(values, "x").dtype == np.float64


def test_fractions_and_decimals_are_rounded_to_nearest():
    values = objects([Fraction(1, 3), Decimal("0.1")], [mpmath.mpf(1) / 3, Fraction(2**54 + 1, 2**54)])
    assert as_floats(values, "x").tolist() == [[1 / 3, 0.1], [1 / 3, 1.0]]
    for huge, shown in ((Fraction(10**400), "inf"), (Fraction(-(10**400)), "-inf")):
        assert as_doubles(huge, "x") == float(shown)
        with pytest.raises(ValueError, match=rf"x\[0\] is {shown}"):
            as_floats([huge], "x")


PLANE, SPHERE = np.random.default_rng(0).random((3000, 2)), np.random.default_rng(1).normal(size=(3000, 3))
CALLS = {
    "PlanarDelaunay": lambda w: PlanarDelaunay(PLANE, workers=w).simplices,
    "circumcenters": lambda w: SphericalDelaunay(SPHERE, workers=w).circumcenters,
    "find_simplex": lambda w: PlanarDelaunay(PLANE).find_simplex(PLANE, workers=w),
    "nearest": lambda w: SphericalDelaunay(SPHERE).nearest(SPHERE, workers=w),
    "k nearest": lambda w: PlanarDelaunay(PLANE).nearest(PLANE, k=3, workers=w),
    "PlanarVoronoi": lambda w: PlanarVoronoi(PLANE, workers=w).areas(),
    "gabriel_graph": lambda w: gabriel_graph(PLANE, workers=w),
    "lonlat_to_xyz": lambda w: lonlat_to_xyz(PLANE, workers=w),
    "xyz_to_lonlat": lambda w: xyz_to_lonlat(SPHERE, workers=w),
    "images": lambda w: fisheye((0, 0), magnification=3.0)(SPHERE, workers=w),
    "images of places": lambda w: fisheye((0, 0), magnification=3.0).lonlat(PLANE, workers=w),
    "scale_factor": lambda w: fisheye((0, 0), magnification=3.0).scale_factor(SPHERE, workers=w),
    "linear": lambda w: LinearInterpolator(PLANE, PLANE[:, 0])(PLANE[::7], workers=w),
    "smooth": lambda w: SmoothInterpolator(PLANE, PLANE[:, 0])(PLANE[::7], workers=w),
    "gradients": lambda w: NaturalNeighborInterpolator(PLANE, PLANE[:, 0]).gradient(PLANE[::7] + 0.001, workers=w),
    "natural neighbours": lambda w: NaturalNeighborInterpolator(PLANE, PLANE[:, 0])(PLANE[::7], workers=w),
}


@pytest.mark.parametrize("call", CALLS)
def test_any_number_of_workers(call):
    expected = CALLS[call](1)
    for workers in (2, np.int64(3), None, -1, 10**6, 2**31, 10**30):
        assert np.array_equal(CALLS[call](workers), expected, equal_nan=True)


def test_workers_that_are_no_number_of_threads():
    for wrong in (0, -2, -(10**30)):
        with pytest.raises(ValueError, match="workers is"):
            thread_count(wrong, 10)
    for wrong in (1.5, "2", True, [2]):
        with pytest.raises(TypeError, match="workers must be one integer"):
            thread_count(wrong, 10)
