"""Cells and triangles of the sphere on the map: valid, counterclockwise, and a tiling whatever the points are."""

import antimeridian
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from stereodel import SphericalDelaunay, SphericalVoronoi, check_delaunay
from stereodel.curves.ragged import Ragged
from stereodel.io import to_geodataframe
from stereodel.io.maps import on_map, tiles
from stereodel.io.rows_of import rows_of
from stereodel.sphere import angular_distance, lonlat_to_xyz, xyz_to_lonlat
from tests import sets
from tests.examples import examples

WORLD = 360.0 * 180.0
RANDOM = sets.sphere("unit").drawn(100)


def circle(count, axis, shift=0.0):
    """Points of the great circle around a coordinate axis."""
    t = 2 * np.pi * np.arange(count) / count + shift
    return np.insert(np.column_stack([np.cos(t), np.sin(t)]), axis, 0.0, axis=1)


def lonlat_grid(step, shift=0.0):
    return [[lon + shift, lat] for lon in np.arange(-180, 180, step) for lat in np.arange(-90 + step, 90, step)]


def cluster(center, size, count=20):
    return np.asarray(center) + size * np.random.default_rng(3).normal(size=(count, 3))


STATION = [[60 * k, -89.99] for k in range(6)] + [[0, -90]]
AT_THE_BORDER = np.random.default_rng(5).normal([180, 0], [2, 3], size=(60, 2)) % [360, 90]
ON_THE_MAP = {
    "meridians 0 and 180": circle(7, 1, 0.1),
    "meridians 90 and -90": circle(6, 0),
    "border over both poles": lonlat_to_xyz([[0, 1], [1, 1]]),
    "graticule": lonlat_to_xyz(lonlat_grid(15)),
    "graticule beside the 180th meridian": lonlat_to_xyz(lonlat_grid(15, 7.5)),
    "cluster at the 180th meridian": cluster([-1, 0, 0], 1e-12),
    "cluster at the limit of rounding": cluster([0.3, -0.5, 0.2], 1e-15),
    "station at the south pole": np.vstack([lonlat_to_xyz(STATION), RANDOM[:30]]),
    "narrow strips": np.vstack([lonlat_to_xyz([[10, 50 + 1e-5 * k] for k in range(12)]), RANDOM[:5]]),
    "around the 180th meridian": np.vstack([lonlat_to_xyz(AT_THE_BORDER), RANDOM[:10]]),
    "around a pole": np.vstack([cluster([0, 0, 1], 1e-3, 60), RANDOM[:10]]),
    "on coordinate planes": np.vstack([circle(24, axis, 0.1 * axis) for axis in range(3)]),
    "pairs": np.vstack([RANDOM, RANDOM * (1 + 1e-7 * RANDOM[::-1])]),
}
"""What is hard about the 180th meridian, the poles and chords, beside what is hard on any sphere."""

BELOW_ROUNDING = {f"sphere {name}" for name in ("needles", "a rounding and 8 far", "ends of an axis", "mixed scales")}
"""Whose triangles and cells are smaller than the rounding of degrees, so that rows vanish or turn over."""

SETS = [
    *(pytest.param(points, id=name) for name, points in ON_THE_MAP.items()),
    *(
        pytest.param(one.values[0].drawn(60), id=one.id)
        for one in sets.of("sphere", without=["sizes"])[1:]
        if one.id not in BELOW_ROUNDING
    ),
    pytest.param(sets.sphere("airports").drawn(28_298), id="all airports", marks=pytest.mark.thorough),
]


def nothing(net, block):
    """No arc is off the border."""
    return np.zeros(len(net.ends[block]), dtype=bool)


