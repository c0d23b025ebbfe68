"""Rings of map files: what runs along ±180° and the poles is taken out, what is a border there stays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.curves.insides import oriented
from stereodel.curves.ragged import Ragged
from stereodel.curves.seams import stitched
from stereodel.curves.trace import unwrapped


def box(west, south, east, north):
    return np.array([(west, south), (east, south), (east, north), (west, north), (west, south)], dtype=float)


def edges(rings, owner=None):
    """What is left of rings: for each the set of its edges, longitudes modulo 360, and its owner."""
    rings = Ragged.of([np.asarray(ring, dtype=float) for ring in rings], np.zeros((0, 2)))
    owner = np.zeros(len(rings), dtype=np.intp) if owner is None else np.asarray(owner)
    start, end, rows, owners = stitched(rings, owner)
    ends = [np.column_stack([np.mod(p[:, 0], 360), p[:, 1]]) for p in (start, end)]
    return [{(*ends[0][k], *ends[1][k]) for k in row.tolist()} for row in rows], owners.tolist()


def test_rings_that_touch_no_seam_stay_as_they_are():
    """So that only the others are sorted: whole coasts have a hundred times as many edges."""
    rings = Ragged.of([box(0, 0, 10, 10), box(20, -5, 30, 5)])
    start, end, rows, owner = stitched(rings, np.array([0, 1]))
    np.testing.assert_array_equal(start, np.concatenate([box(0, 0, 10, 10)[:-1], box(20, -5, 30, 5)[:-1]]))
    np.testing.assert_array_equal(end, np.concatenate([box(0, 0, 10, 10)[1:], box(20, -5, 30, 5)[1:]]))
    assert [row.tolist() for row in rows] == [[0, 1, 2, 3], [4, 5, 6, 7]]
    assert owner.tolist() == [0, 1]
    # Beside one that does, they still keep their edges in order.
    some, _ = edges([box(170, 0, 180, 10), box(0, 0, 10, 10)])
    assert len(some) == 2
    assert some[0] == edges([box(0, 0, 10, 10)])[0][0]


def test_parts_that_meet_at_180_become_one_ring():
    found, owner = edges([box(170, 0, 180, 10), box(-180, 0, -170, 10)])
    assert owner == [0]
    assert len(found[0]) == 6
    assert not any(edge[0] == edge[2] == 180 for edge in found[0])
    # Where they meet only in part, the rest of the meridian is a border.
    found, _ = edges([box(170, 0, 180, 10), box(-180, 5, -170, 15)])
    along = {edge for edge in found[0] if edge[0] == edge[2] == 180}
    assert along == {(180, 0, 180, 5), (180, 15, 180, 10)}


def test_parts_of_different_regions_stay_apart():
    found, owner = edges([box(170, 0, 180, 10), box(-180, 0, -170, 10)], [0, 1])
    assert sorted(owner) == [0, 1]
    assert all(len(ring) == 4 for ring in found)


def test_longitudes_beyond_180_close():
    """Places count modulo 360: (190, 0) and (−170, 0) are one, and so are 180 and −180."""
    ring = np.array([(170, 0), (180, 0), (190, 0), (190, 10), (180, 10), (170, 10), (170, 0)], dtype=float)
    found, _ = edges([ring])
    assert len(found) == 1
    assert len(found[0]) == 6
    across = [np.array([(170, 0), (180, 0), (180, 10), (170, 10), (170, 0)]), box(180, 0, 190, 10)]
    found, _ = edges(across)
    assert len(found) == 1
    assert len(found[0]) == 6


@pytest.mark.parametrize("ring", [box(-180, -90, 180, 90), box(-180, -90, 180, 90)[::-1]])
def test_the_whole_world_has_no_border(ring):
    found, owner = edges([ring])
    assert found == []
    assert owner == []


def test_a_cap_about_a_pole_keeps_its_parallel():
    found, _ = edges([box(-180, -90, 180, -60)])
    assert found == [{(180, -60, 180, -60)}]
    found, _ = edges([[(-180, -90), (180, -90), (180, -60), (0, -55), (-180, -60), (-180, -90)]])
    assert found == [{(180, -60, 0, -55), (0, -55, 180, -60)}]


def test_a_wedge_to_the_pole_loses_the_edge_along_it():
    found, _ = edges([[(0, 60), (40, 60), (40, 90), (0, 90), (0, 60)]])
    assert found == [{(0, 60, 40, 60), (40, 60, 40, 90), (0, 90, 0, 60)}]


def test_a_hole_with_a_side_on_the_meridian():
    """The shell runs up +180 past the hole's side, which runs down: on the sphere neither is a border there."""
    shell = np.array([(100, -20), (180, -20), (180, 20), (100, 20), (100, -20)], dtype=float)
    hole = np.array([(150, -10), (150, 10), (180, 10), (180, -10), (150, -10)], dtype=float)
    found, _ = edges([shell, hole])
    along = {edge for ring in found for edge in ring if edge[0] == edge[2] == 180}
    assert along == {(180, -20, 180, -10), (180, 10, 180, 20)}


