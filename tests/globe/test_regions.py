"""Regions by their borders: what is inside, under lenses and across limb, antimeridian and poles; neighbours tile."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel import MoebiusMap, SphericalVoronoi, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel.curves.chart import Chart
from stereodel.curves.clip import signed_areas
from stereodel.curves.trace import Edges
from stereodel.curves.view import StereographicView, View
from stereodel.globe.regions import SphereRegions
from stereodel.sphere import SphereCircle
from tests.examples import examples
from tests.globe.sights import distance, places, sizes, views, winding
from tests.tiers import by_day

NONE = MoebiusMap.identity()

# Rings, and the west, south, east and north of the boxes that they bound.
BOXES = {
    "plain": ([(10, 20), (50, 20), (50, 60), (10, 60)], (10, 20, 50, 60)),
    "across": ([(170, -10), (-170, -10), (-170, 10), (170, 10)], (170, -10, 190, 10)),
    "beyond": ([(170, -10), (190, -10), (190, 10), (170, 10)], (170, -10, 190, 10)),
    "south as in files": ([(-180, -90), (180, -90), (180, -60), (-180, -60)], (-180, -90, 180, -60)),
    "north once round": ([(0, 60), (90, 60), (180, 60), (-90, 60)], (-180, 60, 180, 90)),
    "south once round": ([(0, -60), (-90, -60), (-180, -60), (90, -60)], (-180, -90, 180, -60)),
    "band": ([(-180, -30), (180, -30), (180, 30), (-180, 30)], (-180, -30, 180, 30)),
    "clockwise": ([(10, 60), (50, 60), (50, 20), (10, 20)], (10, 20, 50, 60)),
    "to the pole": ([(0, 70), (40, 70), (40, 90), (0, 90)], (0, 70, 40, 90)),
    "the world": ([(-180, -90), (180, -90), (180, 90), (-180, 90)], (-180, -90, 180, 90)),
}


def seen_places(lens, view, seed=0, n=300):
    """Places in the disc, evenly, and where they are on the sphere."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform(-1, 1, (n, 2))
    xy = xy[np.hypot(*xy.T) < 0.995]
    return xy, lens.inverse()(view.raised(xy) @ view.matrix)


def near_to(loops, xy):
    """Distances of places from the nearest side of the loops."""
    return (
        np.min([distance(xy, loop) for loop in loops], axis=0, initial=np.inf)
        if len(loops)
        else np.full(len(xy), np.inf)
    )


def in_box(xyz, box):
    west, south, east, north = box
    lon, lat = xyz_to_lonlat(xyz).T
    return (np.mod(lon - west, 360) <= east - west) & (south <= lat) & (lat <= north)


@examples(0.4)
@example(focus=(0.0, -66.0), size=1e5, view=View(0.0, 0.0), name="south as in files")
@given(focus=places, size=sizes(-3, 6), view=views, name=st.sampled_from(sorted(BOXES)))
def test_boxes_hold_what_they_should_under_every_lens(focus, size, view, name):
    """Winding numbers of the loops on the page against the box itself, at places all over the disc."""
    ring, box = BOXES[name]
    lens = fisheye(focus, magnification=size)
    loops, owner = SphereRegions.of_lonlat([[ring]]).on(Chart(lens, view))
    assert (owner == 0).all()
    xy, xyz = seen_places(lens, view)
    clear = near_to(loops, xy) > 3e-4
    found = winding(loops, xy)
    np.testing.assert_array_equal(found[clear] > 0, in_box(xyz, box)[clear])
    assert set(found[clear].tolist()) <= {0, 1}


@pytest.mark.parametrize("name", BOXES)
def test_outlines_have_no_seam(name):
    """Outlines are as long as the true border, without the sides along ±180° and to the poles."""
    regions = SphereRegions.of_lonlat([[BOXES[name][0]]])
    points, offsets = regions.outlines.through(NONE, tolerance=1e-5)
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    steps[offsets[1:-1] - 1] = 0.0
    west, south, east, north = (np.radians(side) for side in BOXES[name][1])
    expected = (east - west) * (np.cos(south) + np.cos(north)) + 2 * (north - south) * (east - west < 6.28)
    assert steps.sum() == pytest.approx(expected, rel=1e-3, abs=1e-12)


def test_a_region_of_repeated_points_is_nothing():
    regions = SphereRegions.of_lonlat([[[(10, 10), (20, 10), (10, 10), (20, 10)]]])
    for view in (View(15, 10), View(-165, -10)):
        loops, _ = regions.on(Chart(NONE, view))
        assert np.abs(signed_areas(loops)[0].sum()) < 1e-9


