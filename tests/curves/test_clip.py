"""Lines and regions clipped and closed: ends of lines, membership told in a gnomonic plane, tilings, hard cases."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

from stereodel import SphereCircle, SphericalVoronoi, fisheye
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Box, Cap
from stereodel.curves.fill import triangles
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import great
from stereodel.curves.view import StereographicView, View
from stereodel.io.rows_of import voronoi_sides
from tests import sets
from tests.curves.oracle import Star, in_sight, off_lines, ring, rings, rows, units, whole_circles, winding
from tests.examples import examples
from tests.strategies import SEEDS

X, Y, Z = np.eye(3)
FRONT = View(0, 0)


def area(loops):
    return clip.signed_areas(loops)[0].sum()


def cells(diagram):
    """The ridges of a diagram, and the sides of each cell."""
    ends = diagram.vertices[diagram.ridge_vertices]
    return great(ends[:, 0], ends[:, 1], diagram.ridge_normals()), voronoi_sides(diagram)


def any_view(rng):
    place = rng.uniform(-180, 180), rng.uniform(-90, 90)
    if rng.random() < 0.5:
        return View(*place)
    return StereographicView(*place, angular_radius=float(rng.choice([10.0, 90.0, 170.0])))


@given(SEEDS)
@examples(0.5)
def test_regions_hold_what_they_hold_on_the_sphere(seed):
    """Stars of half a degree to a hemisphere and their complements, with holes, under lenses from 0.1 to 1000."""
    rng = np.random.default_rng(seed)
    center = units(rng.normal(size=3))
    high = rng.choice([0.5, 20, 80])
    outer = Star(rng, center, high / 3, high, rng.integers(3, 14))
    if not outer.round:
        return
    inner = Star(rng, center, high / 40, high / 5, rng.integers(3, 9)) if rng.random() < 0.5 else None
    if inner is not None and not (inner.round and outer.surrounds(inner)):
        inner = None
    parts = [outer.points] + ([inner.points[::-1]] if inner is not None else [])
    everything_else = rng.random() < 0.5
    arcs, sides = rings([part[::-1] if everything_else else part for part in parts])
    lens = fisheye(units(rng.normal(size=3)), magnification=float(10 ** rng.uniform(-1, 3)))
    view, tolerance = any_view(rng), 1e-4
    loops, _ = in_sight(arcs.through(lens), sides, view, tolerance)
    places = rng.uniform(-1, 1, (200, 2))
    places = places[np.hypot(*places.T) < 0.999]
    there = lens.inverse()(view.raised(places) @ view.matrix)
    wanted = outer.holds(there) & ~(inner.holds(there) if inner is not None else False)
    wanted = wanted != everything_else
    found = winding(loops, places)
    clear = off_lines(places, loops) > 3 * tolerance
    assert set(found[clear].tolist()) <= {0, 1}
    assert ((found > 0) == wanted)[clear].all()


def test_a_line_that_begins_in_sight_and_a_closed_one():
    cap = Cap(FRONT, 1e-4)
    arcs = great(units([[1, 1, 0], [0, 1, 0]]), units([[0, 1, 0], [-1, 1, 0]])).turned(FRONT.matrix)
    pieces = cap.cut(arcs)
    found, line = clip.lines(rows(2), pieces, pieces.arcs.sampled(1e-4), cap)
    assert len(found) == 1
    np.testing.assert_allclose(found.values[[0, -1]], [[0.5**0.5, 0], [1, 0]], atol=1e-11)
    # A circle over the limb that is given from its hidden half on is one line, not two.
    circle, sides = whole_circles([SphereCircle.around((90, 0), 30.0)])
    for begun in (sides, Ragged(sides.values[::-1].copy(), sides.offsets)):
        pieces = cap.cut(circle.turned(FRONT.matrix))
        found, _ = clip.lines(begun, pieces, pieces.arcs.sampled(1e-4), cap)
        assert len(found) == 1
    assert line.tolist() == [0]


def test_lines_run_backwards_have_the_same_points(rng):
    points = units(rng.normal(size=(9, 3)))
    cap = Cap(FRONT, 1e-3)
    pieces = cap.cut(great(points[:-1], points[1:]).turned(FRONT.matrix))
    samples = pieces.arcs.sampled(1e-3)
    there, _ = clip.lines(rows(8), pieces, samples, cap)
    back, _ = clip.lines(Ragged(~np.arange(8)[::-1], np.array([0, 8])), pieces, samples, cap)
    for ours, theirs in zip(there, list(back)[::-1], strict=True):
        np.testing.assert_array_equal(ours, theirs[::-1])


BEHIND = Star(np.random.default_rng(0), -X, 5, 30, 8).points
HOLE = Star(np.random.default_rng(1), -X, 1, 3, 8).points


@pytest.mark.parametrize(
    ("parts", "wanted"),
    [
        pytest.param([[X, Y, Z]], np.pi / 4, id="octant"),
        pytest.param([[-X, Z, Y]], 0.0, id="hidden octant"),
        pytest.param([[X, Z, Y]], 3 * np.pi / 4, id="all but an octant"),
        pytest.param([[-X, Y, Z]], np.pi, id="all but a hidden octant"),
        pytest.param([[Y, Z, -Y, (1, 0, 1)]], np.pi / 2 - np.pi / 2 * 0.5**0.5, id="sides on the limb"),
        pytest.param([BEHIND], 0.0, id="hidden"),
        pytest.param([BEHIND[::-1]], np.pi, id="all but what is hidden"),
        pytest.param([BEHIND, HOLE[::-1]], 0.0, id="hidden with a hole"),
        pytest.param([BEHIND[::-1], HOLE], np.pi, id="all but a hidden ring"),
    ],
)
def test_areas_in_sight(parts, wanted):
    """With vertices and sides on the limb, and where all rings are hidden: then all or nothing."""
    loops, _ = in_sight(*rings(parts), FRONT, 1e-6)
    assert area(loops) == pytest.approx(wanted, abs=1e-5)


@pytest.mark.parametrize("lon", [60.0, 60 - 1e-10, 60 + 1e-10, 120.0, 120 - 1e-10, 120 + 1e-10, 0.0, 180.0])
def test_circles_that_touch_the_limb(lon):
    """A sliver at the limb thinner than the tolerance runs clockwise as chords; that must not add the whole disc."""
    circle = SphereCircle.around((lon, 0.0), 90.0 if lon % 180 == 0 else 30.0)
    inside = np.pi * circle.radius**2 * np.cos(np.radians(lon)) if lon < 90 else 0.0
    for one, wanted in ((circle, inside), (circle.complement, np.pi - inside)):
        assert area(in_sight(*whole_circles([one]), FRONT, 1e-6)[0]) == pytest.approx(wanted, abs=1e-5)


ALL_SKY = StereographicView(10, 40, angular_radius=120.0)


@pytest.mark.parametrize(
    ("seed", "size", "view", "tolerance"),
    [
        (9, 4.0, View(10, 40), 1e-4),
        (9, 300.0, ALL_SKY, 1e-4),
        # One of these cells is so thin in front of the limb that its chords run clockwise, as if round all the rest.
        (2, 1.0, View(10, 40), 1e-2),
        *(
            pytest.param(*case, marks=pytest.mark.thorough)
            for case in [(9, 1.0, View(10, 40), 1e-4), (9, 300.0, View(10, 40), 1e-4), (9, 1.0, ALL_SKY, 1e-4)]
            + [(9, 4.0, ALL_SKY, 1e-4), (2, 1.0, View(10, 40), 1e-3), (3, 1.0, View(10, 40), 1e-2)]
            + [(3, 1.0, View(10, 40), 1e-3)]
        ),
    ],
)
def test_cells_tile_the_disc(seed, size, view, tolerance):
    """All regions at once, sides traced once: no gap, no overlap, the areas of all loops are the disc."""
    arcs, sides = cells(SphericalVoronoi(np.random.default_rng(seed).normal(size=(2000, 3))))
    lens = fisheye((10.0, 50.0), magnification=size)
    loops, belongs = in_sight(arcs.through(lens), sides, view, tolerance, np.arange(2000), 2000)
    # Those that run clockwise are left out; were all others as thin, up to a hundredth of the disc would be bare.
    assert area(loops) == pytest.approx(np.pi, abs=3e-4 if seed == 9 else 1e-2 * tolerance)
    assert (clip.signed_areas(loops)[0] > 0).all()
    assert len(np.unique(belongs)) == len(belongs)
    places = np.random.default_rng(1).uniform(-1, 1, (300, 2))
    places = places[np.hypot(*places.T) < 0.99]
    deep = winding(loops, places)
    assert (deep == 1).mean() > 0.98
    assert (deep[off_lines(places, loops) > 3 * tolerance] == 1).all()


def test_the_rim_is_finer_than_the_chains(rng):
    """A rim as coarse as the chains crosses them, and ears then cover 1.8e-3 too much."""
    for _ in range(10):
        circle = SphereCircle.around((rng.uniform(40, 140), rng.uniform(-60, 60)), rng.uniform(20, 80))
        loops, owner = in_sight(*whole_circles([circle]), FRONT, 1e-3)
        corners, _ = triangles(loops, owner)
        (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        assert np.abs(ax * by - ay * bx).sum() / 2 == pytest.approx(area(loops), abs=3e-7)


def test_a_region_whose_rings_are_empty_is_not_hidden():
    """Duplicates have no cell: their rings have no side, and nothing of them is in sight or out of sight."""
    arcs, sides = ring([X, Y, Z])
    some = Ragged(sides.values, np.array([0, 0, 3, 3]))
    loops, owner = in_sight(arcs, some, FRONT, 1e-5, np.arange(3), 3)
    assert owner.tolist() == [1]
    assert area(loops) == pytest.approx(np.pi / 4, abs=1e-4)
    # One side of the hidden ring is on the limb, where its chords leave a sliver.
    hidden, owner = in_sight(*[ring([-X, Z, Y])[0], some], FRONT, 1e-5, np.arange(3), 3)
    assert set(owner.tolist()) <= {1}
    assert abs(area(hidden)) < 2e-5


def on_map(points, step=0.02):
    """Loops on the map of a ring of great-circle edges."""
    arcs, sides = ring(points)
    border = Antimeridian()
    pieces = border.cut(arcs)
    samples = pieces.arcs.spread(np.maximum(1, np.ceil((pieces.arcs.stop - pieces.arcs.begin) / step)).astype(np.intp))
    return clip.regions(sides, np.zeros(1, dtype=np.intp), 1, pieces, samples, border)[0]


def test_rings_on_the_map():
    """Octants at ±180°, with a pole as a vertex; sides on the meridian come back on the right side of the map."""
    for a, b, low, high in ((X, Y, 0, 90), (Y, -X, 90, 180), (-X, -Y, -180, -90), (-Y, X, -90, 0)):
        loops = on_map([a, b, Z])
        assert len(loops) == 1
        assert area(loops) == pytest.approx(90 * 90, abs=1e-9)
        assert (loops.values[:, 0].min(), loops.values[:, 0].max()) == (low, high)
        assert loops.values[:, 1].max() == 90
        assert area(on_map([b, a, Z])) == pytest.approx(360 * 180 - 90 * 90, abs=1e-9)
    assert len(on_map(units([[-1, 0.2, -0.2], [-1, -0.2, -0.2], [-1, 0, 0.2]]))) == 2
    polar = on_map(units([[1, 0, 2], [-1, 1, 2], [-1, -1, 2]]))
    assert len(polar) == 1
    assert polar.values[:, 1].max() == 90


@given(SEEDS)
def test_a_ring_and_its_reverse_fill_the_map(seed):
    rng = np.random.default_rng(seed)
    points = units(sets.cube_grid(1))[rng.permutation(26)[:3]]
    if abs(np.linalg.det(points)) < 0.1:
        return
    assert area(on_map(points)) + area(on_map(points[::-1])) == pytest.approx(360 * 180, abs=1e-6)


def test_chains_are_joined_by_their_order_along_the_border():
    """Strips through a box: ends and starts sorted, no search; what overlaps counts twice."""
    box = Box(0.0, 4.0, 0.0, 4.0)
    up, down = lambda x: np.array([[x, 0.0], [x, 4.0]]), lambda x: np.array([[x, 4.0], [x, 0.0]])
    one, beside = [up(2), down(1)], [up(3.5), down(3)]
    loops, owner = clip.closed_along(box, Ragged.of(one + beside), np.zeros(4, dtype=np.intp))
    assert owner.tolist() == [0, 0]
    assert clip.signed_areas(loops)[0].tolist() == [4.0, 2.0]
    loops, owner = clip.closed_along(box, Ragged.of([*one, up(3), down(1.5)]), np.zeros(4, dtype=np.intp))
    assert area(loops) == 4 + 6
    loops, owner = clip.closed_along(box, Ragged.of(one + beside), np.array([0, 0, 1, 1]))
    assert np.bincount(owner, clip.signed_areas(loops)[0]).tolist() == [4.0, 2.0]
    # What is left and right of a strip, with the corners of the box.
    loops, _ = clip.closed_along(box, Ragged.of([up(1), down(3)]), np.zeros(2, dtype=np.intp))
    assert clip.signed_areas(loops)[0].tolist() == [4.0, 4.0]


def test_hidden_edges_may_be_left_out_where_the_middle_is_known():
    """A ring that leaves the disc twice and one that is hidden: the same loops without the edges behind the limb."""
    angle = np.radians(np.arange(0, 360, 5))
    wave = units(np.stack([0.3 * np.cos(3 * angle), np.cos(angle), np.sin(angle)], axis=1))
    behind = units(np.stack([-2 + 0 * angle, np.cos(angle), np.sin(angle)], axis=1))
    arcs, sides = rings([wave, behind])
    cap = Cap(FRONT, 1e-4)
    owner = np.array([0, 1])
    for middle in ([True, False], [False, True]):
        found = []
        for kept in (np.ones(len(arcs), dtype=bool), (arcs.start[:, 0] > -0.01) | (arcs.end[:, 0] > -0.01)):
            left = sides.kept(kept[sides.values])
            left = Ragged((np.cumsum(kept) - 1)[left.values], left.offsets)
            some = replace(arcs.take(kept), edge=np.arange(np.count_nonzero(kept)))
            pieces = cap.cut(some.turned(FRONT.matrix))
            samples = pieces.arcs.sampled(1e-4)
            seen, region, shown = clip.in_sight(left, owner, 2, pieces, samples, cap, np.full((len(left), 3), np.nan))
            found.append(clip.bordered(seen, region, np.array(middle) & ~shown, cap))
        (loops, region), (other, again) = found
        assert region.tolist() == again.tolist()
        assert abs(area(loops.take(region == 0)) - area(other.take(region == 0))) < 1e-12
        assert (region == 1).sum() == middle[1]


def test_a_rim_may_be_as_coarse_as_the_chains():
    fine, coarse = (Cap(FRONT, 1e-4, *fineness).once() for fineness in ((), (1.0,)))
    assert 30 < len(fine) / len(coarse) < 33
    assert np.hypot(*((coarse[1:] + coarse[:-1]) / 2).T).min() > 1 - 1.01e-4
