"""The picture of the Earth lies where the map says, and is decoded only when asked for."""

import subprocess
import sys

import numpy as np
import pytest
import shapely

from stereodel import data


def test_the_picture():
    picture = data.blue_marble()
    assert picture.shape == (1024, 2048, 3)
    assert picture.dtype == np.uint8
    assert not picture.flags.writeable
    assert data.blue_marble() is picture


@pytest.mark.parametrize(
    ("lon", "lat", "hue"),
    [
        (-150.0, 0.0, "blue"),
        (-179.9, 0.0, "blue"),
        (15.0, 23.0, "sand"),
        (60.0, -80.0, "white"),
        (-42.0, 72.0, "white"),
    ],
)
def test_colours_of_places(lon, lat, hue):
    red, green, blue = data.blue_marble()[int((90 - lat) * 1024 / 180), int((lon + 180) * 2048 / 360)].astype(int)
    assert {"blue": blue > 2 * red, "sand": red > green > blue > 60, "white": min(red, green, blue) > 200}[hue]


def test_the_picture_fits_the_map():
    """What is land and what is sea agree best where the picture is not moved at all."""
    lon, lat = np.arange(-178.0, 178.0), np.arange(-55.0, 60.0)
    land = shapely.geometry.shape(data.land())
    shapely.prepare(land)
    wanted = shapely.contains_xy(land, *np.meshgrid(lon, lat))

    def agreement(east, north):
        i = ((90 - lat - north) * 1024 / 180).astype(int)
        j = ((lon + east + 180) * 2048 / 360).astype(int)
        red, green, blue = np.moveaxis(data.blue_marble()[np.ix_(i, j)].astype(int), -1, 0)
        return np.mean((blue <= np.maximum(red, green)) == wanted)

    shares = {(east, north): agreement(east, north) for east in (-1, 0, 1) for north in (-1, 0, 1)}
    assert max(shares, key=shares.get) == (0, 0)
    assert shares[0, 0] > 0.95


def test_no_image_library_before_the_picture():
    code = "import sys, stereodel.data; print('PIL' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"
