"""Contours as lines on the map."""

import numpy as np
import pytest
import shapely

from stereodel import PlanarDelaunay, SphericalDelaunay, lonlat_to_xyz
from stereodel.interpolation import contours
from stereodel.io import to_geodataframe

AXIS = np.array([0.5, 0.3, 0.8])


@pytest.fixture(scope="module")
def sphere():
    rng = np.random.default_rng(3)
    lonlat = np.column_stack([rng.uniform(-180, 180, 3000), np.degrees(np.arcsin(rng.uniform(-1, 1, 3000)))])
    triangulation = SphericalDelaunay.from_lonlat(lonlat)
    return triangulation, contours(triangulation, lonlat_to_xyz(lonlat) @ AXIS, np.linspace(-0.9, 0.9, 10))


def test_lines_of_the_sphere_are_cut_and_lie_where_the_values_are(sphere):
    _, found = sphere
    frame = to_geodataframe(found, max_segment=1)
    assert frame.crs == "EPSG:4326"
    assert frame["level"].tolist() == [contour.level for contour in found]
    assert frame["closed"].all()
    for level, line in zip(frame["level"], frame.geometry, strict=True):
        places = shapely.get_coordinates(line)
        assert np.abs(lonlat_to_xyz(places) @ AXIS - level).max() < 0.01
        for part in shapely.get_parts(line):
            steps = np.abs(np.diff(shapely.get_coordinates(part), axis=0))
            assert steps[:, 0].max() < 180
    # A large ring about the axis goes round a pole and so across the 180th meridian, where it is cut.
    for line in frame.geometry[frame["level"].abs() < 0.5]:
        ends = [part.coords[k] for part in shapely.get_parts(line) for k in (0, -1)]
        assert {abs(lon) for lon, _ in ends} == {180.0}


def test_higher_values_are_on_the_left(sphere):
    _, found = sphere
    for line in to_geodataframe(found).geometry:
        for part in shapely.get_parts(line):
            start, end = lonlat_to_xyz(shapely.get_coordinates(part)[:2])
            assert np.cross(start, end) @ AXIS > 0


def test_the_plane():
    (ridge,) = contours(PlanarDelaunay([[0, 0], [2, 0], [2, 2], [0, 2]]), [0, 4, 4, 0], 1)
    frame = to_geodataframe([ridge], crs="EPSG:25832")
    assert frame.crs == "EPSG:25832"
    assert shapely.get_coordinates(frame.geometry).tolist() == ridge.points.tolist()


def test_none_and_wrong_ones(sphere):
    assert len(to_geodataframe([])) == 0
    with pytest.raises(TypeError, match=r"mesh\[1\] must be a Contour, not int"):
        to_geodataframe([sphere[1][0], 5])
    with pytest.raises(ValueError, match="not of contours"):
        to_geodataframe(sphere[1], what="cells")
