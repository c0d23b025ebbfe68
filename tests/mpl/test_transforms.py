"""Longitude and latitude on matplotlib's page: points against PROJ, lines and regions against brute force."""

from itertools import pairwise, product

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path
from pyproj import Transformer

from stereodel import MoebiusMap, fisheye, great_circle_points, lonlat_to_xyz, xyz_to_lonlat
from stereodel.curves.ragged import Ragged
from stereodel.curves.view import StereographicView, View, turned
from stereodel.mpl.transforms import EDGES, LonLatToPage
from tests.globe.sights import winding

VIEWS = [View(20.0, 35.0, 10.0), StereographicView(-60.0, -20.0, angular_radius=140.0), View(0.0, 90.0)]
LENSES = [MoebiusMap.identity(), fisheye((10.0, 50.0), magnification=6.0), fisheye((-100.0, -40.0), magnification=0.3)]

sights = st.tuples(st.sampled_from(LENSES), st.sampled_from(VIEWS))
# GEOS warns of distances from lines with parts as small as 1e-167.
places = st.tuples(st.floats(-180, 180), st.floats(-90, 90)).map(lambda place: tuple(np.round(place, 12).tolist()))


def seen(lens, view, xyz):
    """Page points, and which of the places are seen, the long way round."""
    axes = turned(lens(xyz), view.matrix)
    return view.flattened(axes), axes[:, 2] - view.edge


def parts(path):
    """The lines of a path; `Path.to_polygons` would simplify them for pixels of the size of its unit."""
    begins = np.flatnonzero(path.codes == Path.MOVETO) if len(path.vertices) else np.zeros(0, dtype=int)
    return np.split(path.vertices, begins[1:]) if len(begins) else []


def distance(points, path):
    """Of points (n, 2) from a path of lines."""
    if not len(path.vertices):
        return np.full(len(points), np.inf)
    lines = [shapely.LineString(line) for line in parts(path)]
    with np.errstate(all="ignore"):
        return shapely.distance(shapely.points(points), shapely.MultiLineString(lines))


def test_points_are_those_of_proj():
    lens = fisheye((10.0, 50.0), magnification=6.0)
    lonlat = xyz_to_lonlat(np.random.default_rng(0).normal(size=(500, 3)))
    moved = np.column_stack(Transformer.from_pipeline(lens.to_proj()).transform(*lonlat.T))
    for view, proj in [
        (View(20.0, 35.0), "+proj=ortho +lat_0=35 +lon_0=20 +R=1"),
        (StereographicView(20.0, 35.0, angular_radius=90.0), "+proj=stere +lat_0=35 +lon_0=20 +k_0=0.5 +R=1"),
    ]:
        page = LonLatToPage(lens, view).transform(lonlat)
        shown = ~np.isnan(page[:, 0])
        to_page = Transformer.from_pipeline(
            f"+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad +step {proj}"
        )
        assert np.allclose(page[shown], np.column_stack(to_page.transform(*moved[shown].T)), atol=1e-9)
        assert np.array_equal(shown, seen(lens, view, lonlat_to_xyz(lonlat))[1] >= 0)
    page = LonLatToPage(LENSES[1], VIEWS[0]).transform([(10, 50), (np.nan, 3), (10, 91), (np.inf, 0)])
    assert np.isnan(page).tolist() == [[False, False]] + [[True, True]] * 3


@given(sights, st.floats(0, 0.999999), st.floats(0, 2 * np.pi))
def test_there_and_back(sight, radius, angle):
    globe = LonLatToPage(*sight)
    page = np.array([radius * np.cos(angle), radius * np.sin(angle)])
    # Near the limb of a ball the height is the square root of what is left of 1.
    assert np.allclose(globe.transform(globe.inverted().transform(page)), page, atol=1e-9)
    assert np.isnan(globe.inverted().transform([1.0, 0.1])).all()
    assert globe.inverted().inverted() is globe


@given(sights, st.lists(places, min_size=2, max_size=6, unique=True))
def test_lines_stay_within_the_tolerance(sight, vertices):
    lens, view = sight
    globe = LonLatToPage(lens, view)
    xyz = lonlat_to_xyz(vertices)
    ends = [(a, b) for a, b in pairwise(xyz) if 1e-6 < np.sum((a - b) ** 2) < 4 - 1e-6]
    if len(ends) < len(xyz) - 1:
        return
    path = globe.transform_path(Path(vertices))
    page, height = seen(lens, view, np.concatenate([great_circle_points(a, b, 200) for a, b in ends]))
    if (height > 1e-6).any():
        assert distance(page[height > 1e-6], path).max() <= 1.01 * globe.tolerance
    for line in parts(path):
        for end in (line[0], line[-1]):
            at_vertex = np.abs(page - end).max(axis=1).min() < 1e-9
            assert at_vertex or np.hypot(*end) == pytest.approx(1, abs=1e-9)
    # The limb counts as seen to a depth of 1e-12, which a flat map shows somewhat larger.
    assert len(path.vertices) == 0 or np.hypot(*path.vertices.T).max() <= 1 + 1e-11


