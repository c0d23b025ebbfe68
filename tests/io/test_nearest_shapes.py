"""`nearest_shapes` beside minima along each side, beside Shapely's insides, and beside geodesics of the ellipsoid."""

import numpy as np
import pyproj
import pytest
import shapely
from scipy.optimize import minimize_scalar

from stereodel import angular_distance, data, lonlat_to_xyz, xyz_to_lonlat
from stereodel.constants import OUTLINE_TOLERANCE
from stereodel.earth import MEAN_RADIUS_KM
from stereodel.io import nearest_shapes
from tests.tiers import by_day


def angle(a, b, latitude):
    return np.radians(angular_distance(*(lonlat_to_xyz(p, latitude=latitude) for p in (a, b))))


def least_along(place, a, b, latitude, most):
    """The angle to the side from a to b, straight in degrees: a minimum next to the least of a hundred samples.

    That sample itself, if no place half way to another one can be nearer than `most`.
    """
    steps = np.linspace(0, 1, 101)

    def far(t):
        return angle(place, a + t * (b - a), latitude)

    samples = far(steps[:, None])
    k = int(np.argmin(samples))
    if samples[k] - np.radians(np.abs(b - a).sum() / 100) > most:
        return samples[k]
    low, high = steps[max(k - 1, 0)], steps[min(k + 1, 100)]
    return min(minimize_scalar(far, bounds=(low, high), method="bounded", options={"xatol": 1e-12}).fun, far(steps[k]))


def brute(place, geometry, latitude):
    """0 within a polygon, as Shapely has it on the map; else the least of all sides."""
    if geometry.geom_type == "Polygon" and shapely.intersects_xy(geometry, *place):
        return 0.0
    rings = shapely.get_rings(geometry) if geometry.geom_type == "Polygon" else [geometry]
    lines = [shapely.get_coordinates(ring) for ring in rings]
    sides = (side for line in lines for side in zip(line, line[1:] if len(line) > 1 else line, strict=False))
    least = np.inf
    for side in sides:
        least = min(least, least_along(place, *side, latitude, least))
    return least


def random_shapes(rng, count):
    """Points, lines, and polygons around places, some with a hole, of one to twenty degrees."""
    for kind in rng.permutation(np.arange(count) % 4).tolist():
        lon, lat, size = rng.uniform(-150, 150), rng.uniform(-65, 65), rng.uniform(1, 20)
        turn = np.sort(rng.uniform(0, 2 * np.pi, 7))
        around = np.array([lon, lat]) + size * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        if kind == 0:
            yield shapely.Point(lon, lat)
        elif kind == 1:
            yield shapely.LineString(around[rng.permutation(7)])
        else:
            hole = [0.2 * around + 0.8 * around.mean(axis=0)] if kind == 3 else []
            yield shapely.Polygon(around, hole)


@pytest.mark.parametrize(("seed", "latitude"), by_day([(1, "authalic"), (2, "spherical"), (3, "geodetic")]))
def test_the_nearest_is_that_of_minima_along_all_sides(seed, latitude):
    rng = np.random.default_rng(seed)
    shapes = list(random_shapes(rng, 12))
    inner = [shapely.get_coordinates(shape).mean(axis=0) for shape in shapes]
    places = np.concatenate([xyz_to_lonlat(rng.normal(size=(25, 3))), inner, [[0, 90], [77, -90], [180, 3], [-180, 3]]])
    number, distance = nearest_shapes(places, shapes, latitude=latitude, radius=1.0)
    for place, found, far in zip(places, number, distance, strict=True):
        every = np.array([brute(place, shape, latitude) for shape in shapes])
        assert far == pytest.approx(every.min(), abs=OUTLINE_TOLERANCE)
        assert every[found] <= every.min() + 2 * OUTLINE_TOLERANCE


LAKE = [(2, 2), (8, 2), (8, 8), (2, 8), (2, 2)]
ISLAND = [(4, 4), (6, 4), (6, 6), (4, 6), (4, 4)]
COUNTRY = shapely.MultiPolygon([shapely.Polygon([(0, 0), (10, 0), (10, 10), (0, 10)], [LAKE]), shapely.Polygon(ISLAND)])
ACROSS = [[[170, -10], [190, -10], [190, 10], [170, 10], [170, -10]]]
CUT = shapely.MultiPolygon([shapely.box(170, -10, 180, 10), shapely.box(-180, -10, -170, 10)])


