"""Regions and lines of maps under lenses, across limb, antimeridian and poles: what is inside, cut, and tiles."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel import MoebiusMap, SphericalVoronoi, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel.curves.chart import Chart
from stereodel.curves.clip import signed_areas
from stereodel.curves.ragged import Ragged, thinned
from stereodel.curves.trace import Edges
from stereodel.curves.view import StereographicView, View
from stereodel.globe.outlines_on_sphere import SphereLines, SphereRegions
from stereodel.sphere import SphereArc, SphereCircle
from stereodel.sphere.vectors import turned
from tests.examples import examples
from tests.globe.sights import distance, length, sampled, views, winding
from tests.strategies import LONLAT, decades
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
    return np.min([np.full(len(xy), np.inf), *(distance(xy, loop) for loop in loops)], axis=0)


@examples(0.4)
@example(focus=(0.0, -66.0), size=1e5, view=View(0.0, 0.0), name="south as in files")
@given(focus=LONLAT, size=decades(-3, 6), view=views, name=st.sampled_from(sorted(BOXES)))
def test_boxes_hold_what_they_should_under_every_lens(focus, size, view, name):
    """Winding numbers of the loops on the page against the box itself, at places all over the disc."""
    ring, (west, south, east, north) = BOXES[name]
    lens = fisheye(focus, magnification=size)
    loops, owner = SphereRegions.of_lonlat([[ring]]).on(Chart(lens, view))
    assert (owner == 0).all()
    xy, xyz = seen_places(lens, view)
    clear = near_to(loops, xy) > 3e-4
    found = winding(loops, xy)
    lon, lat = xyz_to_lonlat(xyz).T
    inside = (np.mod(lon - west, 360) <= east - west) & (south <= lat) & (lat <= north)
    np.testing.assert_array_equal(found[clear] > 0, inside[clear])
    assert set(found[clear].tolist()) <= {0, 1}


@pytest.mark.parametrize("name", BOXES)
def test_outlines_have_no_seam(name):
    """Outlines are as long as the true border, without the sides along ±180° and to the poles."""
    regions = SphereRegions.of_lonlat([[BOXES[name][0]]])
    west, south, east, north = (np.radians(side) for side in BOXES[name][1])
    expected = (east - west) * (np.cos(south) + np.cos(north)) + 2 * (north - south) * (east - west < 6.28)
    assert length(regions.outlines) == pytest.approx(expected, rel=1e-3, abs=1e-12)


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
@given(focus=LONLAT, size=decades(-2, 4), view=views, radius=st.floats(1, 179), at=LONLAT)
def test_the_insides_of_circles(focus, size, view, radius, at):
    circle = SphereCircle.around(at, radius)
    lens = fisheye(focus, magnification=size)
    loops, _ = SphereRegions.circles([circle]).on(Chart(lens, view))
    xy, xyz = seen_places(lens, view)
    clear = near_to(loops, xy) > 3e-4
    np.testing.assert_array_equal(winding(loops, xy)[clear] > 0, circle.contains(xyz)[clear])


@given(focus=LONLAT, size=decades(-2, 4), view=views, name=st.sampled_from(sorted(BOXES)))
def test_edges_that_are_left_out_are_out_of_sight(focus, size, view, name):
    chart = Chart(fisheye(focus, magnification=size), view)
    regions = SphereRegions.of_lonlat([[BOXES[name][0]]])
    some, _ = regions.on(chart)
    lines, _ = regions.outlines.on(chart)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Edges, "within", lambda self, center, reach: np.ones(len(self), dtype=bool))
        whole, _ = regions.on(chart)
        np.testing.assert_array_equal(lines.values, regions.outlines.on(chart)[0].values)
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


def test_jumps_across_the_antimeridian_go_the_short_way():
    """From one side of it to the other there is no way at all."""
    lines = SphereLines.straight_in_lonlat([[(170, 10), (-170, 12), (-160, 12)], [(-179, 0), (179, 0)]])
    assert np.abs(xyz_to_lonlat(sampled(lines).values)[:, 0]).min() > 159.9
    assert len(lines.sides) == 2
    assert length(SphereLines.straight_in_lonlat([[(180, 10), (-180, 10), (-170, 10)]])) < np.radians(10)


@given(start=LONLAT, end=LONLAT, focus=LONLAT, size=decades(-2, 6), view=views)
def test_what_is_seen_of_an_arc_is_on_its_exact_image(start, end, focus, size, view):
    """All of the image in the disc is near what is drawn, and what is drawn is near the image."""
    a, b = lonlat_to_xyz([start, end])
    if not 1e-3 < np.linalg.norm(a - b) < 1.999:
        return
    lens = fisheye(focus, magnification=size)
    chart = Chart(lens, view, tolerance=1e-3)
    seen, _ = SphereLines.great(a[None], b[None]).on(chart)
    axes = turned(lens.image_of(SphereArc.great(a, b)).sample(4000), view.matrix)
    truth = view.flattened(axes[axes[:, 2] > view.edge])
    if not len(seen):
        # Out of sight, but for a point on the rim.
        assert len(truth) == 0 or np.ptp(truth, axis=0).max() < 1e-2
        return
    assert (np.hypot(*seen.values.T) <= 1 + 1e-9).all()
    gaps = np.min([distance(truth, line) for line in seen], axis=0) if len(truth) else np.zeros(1)
    assert gaps.max() <= 2.2e-3
    # Ends are ends of the image, or on the rim.
    ends = np.concatenate([seen.values[seen.offsets[:-1]], seen.values[seen.offsets[1:] - 1]])
    own = view.flattened(turned(lens(np.stack([a, b])), view.matrix))
    away = np.minimum(np.abs(np.hypot(*ends.T) - 1), np.linalg.norm(ends[:, None] - own, axis=-1).min(axis=1))
    assert away.max() < 1e-9


def test_lines_out_of_sight_leave_nothing():
    lines = SphereLines.straight_in_lonlat([[(170, -10), (175, -20), (180, -30)]])
    for view in (View(0, 0), StereographicView(0, 0, angular_radius=100)):
        seen, _ = lines.on(Chart(NONE, view))
        assert seen.values.shape == (0, 2)
        assert len(seen) == 0
    assert len(SphereLines.straight_in_lonlat([]).on(Chart(NONE, View(0, 0)))[0]) == 0


@given(st.integers(0, 1000), st.floats(0.01, 1.0))
def test_thinning_moves_no_line_by_more_than_the_spacing(seed, spacing):
    rng = np.random.default_rng(seed)
    lines = Ragged(np.cumsum(rng.normal(scale=0.1, size=(60, 2)), axis=0), np.array([0, 20, 22, 60]))
    for line, thin in zip(lines, thinned(lines, spacing), strict=True):
        assert (thin[0] == line[0]).all()
        assert (thin[-1] == line[-1]).all()
        assert np.linalg.norm(line[:, None] - thin, axis=-1).min(axis=1).max() <= spacing


@pytest.mark.parametrize("size", [1e4, 1e8, 1e12])
@pytest.mark.parametrize("latitude", ["spherical", "authalic"])
def test_long_edges_through_a_strong_lens_are_exact_and_few_pieces(size, latitude):
    """Through the focus, beside it and far from it; equal pieces would be ten million."""
    ends = np.array([[(-8.0, 45.0), (12.0, 52.0)], [(-8.0, 45.1), (12.0, 52.0)], [(100.0, 0.0), (120.0, 30.0)]])
    focus, tolerance = ends[0].mean(axis=0), 1e-4
    lens = fisheye(lonlat_to_xyz(focus, latitude=latitude), magnification=size)
    edges = SphereLines.straight_in_lonlat(ends, latitude).edges
    arcs = edges.arcs_under(lens, tolerance)
    assert len(arcs) < 3000
    assert (np.diff(arcs.edge) >= 0).all()
    for edge, (start, end) in enumerate(ends):
        own = arcs.take(arcs.edge == edge)
        assert np.array_equal(own.start[0], lonlat_to_xyz(start, latitude=latitude))
        assert np.array_equal(own.end[-1], lonlat_to_xyz(end, latitude=latitude))
        assert np.array_equal(own.start[1:], own.end[:-1])
        # Closer and closer to the focus, as the lens shows it.
        near = 0.5 + np.array([-1, 1])[:, None] * np.geomspace(0.5, 1e-3 / size, 40)
        truth = lens(lonlat_to_xyz(start + np.sort(near.ravel())[:, None] * (end - start), latitude=latitude))
        drawn = own.through(lens).sampled(tolerance / 2).values
        assert distance(truth, drawn).max() <= tolerance + 4e-16 * size  # the rounding of the places