CLOSE = fisheye((155.0, 57.5), magnification=1000.0), View(155.0, 57.5)  # the line passes the focus


@pytest.mark.parametrize("sight", [CLOSE, *[(lens, view) for lens in LENSES for view in VIEWS]])
def test_straight_edges_are_straight_on_the_map(sight):
    globe = LonLatToPage(*sight, "straight")
    ends = np.array([(-170.0, 60.0), (120.0, 55.0)])
    turned_round = np.array([(-170.0, 60.0), (-240.0, 55.0)])  # 290° are more than half the map
    share = (np.linspace(-1, 1, 3001)[:, None] ** 3 + 1) / 2  # densest half-way
    page, height = seen(*sight, lonlat_to_xyz((1 - share) * turned_round[0] + share * turned_round[1]))
    path = globe.transform_path(Path(ends))
    assert (height > 1e-6).any() == (len(path.vertices) > 0)
    if len(path.vertices):
        assert distance(page[height > 1e-6], path).max() <= 2 * globe.tolerance


def path_of(polygon):
    parts = [np.asarray(ring.coords) for ring in (polygon.exterior, *polygon.interiors)]
    return Path.make_compound_path(*(Path(part, closed=True) for part in parts))


def agrees(globe, polygon, path, count=300, seed=1):
    """Whether a path winds once around places on the page that are inside a polygon on the map, and not around others.

    But for its border. Winding once, and so also the other way round, is what every renderer fills.
    """
    rng = np.random.default_rng(seed)
    radius, angle = np.sqrt(rng.uniform(0, 1, count)), rng.uniform(0, 2 * np.pi, count)
    page = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    lonlat = globe.inverted().transform(page)
    wanted = np.zeros(count, dtype=bool)
    for shift in (-720.0, -360.0, 0.0, 360.0, 720.0):
        wanted |= shapely.contains_xy(polygon, lonlat[:, 0] + shift, lonlat[:, 1])
    clear = distance(page, path) > 3 * globe.tolerance
    return np.array_equal(wanted[clear], winding(parts(path), page)[clear])


def simple_star(rng, middle, size):
    """A closed ring around a place that contains a disc of a fifth of its size, in either direction; between poles."""
    n = rng.integers(8, 14)
    angle = 2 * np.pi * (np.arange(n) + rng.uniform(0.1, 0.9, n)) / n
    radius = size * rng.uniform(0.35, 1.0, n)[:, None]
    ring = np.asarray(middle) + radius * np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    ring[:, 1] = np.clip(ring[:, 1], -90.0, 90.0)
    return np.vstack([ring, ring[:1]])[:: rng.choice([-1, 1])]


@given(sights, st.integers(0, 10**9), st.floats(-180, 180), st.floats(-70, 70))
def test_rings_within_rings_are_holes_and_islands(sight, seed, lon, lat):
    """By the even-odd rule on the map, in whichever direction and order the rings are given."""
    rng = np.random.default_rng(seed)
    size = rng.uniform(5, 60)
    rings = [simple_star(rng, (lon, lat), size * 0.2**depth) for depth in range(rng.integers(1, 5))]
    rings += [
        simple_star(rng, (lon + 150, 0), 25 * 0.2**depth) for depth in range(rng.integers(0, 4) if size < 45 else 0)
    ]
    shape = shapely.Polygon(rings[0])
    for ring in rings[1:]:
        shape = shape.symmetric_difference(shapely.Polygon(ring))
    path = Path.make_compound_path(*(Path(rings[k], closed=True) for k in rng.permutation(len(rings))))
    globe = LonLatToPage(*sight, "straight")
    assert agrees(globe, shape, globe.transform_path(path))


def followed(ring, count=400):
    """A ring of great circles as a ring on the map, on which longitude goes on where it passes ±180°."""
    xyz = lonlat_to_xyz(ring)
    arcs = [xyz_to_lonlat(great_circle_points(a, b, count)) for a, b in pairwise(xyz)]
    line = np.concatenate(arcs)
    return np.column_stack([np.unwrap(line[:, 0], period=360), line[:, 1]])