@pytest.mark.parametrize("size", by_day([1.0, 10.0, 1000.0], 10.0))
@pytest.mark.parametrize("view", [View(10, 20), View(2.35, 48.86), StereographicView(-50, -60, angular_radius=130)])
def test_cells_tile_the_disc(size, view):
    """The cells together are the disc, and each is where its site is the nearest."""
    voronoi = SphericalVoronoi(np.random.default_rng(3).normal(size=(300, 3)))
    chart = Chart(fisheye((2.35, 48.86), magnification=size), view, tolerance=1e-4)
    loops, owner = SphereRegions.cells(voronoi).on(chart)
    assert signed_areas(loops)[0].sum() == pytest.approx(np.pi, rel=1e-4)
    xy, xyz = seen_places(chart.lens, view, n=200)
    clear = near_to(loops, xy) > 3e-4
    nearest = np.argmax(xyz @ voronoi.points.T / np.linalg.norm(voronoi.points, axis=1), axis=1)
    for site in np.unique(nearest[clear]):
        inside = winding([loop for loop, its in zip(loops, owner, strict=True) if its == site], xy)
        np.testing.assert_array_equal(inside[clear] > 0, (nearest == site)[clear])


def test_a_cell_may_hold_all_that_is_seen():
    """Of two hundred cells one is all of the disc, where the lens shows no border."""
    points = np.random.default_rng(3).normal(size=(200, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    lens = fisheye(points[17], magnification=1e6)
    chart = Chart(lens, View(*xyz_to_lonlat(lens(points[17]))))
    loops, owner = SphereRegions.cells(SphericalVoronoi(points)).on(chart)
    assert owner.tolist() == [17]
    assert signed_areas(loops)[0] == pytest.approx([np.pi], rel=1e-5)


# Far larger than the view, through a strong lens: its border is behind the globe, and no larger than a point there.
@examples(0.4)
@example(focus=(0.0, 0.0), size=1e4, view=View(0.0, 0.0), radius=152.0, at=(0.0, 0.0))
@given(focus=places, size=sizes(-2, 4), view=views, radius=st.floats(1, 179), at=places)
def test_the_insides_of_circles(focus, size, view, radius, at):
    circle = SphereCircle.around(at, radius)
    lens = fisheye(focus, magnification=size)
    loops, _ = SphereRegions.circles([circle]).on(Chart(lens, view))
    xy, xyz = seen_places(lens, view)
    clear = near_to(loops, xy) > 3e-4
    np.testing.assert_array_equal(winding(loops, xy)[clear] > 0, circle.contains(xyz)[clear])


@given(focus=places, size=sizes(-2, 4), view=views, name=st.sampled_from(sorted(BOXES)))
def test_edges_that_are_left_out_are_out_of_sight(focus, size, view, name):
    chart = Chart(fisheye(focus, magnification=size), view)
    regions = SphereRegions.of_lonlat([[BOXES[name][0]]])
    some, _ = regions.on(chart)
    lines = regions.outlines.on(chart)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Edges, "within", lambda self, center, reach: np.ones(len(self), dtype=bool))
        whole, _ = regions.on(chart)
        np.testing.assert_array_equal(lines.values, regions.outlines.on(chart).values)
    np.testing.assert_array_equal(some.values, whole.values)


@pytest.mark.parametrize(
    ("rings", "message"), [([[(0, 0), (1, 1)]], "needs three"), ([[(0, 95), (1, 1), (2, 2)]], "latitude")]
)
def test_bad_rings_are_named(rings, message):
    with pytest.raises(ValueError, match=r"polygons\[1\].*" + message):
        SphereRegions.of_lonlat([[[(0, 0), (1, 0), (1, 1)]], rings])


def test_tiny_regions_at_huge_magnification_are_smooth():
    """A circle of a metre of many sides, ten million times larger: its image's outline has no long chords."""
    t = np.arange(8) * np.pi / 4
    ring = np.stack([2.0 + 1e-5 * np.cos(t), 48.0 + 1e-5 * np.sin(t)], axis=1)
    lens = fisheye((2.0, 48.0), magnification=1e7)
    chart = Chart(lens, View(*xyz_to_lonlat(lens(lonlat_to_xyz((2.0, 48.0))))))
    loops, _ = SphereRegions.of_lonlat([[ring]]).on(chart)
    (loop,) = loops
    assert np.linalg.norm(np.diff(loop, axis=0), axis=1).max() < 0.25