@given(st.lists(st.integers(0, 5), min_size=2, max_size=6, unique=True), st.integers(0, 10**6))
def test_every_edge_that_is_left_has_a_follower(heights, seed):
    """Boxes at random on both sides of the meridian: rings close on the sphere and no edge is lost or doubled."""
    rng = np.random.default_rng(seed)
    low, high = sorted(rng.choice(heights, 2, replace=False))
    rings = [box(170, low, 180, high), box(-180, min(heights), -170, max(heights)), box(160, 20, 180, 90)]
    found, _ = edges(rings)
    for ring in found:
        starts, ends = sorted(e[:2] for e in ring), sorted(e[2:] for e in ring)
        fold = lambda p: (0.0, p[1]) if abs(p[1]) == 90 else p  # noqa: E731
        assert sorted(map(fold, starts)) == sorted(map(fold, ends))


def test_rings_are_turned_so_that_their_region_is_on_the_left():
    square, small = box(0, 0, 10, 10), box(2, 2, 4, 4)
    for shell in (square, square[::-1]):
        for hole in (small, small[::-1]):
            turned = list(oriented(Ragged.of([shell, hole]), np.array([False, True]))[0])
            np.testing.assert_array_equal(turned[0], square)
            np.testing.assert_array_equal(turned[1], small[::-1])


def test_rings_over_180_are_turned_as_they_go_on():
    ring = box(170, 0, 190, 10)
    jumping = ring - np.where(ring[:, :1] > 180, [360.0, 0.0], [0.0, 0.0])
    for given_ring in (jumping, jumping[::-1]):
        (turned,) = oriented(unwrapped(Ragged.of([given_ring])), np.array([False]))[0]
        assert np.ptp(turned[:, 0]) == 20
        x, y = turned.T
        assert np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) > 0


@pytest.mark.parametrize(("height", "outer", "east"), [(70, True, True), (-70, True, False), (-70, False, True)])
def test_a_ring_round_a_pole_holds_the_smaller_side(height, outer, east):
    lon = np.arange(0.0, 361.0, 30.0)
    ring = np.column_stack([np.where(lon > 180, lon - 360, lon), height + 5 * np.sin(np.radians(3 * lon))])
    for given_ring in (ring, ring[::-1]):
        (turned,) = oriented(unwrapped(Ragged.of([given_ring])), np.array([not outer]))[0]
        assert (turned[-1, 0] - turned[0, 0] > 0) == east


@pytest.mark.parametrize("seam", [0.0, 20.25, -180.0])
def test_a_map_may_be_cut_elsewhere(seam):
    """A band around the Earth from its own western border is two parallels; at 180° it has no seam then."""
    rings = Ragged.of([box(seam, -60, seam + 360, 60)])
    start, end, rows, _ = stitched(rings, np.zeros(1, dtype=np.intp), seam)
    assert sorted(row.tolist() for row in rows) == [[0], [1]]
    assert (start[:, 1] == end[:, 1]).all()
    kept = stitched(Ragged.of([box(170, 0, 180, 10)]), np.zeros(1, dtype=np.intp), seam)[2]
    assert len(kept.values) == 4


@given(st.lists(st.floats(-180, 179), min_size=3, max_size=30, unique=True), st.integers(0, 100), st.booleans())
def test_rings_round_the_earth_end_where_they_began(lon, first, east):
    """To the last bit, a turn on: so they close, though a vertex on the seam has all edges sorted by their ends."""
    lon = np.sort(np.append(lon, -180.0))
    lon = np.unique(np.round(lon, 9))
    lon = np.roll(lon, first % len(lon))[:: 1 if east else -1]
    if np.diff(np.sort(lon), append=lon.min() + 360).max() > 170:
        return
    ring = np.stack([lon, 60 + 10 * np.cos(np.radians(lon))], axis=1)
    ring = np.vstack([ring, ring[:1]])
    whole = unwrapped(Ragged.of([ring]))
    assert whole.values[-1, 0] - whole.values[0, 0] == (360 if east else -360)
    start, end, rows, _ = stitched(whole, np.zeros(1, dtype=np.intp))
    assert len(rows) == 1
    np.testing.assert_array_equal(np.mod(end[rows.values, 0], 360), np.mod(start[rows.values[rows.following], 0], 360))
