"""Geometries through conformal maps: against PROJ, against places inside and outside, there and back."""

import geopandas
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Transformer
from scipy.spatial import KDTree

from stereodel import MoebiusMap, bubble_to_bubble, data, fisheye
from stereodel.io import warp
from stereodel.sphere import SphereCircle, angular_distance, lonlat_to_xyz, xyz_to_lonlat
from tests.examples import examples
from tests.globe import truth

WORLD = shapely.box(-180, -90, 180, 90)
LENSES = [
    MoebiusMap.identity(),
    fisheye((2.35, 48.86), magnification=5.0),
    fisheye((-170.0, -80.0), magnification=0.2),
    MoebiusMap.rotation((30.0, 20.0), 130.0),
    bubble_to_bubble(SphereCircle.around((20.0, 50.0), 20.0), SphereCircle.around((-120.0, -60.0), 100.0), turn=70),
]
PLACES = xyz_to_lonlat(np.random.default_rng(3).normal(size=(400, 3)))


def land(resolution="110m"):
    return shapely.geometry.shape(data.land(resolution).__geo_interface__)


def far_from(lonlat, geometry, degrees):
    """Whether places between 85° S and 85° N are farther from a border than some degrees of the sphere."""
    gaps = shapely.distance(shapely.points(lonlat), shapely.boundary(geometry))
    return (gaps > degrees / np.cos(np.radians(85))) & (np.abs(lonlat[:, 1]) < 85)


def same_places(source, image, lens, tolerance=0.01):
    """Whether the images of the places inside are the places inside the image, but close to the borders."""
    moved = xyz_to_lonlat(lens(lonlat_to_xyz(PLACES)))
    clear = far_from(moved, image, 3 * tolerance) & far_from(PLACES, source, 1e-6)
    inside = shapely.contains_xy(source, *PLACES.T)
    return np.array_equal(inside[clear], shapely.contains_xy(image, *moved.T)[clear])


@pytest.mark.parametrize("lens", LENSES)
def test_the_land_of_the_earth_and_everything_else(lens):
    source = land()
    images = []
    for part in (source, WORLD.difference(source)):
        image = warp(part, lens)
        assert image.is_valid
        assert shapely.box(*image.bounds).within(WORLD)
        assert shapely.is_ccw(shapely.get_exterior_ring(shapely.get_parts(image))).all()
        assert same_places(part, image, lens)
        images.append(image)
    assert images[0].intersection(images[1]).area < 30  # of 64800, along all coasts
    assert warp(WORLD, lens).equals(WORLD)
    assert warp(shapely.Polygon(), lens).is_empty


@examples(0.5)
@given(st.sampled_from(LENSES), st.integers(0, 10**9), st.floats(0.5, 60))
def test_stars_with_holes_of_all_sizes(lens, seed, size):
    rng = np.random.default_rng(seed)
    middle = rng.uniform((-180, -80), (180, 80))
    angle = np.sort(rng.uniform(0, 2 * np.pi, rng.integers(3, 12)))[:, None]
    radius = size * rng.uniform(0.4, 1, (len(angle), 1)) * (1.5, 1)
    star = shapely.Polygon(middle + radius * np.hstack([np.cos(angle), np.sin(angle)])).buffer(0)
    hole = star.representative_point().buffer(size / 20)
    source = shapely.intersection(star.difference(hole), WORLD)
    if source.is_empty or source.geom_type not in ("Polygon", "MultiPolygon"):
        return
    image = warp(source, lens)
    assert image.is_valid
    assert same_places(source, image, lens)


def test_vertices_are_those_of_proj():
    lens = LENSES[1]
    pipeline = Transformer.from_pipeline(lens.to_proj())
    lonlat = np.array([(0, 40), (10, 45), (-20, 60), (100, -30)], dtype=float)
    moved = np.column_stack(pipeline.transform(*lonlat.T))
    assert np.allclose(shapely.get_coordinates(warp(shapely.points(lonlat), lens)), moved, atol=1e-9)
    line = shapely.get_coordinates(warp(shapely.LineString(lonlat[:3]), lens))
    gaps = np.abs(line[:, None] - moved[:3]).max(axis=-1).min(axis=0)
    assert gaps.max() < 1e-9


