"""`griddata` against SciPy's and against the interpolators."""

import numpy as np
import pytest
import scipy.interpolate

from stereodel.interpolation import (
    griddata,
)
from tests.interpolation.known import KINDS


@pytest.mark.parametrize("method", ["linear", "nearest"])
@pytest.mark.parametrize("fill_value", [np.nan, -7.0])
def test_values_are_those_of_scipy(method, fill_value, rng):
    points, values = rng.random((100, 2)), rng.normal(size=(100, 2))
    x, y = np.meshgrid(np.linspace(-0.2, 1.2, 31), np.linspace(-0.2, 1.2, 23))
    ours = griddata(points, values, (x, y), method=method, fill_value=fill_value)
    theirs = scipy.interpolate.griddata(points, values, (x, y), method=method, fill_value=fill_value)
    assert ours.shape == theirs.shape == (23, 31, 2)
    assert np.allclose(ours, theirs, rtol=0, atol=1e-9, equal_nan=True)
    by_columns = griddata(tuple(points.T), values, np.stack([x, y], axis=-1), method=method, fill_value=fill_value)
    assert np.array_equal(by_columns, ours, equal_nan=True)


@pytest.mark.parametrize("method", KINDS)
def test_methods_are_the_interpolators(method, rng):
    lonlat, values = np.column_stack([rng.uniform(-50, 50, 80), rng.uniform(-40, 40, 80)]), rng.normal(size=80)
    targets = np.column_stack([rng.uniform(-90, 90, 50), rng.uniform(-60, 60, 50)])
    expected = KINDS[method].from_lonlat(lonlat, values, latitude="geodetic")(lonlat=targets)
    found = griddata(lonlat, values, targets, method=method, latitude="geodetic")
    assert np.array_equal(found, expected, equal_nan=True)
    filled = griddata(lonlat, values, tuple(targets.T), method=method, latitude="geodetic", fill_value=9)
    assert np.array_equal(filled, np.where(np.isnan(expected), 9, expected))


def test_what_is_not_known_is_not_filled():
    """Only what is outside is."""
    values = np.ma.masked_equal([1.0, 2.0, 3.0, -9.0], -9)
    found = griddata([[0, 0], [4, 0], [0, 4], [4, 4]], values, [[1, 1], [3, 3], [9, 9]], fill_value=0)
    assert np.array_equal(found, [1.75, np.nan, 0], equal_nan=True)


def test_other_methods_are_refused():
    with pytest.raises(ValueError, match=r"method is 'cubic', which SciPy has.*'smooth'"):
        griddata([[0, 0]], [1], [[0, 0]], method="cubic")
    with pytest.raises(ValueError, match="method is 'best', but must be one of 'nearest'"):
        griddata([[0, 0]], [1], [[0, 0]], method="best")