@given(sights, st.integers(0, 10**9))
def test_regions_of_great_circles_are_those_of_the_map(sight, seed):
    """Stars with wide edges, far to the north and south, where great circles are far from straight; with a hole."""
    rng = np.random.default_rng(seed)
    middle = rng.uniform(-180, 180), rng.uniform(-50, 50)
    ring = simple_star(rng, middle, rng.uniform(10, 75 - abs(middle[1])))
    shape = shapely.Polygon(followed(ring))
    inner = shape.buffer(-1)
    if not shape.is_valid or inner.is_empty:
        return
    spot = inner.representative_point()
    hole = simple_star(rng, (spot.x, spot.y), 0.4)
    around = shapely.Polygon(followed(hole))
    shape = shape.difference(shapely.affinity.translate(around, 360 * round((spot.x - around.centroid.x) / 360)))
    globe = LonLatToPage(*sight)
    path = Path.make_compound_path(Path(ring, closed=True), Path(hole, closed=True))
    assert agrees(globe, shape, globe.transform_path(path))


def test_a_great_circle_beyond_the_third_corner():
    """On the map its chord runs south of the corner, the great circle north of it: the other way round."""
    ring = np.array([(-60, 60), (60, 60), (0, 70), (-60, 60)], dtype=float)
    path = LonLatToPage(MoebiusMap.identity(), View(0, 72)).transform_path(Path(ring, closed=True))
    x, y = path.vertices.T
    assert 0.001 < np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) / 2 < 0.2


def test_rings_that_touch():
    """Holes at a corner and at a side of their shell, islands that share a side, in all directions."""
    box = shapely.box
    shapes = [
        [box(0, 0, 40, 30), box(0, 0, 10, 10)],
        [box(0, 0, 40, 30), box(0, 10, 10, 20)],
        [box(0, 0, 40, 30), box(40, 0, 50, 30)],
        [box(0, 0, 40, 30), box(0, 30, 40, 50), box(10, 35, 20, 45)],
        [box(0, 0, 40, 30), box(10, 30, 70, 50)],
        [box(0, 0, 40, 30), shapely.Polygon([(40, 30), (30, 5), (10, 5), (5, 20)])],
    ]
    globe = LonLatToPage(fisheye((20, 20), magnification=1.5), View(20, 20), "straight")
    for shape in shapes:
        wanted = shape[0]
        for other in shape[1:]:
            wanted = wanted.symmetric_difference(other)
        for ways in product((1, -1), repeat=len(shape)):
            rings = [np.asarray(part.exterior.coords)[::way] for part, way in zip(shape, ways, strict=True)]
            path = globe.transform_path(Path.make_compound_path(*(Path(ring, closed=True) for ring in rings)))
            assert agrees(globe, wanted, path), (shape, ways)


@pytest.mark.parametrize("sight", [(lens, view) for lens in LENSES for view in VIEWS])
@pytest.mark.parametrize("west", [-180.0, 0.0, 20.3])
def test_seams_of_the_map_are_no_borders(sight, west):
    """Wherever a map is cut: the whole Earth, a band around it, and both with a hole, have no line along the cut."""
    globe = LonLatToPage(*sight, "straight")
    hole = shapely.box(west + 100, 15, west + 160, 60)
    for south, north in ((-90, 90), (-60, 75), (10, 90)):
        whole = shapely.box(west, south, west + 360, north)
        for shape in (whole, whole.difference(hole)):
            path = globe.transform_path(path_of(shape))
            assert agrees(globe, shape, path)
            on_map = globe.inverted().transform(path.vertices * (1 - 1e-9))
            inner = np.hypot(*path.vertices.T) < 0.99
            along = np.abs(np.mod(on_map[:, 0] - west + 180, 360) - 180) < 1e-6
            assert np.count_nonzero(inner & along) <= 4  # parallels pass there


@pytest.mark.parametrize("sight", [(lens, view) for lens in LENSES for view in VIEWS])
def test_a_slit_is_no_border(sight):
    """A ring that is led to its hole and back along the same edge, in sight or hidden."""
    globe = LonLatToPage(*sight)
    for lon in (-150, -20, 40, 100):
        ring = [(lon, -30), (lon + 80, -30), (lon + 80, 30), (lon, 30), (lon, 0)]
        hole = [(lon + 20, 0), (lon + 30, 10), (lon + 40, 0), (lon + 30, -10), (lon + 20, 0), (lon, 0), (lon, -30)]
        slit = globe.transform_path(Path(ring + hole, closed=True))
        apart = Path.make_compound_path(Path([*ring, ring[0]], closed=True), Path(hole[:5], closed=True))
        page = np.random.default_rng(3).uniform(-0.7, 0.7, (500, 2))
        clear = distance(page, slit) > 3 * globe.tolerance
        assert np.array_equal(
            winding(parts(slit), page)[clear], winding(parts(globe.transform_path(apart)), page)[clear]
        )