@pytest.mark.parametrize("tolerance", [0.01, pytest.param(0.3, marks=pytest.mark.thorough)])
def test_no_chord_strays_from_the_worlds_coast_at_a_thousand(tolerance):
    """Middles of straight pieces of the result, taken back, lie beside the coast by no more than the tolerance."""
    lens = fisheye((-5.0, 48.0), magnification=1000.0)
    source = shapely.geometry.shape(data.coastlines("110m").__geo_interface__)
    image = warp(source, lens, tolerance=tolerance)
    lonlat, line = shapely.get_coordinates(shapely.get_parts(image), return_index=True)
    middles = ((lonlat[1:] + lonlat[:-1]) / 2)[line[1:] == line[:-1]]
    back = xyz_to_lonlat(lens.inverse()(lonlat_to_xyz(middles)))
    nearest = shapely.get_coordinates(
        shapely.line_interpolate_point(source, shapely.line_locate_point(source, shapely.points(back)))
    )
    off = angular_distance(lens(lonlat_to_xyz(nearest)), lonlat_to_xyz(middles))
    assert np.percentile(off, 99.9) <= tolerance
    assert off.max() <= 2 * tolerance  # the nearest place in degrees is not the nearest on the sphere


def test_parts_that_met_at_180_degrees_become_one():
    apart = shapely.MultiPolygon([shapely.box(170, 0, 180, 10), shapely.box(-180, 2, -170, 12)])
    turned = warp(apart, MoebiusMap.rotation((0, 90), 100))
    assert turned.geom_type == "Polygon"
    assert turned.area == pytest.approx(200, rel=1e-3)
    assert warp(apart, MoebiusMap.identity()).geom_type == "MultiPolygon"


def test_a_polygon_over_the_pole():
    lon = np.linspace(-180, 180, 37)
    antarctica = shapely.Polygon(
        [*np.column_stack([lon, -70 + 5 * np.sin(np.radians(3 * lon))]), (180, -90), (-180, -90)]
    )
    moved = warp(antarctica, MoebiusMap.rotation((0, 0), 60))
    assert moved.geom_type == "Polygon"
    assert len(moved.interiors) == 0
    assert same_places(antarctica, moved, MoebiusMap.rotation((0, 0), 60))
    there = warp(shapely.Point(0, -90).buffer(0).union(shapely.box(-40, -20, 40, 20)), MoebiusMap.rotation((90, 0), 90))
    assert there.is_valid
    assert there.bounds[1] == -90


def test_lines_are_cut_at_180_degrees_and_poles():
    line = shapely.LineString([(60, 10), (120, 10)])
    crossing = warp(line, MoebiusMap.rotation((0, 90), 90))
    assert crossing.geom_type == "MultiLineString"
    assert sorted(part.bounds[2] for part in crossing.geoms) == pytest.approx([-150, 180])
    over = warp(shapely.LineString([(0, 60), (0, 89), (180, 89), (180, 60)]), MoebiusMap.identity())
    assert over.is_valid
    assert all(np.abs(np.diff(shapely.get_coordinates(part)[:, 0])).max() < 90 for part in shapely.get_parts(over))
    jumping = warp(shapely.LineString([(170, 0), (-170, 0)]), MoebiusMap.identity())
    assert jumping.length == pytest.approx(20)


