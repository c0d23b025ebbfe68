"""`check_delaunay` accepts SciPy's hulls and rejects every kind of wrong triangulation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull, Delaunay

from stereodel.triangulation.validate import (
    InvalidTriangulation,
    _check_folds,
    _check_single_cover,
    check_delaunay,
    first_occurrences,
)
from stereodel.triangulation.validate_mesh import build_mesh, check_manifold
from stereodel.triangulation.validate_signs import SphereSigns

GOLDEN = (1 + np.sqrt(5)) / 2


def unit_normal(n, seed=0):
    p = np.random.default_rng(seed).normal(size=(n, 3))
    return p / np.linalg.norm(p, axis=1)[:, None]


def hull(points):
    found = ConvexHull(points)
    s = found.simplices.astype(int)
    normal = np.cross(points[s[:, 1]] - points[s[:, 0]], points[s[:, 2]] - points[s[:, 0]])
    inward = (normal * found.equations[:, :3]).sum(axis=1) < 0
    s[inward] = s[inward][:, ::-1]
    return s


def planar(points):
    s = Delaunay(points).simplices.astype(int)
    a, b, c = (points[s[:, k]] for k in range(3))
    clockwise = (b - a)[:, 0] * (c - a)[:, 1] < (b - a)[:, 1] * (c - a)[:, 0]
    s[clockwise] = s[clockwise][:, ::-1]
    return s


def grid(n):
    """Integer grid and its squares, each cut along one diagonal chosen at random."""
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    k = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    square = np.column_stack([k, k + 1, k + n + 1, k + n])
    square = np.where(np.random.default_rng(0).random(len(k))[:, None] < 0.5, square, np.roll(square, 1, axis=1))
    return np.column_stack([x.ravel(), y.ravel()]).astype(float), np.vstack([square[:, :3], square[:, [0, 2, 3]]])


def lifted_grid(n):
    """The grid on rays (exact), with the projection pole as last point and its star."""
    xy, s = grid(n)
    xy -= n // 2
    rays = np.column_stack([2 * xy, 1 - (xy**2).sum(axis=1)])
    i = np.arange(n - 1)
    rim = np.concatenate([i, n - 1 + i * n, n * n - 1 - i, n * (n - 1) - i * n])
    star = np.column_stack([np.roll(rim, -1), rim, np.full(len(rim), n * n)])
    return np.vstack([rays, [0, 0, -1]]), np.vstack([s, star])


ICOSAHEDRON = np.array([np.roll([0, a, b * GOLDEN], k) for k in range(3) for a in (1, -1) for b in (1, -1)])
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)


@pytest.mark.parametrize("n", [4, 5, 7, 20, 300, 3000])
def test_accepts_hulls_of_scipy(n):
    points = unit_normal(n, seed=n)
    report = check_delaunay(points, hull(points))
    assert (report.surface, report.points, report.simplices, report.edges) == ("sphere", n, 2 * n - 4, 3 * n - 6)


@pytest.mark.parametrize("n", [3, 5, 20, 3000])
def test_accepts_planar_triangulations_of_scipy(n):
    points = np.random.default_rng(n).random((n, 2))
    report = check_delaunay(points, planar(points))
    assert (report.surface, report.points, report.ties) == ("plane", n, 0)


def test_accepts_points_in_a_hemisphere_with_closing_facets():
    points = unit_normal(200) + np.array([0, 0, 1.5])
    points /= np.linalg.norm(points, axis=1)[:, None]
    check_delaunay(points, hull(points))


@pytest.mark.parametrize("scale", [1e-150, 2.0**-30, 1.0, 1e140])
def test_every_diagonal_of_a_grid_is_a_tie(scale):
    points, s = grid(12)
    report = check_delaunay(points * 2.0 ** np.round(np.log2(scale)), s)
    assert report.ties == 11 * 11


def test_lifted_grid_with_its_pole():
    points, s = lifted_grid(8)
    lengths = np.random.default_rng(0).integers(1, 9, len(points))[:, None] * 2.0**-700
    report = check_delaunay(points * lengths, s)
    # one tie in every square, and the star of the pole is one polygon for each side of the grid
    assert report.ties == 7 * 7 + 4 * 6


def test_cube_with_any_diagonals():
    for seed in range(8):
        s = cube_simplices(seed)
        assert check_delaunay(CUBE, s).ties == 6


def cube_simplices(seed=0):
    rng = np.random.default_rng(seed)
    triangles = []
    for axis in range(3):
        for sign in (-1, 1):
            face = np.flatnonzero(CUBE[:, axis] == sign)
            u, v = CUBE[face][:, (axis + 1) % 3], CUBE[face][:, (axis + 2) % 3] * sign
            ring = np.roll(face[np.argsort(np.arctan2(v, u))], rng.integers(4))
            triangles += [ring[[0, 1, 2]], ring[[0, 2, 3]]]
    return np.array(triangles)


@pytest.mark.parametrize("axis", [(0, 0, 1), (0, 0, -1), (1, 2, 2)])
def test_small_circle_is_a_two_sided_polygon(axis):
    # 3-4-5 points of the circle at height 1, exactly cocircular as rays, turned to the axis by an exact rotation.
    ring = np.array([[3, 4], [-4, 3], [-3, -4], [4, -3], [5, 0]], dtype=float)
    ring = ring[np.argsort(np.arctan2(ring[:, 1], ring[:, 0]))]
    points = np.column_stack([ring, np.full(5, 1.0)])
    if axis[2] == -1:
        points = points * [1, -1, -1]
    if axis[0] == 1:
        points = points @ np.array([[2, -2, 1], [1, 2, 2], [2, 1, -2]])[[0, 1, 2]].T * [1, 1, 1]
    top = [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    bottom = [[3, 2, 1], [1, 0, 4], [1, 4, 3]]
    if np.linalg.det(points[[0, 1, 2]]) < 0 and axis[0] == 1:
        points = -points
    report = check_delaunay(points, top + bottom)
    assert report.simplices == 6
    assert report.ties == report.edges == 9
    with pytest.raises(InvalidTriangulation, match="do not meet in one convex polygon"):
        check_delaunay(points[[0, 1, 2, 4, 3]], top + bottom)


def test_three_points_have_two_triangles():
    points = np.eye(3)
    check_delaunay(points, [[0, 1, 2], [0, 2, 1]])
    with pytest.raises(InvalidTriangulation, match="span one"):
        check_delaunay(points, np.zeros((0, 3), int))


def test_equator_and_poles_with_a_great_circle_facet():
    equator = np.array([[3, 4, 0], [-4, 3, 0], [-3, -4, 0], [4, -3, 0]], dtype=float)
    closed = np.vstack([equator, [[0, 0, 1]]])
    roof = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    check_delaunay(closed, [*roof, [2, 1, 0], [0, 3, 2]])
    check_delaunay(closed, [*roof, [3, 2, 1], [1, 0, 3]])
    with pytest.raises(InvalidTriangulation):
        check_delaunay(closed[[0, 2, 1, 3, 4]], [*roof, [2, 1, 0], [0, 3, 2]])


@pytest.mark.parametrize(
    "points",
    [np.zeros((0, 2)), [[1, 2]], [[0, 0], [1, 1], [2, 2], [1, 1]], [[1, 0, 0], [-2, 0, 0], [1, 1, 0], [0, -3, 0]]],
)
def test_flat_sets_have_no_simplices(points):
    assert check_delaunay(points, np.zeros((0, 3), int)).simplices == 0


def test_antipodes_do_not_hide_that_a_set_spans():
    with pytest.raises(InvalidTriangulation, match="points 0, 2 and 3 span one"):
        check_delaunay([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]], np.zeros((0, 3), int))


def test_great_circle_must_have_no_simplices():
    equator = np.array([[1, 0, 0], [0, 1, 0], [-1, -1, 0]], dtype=float)
    with pytest.raises(InvalidTriangulation, match="great circle"):
        check_delaunay(equator, [[0, 1, 2], [0, 2, 1]])


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


@pytest.fixture(scope="module")
def good():
    points = unit_normal(60)
    return points, hull(points)


def flipped(s, t=0, k=0):
    """The diagonal of the two triangles on the edge opposite corner k of t, changed."""
    a, b, c = np.roll(s[t], -k)
    other = next(u for u in range(len(s)) if u != t and {b, c} <= set(s[u].tolist()))
    d = next(p for p in s[other] if p not in (b, c))
    result = s.copy()
    result[t], result[other] = (a, b, d), (a, d, c)
    return result


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


RING = np.array([[5, 0, 1], [4, 3, 1], [3, 4, 1], [0, 5, 1], [-3, 4, 1], [-4, -3, 1]], dtype=float)


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


def test_duplicates_are_derived_and_checked(good):
    points, s = good
    more = np.vstack([points, points[7] * 4.0, points[7]])
    assert check_delaunay(more, s, duplicates=[[60, 7], [61, 7]]).duplicates == 2
    with pytest.raises(InvalidTriangulation, match=r"leaves out \[61, 7\]"):
        check_delaunay(more, s, duplicates=[[60, 7]])
    with pytest.raises(InvalidTriangulation, match=r"lists \[61, 60\]"):
        check_delaunay(more, s, duplicates=[[60, 7], [61, 60]])
    with pytest.raises(InvalidTriangulation, match="point 7 is used by no simplex"):
        check_delaunay(more, np.where(s == 7, 60, s))


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


@pytest.mark.parametrize(
    ("simplices", "message"),
    [
        ([[0, 1, 3]], "outside 0 to 2"),
        ([[0, 1, -1]], "outside 0 to 2"),
        ([[0, 1, 1]], "a point twice"),
        ([[0.0, 1.0, 2.0]], "must hold integers"),
        ([[0, 1]], "must have shape"),
    ],
)
def test_malformed_simplices(simplices, message):
    with pytest.raises(InvalidTriangulation, match=message):
        check_delaunay([[0, 0], [1, 0], [0, 1]], simplices)


def test_accepts_an_object(good):
    class Triangulation:
        points, simplices = good

    assert check_delaunay(Triangulation()).simplices == 116


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 3).filter(any), min_size=1, max_size=30), st.data())
def test_first_occurrences_of_directions(vectors, data):
    factors = data.draw(st.lists(st.sampled_from([1.0, 3.0, 0.1, 2.0**-1060]), min_size=30, max_size=30))
    points = np.array([np.array(v) * (f if f != 0.1 else 5.0) for v, f in zip(vectors, factors, strict=False)])
    rays = [tuple(np.array(v) // np.gcd.reduce(v)) for v in vectors]
    assert first_occurrences(points).tolist() == [rays.index(r) for r in rays]


def test_directions_closer_than_an_ulp_are_different():
    points = np.array([[1, 3, 5], [1 + 2.0**-52, 3 + 3 * 2.0**-51, 5], [2, 6, 10]], dtype=float)
    points[1] = [3.0, 9.0 + 2.0**-49, 15.0]
    points = np.vstack([points, [[1e300, 1e-20, 0], [1e300, 2e-20, 0], [-0.0, -1, 0], [0, -1, -0.0]]])
    assert first_occurrences(points).tolist() == [0, 1, 0, 3, 4, 5, 5]
    underflown = [[1e300, 1e-30, 0], [1e300, 2e-30, 0], [1, 0, 0], [2e300, 2e-30, 0]]  # all quotients are (1, 0, 0)
    assert first_occurrences(np.array(underflown)).tolist() == [0, 1, 2, 0]
