"""Datasets as models of ocean, atmosphere and sky write them: coordinates are found, all variables interpolated."""

import mpmath
import numpy as np
import pytest
import xarray as xr
from cdshealpix.nested import healpix_to_lonlat as nested_centres
from cdshealpix.ring import healpix_to_lonlat as ring_centres

from stereodel import lonlat_to_xyz
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator
from stereodel.interpolation import weights as of_weights
from stereodel.xarray import healpix
from tests.interpolation.known import known

PLACES = {"lon": [3.0, 7.5, 12.25], "lat": [41.0, 44.5]}
AT = np.stack(np.meshgrid(PLACES["lon"], PLACES["lat"]), axis=-1)
BENT = np.stack(np.meshgrid(np.linspace(-4, 20, 13), np.linspace(35, 50, 11)), axis=-1)
BENT = BENT + 0.05 * BENT[..., ::-1] % 0.7
"""Longitude and latitude of a curvilinear grid, (11, 13, 2)."""
CELLS = BENT.reshape(-1, 2)


def field(lonlat, *leading):
    """A smooth function of place, of another size at each index of the leading dimensions."""
    sizes = np.arange(float(np.prod(leading))).reshape(leading)
    return np.add.outer(sizes, known(lonlat_to_xyz(lonlat)))


def expected(lonlat, values, kind=LinearInterpolator):
    """(leading, 2, 3), one field after the other."""
    points = lonlat.reshape(-1, 2)
    fields = values.reshape(-1, len(points))
    found = [kind.from_lonlat(points, each)(lonlat=AT) for each in fields]
    return np.reshape(found, (*values.shape[: values.ndim - lonlat.ndim + 1], *AT.shape[:2]))


def nemo():
    """Curvilinear, with auxiliary coordinates by name, units and the attribute of the variables."""
    where = {"coordinates": "time_centered nav_lat nav_lon"}
    return xr.Dataset(
        {
            "nav_lon": (("y", "x"), BENT[..., 0], {"units": "degrees_east", "standard_name": "longitude"}),
            "nav_lat": (("y", "x"), BENT[..., 1], {"units": "degrees_north", "standard_name": "latitude"}),
            "votemper": (("time_counter", "deptht", "y", "x"), field(BENT, 2, 3).astype("f4"), where | {"units": "K"}),
            "sossheig": (("time_counter", "y", "x"), field(BENT, 2), where),
            "tmask": (("y", "x"), np.ones((11, 13), dtype=np.int8)),
            "nav_lev": ("deptht", [0.5, 1.5, 2.6]),
            "e1_of_rows": ("y", np.arange(11.0)),
        },
        {"time_counter": [0.0, 1.0]},
        {"title": "made up"},
    )


def wrf(moving=False):
    """Coordinates with the dimension Time, and variables on a staggered grid with its own."""
    lonlat = np.stack([BENT, BENT + (0.1 if moving else 0.0)])
    staggered = np.pad(lonlat, ((0, 0), (0, 0), (0, 1), (0, 0)), mode="edge")
    grid, wide = ("Time", "south_north", "west_east"), ("Time", "south_north", "west_east_stag")
    return xr.Dataset(
        {
            "T2": (grid, field(BENT, 2), {"coordinates": "XLONG XLAT XTIME", "units": "K"}),
            "U": (wide, np.ones((2, 11, 14))),
            "P_TOP": ("Time", [5000.0, 5000.0]),
        },
        {
            "XLONG": (grid, lonlat[..., 0], {"units": "degree_east"}),
            "XLAT": (grid, lonlat[..., 1], {"units": "degree_north"}),
            "XLONG_U": (wide, staggered[..., 0], {"units": "degree_east"}),
            "XLAT_U": (wide, staggered[..., 1], {"units": "degree_north"}),
        },
    )


def mpas():
    """Cells in radians, among the variables; those of vertices with nothing on them."""
    radians = np.radians(CELLS)
    return xr.Dataset(
        {
            "lonCell": ("nCells", radians[:, 0], {"units": "rad"}),
            "latCell": ("nCells", radians[:, 1], {"units": "rad"}),
            "lonVertex": ("nVertices", np.zeros(7), {"units": "rad"}),
            "latVertex": ("nVertices", np.zeros(7), {"units": "rad"}),
            "temperature": (("Time", "nCells", "nVertLevels"), np.moveaxis(field(CELLS, 2, 3), -1, 1)),
            "indexToCellID": ("nCells", np.arange(1, len(CELLS) + 1, dtype="i4")),
            "verticesOnCell": (("nCells", "maxEdges"), np.zeros((len(CELLS), 6), dtype="i4")),
        }
    )