@pytest.mark.parametrize("start", [0.1, 100.3, 180.0, -179.9])
def test_rings_around_the_earth_hold_the_smaller_side(start):
    """Wherever they begin, with a vertex on the 180th meridian, and with great circles."""
    lon = np.sort(np.append(np.mod(start + np.linspace(0, 360, 23)[:-1], 360), [0.0, 180.0]))
    lon = np.roll(lon, -int(np.argmin(np.abs(np.mod(lon - start + 180, 360) - 180))))
    lon = np.mod(lon + 180, 360) - 180
    for lat, side in ((70, 90), (-50, -90), (20, 90), (-3, -90)):
        ring = np.stack([lon, lat + 2.0 * np.sin(np.radians(3 * lon))], axis=1)
        for way in (1, -1):
            path = Path(np.vstack([ring, ring[:1]])[::way], closed=True)
            for kind in EDGES:
                globe = LonLatToPage(MoebiusMap.identity(), View(30, side), kind)
                size = winding(parts(globe.transform_path(path)), np.array([[0.0, 0.0], [0.3, 0.01]]))
                assert (size == 1).all() or lat in (20, -3)
                other = LonLatToPage(MoebiusMap.identity(), View(30, -side), kind).transform_path(path)
                assert not winding(parts(other), np.array([[0.0, 0.0], [0.3, 0.01]])).any()


def test_several_regions_at_once_are_those_one_by_one(rng):
    rings = Ragged.of([simple_star(rng, rng.uniform((-180, -60), (180, 60)), 30) for _ in range(12)])
    for globe in (LonLatToPage(LENSES[1], VIEWS[0]), LonLatToPage(LENSES[2], VIEWS[1], "straight")):
        owner = np.arange(12) // 2
        loops, region = globe.regions(rings, owner, 6)
        for k in range(6):
            alone, _ = globe.regions(rings.take(owner == k), np.zeros(2, dtype=int), 1)
            assert np.array_equal(np.concatenate([*loops.take(region == k), np.zeros((0, 2))]), alone.values)


def test_opposite_ends_are_joined_over_the_north():
    globe = LonLatToPage(MoebiusMap.identity(), View(0, 90))
    for ends in ([(20, 0), (-160, 0)], [(20, 50), (-160, -50)], [(20, -50), (200, 50)], [(10.1, 5), (-169.9, -5)]):
        line = globe.transform_path(Path(ends)).vertices
        assert np.hypot(*line.T).min() < 1e-12
        assert np.abs(globe.inverted().transform([(0, 1e-3)])).max() <= 180
    # From pole to pole down the meridian that is given.
    side = LonLatToPage(MoebiusMap.identity(), View(30, 0)).transform_path(Path([(30, 90), (30, -90)])).vertices
    assert np.abs(side[:, 0]).max() < 1e-12
    assert np.ptp(side[:, 1]) == pytest.approx(2)


@pytest.mark.parametrize("sight", [(lens, view) for lens in LENSES for view in VIEWS])
def test_regions_around_poles_and_of_everything(sight):
    globe = LonLatToPage(*sight, "straight")
    lon = np.linspace(-180, 180, 25)
    coast = np.stack([lon, -70 + 8 * np.cos(np.radians(3 * lon))], axis=1)
    antarctica = shapely.Polygon([*coast, (180, -90), (-180, -90)])
    # Without the detour over the pole, whose ring goes round it instead.
    assert agrees(globe, antarctica, globe.transform_path(Path(coast, closed=True)))
    north, world = shapely.Polygon([*(coast + (0, 90)), (180, 90), (-180, 90)]), shapely.box(-180, -90, 180, 90)
    ocean = world.difference(shapely.box(-100, -60, 60, 75)).difference(shapely.box(100, -40, 150, 0))
    for shape in (antarctica, north, world, ocean):
        assert agrees(globe, shape, globe.transform_path(path_of(shape)))


def test_curves_and_gaps():
    globe = LonLatToPage(MoebiusMap.identity(), View(0, 0))
    circle = globe.transform_path(Path.circle((0, 0), 10))
    assert np.hypot(*circle.vertices.T).min() > 0.99 * np.sin(np.radians(9.9))
    gap = globe.transform_path(Path([(0, 0), (10, 0), (np.nan, 0), (20, 0), (30, 0)]))
    assert len(parts(gap)) == 2
    assert len(globe.transform_path(Path(np.zeros((0, 2)))).vertices) == 0