def test_every_kind_comes_back_as_it_was():
    lens = LENSES[1]
    kinds = [
        shapely.Point(1, 2),
        shapely.MultiPoint([(1, 2), (3, 4)]),
        shapely.LineString([(1, 2), (3, 4)]),
        shapely.LinearRing([(1, 2), (3, 4), (5, 0)]),
        shapely.MultiLineString([[(1, 2), (3, 4)], [(10, 2), (3, 40)]]),
        shapely.box(0, 0, 1, 1),
        shapely.GeometryCollection([shapely.Point(1, 2), shapely.box(0, 0, 1, 1)]),
        shapely.Point(),
        None,
    ]
    images = warp(kinds, lens)
    names = [[one.geom_type for one in some[:-2]] for some in (kinds, images)]
    assert names[1] == [name.replace("LinearRing", "LineString") for name in names[0]]
    assert shapely.equals_identical(images[-2], shapely.Point())
    assert images[-1] is None
    assert np.array_equal(warp(np.reshape(kinds[:4], (2, 2)), lens)[1, 0], images[2])
    assert warp(shapely.Point(1, 2, 3), lens).has_z is False
    assert len(warp([], lens)) == 0


def test_frames_keep_their_columns_and_index():
    frame = geopandas.GeoDataFrame(
        {"name": ["a", "b"]}, geometry=[shapely.box(0, 0, 1, 1), None], index=[7, 9], crs=4326
    )
    image = warp(frame.to_crs(3857), LENSES[1])
    assert isinstance(image, geopandas.GeoDataFrame)
    assert image.crs == "EPSG:4326"
    assert image["name"].to_dict() == {7: "a", 9: "b"}
    assert image.geometry[9] is None
    assert shapely.equals_exact(image.geometry[7], warp(frame.geometry[7], LENSES[1]), 1e-6, normalize=True)
    assert warp(frame.geometry.set_crs(None, allow_override=True), LENSES[1]).crs is None


@pytest.mark.parametrize("lens", [MoebiusMap.identity(), fisheye((30.0, 40.0), magnification=2.0)])
@pytest.mark.parametrize(("rise", "width"), [(0, 1e-5), (6, 1e-3), (6, 1e-4)])
def test_strips_narrower_than_the_tolerance_stay_whole(lens, rise, width):
    """1 m wide and 60° long, or slanted, with corners at different places: chords that stray by 0.01° would cross."""
    corners = [(0, 50), (60, 50 + rise), (60, 50 + rise + width), (0, 50 + width)]
    corners[3:3] = [(25, 50 + rise * 25 / 60 + width)] if rise else []
    image = warp(shapely.Polygon(corners), lens)
    assert image.is_valid
    assert image.geom_type == "Polygon"
    if lens.magnification == 1:
        assert image.area == pytest.approx(60 * width, rel=0.05)


SLIVERS = {
    "parallel": [(3, 47), (23, 47), (23, 47.00000006), (8.4, 47.00000006), (3, 47.00000006)],
    "short": [(147, 39), (148.1, 39), (148.1, 39.00000004), (147.5, 39.00000004), (147, 39.00000004)],
    "to 180": [(120, 85.6), (180, 85.6), (180, 85.60000006), (164, 85.60000006), (120, 85.60000006)],
    "from 180": [(-180, 59), (-120, 60.5), (-120, 60.50000002), (-138, 60.05000002), (-180, 59.00000002)],
    "along 180": [(-180, -68), (-179.999995, -68), (-179.999995, 68), (-180, 68), (-180, 30)],
    "meridian": [(60, 66), (60.000006, 66), (60.000006, -66), (60, -66), (60, -29)],
    "slanted": [(57, 64), (62, 65), (62, 65.000007), (59, 64.400007), (57, 64.000007)],
    "triangle": [(14.5, -69), (134.5, -69), (134.5, -68.99999999)],
    "from a pole": [(-114.6, -90), (-114.2, 60), (-114.2, 60.00000002)],
    "to a pole": [(169.6, 39), (170, 89.9998), (170, 90)],
    "from a corner": [(-180, -90), (-175, -49), (-175, -48.999999)],
}
"""Each covered the map, or was lost, under one of `THINNING` or another."""
THINNING = [((20.0, 30.0), 2.0), ((-170.0, -80.0), 7.0), ((60.0, -20.0), 50.0), ((60.0, -20.0), 0.2)]
THINNING = [MoebiusMap.identity(), *(fisheye(focus, magnification=size) for focus, size in THINNING)]


