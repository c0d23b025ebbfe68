"""Triangles of strokes, dots and fills: areas, coverage, and the union that they make."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from stereodel.render.tessellation import FLATNESS, discs, flatten, region, ribbons
from tests.globe.sights import distance, winding

POINTS = arrays(np.float64, st.tuples(st.integers(3, 12), st.just(2)), elements=st.floats(0, 100, width=32))


def covered(triangles, points):
    """How many triangles (n, 3, 2) contain each of (m, 2) points, none of which lies on an edge."""
    a, b, c = (triangles[:, None, i] for i in range(3))
    turn = [np.sign(cross(q - p, points - p)) for p, q in ((a, b), (b, c), (c, a))]
    return (np.abs(np.sum(turn, axis=0)) == 3).sum(axis=0)


def cross(u, v):
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def areas(triangles):
    return np.abs(cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])) / 2


def ribbon(line, width, closed=False, **options):
    line = np.concatenate([line, line[:closed]])
    return ribbons(line, np.array([0, len(line)]), width, closed=closed, **options)


def quarter_circle(radius):
    k = 4 / 3 * np.tan(np.pi / 8)
    return radius * np.array([[[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]]])


@pytest.mark.parametrize("radius", [1.0, 50.0, 3000.0])
def test_chords_stay_near_their_curve(radius):
    """And runs of straight ones keep their ends and corners."""
    path = np.array([[[0, 0], [1, 0], [2, 0], [3, 0]], [[3, 0], [3, 1], [3, 2], [3, 3]]], dtype=float)
    assert flatten(path).tolist() == [[0, 0], [3, 0], [3, 3]]
    points = flatten(quarter_circle(radius))
    middle = (points[:-1] + points[1:]) / 2
    # The cubic itself is off the circle by 2.8e-4 of the radius.
    assert np.abs(np.linalg.norm(middle, axis=1) - radius).max() < FLATNESS + 2.8e-4 * radius
    s = np.linspace(0, 1, 5001)[:, None]
    p = quarter_circle(radius)[0]
    curve = (1 - s) ** 3 * p[0] + 3 * s * (1 - s) ** 2 * p[1] + 3 * s**2 * (1 - s) * p[2] + s**3 * p[3]
    assert distance(points, curve).max() < FLATNESS


@given(POINTS, st.floats(1, 20), st.booleans())
def test_a_ribbon_covers_what_is_near_its_line_and_nothing_else(line, width, closed):
    grid = np.random.default_rng(0).uniform(-20, 120, (400, 2))
    inside = covered(ribbon(line, width, closed=closed), grid) > 0
    away = distance(grid, np.concatenate([line, line[:1]]) if closed else line)
    assert inside[away < width / 2 - 2 * FLATNESS].all()
    assert not inside[away > width / 2 + 1e-6].any()


BENT = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
BACK = np.array([[0.0, 0.0], [10.0, 0.0], [0.0, 0.0]])
POINT = np.array([[3.0, 3.0], [3.0, 3.0]])
DASHED, GAP = [(0.5, 0.1), (3.9, 0.1), (7.1, 0.1), (9.9, 0.1)], [(4.1, 0.1), (6.9, 0.1)]


@pytest.mark.parametrize(
    ("line", "width", "options", "inside", "outside"),
    [
        (BENT, 1.0, {"dash": (4.0, 3.0), "round_caps": False}, [*DASHED, (10.1, 0.9)], [*GAP, (10.1, 1.1)]),
        (BACK, 4.0, {"round_caps": False}, [(11.5, 0.1)], [(12.1, 0.1), (-0.1, 0.1)]),
        (POINT, 10.0, {}, [(3.1, 7.8), (7.8, 3.1)], [(6.9, 6.9), (8.2, 3.1)]),
        (POINT, 10.0, {"round_caps": False}, [], [(3.1, 3.2)]),
    ],
    ids=["dashes go round corners", "turning back is rounded", "a point is a disc", "or nothing"],
)
def test_ribbons_by_hand(line, width, options, inside, outside):
    found = covered(ribbon(line, width, **options), np.array([*inside, *outside])) > 0
    assert found.tolist() == [True] * len(inside) + [False] * len(outside)


@given(POINTS, st.floats(0.5, 20), st.floats(0.5, 20))
def test_dashes_have_their_share_of_the_length(line, dash, gap):
    shape = ribbon(line, 0.02, dash=(dash, gap), round_caps=False)
    length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
    whole, rest = divmod(length, dash + gap)
    drawn = whole * dash + min(rest, dash)
    # Wedges at the bends add less than their radius squared each.
    assert areas(shape).sum() == pytest.approx(0.02 * drawn, abs=len(line) * 4e-4 + 1e-6 * length)
    assert np.isfinite(shape).all()


def triangle_set(triangles):
    return sorted(map(tuple, triangles.reshape(-1, 6).round(9).tolist()))


# Few places, so that neighbours repeat, lines close and lines meet others.


@given(st.lists(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), max_size=7), max_size=6), st.floats(0.1, 2))
def test_many_ribbons_are_the_ribbons_of_each(lines, width):
    runs = [np.array(line, dtype=float).reshape(-1, 2) for line in lines]
    offsets = np.cumsum([0, *map(len, runs)])
    each = [np.zeros((0, 3, 2))]
    for run in runs:
        moves = len(run) > 1 and bool((run != run[0]).any())
        each.append(ribbon(run, width, closed=moves and bool((run[0] == run[-1]).all())))
    together = ribbons(np.concatenate([np.zeros((0, 2)), *runs]), offsets, width)
    assert triangle_set(together) == triangle_set(np.concatenate(each))


@pytest.mark.parametrize("radius", [0.3, 4.0, 200.0])
def test_discs_are_round_to_the_flatness(radius):
    shape = discs(np.array([[0.0, 0.0], [1000.0, 0.0]]), radius)
    middles = (shape[:, 1] + shape[:, 2]) / 2 - shape[:, 0]
    # A disc is at least a triangle, however small.
    assert np.linalg.norm(middles, axis=1).min() >= min(radius - FLATNESS, radius / 2) - 1e-9
    assert len(discs(np.zeros((0, 2)), radius)) == 0


@given(st.lists(POINTS, min_size=1, max_size=3))
def test_a_region_is_what_the_even_odd_rule_says(runs):
    points = np.random.default_rng(1).uniform(-5, 105, (300, 2))
    loops = [np.concatenate([run, run[:1]]) for run in runs]
    points = points[np.min([distance(points, loop) for loop in loops], axis=0) > 1e-6]
    assert np.array_equal(covered(region(runs), points), winding(loops, points) % 2)
    for flat in ([[0.0, 0.0], [5.0, 0.0], [9.0, 0.0]], [[1.0, 1.0]] * 3, [[0.0, 0.0], [3.0, 4.0]]):
        assert areas(region([np.array(flat)])).sum() == 0
