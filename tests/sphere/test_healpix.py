"""HEALPix against numbers that the library of its authors prints, and against its own definition."""

import numpy as np
import pytest

from stereodel.sphere import healpix_centers, lonlat_to_xyz


@pytest.mark.parametrize(
    ("nside", "pixel", "colatitude", "longitude"),
    [
        (16, 1440, 1.52911759, 0.0),
        (16, 427, 0.78550497, 0.78539816),
        (16, 1520, 1.57079633, 1.61988371),
        (16, 0, 0.05103658, 0.78539816),
        (16, 3068, 3.09055608, 0.78539816),
        (1, 11, 2.30052398, 5.49778714),
        (2, 11, 0.84106867, 5.89048623),
        (4, 11, 0.41113786, 5.89048623),
        (8, 11, 0.2044802, 5.89048623),
    ],
)
def test_centers_in_the_order_of_rings(nside, pixel, colatitude, longitude):
    """Of the documentation of healpy's pix2ang, in radians."""
    lon, lat = np.radians(healpix_centers(nside)[pixel])
    assert lon == pytest.approx(longitude, abs=1e-8)
    assert np.pi / 2 - lat == pytest.approx(colatitude, abs=1e-8)


@pytest.mark.parametrize(
    ("nside", "nested", "ring"), [(16, 1130, 1504), (1, 11, 11), (2, 11, 2), (4, 11, 12), (8, 11, 211)]
)
def test_nested_numbers(nside, nested, ring):
    """Of the documentation of healpy's nest2ring."""
    assert np.array_equal(healpix_centers(nside, nested=True)[nested], healpix_centers(nside)[ring])


@pytest.mark.parametrize("nside", [1, 2, 4, 8, 16, 32])
def test_four_nested_pixels_lie_around_the_center_of_theirs(nside):
    """Their mean is nearer to it than half a side."""
    parents = lonlat_to_xyz(healpix_centers(nside, nested=True))
    means = lonlat_to_xyz(healpix_centers(2 * nside, nested=True)).reshape(-1, 4, 3).mean(axis=1)
    assert np.linalg.norm(parents - means, axis=1).max() < 0.16 / nside


@pytest.mark.parametrize("nside", [1, 2, 3, 5, 12])
def test_rings_lie_where_areas_are_equal(nside):
    """Mirrored at the equator, from north to south; sines of latitudes by the fractions of the paper."""
    lonlat = healpix_centers(nside)
    assert (np.diff(lonlat[:, 1]) <= 0).all()
    assert np.array_equal(np.unique(lonlat[:, 1]), -np.unique(lonlat[:, 1])[::-1])
    sines = np.sin(np.radians(np.unique(lonlat[:, 1])[::-1]))[: 2 * nside]
    caps = 1 - np.arange(1, nside) ** 2 / (3 * nside**2)
    belt = 4 / 3 - 2 * np.arange(nside, 2 * nside + 1) / (3 * nside)
    assert np.allclose(sines, np.concatenate([caps, belt]), rtol=0, atol=1e-15)
    assert (lonlat[:, 0] >= 0).all()
    assert (lonlat[:, 0] < 360).all()