@pytest.mark.parametrize("step", [1e-6, 1e-12, 1e-14, 3e-16])
@pytest.mark.parametrize("what", ["cells", "triangles"])
def test_points_on_a_great_circle_but_for_rounding(step, what):
    """Triangles and cells without a width to speak of: nothing fails, nothing is invalid, nothing covers the map."""
    frame_of_axes = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    angle = np.array([0, step, 2 * step, 1, 2, 2 + step, 4])
    points = np.cos(angle)[:, None] * frame_of_axes[0] + np.sin(angle)[:, None] * frame_of_axes[1]
    frame = to_geodataframe(SphericalVoronoi(points), what=what)
    assert frame.is_valid.all()
    assert shapely.area(frame.geometry.values).sum() == pytest.approx(frame["area"].sum() * WORLD / (4 * np.pi), abs=1)


def assert_tiles(geometry):
    """Valid, with outer rings counterclockwise, as large as the map and covering it."""
    parts = shapely.get_parts(geometry)
    assert shapely.is_valid(geometry).all()
    assert shapely.is_ccw(shapely.get_exterior_ring(parts)).all()
    assert shapely.area(geometry).sum() == pytest.approx(WORLD, abs=1e-6)
    assert shapely.area(shapely.union_all(geometry)) == pytest.approx(WORLD, abs=1e-6)
    assert shapely.total_bounds(geometry).tolist() == [-180, -90, 180, 90]


@pytest.mark.parametrize("points", SETS)
def test_cells_tile_the_map(monkeypatch, points):
    """Each holds its point, where those of a cluster do not coincide; the way by the border has the same bytes."""
    diagram = SphericalVoronoi(points)
    frame, sites = to_geodataframe(diagram), to_geodataframe(diagram, what="sites")
    assert_tiles(frame.geometry.values)
    assert (diagram.point_region[frame["point"]] == frame["point"]).all()
    assert frame["area"].sum() == pytest.approx(4 * np.pi, abs=1e-10)
    assert (shapely.distance(frame.geometry.values, np.asarray(sites.geometry)[frame["point"]]) < 1e-9).all()
    assert_long_way_is_the_same(monkeypatch, diagram)


def assert_long_way_is_the_same(monkeypatch, diagram, latitude="spherical"):
    def layers():
        options = {"latitude": latitude, "max_segment": 20.0}
        return [rows_of(diagram, what=what, **options).binary.tolist() for what in ("cells", "triangles")]

    short = layers()
    monkeypatch.setattr(tiles, "_inland", nothing)
    assert layers() == short


def test_the_long_way_to_many_cells(monkeypatch):
    """And to those of latitudes of the ellipsoid. Most take the short way, or two long ways were compared."""
    diagram, asked = SphericalVoronoi(sets.sphere("random").drawn(3000)), []
    clipped = tiles._clipped_block
    with monkeypatch.context() as patch:
        patch.setattr(tiles, "_clipped_block", lambda faces, sides: asked.append(len(faces)) or clipped(faces, sides))
        rows_of(diagram)
    assert 0 < sum(asked) < 400  # those at ±180° and at the poles
    assert_long_way_is_the_same(monkeypatch, diagram, "authalic")


@pytest.mark.parametrize("points", [one for one in SETS if one.id != "cluster at the limit of rounding"])
def test_triangles_tile_the_map_but_for_closing_ones(points):
    triangulation = SphericalDelaunay(points)
    check_delaunay(triangulation.points, triangulation.simplices)
    frame = to_geodataframe(triangulation)
    assert len(frame) == np.count_nonzero(~triangulation.closing)
    assert frame.is_valid.all()
    assert (frame[["a", "b", "c"]].to_numpy() == triangulation.simplices[frame["triangle"]]).all()
    if len(frame) and not triangulation.closing.any():
        assert_tiles(frame.geometry.values)
        assert frame["area"].sum() == pytest.approx(4 * np.pi, abs=1e-10)


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("height", [1e-2, 1e-5, 1e-7])
def test_a_thin_triangle_keeps_its_orientation(side, height):
    """The third corner is 0.6 m to 60 km from the longest side, whose chords of 10° stray by more."""
    a, b = lonlat_to_xyz([[0, 60], [40, 60]])
    normal = np.cross(a, b) / np.linalg.norm(np.cross(a, b))
    triangulation = SphericalDelaunay([a, b, 0.6 * a + 0.4 * b + side * height * normal])
    check_delaunay(triangulation.points, triangulation.simplices)
    frame = to_geodataframe(triangulation, max_segment=10)
    ring = shapely.get_exterior_ring(frame.geometry.values)
    assert frame.is_valid.all()
    assert shapely.is_ccw(ring).tolist() == [True]
    fine = shapely.segmentize(ring[0], 0.01)
    lambert = np.radians(shapely.get_coordinates(fine))
    assert shapely.Polygon(np.column_stack([lambert[:, 0], np.sin(lambert[:, 1])])).area > 0


