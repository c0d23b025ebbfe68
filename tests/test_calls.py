"""Calls that a newcomer writes first: the message says what to write instead."""

import numpy as np
import pytest

from stereodel import (
    Gnomonic,
    SphericalDelaunay,
    SphericalVoronoi,
    angular_distance,
    fisheye,
    great_circle_points,
    lonlat_to_xyz,
    solid_angle,
    xyz_to_lonlat,
)
from stereodel.interpolation import LinearInterpolator

LONLAT = np.array([[0.0, 0.0], [90.0, 10.0], [40.0, 60.0], [-50.0, 20.0]])
LON, LAT = LONLAT.T
MESH = SphericalDelaunay.from_lonlat(LONLAT)
FUNCTION = LinearInterpolator.from_lonlat(LONLAT, LAT)
ROWS = r"give rows \(longitude, latitude\), as np\.column_stack\(\[lon, lat\]\) makes them"
NAMED = r"give longitude and latitude by name, lonlat=np\.column_stack\(\[lon, lat\]\)"
XYZ = r"shape \(\.\.\., 3\), got \(2,\), which means the plane; make directions of longitude .* by lonlat_to_xyz"

CALLS = {
    "MESH.nearest(10, 50)": rf"nearest\(\) takes 1 argument by position, got 2; {NAMED}",
    "MESH.find_simplex(10, 50)": NAMED,
    "FUNCTION(LON, LAT)": NAMED,
    "MESH.nearest([10, 50])": "for longitude and latitude write lonlat=",
    "FUNCTION(np.zeros((720, 1440, 2)))": "for longitude and latitude write lonlat=",
    "lonlat_to_xyz(10, 50)": r"give longitude and latitude as one pair \(lon, lat\), or rows",
    "fisheye((10, 50), 4)": r"fisheye\(\) takes 1 argument by position, got 2; magnification= is a keyword",
    "SphericalDelaunay.from_lonlat(LON, LAT)": ROWS,
    "SphericalVoronoi.from_lonlat(LON, LAT)": ROWS,
    "LinearInterpolator.from_lonlat(LON, LAT, LAT)": rf"takes 2 arguments by position, got 3; {ROWS}",
    "SphericalDelaunay.from_lonlat(LON)": ROWS,
    "SphericalDelaunay.from_lonlat(LONLAT.T)": ROWS,
    "angular_distance((10, 50), (20, 60))": f"a must have {XYZ}",
    "great_circle_points((10, 50), (20, 60), 3)": f"a must have {XYZ}",
    "solid_angle((0, 0), (90, 0), (0, 90))": f"a must have {XYZ}",
    "xyz_to_lonlat((10, 50))": f"xyz must have {XYZ}",
    "Gnomonic((0, 0)).forward((10, 50))": f"xyz must have {XYZ}",
    "fisheye((10, 50), magnification=4)((10, 50))": "for longitude and latitude call its method lonlat",
}


@pytest.mark.parametrize("call", CALLS)
def test_the_message_says_what_to_write(call):
    with pytest.raises((TypeError, ValueError), match=CALLS[call]):
        eval(call)


def test_what_it_says_works():
    assert MESH.nearest(lonlat=np.column_stack([LON, LAT])).tolist() == [0, 1, 2, 3]
    assert FUNCTION(lonlat=LONLAT).tolist() == LAT.tolist()
    assert angular_distance(lonlat_to_xyz((10, 50)), lonlat_to_xyz((10, 60))) == pytest.approx(10)
    assert fisheye((10, 50), magnification=4).lonlat((10, 50)) == pytest.approx([10, 50])
    for kind in (SphericalDelaunay, SphericalVoronoi):
        assert np.allclose(kind.from_lonlat(np.column_stack([LON, LAT])).lonlat, LONLAT)
    assert np.allclose(xyz_to_lonlat(great_circle_points(*lonlat_to_xyz([(10, 50), (10, 60)]), 3))[1], (10, 55))
    assert solid_angle(*lonlat_to_xyz([(0, 0), (90, 0), (0, 90)])) == pytest.approx(np.pi / 2)
    assert np.allclose(Gnomonic((10, 50)).forward(lonlat_to_xyz((10, 50))), 0)
