"""Other doors to the interpolators: the accessor of DataArrays; `griddata` as SciPy has it."""

import dask
import dask.array
import numpy as np
import pytest
import scipy.interpolate
import xarray as xr

import stereodel.interpolation
import stereodel.spatial
import stereodel.xarray
from stereodel import SphericalDelaunay
from stereodel.interpolation import LinearInterpolator, griddata
from tests.interpolation.known import KINDS

LON, LAT = np.linspace(-10, 10, 5), np.linspace(-8, 8, 3)
GRID = np.stack(np.meshgrid(LON, LAT), axis=-1)


@pytest.fixture
def lonlat():
    return np.random.default_rng(1).uniform(-30, 30, (50, 2))


@pytest.fixture
def stations(lonlat):
    """Four times, fifty stations, three levels."""
    coords = {name: ("station", lonlat[:, k]) for k, name in enumerate(("lon", "lat"))}
    coords |= {"time": np.arange(4), "code": ("station", np.arange(50)), "source": "made up"}
    values = np.random.default_rng(2).normal(size=(4, 50, 3))
    values[1, 7, 1] = np.nan
    return xr.DataArray(values, coords, ("time", "station", "level"), "t", {"units": "K"})


@pytest.mark.parametrize("method", KINDS)
@pytest.mark.parametrize(
    "order", [("time", "station", "level"), ("station", "level", "time"), ("level", "time", "station")]
)
def test_the_accessor_gives_a_grid(method, order, stations, lonlat):
    """For axes as lists; whatever the order of dimensions."""
    found = stations.transpose(*order).stereodel.interpolate(lon=LON, lat=LAT, method=method, latitude="geodetic")
    values = np.moveaxis(stations.values, 1, 0)
    expected = KINDS[method].from_lonlat(lonlat, values, latitude="geodetic")(lonlat=GRID)
    assert found.dims == (*(name for name in order if name != "station"), "lat", "lon")
    assert np.array_equal(found.transpose("lat", "lon", "time", "level"), expected, equal_nan=True)
    assert np.isnan(expected).any()
    assert found.name == "t"
    assert found.attrs == {"units": "K"}
    assert set(found.coords) == {"lon", "lat", "time", "source"}
    assert np.array_equal(found.lon, LON)
    assert np.array_equal(found.lat, LAT)


@pytest.mark.parametrize("method", KINDS)
def test_lazy_values_stay_lazy(method, stations):
    """Nothing is computed before it is asked for, and the weights are made once."""
    lazy = stations.copy(data=dask.array.from_array(stations.values, chunks=(1, 20, 2)))
    with dask.config.set(scheduler=refused):
        found = lazy.stereodel.interpolate(lon=LON, lat=LAT, method=method)
    assert isinstance(found.data, dask.array.Array)
    assert found.shape == (4, 3, 3, 5)
    expected = stations.stereodel.interpolate(lon=LON, lat=LAT, method=method)
    computed = found.compute(scheduler="synchronous")
    xr.testing.assert_identical(xr.zeros_like(computed), xr.zeros_like(expected))
    xr.testing.assert_allclose(computed, expected, rtol=1e-13)  # fitted gradients: sums of several fields at once


def refused(*_, **__):
    raise AssertionError("computed too early")


def test_points_and_curvilinear_grids(stations, lonlat):
    linear = LinearInterpolator.from_lonlat(lonlat, np.moveaxis(stations.values, 1, 0))
    phi = xr.DataArray(LAT, dims="place", name="phi", attrs={"units": "degrees_north"})
    found = stations.stereodel.interpolate(lon=xr.DataArray(LON[:3], dims="place"), lat=phi)
    assert found.dims == ("time", "level", "place")
    expected = np.moveaxis(linear(lonlat=np.column_stack([LON[:3], LAT])), 0, -1)
    assert np.array_equal(found, expected, equal_nan=True)
    assert np.array_equal(found.lon, LON[:3])
    assert found.phi.attrs == {"units": "degrees_north"}
    bent = [xr.DataArray(GRID[..., k] + GRID[..., 1 - k] / 9, dims=("y", "x")) for k in (0, 1)]
    found = stations.isel(time=0, level=0).stereodel.interpolate(lon=bent[0], lat=bent[1])
    assert found.dims == ("y", "x")
    assert found.lon.dims == ("y", "x")
    expected = linear(lonlat=np.stack(bent, axis=-1))[..., 0, 0]
    assert np.array_equal(found, expected, equal_nan=True)