def on_sphere(polygon):
    """Its area on the unit sphere: that of its sides' middles in longitude and the sine of latitude."""
    equal = shapely.transform(
        shapely.segmentize(polygon, 0.25), lambda p: np.column_stack([np.radians(p[:, 0]), np.sin(np.radians(p[:, 1]))])
    )
    return shapely.area(equal)


@pytest.mark.parametrize(("seed", "count"), [(1, 12), pytest.param(2, 600, marks=pytest.mark.thorough)])
@pytest.mark.parametrize("lens", THINNING)
def test_slivers(lens, seed, count):
    """Images lie along those of their sides, none is lost, and under the identity areas are what they were.

    By chords, they covered the map; by the turn at the highest of crossing chords, they were holes, and lost.
    """
    some = [shapely.Polygon(ring) for ring in truth.slivers(np.random.default_rng(seed), count)]
    named, tolerance = [shapely.Polygon(ring) for ring in SLIVERS.values()], 0.01
    slivers = np.array([*named, *(one for one in some if one.is_valid)])
    images, reach = warp(slivers, lens, tolerance=tolerance), np.radians(tolerance)
    assert shapely.is_valid(images).all()
    # Narrower ones may have both sides on the same chords.
    lost = shapely.is_empty(images)
    assert (2 * shapely.area(slivers)[lost] <= 1e-8 * shapely.length(slivers)[lost]).all()
    assert lost.mean() < 0.01
    assert (np.abs(shapely.total_bounds(images)) <= [180, 90, 180, 90]).all()
    for sliver, image in zip(slivers[~lost], images[~lost], strict=True):
        fine = shapely.get_coordinates(shapely.segmentize(sliver.boundary, shapely.length(sliver) / 2000))
        before, after = lonlat_to_xyz(fine), lens(lonlat_to_xyz(fine))
        steps, moved = (np.linalg.norm(np.diff(p, axis=0), axis=1) for p in (before, after))
        scale = (moved / np.maximum(steps, 1e-12)).max()
        off = KDTree(after).query(lonlat_to_xyz(shapely.get_coordinates(image)))[0]
        assert off.max() <= moved.max() / 2 + 2 * reach, sliver.wkt
        width = np.radians(0.1) * scale**2 if sliver.area > 1e-3 else 0.0
        assert on_sphere(image) <= moved.sum() * (reach + width), sliver.wkt
        if lens.magnification == 1:
            assert abs(on_sphere(image) - on_sphere(sliver)) <= moved.sum() * reach, sliver.wkt


@pytest.mark.parametrize(("side", "west"), [(0, 0), (1, 140), (2, 0), (3, 140)])
def test_holes_may_touch_their_shell_first(side, west):
    """A hole whose first corner lies on a side of its shell, where chords leave it outside, was lost."""
    shore = shapely.box(west, -30, west + 40, 40)
    lake = np.array([(west + 20, 10), (west + 15, 0), (west + 25, 0)], dtype=float)
    lake[0] = [(west, 3), (west + 40, 3), (west + 17, -30), (west + 17, 40)][side]
    source = shapely.Polygon(shore.exterior.coords, [lake])
    assert source.is_valid
    for lens in LENSES:
        image = warp(source, lens)
        assert image.is_valid
        assert same_places(source, image, lens)


def test_parts_that_touch_at_corners_stay_few_points(rng):
    """They cross there however fine the chords are: the sampling was refined to millions of points."""
    boxes = [shapely.box(w, s, w + 15, s + 15) for w in range(-180, 180, 15) for s in range(-90, 90, 15)]
    source = shapely.union_all([box for box in boxes if rng.random() < 0.5])
    image = warp(source, fisheye((20.0, 30.0), magnification=12.0))
    assert image.is_valid
    assert shapely.get_num_coordinates(image) < 20_000