def ask(dataset, **options):
    return dataset.stereodel.interpolate(**PLACES, **options)


def test_an_ocean_model_on_a_curvilinear_grid():
    ocean = nemo()
    with pytest.warns(UserWarning, match="left out, without numbers at all points of the source: e1_of_rows"):
        found = ask(ocean)
    assert set(found.data_vars) == {"votemper", "sossheig", "tmask", "nav_lev"}
    assert found.votemper.dims == ("time_counter", "deptht", "lat", "lon")
    assert np.array_equal(found.votemper, expected(BENT, ocean.votemper.values))
    assert np.array_equal(found.sossheig, expected(BENT, ocean.sossheig.values))
    assert (found.tmask == 1).all()
    assert found.nav_lev.identical(ocean.nav_lev)
    assert found.votemper.attrs["units"] == "K"
    assert found.attrs == {"title": "made up"}
    assert np.array_equal(found.time_counter, [0, 1])
    # As a file that is opened with its coordinates decoded has them; and one array with the grid from another file.
    decoded = ocean.set_coords(["nav_lon", "nav_lat"]).votemper
    alone = ocean[["votemper"]].votemper.stereodel.interpolate(**PLACES, source=(ocean.nav_lon, ocean.nav_lat))
    for other in (decoded.stereodel.interpolate(**PLACES), alone):
        assert np.array_equal(other, found.votemper)
    with pytest.raises(ValueError, match="there is none; name two by source=, ask the whole dataset"):
        ocean.votemper.stereodel.interpolate(**PLACES)
    ocean.nav_lon.attrs, ocean.nav_lat.attrs = {}, {}  # known by their names alone
    assert np.array_equal(ask(ocean.drop_vars("e1_of_rows")).votemper, found.votemper)


def test_weights_are_made_once(monkeypatch):
    made = []

    class Counted(of_weights.Weights):
        def __post_init__(self):
            made.append(self)
            super().__post_init__()

    monkeypatch.setattr(of_weights, "Weights", Counted)
    ask(nemo().drop_vars("e1_of_rows"))
    assert len(made) == 1


@pytest.mark.parametrize("times", [1, 2])
def test_an_atmosphere_model_whose_coordinates_have_a_time(times):
    air = wrf().isel(Time=slice(times))
    found = air.T2.stereodel.interpolate(**PLACES, method="natural")
    assert found.dims == ("Time", "lat", "lon")
    assert np.array_equal(found, expected(BENT, air.T2.values, NaturalNeighborInterpolator))
    with pytest.raises(ValueError, match="there are several: XLONG, XLONG_U; name two by source="):
        ask(air.drop_vars("P_TOP").assign(T2=air.T2.drop_attrs()))
    with pytest.warns(UserWarning, match="left out.*: U, P_TOP|left out.*: U$"):
        both = ask(air)  # T2 names its coordinates, U does not
    assert np.array_equal(both.T2, ask(air.drop_vars(["U"])).T2)
    assert np.array_equal(both.P_TOP, air.P_TOP)


def test_stations_with_a_time_of_one_step_and_points_that_move_in_time():
    coords = {name: (("Time", "station"), CELLS[None, :, k]) for k, name in enumerate(("XLONG", "XLAT"))}
    values = xr.DataArray(field(CELLS, 1), coords, ("Time", "station"))
    assert np.array_equal(values.stereodel.interpolate(**PLACES), expected(CELLS, values.values))
    moving = wrf(moving=True).T2
    with pytest.raises(ValueError, match=r"move along 'Time'; take one time, isel\(Time=0\)"):
        moving.stereodel.interpolate(**PLACES)
    still = moving.isel(Time=0)
    assert np.array_equal(still.stereodel.interpolate(**PLACES), expected(BENT, still.values))


def test_cells_in_radians():
    mesh = mpas()
    found = ask(mesh)
    wanted = expected(CELLS, np.moveaxis(mesh.temperature.values, 1, -1))
    assert found.temperature.dims == ("Time", "nVertLevels", "lat", "lon")
    assert np.allclose(found.temperature.transpose("Time", "nVertLevels", "lat", "lon"), wanted, rtol=1e-13)
    assert found.verticesOnCell.dims == ("maxEdges", "lat", "lon")
    assert "lonCell" not in found
    assert found.lonVertex.identical(mesh.lonVertex)
    back = found.temperature.stereodel.interpolate(lon=mesh.lonCell, lat=mesh.latCell)
    assert back.dims == ("Time", "nVertLevels", "nCells")
    assert back.lonCell.variable.identical(mesh.lonCell.variable)
    inside = np.isfinite(back.isel(Time=0, nVertLevels=0))
    assert 0 < inside.sum() < len(CELLS)
    mesh["vorticity"] = ("nVertices", np.ones(7))
    with pytest.raises(ValueError, match="longitude, but there are several: lonCell, lonVertex; name two by source="):
        ask(mesh)
    assert ask(mesh, source=("lonCell", "latCell")).vorticity.identical(mesh.vorticity)


