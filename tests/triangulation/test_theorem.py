"""Theorem 1 of the paper, exactly, with the correction for bubbles that contain the projection pole."""

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from figures._theorem import PROJECTION_POLE, exact_lift, merged_polygons, theorem_1_holds
from stereodel import PlanarDelaunay, SphericalDelaunay
from stereodel.triangulation import planar_part

GRID = np.array([[x, y] for x in range(-3, 4) for y in range(-2, 3)], dtype=float)
DYADIC = st.tuples(st.integers(-(2**12), 2**12), st.integers(-(2**12), 2**12))
SMALL = st.tuples(st.integers(-3, 3), st.integers(-3, 3))


def random_points(n, seed=0):
    return np.round(np.random.default_rng(seed).normal(size=(n, 2)) * 2**20) / 2**20


def test_lift_is_the_inverse_stereographic_projection():
    xy = random_points(50)
    rays = exact_lift(xy)
    length = np.linalg.norm(rays, axis=1)
    assert length == pytest.approx(1 + (xy**2).sum(axis=1))
    assert rays[:, :2] / (length + rays[:, 2])[:, None] == pytest.approx(xy)


@pytest.mark.parametrize("point", [(0.1, 0.0), (2.0**30, 0.0), (2.0**-30, 1.0), (1e-300, 0.0), (1 + 2.0**-52, 0.0)])
def test_lift_refuses_to_round(point):
    with pytest.raises(ValueError, match=r"points\[1\] .* has no exact lift"):
        exact_lift([[1, 1], point])


@given(st.lists(DYADIC, max_size=20) | st.lists(SMALL, max_size=14), st.integers(-4, 12))
@example(random_points(150).tolist(), 0)
@example(GRID.tolist(), 1)
@example((GRID * 32 + [1024, 0]).tolist(), 0)
def test_theorem_1_in_general(points, exponent):
    assert theorem_1_holds(np.ldexp(np.reshape(points, (-1, 2)).astype(float), -exponent))


def test_points_whose_lift_is_one_great_circle():
    """Their own hull has no facets; with the pole it has the triangle of the plane."""
    points = [[1, 0], [-2, 1], [2, 1]]
    assert SphericalDelaunay(exact_lift(points)).dimension == 1
    assert len(PlanarDelaunay(points).simplices) == 1
    assert theorem_1_holds(points)


def test_without_the_correction_it_fails():
    """The hull is closed: some of its facets are no triangles of the plane."""
    points = random_points(40)
    sphere = SphericalDelaunay(exact_lift(points))
    assert len(planar_part(sphere, PROJECTION_POLE)) < len(sphere.simplices) == 2 * 40 - 4
    assert merged_polygons(sphere) != merged_polygons(PlanarDelaunay(points))


@pytest.mark.parametrize(
    ("points", "hull", "plane"),
    [
        # A point inside the circle of the others: what holds no point is the outside.
        ([[0, 0], [4, 0], [0, 4], [1, 1]], ["012", "013", "023", "123"], ["013", "023", "123"]),
        # Three on a line, a circle through the pole, where the open bubble is not enough; and its neighbour.
        ([[0, 0], [1, 0], [2, 0], [1, 3]], ["012", "013", "023", "123"], ["013", "123"]),
        # A square with a fifth point on the right: the pole sees the two facets that reach around it.
        ([[0, 0], [1, 0], [1, 1], [0, 1], [3, 0]], ["012", "014", "023", "034", "124", "234"], ["012", "023", "124"]),
    ],
)
def test_facets_that_are_left_out_by_hand(points, hull, plane):
    sphere = SphericalDelaunay(exact_lift(points))
    for simplices, expected in ((sphere.simplices, hull), (planar_part(sphere, PROJECTION_POLE), plane)):
        assert sorted("".join(map(str, sorted(corners))) for corners in simplices.tolist()) == expected
    assert theorem_1_holds(points)


@given(st.lists(SMALL, min_size=4, max_size=14, unique=True))
def test_as_many_facets_are_left_out_as_the_hull_has_points_but_two(points):
    """2n − 4 triangles on the sphere, 2n − 2 − h in the plane, of h points on the boundary of the convex hull."""
    sphere, plane = SphericalDelaunay(exact_lift(points)), PlanarDelaunay(np.array(points, dtype=float))
    assume(plane.dimension == sphere.dimension == 2)
    on_boundary = len(np.unique(plane.convex_hull))
    left_out = len(sphere.simplices) - len(planar_part(sphere, PROJECTION_POLE))
    assert len(sphere.simplices) == 2 * len(points) - 4
    assert left_out == on_boundary - 2


def test_the_octahedron_seen_from_one_of_its_corners():
    """The pole as a site: its star is what the plane lacks."""
    points = np.array([[0, 0], [1, 0], [0, 1], [-1, 0], [0, -1]], dtype=float)
    octahedron = SphericalDelaunay(np.vstack([exact_lift(points), PROJECTION_POLE]))
    part = planar_part(octahedron, PROJECTION_POLE)
    assert len(octahedron.simplices) == 8
    assert merged_polygons(octahedron, part) == merged_polygons(PlanarDelaunay(points))
    assert len(part) == 4


def test_any_pole():
    """Seen from any point of the sphere the planar part has the points it sees as its convex hull: V - E + F = 1."""
    points = np.random.default_rng(0).normal(size=(50, 3))
    sphere = SphericalDelaunay(points)
    for pole in np.random.default_rng(1).normal(size=(5, 3)):
        part = planar_part(sphere, pole)
        edges = {frozenset(e) for s in part.tolist() for e in ((s[0], s[1]), (s[1], s[2]), (s[2], s[0]))}
        assert 50 - len(edges) + len(part) == 1


def test_merged_polygons_do_not_depend_on_the_tie_rule():
    """Mirroring turns the order of the points round and with it the diagonals."""
    triangulation, mirrored = PlanarDelaunay(GRID), PlanarDelaunay(GRID * [-1, 1])
    assert {frozenset(s) for s in triangulation.simplices.tolist()} != {
        frozenset(s) for s in mirrored.simplices.tolist()
    }
    assert {frozenset(p) for p in merged_polygons(triangulation)} == {frozenset(p) for p in merged_polygons(mirrored)}
    assert all(len(p) == 4 for p in merged_polygons(triangulation))