@pytest.mark.parametrize("names", [("longitude", "latitude"), ("x", "y")])
def test_the_source_may_be_a_grid(names):
    """Its coordinates found by name, standard name or units; a global one closes at the antimeridian."""
    lon, lat = np.arange(0, 360, 30.0), np.arange(-60, 61, 30.0)
    attrs = [{"standard_name": "longitude"}, {"units": "degrees_north"}] if names[0] == "x" else [{}, {}]
    coords = {names[0]: (names[0], lon, attrs[0]), names[1]: (names[1], lat, attrs[1])}
    values = np.random.default_rng(1).normal(size=(len(lat), len(lon)))
    grid = xr.DataArray(values, coords, (names[1], names[0]))
    points = np.stack(np.meshgrid(lon, lat), axis=-1).reshape(-1, 2)
    expected = LinearInterpolator.from_lonlat(points, values.ravel())(lonlat=(345, 10))
    assert grid.stereodel.interpolate(lon=-15.0, lat=10.0).item() == pytest.approx(expected, rel=1e-14)
    assert grid.T.stereodel.interpolate(lon=-15.0, lat=10.0).item() == pytest.approx(expected, rel=1e-14)
    same = grid.stereodel.interpolate(lon=lon[:3], lat=lat)
    assert np.array_equal(same, values[:, :3])


def test_one_place_and_extrapolation(stations, lonlat):
    far = stations.stereodel.interpolate(lon=80.0, lat=0.0, extrapolate="nearest")
    assert far.dims == ("time", "level")
    assert far.lon.item() == 80.0
    assert np.array_equal(far, stations.isel(station=int(np.argmax(lonlat[:, 0]))))
    assert np.isnan(stations.stereodel.interpolate(lon=80.0, lat=0.0)).all()


def test_what_cannot_be_found_is_said(stations):
    twice = stations.assign_coords(longitude=("station", np.zeros(50)))
    named = twice.stereodel.interpolate(lon=LON, lat=LAT, source=("lon", "lat"))
    assert np.array_equal(named, stations.stereodel.interpolate(lon=LON, lat=LAT), equal_nan=True)
    apart = {name: xr.DataArray(LON, {"p": LON + k}, "p") for k, name in enumerate(("lon", "lat"))}
    for given, options, message in (
        (stations.drop_vars("lon"), {}, "one coordinate of longitude, but there is none; name two by source="),
        (twice, {}, "there are several: lon, longitude"),
        (stations, {"source": ("l", "lat")}, "source names 'l', but the coordinates are lon, lat, time, code"),
        (stations, {"source": (xr.DataArray(LON, dims="q"),) * 2}, "the source has q, but the values have time, "),
        (stations, {"lon": xr.DataArray(LON, dims="time")}, "have the dimension 'time', which the values also have"),
        (stations, {"lon": GRID[..., 0]}, r"lon has shape \(3, 5\); give a DataArray"),
        (stations, apart, r"cannot align|conflict|join"),
    ):
        with pytest.raises(ValueError, match=message):
            given.stereodel.interpolate(**{"lon": LON, "lat": LAT} | options)


def test_the_accessor_is_there_by_one_import():
    assert isinstance(xr.DataArray(1).stereodel, stereodel.xarray.StereodelAccessor)


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


NAMED = {"LinearNDInterpolator": "linear", "CloughTocher2DInterpolator": "smooth", "NearestNDInterpolator": "nearest"}


@pytest.fixture
def field(rng):
    points = rng.random((400, 2))
    return points, np.sin(4 * points[:, 0]) + points[:, 1] ** 2, rng.uniform(-0.1, 1.1, (200, 2))


@pytest.mark.parametrize("name", NAMED)
def test_classes_by_scipys_names_are_griddata(name, field):
    points, values, places = field
    ours, theirs = (getattr(m, name) for m in (stereodel.interpolation, scipy.interpolate))
    function = ours(points, values)
    found = function(places)
    assert np.array_equal(found, griddata(points, values, places, method=NAMED[name]), equal_nan=True)
    near = {"CloughTocher2DInterpolator": 2e-2}.get(name, 1e-12)  # another function, of the same smoothness
    assert np.allclose(found, theirs(points, values)(places), rtol=0, atol=near, equal_nan=True)
    for call in (function(*places.T), function(tuple(places.T)), function(places.tolist())):
        assert np.array_equal(call, found, equal_nan=True)
    assert np.array_equal(function(0.5, 0.5), function([0.5, 0.5]))
    assert np.array_equal(ours(tuple(points.T), values, -5.0)(places), np.where(np.isnan(found), -5.0, found))
    for triangulation in (function.tri, scipy.spatial.Delaunay(points), stereodel.spatial.Delaunay(points)):
        assert np.array_equal(ours(triangulation, values)(places), found, equal_nan=True)


def test_classes_by_scipys_names_on_the_sphere(lonlat):
    values = np.cos(np.radians(lonlat[:, 1]))
    function = stereodel.interpolation.LinearNDInterpolator(lonlat, values, latitude="geodetic")
    assert np.array_equal(function(LON[1:4], LAT), griddata(lonlat, values, (LON[1:4], LAT), latitude="geodetic"))
    directions = SphericalDelaunay.from_lonlat(lonlat).points
    assert stereodel.interpolation.NearestNDInterpolator(directions, values)(directions[3]) == values[3]
