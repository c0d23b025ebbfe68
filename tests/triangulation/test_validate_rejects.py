"""`check_delaunay` rejects every kind of wrong triangulation."""

import numpy as np
import pytest

from stereodel.triangulation.validate import (
    InvalidTriangulation,
    _check_folds,
    _check_single_cover,
    check_delaunay,
)
from stereodel.triangulation.validate_mesh import build_mesh, check_manifold
from stereodel.triangulation.validate_signs import SphereSigns
from tests.triangulation.meshes import (
    GOLDEN,
    ICOSAHEDRON,
    RING,
    flipped,
    grid,
    hull,
    planar,
    unit_normal,
)


@pytest.fixture(scope="module")
def good():
    points = unit_normal(60)
    return points, hull(points)


def test_rejects_the_great_icosahedron():
    # The faces of the icosahedron on its algebraic conjugate, √5 → −√5: a closed manifold with V − E + F = 2.
    s = hull(ICOSAHEDRON)
    conjugate = np.where(np.abs(ICOSAHEDRON) == GOLDEN, ICOSAHEDRON / -(GOLDEN**2), ICOSAHEDRON)
    check_delaunay(ICOSAHEDRON, s)
    with pytest.raises(InvalidTriangulation, match=r"turn once|lies in"):
        check_delaunay(conjugate, s)
    with pytest.raises(InvalidTriangulation):
        check_delaunay(conjugate, s[:, ::-1])


def test_great_icosahedron_passes_every_local_test():
    conjugate = np.where(np.abs(ICOSAHEDRON) == GOLDEN, ICOSAHEDRON / -(GOLDEN**2), ICOSAHEDRON)
    mesh = build_mesh(hull(ICOSAHEDRON), 12)
    check_manifold(mesh, np.arange(12), euler=2)
    h = mesh.inner
    rows = np.column_stack([mesh.origin[h], mesh.target[h], mesh.apex[h], mesh.apex[mesh.twin[h]]])
    signs = SphereSigns(conjugate).bubble(rows)
    assert len(signs) == 30
    assert abs(signs.sum()) == 30


def test_rejects_a_flipped_edge(good):
    points, s = good
    for t in range(10):
        try:
            wrong = flipped(s, t)
        except StopIteration:
            continue
        with pytest.raises(InvalidTriangulation):
            check_delaunay(points, wrong)


def test_rejects_a_flipped_edge_in_the_plane():
    points = np.random.default_rng(1).random((40, 2))
    s = planar(points)
    inner = next(t for t in range(len(s)) if sum(len(set(s[t]) & set(u)) == 2 for u in s) == 3)
    with pytest.raises(InvalidTriangulation, match=r"inside the circle|not counterclockwise"):
        check_delaunay(points, flipped(s, inner))