@pytest.mark.parametrize("name", ["graticule", "station at the south pole", "narrow strips"])
def test_neighbours_share_points(name):
    """A coverage: no gaps, no overlaps, no vertex in the middle of a neighbour's side."""
    parts = shapely.get_parts(to_geodataframe(SphericalVoronoi(ON_THE_MAP[name])).geometry.values)
    assert shapely.coverage_is_valid(parts)


def chords(geometry):
    """Both ends of every chord of outer rings that does not run along the border of the map, as unit vectors."""
    rings = [shapely.get_coordinates(ring) for ring in shapely.get_exterior_ring(shapely.get_parts(geometry))]
    steps = np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings])
    border = (np.abs(steps[:, :, 0]) == 180).all(axis=1) | (np.abs(steps[:, :, 1]) == 90).all(axis=1)
    return steps[~border]


@pytest.mark.parametrize("max_segment", [0.5, 2.0, 90.0])
def test_chords_are_short(max_segment):
    steps = chords(to_geodataframe(SphericalVoronoi(RANDOM), max_segment=max_segment).geometry.values)
    xyz = lonlat_to_xyz(steps)
    assert angular_distance(xyz[:, 0], xyz[:, 1]).max() <= max_segment * (1 + 1e-12)
    assert np.abs(steps[:, 1, 0] - steps[:, 0, 0]).max() <= max_segment * (1 + 1e-12)


def test_chords_follow_great_circles():
    """Every point of a cell's border is as far from the cell's site as from the nearest other one."""
    diagram = SphericalVoronoi(RANDOM)
    frame = to_geodataframe(diagram)
    for point, cell in zip(frame["point"], frame.geometry, strict=True):
        corners = chords(np.array([cell]))[:, 0]
        gaps = np.sort(angular_distance(lonlat_to_xyz(corners)[:, None], RANDOM[None]), axis=1)
        own = angular_distance(lonlat_to_xyz(corners), RANDOM[point])
        assert np.abs(own - gaps[:, 0]).max() < 1e-11
        on_map_border = (np.abs(corners[:, 0]) == 180) | (np.abs(corners[:, 1]) == 90)
        assert (gaps[~on_map_border, 1] - gaps[~on_map_border, 0]).max() < 1e-11


@pytest.mark.parametrize("latitude", ["spherical", "geodetic", "authalic"])
def test_areas_in_an_equal_area_projection(latitude):
    """Lambert's cylinder (λ, sin φ) keeps areas; chords of 0.1° are near enough to great circles."""
    diagram = SphericalVoronoi.from_lonlat(np.column_stack([RANDOM[:, 0] * 100, RANDOM[:, 1] * 25]), latitude=latitude)
    frame = to_geodataframe(diagram, max_segment=0.1, latitude=latitude)
    back = {"spherical": lambda lat: lat}.get(latitude) or (
        lambda lat: np.degrees(np.arcsin(lonlat_to_xyz(np.column_stack([0 * lat, lat]), latitude=latitude)[:, 2]))
    )
    flat = shapely.transform(
        frame.geometry.values,
        lambda c: np.column_stack([np.radians(c[:, 0]), np.sin(np.radians(back(c[:, 1])))]),
    )
    assert np.abs(shapely.area(flat) / frame["area"] - 1).max() < 1e-5


