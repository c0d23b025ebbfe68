"""The Earth's radii, and areas of cells in km² against geodesic polygons on the ellipsoid."""

import mpmath
import numpy as np
import pytest
from mpmath import mpf
from pyproj import Geod

from stereodel import SphericalDelaunay, SphericalVoronoi, check_delaunay, earth, xyz_to_lonlat
from stereodel.sphere import great_circle_points

WGS84 = Geod(ellps="WGS84")


def test_radii():
    assert pytest.approx(WGS84.a / 1000, rel=1e-15) == earth.EQUATORIAL_RADIUS_KM
    assert pytest.approx(WGS84.b / 1000, rel=1e-15) == earth.POLAR_RADIUS_KM
    assert pytest.approx(6371.008771415, abs=1e-9) == earth.MEAN_RADIUS_KM
    with mpmath.workdps(40):
        f = 1 / mpf("298.257223563")
        e = mpmath.sqrt(f * (2 - f))
        area = 2 * mpmath.pi * mpf("6378.137") ** 2 * (1 + (1 - e**2) * mpmath.atanh(e) / e)
        assert float(mpmath.sqrt(area / (4 * mpmath.pi))) == pytest.approx(earth.AUTHALIC_RADIUS_KM, rel=4e-16)


def outline(voronoi, cell, steps):
    """The boundary of a cell on the ellipsoid: (lon, lat) along its great circles on the authalic sphere."""
    corners = voronoi.vertices[voronoi.regions[cell]]
    sides = [great_circle_points(a, b, steps)[:-1] for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    return xyz_to_lonlat(np.concatenate(sides), latitude="authalic")


@pytest.mark.parametrize("seed", range(3))
def test_areas_are_those_of_the_ellipsoid(seed):
    rng = np.random.default_rng(seed)
    lonlat = np.stack([rng.uniform(-180, 180, 40), np.degrees(np.arcsin(rng.uniform(-1, 1, 40)))], axis=-1)
    triangulation = SphericalDelaunay.from_lonlat(lonlat, latitude="authalic")
    check_delaunay(triangulation)
    voronoi = SphericalVoronoi.from_lonlat(lonlat, latitude="authalic")
    assert np.array_equal(voronoi.vertices, SphericalVoronoi(triangulation).vertices)
    areas = voronoi.areas(radius=earth.AUTHALIC_RADIUS_KM)
    for cell in rng.choice(40, 8, replace=False):
        # Between two of n points of a side, the geodesic leaves the curve by O(1/n²): so do the areas. Extrapolated
        # from n and 2n, O(1/n⁴) of some 1e-3 of the area remains, 1e-11 for n = 100; pyproj sums to 1e-9.
        coarse, fine = (abs(WGS84.polygon_area_perimeter(*outline(voronoi, cell, n + 1).T)[0]) for n in (100, 200))
        assert areas[cell] == pytest.approx((4 * fine - coarse) / 3 / 1e6, rel=1e-8)