def test_rejects_a_swapped_sliver():
    """A quadrilateral 1e-13 from cocircular: the wrong diagonal differs by the last digits only."""
    angle = np.radians([0, 90, 180, 270])
    rim = np.column_stack([np.cos(angle), np.sin(angle), np.full(4, 0.5)])
    rim[0, 2] += 1e-13
    points = np.vstack([rim, [[0, 0, -1]]])
    below = [[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]
    diagonals = [[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]]
    verdicts = []
    for pair in diagonals:
        try:
            verdicts.append(check_delaunay(points, below + pair).ties == 0)
        except InvalidTriangulation:
            verdicts.append(False)
    assert sorted(verdicts) == [False, True]


def test_rejects_a_missing_triangle(good):
    points, s = good
    with pytest.raises(InvalidTriangulation, match="not closed"):
        check_delaunay(points, s[1:])


def test_rejects_a_reversed_triangle(good):
    points, s = good
    wrong = s.copy()
    wrong[3] = wrong[3, ::-1]
    with pytest.raises(InvalidTriangulation, match="same direction"):
        check_delaunay(points, wrong)


def test_rejects_an_inside_out_sphere(good):
    points, s = good
    with pytest.raises(InvalidTriangulation, match="lies inside the circle"):
        check_delaunay(points, s[:, ::-1])


def test_rejects_a_repeated_triangle(good):
    points, s = good
    with pytest.raises(InvalidTriangulation, match="more than two"):
        check_delaunay(points, np.vstack([s, s[:1]]))


def test_rejects_two_spheres(good):
    points, s = good
    twice = np.vstack([points, -unit_normal(60, seed=5)])
    both = np.vstack([s, hull(twice[60:]) + 60])
    with pytest.raises(InvalidTriangulation, match="several surfaces"):
        check_delaunay(twice, both)


def test_rejects_a_doubly_covered_sphere():
    """Two nested octahedra slit open and joined cross-wise: one connected surface that covers the sphere twice."""
    rng = np.random.default_rng(0)
    one, two = unit_normal(30, seed=1), unit_normal(30, seed=2)
    points = np.vstack([one, two])
    s, t = hull(one), hull(two) + 30
    # Join along an edge of each: the copies of two triangles exchange neighbours by renaming a corner fan.
    a, b, c = s[0]
    d, e, f = t[rng.integers(len(t))]
    tube = [[a, b, d], [b, e, d], [b, c, e], [c, f, e], [c, a, f], [a, d, f]]
    rest = s[1:].tolist() + [u for u in t.tolist() if set(u) != {d, e, f}]
    for k in range(3):
        ring = np.roll([d, f, e], k)
        names = dict(zip((d, e, f), ring, strict=True))
        joined = rest + [[names.get(p, p) for p in u] for u in tube]
        with pytest.raises(InvalidTriangulation):
            check_delaunay(points, joined)


def test_rejects_a_star_that_turns_twice():
    """Every triangle a b c of a double pyramid around {5/2}: locally convex, wound twice around its axis."""
    angle = 2 * np.pi * 2 * np.arange(5) / 5
    points = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(5)])
    points = np.vstack([points, [[0, 0, 1]], [[0, 0, -1]]])
    s = [[k, (k + 1) % 5, 5] for k in range(5)] + [[(k + 1) % 5, k, 6] for k in range(5)]
    with pytest.raises(InvalidTriangulation):
        check_delaunay(points, s)
    order = np.argsort(angle % (2 * np.pi))
    check_delaunay(points[[*order, 5, 6]], s)


def test_the_link_of_a_vertex_must_turn_once():
    """From the tip of that double pyramid every other triangle is counterclockwise, but they go round twice."""
    angle = 2 * np.pi * 2 * np.arange(5) / 5
    points = np.vstack([np.column_stack([np.cos(angle), np.sin(angle), np.zeros(5)]), [[0, 0, 1]], [[0, 0, -1]]])
    s = np.array([[k, (k + 1) % 5, 5] for k in range(5)] + [[(k + 1) % 5, k, 6] for k in range(5)])
    with pytest.raises(InvalidTriangulation, match="covered twice"):
        _check_single_cover(build_mesh(s, 7), SphereSigns(points), 5)
    order = np.argsort(angle % (2 * np.pi))
    _check_single_cover(build_mesh(s, 7), SphereSigns(points[[*order, 5, 6]]), 5)


@pytest.mark.parametrize("height", [0, 1, -1])
def test_rejects_a_fold_within_a_plane(height):
    square = np.array([[3, 4, height], [-4, 3, height], [-3, -4, height], [4, -3, height]], dtype=float)
    mesh = build_mesh(np.array([[0, 1, 2], [0, 2, 3]]), 4)
    _check_folds(mesh, SphereSigns(square), mesh.inner)
    with pytest.raises(InvalidTriangulation, match="folded"):
        _check_folds(mesh, SphereSigns(square[[0, 2, 1, 3]]), mesh.inner)


def test_rejects_a_fold_that_nothing_else_sees():
    """Flat triangles around point 2, folded: all edges are ties or convex, and from point 0 they are seen edge-on."""
    points = np.vstack([RING, [[0, 0, -1]]])
    below = [[6, 3, 1], [6, 4, 3], [6, 5, 4], [1, 0, 6], [0, 5, 6]]
    flat = [[0, 1, 5], [1, 3, 4], [1, 4, 2], [4, 5, 2], [5, 1, 2]]
    with pytest.raises(InvalidTriangulation, match="folded"):
        check_delaunay(points, below + flat)