def test_degrees_of_radians_are_the_nearest_doubles(rng):
    values = nemo().votemper[0, 0].assign_coords(lon=nemo().nav_lon, lat=nemo().nav_lat)
    radians = [rng.uniform(*sides, size=200) * np.pi / 180 for sides in ((0, 15), (38, 48))]
    with mpmath.workprec(200):
        degrees = [np.array([float(mpmath.degrees(mpmath.mpf(float(x)))) for x in each]) for each in radians]
    assert any((np.degrees(x) != y).any() for x, y in zip(radians, degrees, strict=True))
    asked = [xr.DataArray(x, dims="place", attrs={"units": "radians"}) for x in radians]
    plain = [xr.DataArray(x, dims="place") for x in degrees]
    found, wanted = (values.stereodel.interpolate(lon=lon, lat=lat) for lon, lat in (asked, plain))
    assert np.isfinite(wanted).any()
    assert np.array_equal(found, wanted, equal_nan=True)


@pytest.mark.parametrize(
    ("lon", "lat", "units"),
    [
        *(("lon_rho", "lat_rho", ""), ("TLONG", "TLAT", ""), ("geolon", "geolat", ""), ("glamt", "gphit", "")),
        *(("lonc", "latc", ""), ("clon", "clat", "radian"), ("x", "y", "degrees")),
        ("east", "north", "degrees_"),  # the conventions come before names
    ],
)
def test_names_and_units_of_other_models(lon, lat, units):
    scale = np.pi / 180 if units == "radian" else 1.0
    rules = [{"units": units, "axis": axis} if units else {} for axis in "XY"]
    if units == "degrees_":
        rules = [{"units": f"degrees_{way}"} for way in (lon, lat)]
    data = {
        lon: ("node", CELLS[:, 0] * scale, rules[0]),
        lat: ("node", CELLS[:, 1] * scale, rules[1]),
        "zeta": ("node", field(CELLS)),
        "latent_heat": ("node", field(CELLS)),
        "rlon": ("node", CELLS[:, 0] * 0, {"standard_name": "grid_longitude", "units": "degrees", "axis": "X"}),
    }
    named = dict.fromkeys(("lon", "lat"), ("node", 0 * CELLS[:, 0])) if lon == "east" else {}
    found = ask(xr.Dataset(data | named))
    assert np.allclose(found.zeta, expected(CELLS, field(CELLS)), rtol=1e-13)
    assert np.array_equal(found.latent_heat, found.zeta)


@pytest.mark.parametrize(("order", "centres"), [("nested", nested_centres), ("ring", ring_centres)])
def test_pixels_of_healpix(order, centres):
    pixels = np.arange(12 * 16**2, dtype=np.uint64)
    lon, lat = (each.to_value("deg") for each in (centres(pixels, 4 if order == "nested" else 16)))
    own = healpix(16, order=order)
    turned = (own["lon"].values - lon + 180) % 360 - 180
    assert np.abs(turned).max() < 1e-12
    assert np.abs(own["lat"].values - lat).max() < 1e-12
    sky = xr.Dataset({"t": ("cell", field(np.column_stack([lon, lat]))), "mask": ("cell", pixels.astype("i4") * 0)})
    with pytest.raises(ValueError, match=r"there is none; .* by healpix\(nside\)"):
        ask(sky)
    found = ask(sky.assign_coords(own))
    assert np.allclose(found.t, known(lonlat_to_xyz(AT)), atol=0.01)
    assert (found.mask == 0).all()
    onto = found.t.stereodel.interpolate(**healpix(nside=8, order=order, dim="pixel"), extrapolate="nearest")
    assert onto.dims == ("pixel",)
    assert onto.sizes == {"pixel": 768}


def test_what_healpix_cannot_be_is_said():
    with pytest.raises(ValueError, match=r'nside is 3, but must be a power of two for nested order; or give order="r'):
        healpix(3)
    assert healpix(3, order="ring")["lat"].sizes == {"cell": 108}
    with pytest.raises(ValueError, match="order is 'nest', but must be one of 'nested', 'ring'"):
        healpix(2, order="nest")


def test_a_dataset_without_numbers_at_the_points():
    words = nemo()[["nav_lon", "nav_lat"]].assign(name=(("y", "x"), np.full((11, 13), "sea")))
    with pytest.raises(ValueError, match="no variable has numbers at the points of the source, along y, x"):
        ask(words)