@examples(0.5)
@given(
    st.lists(
        st.tuples(st.sampled_from([-180.0, -90.0, 0.0, 90.0, 179.0]) | st.floats(-180, 180), st.floats(-90, 90)),
        min_size=1,
        max_size=12,
    )
)
def test_any_points_give_a_tiling(lonlat):
    assert_tiles(to_geodataframe(SphericalVoronoi.from_lonlat(lonlat), max_segment=15).geometry.values)


def test_cells_are_those_of_antimeridian():
    """As that package cuts them, from many steps between corners."""
    diagram, share = SphericalVoronoi(RANDOM), np.linspace(0, 1, 60)[:-1, None]
    for region, cell in zip(diagram.regions, to_geodataframe(diagram).geometry, strict=True):
        corners = diagram.vertices[region]
        steps = [a + share * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
        ring = shapely.Polygon(xyz_to_lonlat(np.concatenate(steps)))
        theirs = antimeridian.fix_polygon(ring, fix_winding=False, great_circle=True)
        assert shapely.symmetric_difference(theirs, cell).area < 0.01 * cell.length


# What is said of rings without Shapely.

STEPS = st.tuples(st.integers(-3, 3), st.integers(-3, 3))


@given(st.lists(st.lists(STEPS, min_size=3, max_size=9), min_size=1, max_size=6))
def test_rings_that_are_simple_are_valid_and_counterclockwise(rings):
    """Of any corners on a small grid, with points that repeat, sides that touch, and rings that turn twice."""
    rows = Ragged.of([np.array(ring, dtype=np.float64) for ring in rings])
    for ring, found in zip(rings, on_map.simple(rows).tolist(), strict=True):
        outline = shapely.LinearRing(ring)
        assert not found or (shapely.Polygon(outline).is_valid and outline.is_ccw), ring


@given(st.lists(st.lists(STEPS, min_size=3, max_size=9), min_size=1, max_size=6), st.booleans())
def test_convex_rings_are_simple_one_way_round(rings, turned):
    hulls = [shapely.MultiPoint(ring).convex_hull for ring in rings]
    corners = [shapely.get_coordinates(hull.exterior)[:0:-1] for hull in hulls if hull.geom_type == "Polygon"]
    wanted = [shapely.LinearRing(ring).is_ccw for ring in corners]
    rows = Ragged.of([ring[::-1] if turned else ring for ring in corners], np.zeros((0, 2)))
    if len(rows):
        assert on_map.simple(rows).tolist() == [each != turned for each in wanted]


def test_of_parts_side_by_side_and_on_each_other():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], dtype=np.float64)
    loops = Ragged.of([square, square + [2, 0], square, square + [0.5, 0], square, square + [1, 0], square[::-1]])
    owner = np.array([0, 0, 1, 1, 2, 2, 3])
    polygons, outer = on_map.polygons_on_map(loops, owner, 5)
    assert outer.tolist() == [True] * 6 + [False]
    assert [cell is None for cell in polygons] == [False, False, False, True, True]
    # Parts that overlap, and parts that share a side, are no valid MultiPolygon; a hole alone is nothing.
    assert on_map.invalid(polygons, loops, owner).tolist() == [False, True, True, False, False]


def test_rings_that_turn_twice_or_touch_themselves_are_not_simple():
    turns = np.radians(90 + 72 * np.arange(5))
    pentagon = np.column_stack([np.cos(turns), np.sin(turns)])
    star = pentagon[[0, 2, 4, 1, 3]]  # each side has the middle on its left, twice around
    touching = np.array([[0, 0], [4, 0], [4, 2], [2, 0], [0, 2]], dtype=np.float64)
    notched = touching + np.array([[0, 0], [0, 0], [0, 0], [0, 0.5], [0, 0]])
    still = np.repeat(pentagon, 2, axis=0)
    rings = Ragged.of([pentagon, star, touching, notched, notched[::-1], still])
    assert on_map.simple(rings).tolist() == [True, False, False, True, False, True]
