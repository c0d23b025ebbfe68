"""Panoramas through lenses: where each pixel looks, against many samples a pixel, and seams of cubes."""

import numpy as np
import pytest

from stereodel import fisheye, xyz_to_lonlat
from stereodel.curves.view import View
from stereodel.globe import Raster
from tests.globe.supersampling import SAMPLES, checkerboard, grid, interpolated, means, noise, psnr, zone_plate
from tests.refused import refused
from tests.tiers import by_day

LENS = fisheye((20.0, 40.0), magnification=3.0)
VIEW = View(35.0, -20.0, 15.0)
RASTERS = {"squares": (checkerboard(256, 32), 38.0), "rings": (zone_plate(256), 41.0), "noise": (noise(256), 36.0)}
ORDER = ["right", "left", "up", "down", "front", "back"]


def equirectangular(x, y):
    """Directions (..., 3) right, up, ahead of places in [0, 1] of a picture, x right and y down."""
    lon, lat = (x - 0.5) * 2 * np.pi, (0.5 - y) * np.pi
    return np.stack([np.cos(lat) * np.sin(lon), np.sin(lat), np.cos(lat) * np.cos(lon)], axis=-1)


def cubemap(face):
    """As `equirectangular`, of a face as OpenGL's specification has it: by s, t and the major axis, z away from us."""

    def directions(x, y):
        s, t, one = 2 * x - 1, 2 * y - 1, np.ones_like(x)
        axes = {
            "right": (one, -t, -s),
            "left": (-one, -t, s),
            "up": (s, one, t),
            "down": (s, -one, -t),
            "front": (s, -t, one),
            "back": (-s, -t, -one),
        }[face]
        return np.stack(axes, axis=-1) / np.sqrt(1 + s**2 + t**2)[..., None]

    return directions


def planet(radius):
    def directions(x, y):
        a, b = (np.tan(np.radians(radius) / 2) * side for side in (2 * x - 1, 1 - 2 * y))
        return np.stack([2 * a, 2 * b, 1 - a**2 - b**2], axis=-1) / (1 + a**2 + b**2)[..., None]

    return directions


WINDOWS = [(512, (300, 90, 14, 14)), (1024, (500, 250, 12, 12)), (128, (0, 30, 14, 14)), (128, (60, 0, 14, 4))]
WINDOWS += [(128, (5, 60, 14, 4))]
CASES = [(kind, "equirectangular", *where) for kind in RASTERS for where in WINDOWS]
CASES += [("rings", face, 96, (82, 3, 12, 12)) for face in ORDER]
CASES += [("rings", "planet", 128, (x, y, 12, 12)) for x, y in ((0, 0), (116, 0), (56, 56), (0, 116), (116, 116))]


@pytest.mark.parametrize(("kind", "form", "size", "window"), by_day(CASES, *(c for c in CASES if c[0] == "rings")))
def test_panoramas_without_aliasing(kind, form, size, window):
    """Faces of cubes are those of OpenGL; little planets fill their square."""
    (raster, least), (left, top, columns, rows) = RASTERS[kind], window
    given, view, height = Raster(raster), VIEW, size
    if form == "planet":
        found, view, where = given.panorama(LENS, form, size=size, angular_radius=120.0), View(0, -90), planet(120.0)
    elif form == "equirectangular":
        found, where, height = given.panorama(LENS, view=VIEW, size=size), equirectangular, size // 2
    else:
        faces, where = given.panorama(LENS, "cubemap", view=VIEW, size=size), cubemap(form)
        assert len(faces) == 6
        found = faces[ORDER.index(form)]
    assert found.shape == (height, size, 4)
    assert (found[..., 3] == 255).all()
    part = found[top : top + rows, left : left + columns, 0].astype(float)
    # Of 16 × 16 samples of each pixel: means of the raster where they look.
    sides = (left, columns, size), (top, rows, height)
    x, y = np.meshgrid(*((k + (np.arange(SAMPLES * n) + 0.5) / SAMPLES) / side for k, n, side in sides))
    lonlat = xyz_to_lonlat(LENS.inverse()(where(x, y) @ view.matrix))
    expected = means(interpolated(raster, *lonlat.reshape(-1, 2).T).reshape(x.shape))
    assert psnr(expected, part) > least


def test_nothing_asked_for_is_the_panorama_itself():
    """As the surface through the texels has it, whose means over texels differ from them in what is as fine."""
    lon, lat = grid(128)
    smooth = np.round(127.5 + 60 * np.cos(lat) * np.sin(3 * lon) + 40 * np.sin(2 * lat)).astype(np.uint8)
    found = Raster(smooth).panorama()
    assert found.shape == (128, 256, 4)
    assert np.abs(found[..., 0].astype(int) - smooth).max() <= 1
    assert psnr(found[..., 0].astype(float), smooth.astype(float)) > 52
    fine = Raster(noise(128)).panorama()[..., 0].astype(float)
    assert psnr(fine, noise(128).astype(float)) > 18


def test_threads_change_nothing_and_parts_are_transparent():
    raster = Raster(noise(64))
    for form in ("equirectangular", "cubemap", "planet"):
        one, two = (raster.panorama(LENS, form, size=64, workers=workers) for workers in (1, 2))
        assert np.array_equal(one, two)
    part = Raster(np.full((10, 20), 100, dtype=np.uint8), (0.0, 0.0, 90.0, 45.0))
    assert part.panorama().shape == (40, 80, 4)
    opaque = part.panorama()[..., 3] == 255
    assert opaque[11:19, 41:59].all()
    assert not opaque[:, :39].any()


test_what_is_refused = refused(
    ({"form": "disc"}, "form is 'disc', but must be one of"),
    ({"size": 33}, "size is 33, but an equirectangular panorama is twice as wide"),
    ({"size": 0}, "size"),
    ({"size": 20_000}, "makes 200000000 pixels of its equirectangular"),
    ({"form": "cubemap", "size": 5000}, "makes 150000000 pixels"),
    ({"form": "planet", "angular_radius": 161.0}, "angular_radius"),
    ({"form": "planet", "angular_radius": 0.0}, "angular_radius"),
    call=lambda options: Raster(noise(8)).panorama(**options),
)
