"""Rasters through lenses: against many samples a pixel, at seams, poles and limb, and the rules of the interface."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import MoebiusMap, Rotation, _kernel, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel import _kernel_probe as probe
from stereodel.curves.view import StereographicView, View
from stereodel.globe import Raster
from tests.examples import examples
from tests.globe.sights import disc
from tests.globe.supersampling import checkerboard, grid, noise, psnr, reference, zone_plate
from tests.refused import refused
from tests.strategies import LONLAT, decades

PLAIN = MoebiusMap.identity()
MILD, STRONG = (fisheye((20.0, 40.0), magnification=size) for size in (4.0, 20.0))
RASTERS = {"squares": (checkerboard(256, 32), 39.0), "rings": (zone_plate(256), 41.0), "noise": (noise(256), 35.0)}
"""And the least signal-to-noise ratio, decibels, that any place has."""
PLACES = {
    "grown": (PLAIN, View(20, 40), 1024, (500, 480, 12, 12)),
    "as large": (PLAIN, View(20, 40), 256, (120, 120, 14, 14)),
    "limb above": (PLAIN, View(20, 40), 256, (120, 0, 14, 6)),
    "limb beside": (PLAIN, View(20, 40), 256, (250, 120, 6, 14)),
    "limb aslant": (PLAIN, View(20, 40), 256, (206, 30, 12, 12)),
    "pole": (PLAIN, View(20, 80), 128, (56, 46, 14, 14)),
    "pole in the middle": (PLAIN, View(20, -90), 128, (57, 57, 14, 14)),
    "pole, grown": (fisheye((0.0, 90.0), magnification=8.0), View(0, 90), 128, (57, 57, 14, 14)),
    "other pole, grown": (fisheye((0.0, -90.0), magnification=8.0), View(0, -90), 128, (57, 57, 14, 14)),
    "pole at the limb": (PLAIN, View(20, 1), 128, (58, 0, 12, 6)),
    "shrunk": (PLAIN, View(20, 40), 32, (0, 0, 14, 14)),
    "shrunk much": (PLAIN, View(20, 40), 12, (0, 0, 12, 12)),
    "antipode": (STRONG, View(200, -40), 128, (57, 57, 14, 14)),
    "flat": (MILD, StereographicView(20, 40, angular_radius=150), 128, (2, 60, 12, 8)),
}


def part(raster, lens, view, size, window):
    """A part (left, top, width, height) of a picture `size` pixels across."""
    left, top, width, height = window
    step = 2.0 / size
    return raster.painted(lens, view, (left * step - 1.0, 1.0 - top * step, step, step), (width, height))


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("kind", RASTERS)
def test_no_aliasing(kind, place):
    raster, least = RASTERS[kind]
    lens, view, size, window = PLACES[place]
    expected, covered = reference(raster, lens, view, size, window)
    found = part(Raster(raster), lens, view, size, window).astype(np.float64)
    assert psnr(expected, found[..., 0] * found[..., 3] / 255) > least
    # The reference counts samples; those in a pixel are off by the straightness of the limb and their number.
    assert np.abs(found[..., 3] / 255 - covered).max() < 0.05


@examples(0.5)
@given(st.integers(0, 511), st.floats(-90, 90), st.sampled_from([1.0, 5.0]))
def test_no_seam(columns, lat, magnification):
    """Turning the raster about the axis and looking from as much farther east is the same picture."""
    raster, turn = noise(256), columns * 360 / 512
    there = Raster(raster).warp(fisheye((0.0, 30.0), magnification=magnification), View(0.0, lat), 90)
    moved = fisheye((turn, 30.0), magnification=magnification)
    turned = Raster(np.roll(raster, columns, axis=1)).warp(moved, View(turn, lat), 90)
    # At odd columns the means of pairs are others; what they stand for is the same.
    assert psnr(there.astype(float), turned.astype(float)) > (60 if columns % 16 == 0 else 32)


@given(st.integers(0, 255), decades(-3, 3), LONLAT)
def test_one_colour_stays_one_colour(level, size, focus):
    raster = Raster(np.full((9, 18, 3), level, dtype=np.uint8))
    found = raster.warp(fisheye(focus, magnification=size), View(0, 0), 40)
    assert set(found[found[..., 3] > 0][:, :3].ravel().tolist()) == {level}


def lens_parts(lens, view):
    back = lens.inverse()
    return back.right.matrix @ view.matrix.T, back.magnification, back.left.matrix


def projected(view):
    """What the kernel is told of a view beside its axes."""
    if isinstance(view, View):
        return "orthographic", 0.0
    return "stereographic", np.tan(np.radians(view.angular_radius / 2))


@pytest.mark.parametrize("view", [View(17, 33, 20), StereographicView(17, 33, 20, angular_radius=170)])
@pytest.mark.parametrize("magnification", [1.0, 20.0, 1e3, 1e6, 1e-3])
def test_traced_points_are_those_of_the_exact_map(view, magnification):
    """Within a thousandth of a pixel on the page, of a globe of 2000 pixels, however strong the lens."""
    lens = fisheye((17.5, 33.2), magnification=magnification) @ MoebiusMap.rotation(Rotation.about((50, 60), 70))
    x = np.linspace(-0.9, 0.9, 401)
    traced = probe.trace_page(*lens_parts(lens, view), *projected(view), (-0.9, 0.31, 1.8 / 400, 1e-3), 401)
    exact = lens.inverse()(view.raised(np.stack([x, np.full(401, 0.31)], axis=-1)) @ view.matrix)
    found = lonlat_to_xyz(np.degrees(traced[:, :2]))
    scale = np.maximum(lens.scale_factor(exact), 1.0)
    assert (np.linalg.norm(found - exact, axis=-1) * scale).max() < 0.001 * 2 / 2000 * max(1, magnification / 1e3)


def gnomonic(ends):
    return np.column_stack([ends, np.ones(len(ends))]) / np.sqrt(1 + np.sum(ends**2, axis=1))[:, None]


def equirectangular(ends):
    """Right, up, ahead."""
    x, y, z = lonlat_to_xyz(np.degrees(ends)).T
    return np.column_stack([y, z, x])


FLAT = StereographicView(17, 33, 20, angular_radius=170)


@pytest.mark.parametrize(
    ("raised", "projection"),
    [
        (View(17, 33, 20).raised, projected(View(17, 33, 20))),
        (FLAT.raised, projected(FLAT)),
        (gnomonic, ("gnomonic", 0.0)),
        (equirectangular, ("equirectangular", 0.0)),
    ],
    ids=lambda given: given[0] if isinstance(given, tuple) else "",
)
def test_traced_changes_are_derivatives(raised, projection):
    view, lens, step = View(17, 33, 20), fisheye((40.0, 10.0), magnification=3.0), 1e-6
    for x, y in np.random.default_rng(3).uniform(-0.6, 0.6, (20, 2)):
        row = probe.trace_page(*lens_parts(lens, view), *projection, (x, y, step, step / 2), 1)[0]
        ends = np.array([[x + step, y], [x - step, y], [x, y + step], [x, y - step], [x, y]])
        east, west, north, south, at = np.radians(xyz_to_lonlat(lens.inverse()(raised(ends) @ view.matrix)))
        assert row[:2] == pytest.approx(at, abs=1e-8)
        assert row[[2, 4, 3, 5]] == pytest.approx([*(east - west) / 2, *(north - south) / 4], rel=1e-4, abs=1e-12)


def test_threads_and_windows_change_nothing():
    raster = Raster(np.dstack([noise(128), checkerboard(128, 8), zone_plate(128)]))
    whole = raster.warp(STRONG, View(30, 30), 200, workers=1)
    assert np.array_equal(raster.warp(STRONG, View(30, 30), 200, workers=3), whole)
    left, top, width, height = 37, 81, 120, 50
    window = part(raster, STRONG, View(30, 30), 200, (left, top, width, height))
    # A window's corner is rounded, so that a pixel may be rounded the other way.
    apart = window.astype(int) - whole[top : top + height, left : left + width]
    assert np.abs(apart).max() <= 1


@pytest.mark.parametrize("shape", [(7, 14), (45, 90), (64, 128), (100, 200), (1, 2)])
def test_levels_are_means_over_the_sphere(shape):
    height, width = shape
    texels = np.random.default_rng(2).integers(0, 256, (height, width, 4), dtype=np.uint8)
    levels = _kernel.raster_levels(texels, np.radians([-180.0, -90.0, 180.0, 90.0]), 2)
    edges = np.sin(np.pi / 2 - np.arange(height + 1) * np.pi / height)
    mean = np.average(texels.astype(float).mean(axis=1), axis=0, weights=-np.diff(edges))
    # One level of rounding in each of the last means.
    assert levels[-4:] == pytest.approx(mean, abs=1.5)


@pytest.mark.parametrize("latitude", ["spherical", "geodetic", "authalic"])
def test_latitudes_of_rows(latitude):
    """A wave 9° long, of which a fifth of a degree, the most that latitudes differ by, is an eighth of its height."""
    raster = Raster(np.round(127.5 + 120 * np.sin(40 * grid(512)[1])).astype(np.uint8), latitude=latitude)
    view, xy = View(50, 35), disc(201)
    inside = np.sum(xy**2, axis=-1) < 0.5
    lat = np.radians(xyz_to_lonlat(view.raised(xy[inside]) @ view.matrix, latitude=latitude)[:, 1])
    assert np.abs(raster.warp(PLAIN, view, 201)[inside][:, 0] - (127.5 + 120 * np.sin(40 * lat))).max() < 5


def test_part_of_the_globe():
    """A cut-out looks as the whole does there, has soft edges, and is transparent beyond them."""
    whole = zone_plate(180)
    part = Raster(whole[30:90, 200:300], (20.0, 0.0, 120.0, 60.0))
    view, size = View(60, 20), 200
    found, expected = (r.warp(PLAIN, view, size).astype(int) for r in (part, Raster(whole)))
    inside = found[..., 3] == 255
    assert np.abs(found - expected)[inside].max(axis=-1).mean() < 0.5
    xy = disc(size)
    seen = np.sum(xy**2, axis=-1) < 0.98
    lon, lat = xyz_to_lonlat(view.raised(xy[seen]) @ view.matrix).T
    clear = np.min([lon - 20, 120 - lon, lat, 60 - lat], axis=0)
    assert (found[seen][clear > 1.5][:, 3] == 255).all()
    assert (found[seen][clear < -1.5] == 0).all()
    soft = found[seen][np.abs(clear) < 1.5][:, 3]
    assert ((soft > 20) & (soft < 235)).mean() > 0.2


def test_a_part_across_the_date_line():
    part = Raster(np.full((10, 20), 99, dtype=np.uint8), (170.0, -10.0, 190.0, 10.0))
    found = part.warp(PLAIN, View(180, 0), 101)
    assert found[50, 50].tolist() == [99, 99, 99, 255]
    assert found[50, 20].tolist() == [0, 0, 0, 0]


def test_opacity_carries_no_colour_of_its_own():
    """Beside transparent texels, whatever their colour, the visible ones keep theirs."""
    texels = np.zeros((90, 180, 4), dtype=np.uint8)
    texels[:, 90:] = 200, 100, 50, 255
    texels[:, :90] = 0, 255, 0, 0
    for size in (40, 300):
        found = Raster(texels).warp(PLAIN, View(0, 20), size)
        shown = found[found[..., 3] > 40][:, :3]
        assert np.abs(shown - np.array([200, 100, 50])).max() <= 2


def test_gray_and_colour_agree():
    gray = noise(32)
    views = [
        Raster(a).warp(STRONG, View(0, 0), 60)
        for a in (gray, np.dstack([gray] * 3), np.dstack([gray] * 3 + [0 * gray + 255]))
    ]
    assert np.array_equal(views[0], views[1])
    assert np.array_equal(views[0], views[2])


def test_input_is_not_modified_and_not_shared():
    given = noise(16)
    raster = Raster(given)
    given[:] = 0
    assert raster.pixels.max() > 0
    with pytest.raises(ValueError, match="read-only"):
        raster.pixels[0, 0] = 1


NINE_BY_FOUR = np.zeros((4, 9), np.uint8)
test_bad_rasters_are_refused = refused(
    (np.zeros((4, 8)), None, "pixels must be of uint8, not float64", TypeError),
    (np.zeros((4, 8, 2), np.uint8), None, r"pixels must have shape \(h, w\), \(h, w, 3\) or"),
    (np.zeros((0, 8), np.uint8), None, "not empty"),
    (NINE_BY_FOUR, None, r"9 wide and 4 high; .* bounds=\(west, south, east, north\)"),
    (NINE_BY_FOUR, (0, 0, 361, 9), "bounds runs from longitude 0 to 361"),
    (NINE_BY_FOUR, (0, 9, 5, 0), "bounds runs from latitude 9 to 0"),
    (NINE_BY_FOUR, (0, 0, 5, 91), "bounds runs from latitude 0 to 91"),
    (NINE_BY_FOUR, (0, 0, 5), r"bounds must be \(west, south, east, north\)"),
    (NINE_BY_FOUR, (0, 0, 5, np.nan), "bounds"),
    (np.broadcast_to(np.uint8(0), (2**14, 2**14)), (0, 0, 1, 1), "make the picture smaller"),
    (np.zeros((4, 8), np.uint8), None, "geocentric", "latitude is 'geocentric'"),
    call=lambda pixels, bounds, *latitude: Raster(pixels, bounds, **({"latitude": latitude[0]} if latitude else {})),
)
test_bad_sizes_are_refused = refused(
    *((0, "size is 0"), (2.5, "size must be one integer", TypeError), (2**21, "size is 2097152")),
    call=lambda size: Raster(noise(4)).warp(PLAIN, View(0, 0), size),
)


@pytest.mark.parametrize("magnification", [1e-100, 1e-9, 1e9, 1e100])
def test_lenses_beyond_all_reason_give_a_picture(magnification):
    found = Raster(noise(32)).warp(fisheye((10.0, 20.0), magnification=magnification), View(-170, -20), 31)
    assert found.shape == (31, 31, 4)
    assert found[15, 15, 3] == 255