def test_rejects_two_sides_that_meet_twice_in_one_point():
    """Both sides change twice around point 0, and every other edge between them goes forward."""
    with pytest.raises(InvalidTriangulation, match="do not meet in one convex polygon"):
        check_delaunay(RING[:5], [[0, 1, 4], [0, 4, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2], [1, 2, 4]])


def test_rejects_a_duplicate_used_beside_its_original(good):
    points, s = good
    around = np.flatnonzero((s == 7).any(axis=1))
    x, y = (int(np.roll(s[t], -int(np.argmax(s[t] == 7)))[1]) for t in around[:2])
    star = {int(r[1]): r for r in (np.roll(s[t], -int(np.argmax(s[t] == 7))) for t in around)}
    wrong, here = s.copy(), x
    while here != y:  # the triangles from x round to y go to the copy
        t = next(t for t in around if (np.roll(s[t], -int(np.argmax(s[t] == 7))) == star[here]).all())
        wrong[t] = np.where(s[t] == 7, 60, s[t])
        here = int(star[here][2])
    wrong = np.vstack([wrong, [[7, x, 60], [60, y, 7]]])
    with pytest.raises(InvalidTriangulation, match="point 60 is used by a simplex although"):
        check_delaunay(np.vstack([points, points[7]]), wrong)


def test_rejects_an_unused_point(good):
    points, s = good
    more = np.vstack([points, unit_normal(1, seed=9)])
    with pytest.raises(InvalidTriangulation, match="point 60 is used by no simplex"):
        check_delaunay(more, s)


def test_wrong_neighbors(good):
    points, s = good
    table = {frozenset(np.delete(u, k)): [] for u in s for k in range(3)}
    for t, u in enumerate(s):
        for k in range(3):
            table[frozenset(np.delete(u, k))].append(t)
    neighbors = np.array([[sum(table[frozenset(np.delete(u, k))]) - t for k in range(3)] for t, u in enumerate(s)])
    check_delaunay(points, s, neighbors=neighbors)
    with pytest.raises(InvalidTriangulation, match="neighbors"):
        check_delaunay(points, s, neighbors=neighbors[:, ::-1])


def test_rejects_a_planar_boundary_run_through_twice():
    """A pentagram's star of triangles around the centre covers it twice."""
    angle = 2 * np.pi * 2 * np.arange(5) / 5
    points = np.vstack([np.column_stack([np.cos(angle), np.sin(angle)]), [[0, 0]]])
    with pytest.raises(InvalidTriangulation, match="turns once"):
        check_delaunay(points, [[k, (k + 1) % 5, 5] for k in range(5)])


def test_rejects_a_nonconvex_boundary():
    points = np.array([[0, 0], [4, 0], [2, 1], [2, 4]], dtype=float)
    with pytest.raises(InvalidTriangulation, match="not convex at point 2"):
        check_delaunay(points, [[0, 1, 2], [0, 2, 3]])


def test_rejects_a_hole_and_a_pinch():
    points, s = grid(4)
    centre = [t for t, u in enumerate(s) if {5, 6, 9, 10} >= set(u)]
    with pytest.raises(InvalidTriangulation, match="V - E"):
        check_delaunay(points, np.delete(s, centre, axis=0))
    bow_tie = np.array([[0, 0], [1, 0], [1, 1], [-1, 0], [-1, -1]], dtype=float)
    with pytest.raises(InvalidTriangulation, match="separate fans"):
        check_delaunay(bow_tie, [[0, 1, 2], [0, 3, 4]])


def test_rejects_a_clockwise_triangle():
    with pytest.raises(InvalidTriangulation, match=r"simplex 0 .* not counterclockwise"):
        check_delaunay([[0, 0], [0, 1], [1, 0]], [[0, 1, 2]])


def test_rejects_a_flat_triangle_on_the_boundary():
    with pytest.raises(InvalidTriangulation, match=r"simplex 1 .* not counterclockwise"):
        check_delaunay([[0, 0], [1, 0], [2, 0], [1, 1]], [[0, 2, 3], [0, 1, 2]])
