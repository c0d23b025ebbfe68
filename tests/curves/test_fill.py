"""Loops as triangles: what they cover, holes in the right shell, the owner of each triangle."""

from itertools import pairwise
from time import process_time

import numpy as np
import pytest
from mapbox_earcut import triangulate_float64
from scipy.spatial import Delaunay

from stereodel.curves.clip import signed_areas
from stereodel.curves.fill import triangles, union
from stereodel.curves.ragged import Ragged


def square(x, y, side, clockwise=False):
    loop = np.array([(x, y), (x + side, y), (x + side, y + side), (x, y + side), (x, y)], dtype=float)
    return loop[::-1] if clockwise else loop


def areas(corners):
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return np.abs(ax * by - ay * bx) / 2


def test_holes_belong_to_the_smallest_shell_of_their_region():
    shells = square(0, 0, 10), square(2, 2, 6), square(20, 0, 2), square(2.5, 2.5, 5)
    holes = square(1, 1, 8, clockwise=True), square(3, 3, 1, clockwise=True)
    loops = Ragged.of([shells[0], holes[0], shells[1], holes[1], *shells[2:]])
    owner = np.array([0, 0, 0, 0, 0, 1])
    corners, owners = triangles(loops, owner)
    covered = np.bincount(owners, areas(corners))
    assert covered == pytest.approx([100 - 64 + 36 - 1 + 4, 25])
    assert covered == pytest.approx(np.bincount(owner, signed_areas(loops)[0]))
    middles = corners[owners == 0].mean(axis=1)
    in_gap = ((middles > 1) & (middles < 9)).all(axis=1) & ~((middles > 2) & (middles < 8)).all(axis=1)
    assert not in_gap.any()


@pytest.mark.parametrize("turn", range(4))
def test_holes_may_touch_their_shell(turn):
    """Whatever corner comes first, and on whichever side of the shell's border rounding has put it."""
    corner = np.array([(10.0, 5.0), (6, 7), (5, 5), (6, 3)])[::-1]
    hole = np.roll(corner, turn, axis=0)
    loops = Ragged.of([square(0, 0, 10), np.concatenate([hole, hole[:1]]), square(10.1, 2, 5.9)])
    corners, _ = triangles(loops, np.zeros(3, dtype=np.intp))
    assert areas(corners).sum() == pytest.approx(100 - 10 + 5.9**2)
    middle = corners.mean(axis=1)
    assert not ((middle > [5.5, 4.5]) & (middle < [6.5, 5.5])).all(axis=1).any()


@pytest.mark.thorough
def test_a_sea_takes_no_longer_than_its_ears():
    """Each of its islands was measured against the whole shore; an island has a lake with an island of its own."""
    t = np.linspace(0, 2 * np.pi, 60_001)
    shore = np.stack([np.cos(t), np.sin(t)], axis=1) * (40 + np.sin(40 * t) + 0.01 * np.sin(20_000 * t))[:, None]
    shore[-1] = shore[0]
    places = [(x, y) for x in range(-26, 26) for y in range(-26, 26)]
    islands = [square(x, y, 0.6, clockwise=True) for x, y in places]
    inner = [square(x + at, y + at, side, at == 0.2) for x, y in places[::9] for at, side in ((0.1, 0.4), (0.2, 0.1))]
    loops, start = Ragged.of([shore, *islands, *inner]), process_time()
    corners, _ = triangles(loops, np.zeros(len(loops), dtype=np.intp))
    taken, start = process_time() - start, process_time()
    sea = [shore, *islands]
    triangulate_float64(np.concatenate(sea), np.cumsum([len(ring) for ring in sea], dtype=np.uint32))
    assert areas(corners).sum() == pytest.approx(signed_areas(loops)[0].sum(), rel=1e-9)
    assert taken < 0.5 + 3 * (process_time() - start)


def test_nothing_has_no_triangles():
    corners, owners = triangles(Ragged(np.zeros((0, 2)), np.zeros(1, dtype=np.intp)), np.zeros(0, dtype=np.intp))
    assert corners.shape == (0, 3, 2)
    assert owners.shape == (0,)


@pytest.mark.parametrize("seed", range(5))
def test_the_union_of_triangles_is_bounded_by_sides_that_one_has(seed):
    """Counterclockwise loops count, clockwise ones are holes: their areas add up to that of the triangles."""
    rng = np.random.default_rng(seed)
    points = rng.random((40, 2))
    corners = points[Delaunay(points).simplices]
    corners = corners[rng.random(len(corners)) < 0.7]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    corners[ax * by < ay * bx] = corners[ax * by < ay * bx][:, ::-1]
    loops = union(Ragged.of([triangle[[0, 1, 2, 0]] for triangle in corners]))
    assert signed_areas(loops)[0].sum() == pytest.approx(areas(corners).sum(), rel=1e-12)
    assert all((loop[0] == loop[-1]).all() for loop in loops)
    sides = [tuple(map(tuple, pair)) for loop in loops for pair in pairwise(loop)]
    assert len(set(sides)) == len(sides)
    assert not {(b, a) for a, b in sides} & set(sides)


def test_the_union_of_tiles_has_no_inner_side():
    squares = [square(x, y, 1) for x in range(4) for y in range(3) if (x, y) != (1, 1)]
    area, length = signed_areas(union(Ragged.of(squares)))
    assert sorted(area) == [-1.0, 12.0]
    assert sorted(length) == [4.0, 14.0]


def test_stars_become_fans_and_spirals_ears():
    """A loop that is seen whole from its middle, one that is not, and one twice round: each is covered."""
    t = np.linspace(0, 2 * np.pi, 25)
    star = np.stack([np.cos(t), np.sin(t)], axis=1) * np.where(np.arange(25) % 2, 0.5, 1.0)[:, None]
    star[-1] = star[0]
    hook = 3 + np.array([(0, 0), (4, 0), (4, 4), (0, 4), (0, 3), (3, 3), (3, 1), (0, 1), (0, 0)], dtype=float)
    loops = Ragged.of([star, hook])
    corners, owner = triangles(loops, np.array([4, 7]))
    found = areas(corners)
    np.testing.assert_allclose([found[owner == k].sum() for k in (4, 7)], signed_areas(loops)[0], rtol=1e-12)
    assert (owner == 4).sum() == 24
    assert (owner == 7).sum() == 6
