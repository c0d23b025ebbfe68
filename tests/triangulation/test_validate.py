"""`check_delaunay` accepts SciPy's hulls, ties of every kind and sets without triangles, and nothing that is wrong."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.triangulation import validate
from stereodel.triangulation.validate import InvalidTriangulation, check_delaunay, first_occurrences
from stereodel.triangulation.validate_mesh import _labels, build_mesh
from stereodel.triangulation.validate_signs import SphereSigns
from tests import sets
from tests.spaces import SPHERE
from tests.triangulation.meshes import GOLDEN, ICOSAHEDRON, RING, flipped, grid, hull, lifted_grid, planar, unit_normal

GOOD, FAR = unit_normal(60, 0), -unit_normal(60, 5)
TRIANGLES = hull(GOOD)
# The faces of the icosahedron on its algebraic conjugate, √5 → −√5: a closed manifold with V − E + F = 2.
CONJUGATE = np.where(np.abs(ICOSAHEDRON) == GOLDEN, ICOSAHEDRON / -(GOLDEN**2), ICOSAHEDRON)
FIVE = 2 * np.pi * 2 * np.arange(5) / 5
STAR = np.column_stack([np.cos(FIVE), np.sin(FIVE), np.zeros(5)])
PYRAMID = np.vstack([STAR, [[0, 0, 1]], [[0, 0, -1]]])
"""Corners of a double pyramid around {5/2}: wound twice around its axis."""
SIDES = np.array([[k, (k + 1) % 5, 5] for k in range(5)] + [[(k + 1) % 5, k, 6] for k in range(5)])
UNWOUND = PYRAMID[[*np.argsort(FIVE % (2 * np.pi)), 5, 6]]
ROOF = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
CLOSED = np.array([[3, 4, 0], [-4, 3, 0], [-3, -4, 0], [4, -3, 0], [0, 0, 1]], dtype=float)
NONE = np.zeros((0, 3), int)


@pytest.mark.parametrize("n", [4, 5, 7, 20, 300, 3000])
def test_accepts_hulls_of_scipy(n):
    points = unit_normal(n, n)
    report = check_delaunay(points, hull(points))
    assert (report.surface, report.points, report.simplices, report.edges) == ("sphere", n, 2 * n - 4, 3 * n - 6)


@pytest.mark.parametrize("n", [3, 5, 20, 3000])
def test_accepts_planar_triangulations_of_scipy(n):
    points = np.random.default_rng(n).random((n, 2))
    report = check_delaunay(points, planar(points))
    assert (report.surface, report.points, report.ties) == ("plane", n, 0)


def test_accepts_points_in_a_hemisphere_with_closing_facets():
    points = sets.unit(unit_normal(200, 0) + np.array([0, 0, 1.5]))
    check_delaunay(points, hull(points))


@pytest.mark.parametrize("scale", [1e-150, 2.0**-30, 1.0, 1e140])
def test_every_diagonal_of_a_grid_is_a_tie(scale):
    points, s = grid(12)
    assert check_delaunay(points * 2.0 ** np.round(np.log2(scale)), s).ties == 11 * 11


def test_lifted_grid_with_its_pole():
    points, s = lifted_grid(8)
    lengths = np.random.default_rng(0).integers(1, 9, len(points))[:, None] * 2.0**-700
    # one tie in every square, and the star of the pole is one polygon for each side of the grid
    assert check_delaunay(points * lengths, s).ties == 7 * 7 + 4 * 6


@pytest.mark.parametrize("turn", [np.eye(3), np.diag([1, -1, -1]), -sets.TILT])
def test_small_circle_is_a_two_sided_polygon(turn):
    """3-4-5 points of the circle at height 1, exactly cocircular as rays, turned to other axes by exact rotations."""
    ring = np.array([[-3, -4], [4, -3], [5, 0], [3, 4], [-4, 3]])
    points = np.column_stack([ring, np.ones(5)]) @ turn * np.sign(np.linalg.det(turn))
    sides = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [3, 2, 1], [1, 0, 4], [1, 4, 3]]
    report = check_delaunay(points, sides)
    assert report.simplices == 6
    assert report.ties == report.edges == 9
    with pytest.raises(InvalidTriangulation, match="do not meet in one convex polygon"):
        check_delaunay(points[[0, 1, 2, 4, 3]], sides)


def test_a_great_circle_facet_has_any_diagonal():
    check_delaunay(CLOSED, [*ROOF, [2, 1, 0], [0, 3, 2]])
    check_delaunay(CLOSED, [*ROOF, [3, 2, 1], [1, 0, 3]])
    check_delaunay(np.eye(3), [[0, 1, 2], [0, 2, 1]])


@pytest.mark.parametrize("one", sets.of("flat", "few"))
def test_flat_sets_have_no_simplices(one):
    assert check_delaunay(one.points, NONE).simplices == 0


def test_duplicates_are_derived_and_checked():
    more = np.vstack([GOOD, GOOD[7] * 4.0, GOOD[7]])
    assert check_delaunay(more, TRIANGLES, duplicates=[[60, 7], [61, 7]]).duplicates == 2
    with pytest.raises(InvalidTriangulation, match=r"wrong about \[61, 7\]"):
        check_delaunay(more, TRIANGLES, duplicates=[[60, 7]])
    with pytest.raises(InvalidTriangulation, match=r"wrong about \[61, 7\]"):
        check_delaunay(more, TRIANGLES, duplicates=[[60, 7], [61, 60]])


# What is wrong -------------------------------------------------------------------------------------------------------


def a_duplicate_beside_its_original():
    around = np.flatnonzero((TRIANGLES == 7).any(axis=1))
    star = {
        int(r[1]): (t, r) for t, r in ((t, np.roll(TRIANGLES[t], -int(np.argmax(TRIANGLES[t] == 7)))) for t in around)
    }
    x, y = list(star)[:2]
    wrong, here = TRIANGLES.copy(), x
    while here != y:  # the triangles from x round to y go to the copy
        t, row = star[here]
        wrong[t] = np.where(TRIANGLES[t] == 7, 60, TRIANGLES[t])
        here = int(row[2])
    return np.vstack([GOOD, GOOD[7]]), np.vstack([wrong, [[7, x, 60], [60, y, 7]]])


def a_flipped_edge_of_the_plane():
    points = np.random.default_rng(1).random((40, 2))
    s = planar(points)
    inner = next(t for t in range(len(s)) if sum(len(set(s[t]) & set(u)) == 2 for u in s) == 3)
    return points, flipped(s, inner)


def a_fold_that_nothing_else_sees():
    """Flat triangles around point 2, folded: all edges are ties or convex, and from point 0 they are seen edge-on."""
    below = [[6, 3, 1], [6, 4, 3], [6, 5, 4], [1, 0, 6], [0, 5, 6]]
    flat = [[0, 1, 5], [1, 3, 4], [1, 4, 2], [4, 5, 2], [5, 1, 2]]
    return np.vstack([RING, [[0, 0, -1]]]), below + flat


TRIANGLE = [[0, 0], [1, 0], [0, 1]]
BOW_TIE = [[0, 0], [1, 0], [1, 1], [-1, 0], [-1, -1]]
TWICE = [[0, 1, 4], [0, 4, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2], [1, 2, 4]]
OTHER_NUMBER = np.where(TRIANGLES == 7, 60, TRIANGLES)
PENTAGRAM = np.vstack([STAR[:, :2], [[0, 0]]]), [[k, (k + 1) % 5, 5] for k in range(5)]
THREE_ON_A_LINE = [[0, 0], [1, 0], [2, 0], [1, 1]]
WRONG = {
    "number too large": (TRIANGLE, [[0, 1, 3]], "outside 0 to 2"),
    "number too small": (TRIANGLE, [[0, 1, -1]], "outside 0 to 2"),
    "point twice": (TRIANGLE, [[0, 1, 1]], "a point twice"),
    "no integers": (TRIANGLE, [[0.0, 1.0, 2.0]], "must hold integers"),
    "pairs": (TRIANGLE, [[0, 1]], "must have shape"),
    "three points without triangles": (np.eye(3), NONE, "span one"),
    "antipodes hide nothing": ([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]], NONE, "points 0, 2 and 3 span one"),
    "great circle": ([[1, 0, 0], [0, 1, 0], [-1, -1, 0]], [[0, 1, 2], [0, 2, 1]], "great circle"),
    "crossed great circle": (CLOSED[[0, 2, 1, 3, 4]], [*ROOF, [2, 1, 0], [0, 3, 2]], None),
    "great icosahedron": (CONJUGATE, hull(ICOSAHEDRON), r"turn once|lies in"),
    "great icosahedron from inside": (CONJUGATE, hull(ICOSAHEDRON)[:, ::-1], None),
    **{f"flipped edge {t}": (GOOD, flipped(TRIANGLES, t), None) for t in (0, 1, 2)},
    "flipped edge of the plane": (*a_flipped_edge_of_the_plane(), r"inside the circle|not counterclockwise"),
    "missing triangle": (GOOD, TRIANGLES[1:], "not closed"),
    "reversed triangle": (GOOD, np.vstack([TRIANGLES[:3], TRIANGLES[3:4, ::-1], TRIANGLES[4:]]), "same direction"),
    "inside out": (GOOD, TRIANGLES[:, ::-1], "lies inside the circle"),
    "repeated triangle": (GOOD, np.vstack([TRIANGLES, TRIANGLES[:1]]), "more than two"),
    "two spheres": (np.vstack([GOOD, FAR]), np.vstack([TRIANGLES, hull(FAR) + 60]), "several surfaces"),
    "star that turns twice": (PYRAMID, SIDES, None),
    "fold that nothing else sees": (*a_fold_that_nothing_else_sees(), "folded"),
    # Both sides change twice around point 0, and every other edge between them goes forward.
    "two sides meet twice in one point": (RING[:5], TWICE, "do not meet in one convex polygon"),
    "duplicate used": (*a_duplicate_beside_its_original(), "point 60 is used by a simplex although"),
    "duplicate for its original": (np.vstack([GOOD, GOOD[7]]), OTHER_NUMBER, "point 7 is used by no simplex"),
    "unused point": (np.vstack([GOOD, unit_normal(1, 9)]), TRIANGLES, "point 60 is used by no simplex"),
    # A pentagram's star of triangles around the centre covers it twice.
    "boundary run through twice": (*PENTAGRAM, "turns once"),
    "nonconvex boundary": ([[0, 0], [4, 0], [2, 1], [2, 4]], [[0, 1, 2], [0, 2, 3]], "not convex at point 2"),
    "hole": (grid(4)[0], [u for u in grid(4)[1] if not {5, 6, 9, 10} >= set(u)], "V - E"),
    "pinch": (BOW_TIE, [[0, 1, 2], [0, 3, 4]], "separate fans"),
    "clockwise": ([[0, 0], [0, 1], [1, 0]], [[0, 1, 2]], r"simplex 0 .* not counterclockwise"),
    "flat on the boundary": (THREE_ON_A_LINE, [[0, 2, 3], [0, 1, 2]], r"simplex 1 .* not counterclock"),
}


@pytest.mark.parametrize("name", WRONG)
def test_rejects(name):
    points, simplices, message = WRONG[name]
    with pytest.raises(InvalidTriangulation, match=message):
        check_delaunay(np.asarray(points, dtype=float), simplices)


def test_what_looks_like_the_wrong_ones_and_is_right():
    check_delaunay(ICOSAHEDRON, hull(ICOSAHEDRON))
    check_delaunay(UNWOUND, SIDES)


def test_the_link_of_a_vertex_must_turn_once():
    """From the tip of the double pyramid every other triangle is counterclockwise, but they go round twice."""
    with pytest.raises(InvalidTriangulation, match="covered twice"):
        validate._check_single_cover(build_mesh(SIDES, 7), SphereSigns(PYRAMID), 5)
    validate._check_single_cover(build_mesh(SIDES, 7), SphereSigns(UNWOUND), 5)


@pytest.mark.parametrize("height", [0, 1, -1])
def test_rejects_a_fold_within_a_plane(height):
    square = np.array([[3, 4, height], [-4, 3, height], [-3, -4, height], [4, -3, height]], dtype=float)
    mesh = build_mesh(np.array([[0, 1, 2], [0, 2, 3]]), 4)
    validate._check_folds(mesh, SphereSigns(square), mesh.inner)
    with pytest.raises(InvalidTriangulation, match="folded"):
        validate._check_folds(mesh, SphereSigns(square[[0, 2, 1, 3]]), mesh.inner)


def test_wrong_neighbors():
    edges = {}
    for t, u in enumerate(TRIANGLES):
        for k in range(3):
            edges.setdefault(frozenset(np.delete(u, k)), []).append(t)
    neighbors = np.array(
        [[sum(edges[frozenset(np.delete(u, k))]) - t for k in range(3)] for t, u in enumerate(TRIANGLES)]
    )
    check_delaunay(GOOD, TRIANGLES, neighbors=neighbors)
    with pytest.raises(InvalidTriangulation, match="neighbors"):
        check_delaunay(GOOD, TRIANGLES, neighbors=neighbors[:, ::-1])


# Its parts -----------------------------------------------------------------------------------------------------------


@given(SPHERE.points(3, min_size=1, max_size=30), st.data())
def test_first_occurrences_of_directions(points, data):
    factors = data.draw(st.lists(st.sampled_from([1.0, 3.0, 5.0, 2.0**-1060]), min_size=30, max_size=30))
    names = SPHERE.names(points).tolist()
    points = points * np.array(factors[: len(points)])[:, None]
    assert first_occurrences(points).tolist() == [names.index(name) for name in names]


def test_directions_closer_than_an_ulp_are_different():
    points = np.array([[1, 3, 5], [3.0, 9.0 + 2.0**-49, 15.0], [2, 6, 10]], dtype=float)
    points = np.vstack([points, [[1e300, 1e-20, 0], [1e300, 2e-20, 0], [-0.0, -1, 0], [0, -1, -0.0]]])
    assert first_occurrences(points).tolist() == [0, 1, 0, 3, 4, 5, 5]
    underflown = [[1e300, 1e-30, 0], [1e300, 2e-30, 0], [1, 0, 0], [2e300, 2e-30, 0]]  # all quotients are (1, 0, 0)
    assert first_occurrences(np.array(underflown)).tolist() == [0, 1, 2, 0]


def test_components_of_long_chains_take_few_rounds():
    """A path through nodes in any order; as many rounds as nodes would take minutes."""
    order = np.random.default_rng(1).permutation(200_000)
    assert not _labels(len(order), order[:-1], order[1:]).any()
    assert not _labels(len(order), np.arange(len(order) - 1), np.arange(1, len(order))).any()