KNOWN = [
    (COUNTRY, [(1, 1, 0), (10, 5, 0), (5, 5, 0), (2, 2, 0), (3, 0.0, 0), (0, -3, 3), (11, 0, 1)]),
    (shapely.Polygon(COUNTRY.geoms[0].exterior, [LAKE]), [(5, 2.5, 0.5)]),
    ({"type": "Polygon", "coordinates": ACROSS}, [(-175, 0, 0), (180, 0, 0), (-169, 0, 1)]),
    (CUT, [(180, 0, 0), (-180, 12, 2), (168, 0, 2)]),
    (shapely.box(-180, 60, 180, 90), [(0, 90, 0), (123, 89, 0), (-60, 59, 1), (0, -90, 150)]),
    (shapely.LineString([(175, 0), (-175, 0)]), [(180, 1, 1)]),
    (shapely.LineString([(0, 80), (0, 90)]), [(180, 85, 5)]),
    (shapely.LineString([(-180, 60), (180, 60)]), [(17, 90, 30)]),
    (shapely.LineString([(0, 60), (90, 60)]), [(45, 61, 1)]),
    (shapely.Point(0, 0), [(180, 0, 180)]),
    (shapely.MultiPoint([(0, 0), (20, 0)]), [(17, 0, 3)]),
]


@pytest.mark.parametrize(("shape", "places"), KNOWN)
def test_known_distances(shape, places):
    """Within, on the outline, in a lake, on its island, across ±180°, about the poles: on the plain sphere."""
    *places, degrees = np.transpose(places)
    number, distance = nearest_shapes(np.transpose(places), shape, latitude="spherical", radius=1.0)
    assert not number.any()
    assert distance == pytest.approx(np.radians(degrees), abs=OUTLINE_TOLERANCE)
    assert (distance[degrees == 0] < 1e-15).all()


def test_no_point_of_the_outline_is_nearer():
    """And land is land: the outline of Natural Earth, point by point, with Shapely's inside."""
    places, land = xyz_to_lonlat(np.random.default_rng(4).normal(size=(1000, 3))), data.land("110m")
    distance = nearest_shapes(places, land, radius=1.0)[1]
    points, asked = (lonlat_to_xyz(lonlat, latitude="authalic") for lonlat in (land.lonlat, places))
    chords = np.array([np.linalg.norm(points - place, axis=1).min() for place in asked])
    assert (distance <= 2 * np.arcsin(chords / 2) + 1e-15).all()
    whole = shapely.MultiPolygon([(rings[0], rings[1:]) for rings in land.polygons()])
    assert ((distance == 0) == shapely.contains_xy(whole, *places.T)).all()


def test_of_shapes_as_near_the_first_is_named():
    """Neighbours share sides, in opposite directions and cut elsewhere; what contains a place comes before."""
    west, east = shapely.box(0, 50, 1, 60), shapely.Polygon([(1, 50), (3, 50), (3, 60), (1, 60), (1, 57.3), (1, 51.1)])
    south = shapely.box(0, 40, 3, 50)
    places = [(1, 55.5), (1, 63), (1, 50), (1 + 1e-8, 55.5), (1 - 1e-8, 55.5)]
    for shapes in ([west, east, south], [east, south, west]):
        number = nearest_shapes(places, shapes)[0]
        first = min(shapes.index(west), shapes.index(east))
        assert number[:3].tolist() == [first, first, 0]
        assert number[3:].tolist() == [shapes.index(east), shapes.index(west)]


def test_distances_are_those_of_the_ellipsoid_within_what_is_said():
    """Geodesics to points of outlines a tenth of a degree apart, of places at least 300 km away."""
    land, geod = data.land("110m"), pyproj.Geod(ellps="WGS84")
    places = xyz_to_lonlat(np.random.default_rng(5).normal(size=(250, 3)))
    distance = nearest_shapes(places, land)[1]
    places, distance = places[distance > 300], distance[distance > 300]
    outline = shapely.get_coordinates(
        shapely.segmentize(shapely.MultiLineString([ring for rings in land.polygons() for ring in rings]), 0.1)
    )
    points, asked = (lonlat_to_xyz(lonlat, latitude="authalic") for lonlat in (outline, places))
    ratio = []
    for lonlat, place, far in zip(places, asked, distance, strict=True):
        chord = 2 * np.sin(1.006 * far / MEAN_RADIUS_KM / 2)
        near = outline[np.linalg.norm(points - place, axis=1) < chord]
        ratio.append(far / geod.inv(*np.broadcast_to(lonlat, near.shape).T, *near.T)[2].min() * 1000)
    worst = np.abs(np.array(ratio) - 1).max()
    assert 0.0005 < worst < 0.0012


def test_what_is_refused():
    with pytest.raises(ValueError, match="shapes hold no points, lines or polygons; give a source that does"):
        nearest_shapes([(0, 0)], {"type": "FeatureCollection", "features": []})
    with pytest.raises(ValueError, match="radius is 0"):
        nearest_shapes([(0, 0)], shapely.Point(1, 1), radius=0.0)
    assert [len(part) for part in nearest_shapes(np.zeros((0, 2)), shapely.Point(1, 1))] == [0, 0]
