"""Claims about algorithms, and the words "only" and "completely determined" (rows P3, P5, P6 and P23 to P25)."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf, workdps

from stereodel import Gnomonic, HullInsertion, MoebiusMap, Stereographic, fisheye, lonlat_to_xyz
from stereodel import _kernel_probe as probe
from stereodel.conformal import three_points
from stereodel.sphere import SphereCircle, angular_distance, great_circle_points
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, planar_part
from stereodel.triangulation.sites import GHOST, PlaneSites, RaySites
from tests import sets
from tests.exact import unit, volume
from tests.figures.scripts import script
from tests.kernel.stages import OPEN
from tests.reference import incircle_integer, orient2d_integer
from tests.strategies import BETWEEN_POLES


def triangles(simplices):
    return {tuple(sorted(row)) for row in np.asarray(simplices).tolist()}


# P3: linear time.


def vertices_made(points):
    """Voronoi vertices made by inserting points in their order: each new facet has one, each old one was made once."""
    return sum(len(step.new) for step in HullInsertion(points))


@pytest.mark.parametrize("kind", [sets.sphere("unit"), sets.plane("random")], ids=str)
def test_both_graphs_built_together_make_linearly_many_vertices(kind):
    """A new point has fewer than six neighbours on average if it is any of them (Euler), whatever the points."""
    points = kind.drawn(800)
    half, whole = vertices_made(points[:400]), vertices_made(points)
    assert 1.9 < whole / half < 2.1
    assert whole < 6.2 * len(points)


@pytest.mark.parametrize("kind", [sets.sphere("unit"), sets.plane("random")], ids=str)
def test_the_way_back_looks_at_no_coordinates(kind):
    """The triangulation is read off the diagram: other places of the sites change nothing, so nothing is searched."""
    points = kind.drawn(500)
    diagram = (SphericalVoronoi if points.shape[1] == 3 else PlanarVoronoi)(points)
    expected = diagram.delaunay().simplices
    diagram.points = points[::-1].copy()
    assert diagram.delaunay().simplices.tolist() == expected.tolist()


# P5: the counters of the paper's own engine.


def recorded(monkeypatch, kind, name):
    """Lists the arguments of all calls of a method."""
    calls, method = [], getattr(kind, name)

    def wrapper(self, *numbers):
        calls.append(numbers)
        return method(self, *numbers)

    monkeypatch.setattr(kind, name, wrapper)
    return calls


def open_in_doubles(predicate, points, numbers):
    """Which of the tests of four points by number the kernel's filter leaves open."""
    rows = np.array(numbers, dtype=int).reshape(-1, 4)
    return rows[predicate(*points[rows.T], stage="filter") == OPEN]


@pytest.mark.parametrize("rays", sets.named("sphere", "unit", "three close", "cube", "a rounding and 8 far"))
def test_the_engine_counts_exact_ties_on_the_sphere(monkeypatch, rays):
    points, asked = rays.drawn(33), recorded(monkeypatch, RaySites, "sees")
    engine = HullInsertion(points)
    engine.run()
    left_open = open_in_doubles(probe.bubble, points, asked)
    with workdps(120):
        ties = sum(abs(volume(*map(unit, points[four]))) < mpf("1e-100") for four in left_open)
    assert engine.inconclusive == {"exact": ties}
    assert len(left_open) or rays.traits & {"random"}
    assert ties > 0 or not rays.traits & {"ties"}


@pytest.mark.parametrize("sites", sets.named("plane", "random", "small grid", "cluster", "needles"))
def test_the_engine_counts_exact_ties_in_the_plane(monkeypatch, sites):
    points = sites.drawn(40)
    asked = recorded(monkeypatch, PlaneSites, "sees")
    engine = HullInsertion(points)
    engine.run()
    exact = [tuple(map(Fraction, row)) for row in points.tolist()]
    circles = open_in_doubles(probe.incircle, points, [four for four in asked if GHOST not in four])
    ties = sum(incircle_integer(*(exact[i] for i in four)) == 0 for four in circles)
    ties += sum(orient2d_integer(*(exact[i] for i in four if i != GHOST)) == 0 for four in asked if GHOST in four)
    assert engine.inconclusive == {"exact": ties}
    assert (ties > 0) == ("ties" in sites.traits)


# P6: curvature makes the test conclusive.


@pytest.mark.parametrize("size", [1e-4, 1e-6, 1e-8, 1e-10])
def test_curvature_decides_the_exact_sign_in_a_flat_region(rng, size):
    """Four points next to one small circle: the curvature form has the exact sign, the plain one guesses."""
    fours, plain, signs, decided = [], [], [], []
    for _ in range(200):
        axis, u, v = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        angle = rng.uniform(0, 2 * np.pi, size=(4, 1))
        fours.append(axis + size * (np.cos(angle) * u + np.sin(angle) * v))
    for four in fours:
        sign = probe.bubble(*four[:, None], stage="filter")[0]
        decided.append(0 if sign == OPEN else sign)
        a, *others = four / np.linalg.norm(four, axis=1)[:, None]
        plain.append(np.sign(np.linalg.det(np.array(others) - a)))
        with workdps(120):
            signs.append(int(mp.sign(volume(*map(unit, four)))))
    decided, plain, signs = map(np.array, (decided, plain, signs))
    assert (decided != 0).mean() > 0.9
    assert (decided == signs)[decided != 0].all()
    assert (plain != signs).mean() > 0.1


# P23: all stereographic projections keep the combinatorial triangulation, and only they.

CONVERSE = script("claim_projections")
PLACE = CONVERSE["PLACE"]
OTHERS = {name: forward for name, forward in CONVERSE["PROJECTIONS"].items() if name != "stereographic"}


def sites_of_a_cap(count=400, radius=50.0):
    points = sets.sphere("unit").drawn(8 * count, 6)
    return points[angular_distance(points, lonlat_to_xyz(PLACE)) < radius][:count]


def kept_and_broken(points, plane):
    """Triangles of the sphere with bubbles below 20° that are triangles of the plane too, and those that are not."""
    sphere = SphericalDelaunay(points)
    a, b, c = np.moveaxis(points[sphere.simplices], 1, 0)
    normal = np.cross(b - a, c - a)
    height = np.sum(normal * a, axis=1) / np.linalg.norm(normal, axis=1)
    own = triangles(sphere.simplices[height > np.cos(np.radians(20))])
    flat_ones = triangles(PlanarDelaunay(plane).simplices)
    return len(own & flat_ones), len(own - flat_ones)


@pytest.mark.parametrize("center", [PLACE, (-70.0, -10.0), (0.0, 90.0)])
def test_stereographic_projections_keep_all_triangles(center):
    projection, points = Stereographic(center), sets.sphere("unit").drawn(3000)
    part = planar_part(SphericalDelaunay(points), -lonlat_to_xyz(center))
    assert triangles(PlanarDelaunay(projection.forward(points)).simplices) == triangles(part)
    kept, broken = kept_and_broken(sites_of_a_cap(), Stereographic(PLACE).forward(sites_of_a_cap()))
    assert kept > 500
    assert broken == 0


@pytest.mark.parametrize("name", OTHERS)
def test_other_projections_break_triangles(name):
    """Conformal ones too: circles must stay circles, and not only those too small to see."""
    points = sites_of_a_cap()
    kept, broken = kept_and_broken(points, OTHERS[name](points))
    assert kept > 100
    assert broken > 0


@pytest.mark.parametrize("name", ["stereographic", *OTHERS])
def test_a_circle_that_does_not_stay_one_breaks_a_quadrangle(name):
    """Why there are no others: four points next to such a circle have one diagonal before and another one after."""
    projection = OTHERS.get(name, Stereographic(PLACE).forward)
    circle = SphereCircle.around((35.0, 20.0), 25.0)
    agrees = []
    for nudge in (-1e-4, 1e-4):
        points = circle.sample(360)[[0, 80, 170, 260]]
        points[3] += nudge * circle.center
        part = planar_part(SphericalDelaunay(points), -circle.center)
        assert len(part) == 2
        agrees.append(triangles(part) == triangles(PlanarDelaunay(projection(points)).simplices))
    assert all(agrees) == (name == "stereographic")


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_projection_that_keeps_circles_is_stereographic(seed, mirrored):
    """Any conformal map of the sphere, then a projection: one from another point, but for a similitude of the plane."""
    rng = np.random.default_rng(seed)
    lens = fisheye((rng.uniform(-180, 180), rng.uniform(-80, 80)), magnification=rng.uniform(2, 6))
    lens = lens @ MoebiusMap.rotation((rng.uniform(-180, 180), 20.0), rng.uniform(0, 360))
    mirror = np.array([1.0, 1.0, -1.0 if mirrored else 1.0])
    pole = lens.inverse()(np.array([0.0, 0.0, 1.0])) * mirror  # what goes to infinity
    points = sets.sphere("unit").drawn(200, seed)
    points = points[angular_distance(points, pole) > 20]
    image = Stereographic((0, -90)).forward(lens(points * mirror)) @ [1, 1j]
    other = Stereographic(-pole).forward(points) @ [1, 1j]
    if mirrored:
        other = other.conj()
    factor = (image[1] - image[0]) / (other[1] - other[0])
    assert np.abs(image - image[0] - factor * (other - other[0])).max() < 1e-11 * np.abs(image).max()
    # Which the same from a point a degree away is not.
    beside = Stereographic(MoebiusMap.rotation((0.0, 0.0), 1.0)(-pole)).forward(points) @ [1, 1j]
    beside = beside.conj() if mirrored else beside
    factor = (image[1] - image[0]) / (beside[1] - beside[0])
    assert np.abs(image - image[0] - factor * (beside - beside[0])).max() > 1e-4 * np.abs(image).max()


# P24: only similitudes keep the edges, point by point.


def bend(curve):
    """How far points (n, 2) of a curve stray from the line through its ends, over the distance of the ends."""
    along = curve[-1] - curve[0]
    across = np.array([-along[1], along[0]])
    return np.abs((curve - curve[0]) @ across).max() / (along @ along)


def broken_in_plane(points, image):
    return len(triangles(PlanarDelaunay(points).simplices) ^ triangles(PlanarDelaunay(image).simplices))


@pytest.mark.parametrize("matrix", [[[3, -4], [4, 3]], [[3, 4], [4, -3]], [[-2, 0], [0, -2]], [[0, 1], [1, 0]]])
def test_similitudes_of_the_plane_keep_triangles(matrix):
    points = np.random.default_rng(8).integers(-(2**20), 2**20, size=(200, 2)).astype(float)
    assert broken_in_plane(points, points @ np.array(matrix, dtype=float).T + [5.0, -7.0]) == 0


@given(st.floats(0, 180), st.floats(0, 180), st.floats(1.001, 50))
def test_any_other_linear_map_breaks_a_rhombus(first, second, ratio):
    """Its diagonals lie along what is stretched most and least; the shorter one is the Delaunay edge."""
    (u, v), (a, b) = (np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]]) for t in np.radians([first, second]))
    matrix = ratio * np.outer(a, u) + np.outer(b, v)
    longer = np.sqrt(ratio) * v  # longer than u, but its image is shorter than that of u
    points = np.array([u, longer, -u, -longer])
    assert PlanarDelaunay(points).edges.tolist().count([0, 2]) == 1
    assert PlanarDelaunay(points @ matrix.T).edges.tolist().count([1, 3]) == 1


def test_maps_that_keep_lines_or_triangles_but_not_both():
    """In the plane: an affine and a projective map bend no edge and break triangles; inversion the other way round."""
    points = np.random.default_rng(9).random((200, 2)) + [1.0, 1.0]
    edge = points[0] + np.linspace(0, 1, 9)[:, None] * (points[1] - points[0])
    for name, image in {
        "affine": lambda p: p @ np.array([[1.0, 0.6], [0.0, 1.0]]),
        "projective": lambda p: p / (0.2 + p @ [[0.7], [0.1]]),
    }.items():
        assert bend(image(edge)) < 1e-14, name
        assert broken_in_plane(points, image(points)) > 20, name
    inverted = points / np.sum(points**2, axis=1, keepdims=True)
    assert bend(edge / np.sum(edge**2, axis=1, keepdims=True)) > 1e-3
    assert len(triangles(PlanarDelaunay(points).simplices) & triangles(PlanarDelaunay(inverted).simplices)) > 300


def test_from_the_sphere_to_the_plane_nothing_keeps_edges_and_triangles(rng):
    points = sites_of_a_cap()
    arcs = [great_circle_points(points[i], points[i + 1], 9) for i in range(40)]
    for _ in range(5):
        after = rng.normal(size=(2, 2))
        images = [Gnomonic(PLACE).forward(arc) @ after for arc in arcs]
        assert max(map(bend, images)) < 1e-10
        assert kept_and_broken(points, Gnomonic(PLACE).forward(points) @ after)[1] > 20
    assert min(bend(Stereographic(PLACE).forward(arc)) for arc in arcs) > 1e-6
    for name, projection in OTHERS.items():
        assert name == "gnomonic" or max(bend(projection(arc)) for arc in arcs) > 1e-3, name


def test_from_the_sphere_to_itself_only_rotations_and_inversions():
    points = sets.sphere("unit").drawn(200)
    own = triangles(SphericalDelaunay(points).simplices)
    turn = MoebiusMap.rotation((20.0, 50.0), 70.0)
    for image in (turn(points), -points, points * [1, 1, -1]):
        assert triangles(SphericalDelaunay(image).simplices) == own
    # A linear map keeps great circles and breaks triangles; the fisheye keeps triangles and bends great circles.
    squeezed = points * [1.0, 1.0, 1.3]
    assert len(triangles(SphericalDelaunay(squeezed).simplices) - own) > 10
    lens = fisheye((20.0, 50.0), magnification=3)
    assert triangles(SphericalDelaunay(lens(points)).simplices) == own
    a, middle, b = lens(great_circle_points(points[0], points[1], 3))
    assert abs(np.linalg.det([a, middle, b])) > 1e-3
    a, middle, b = great_circle_points(points[0], points[1], 3) * [1.0, 1.0, 1.3]
    assert abs(np.linalg.det([a, middle, b])) < 1e-14


# P25: conformal maps are rigid.


@given(BETWEEN_POLES, BETWEEN_POLES, st.floats(1.5, 8), st.floats(0, 360), st.floats(0.1, 2))
def test_agreement_near_a_point_is_agreement_everywhere(focus, place, magnification, turn, size):
    """Three points of a neighbourhood, `size` degrees wide, and their images determine the map on the whole sphere."""
    lens = fisheye(focus, magnification=magnification) @ MoebiusMap.rotation(place, turn)
    near = neighbourhood(place, size)
    found = three_points(near, lens(near))
    # Rounding of the images counts by the square of how small their triangle is.
    images = np.radians(angular_distance(lens(near), np.roll(lens(near), 1, axis=0))).min()
    points = sets.sphere("unit").drawn(50)
    assert np.radians(angular_distance(found(points), lens(points))).max() < 1e-13 * magnification / images**2


def neighbourhood(place, size):
    axis = lonlat_to_xyz(place)
    start = MoebiusMap.rotation(np.cross(axis, np.roll(axis, 1) + [0, 0, 0.5]), size)(axis)
    return np.array([MoebiusMap.rotation(axis, angle)(start) for angle in (0.0, 120.0, 240.0)])


def test_agreement_of_place_scale_and_direction_at_a_point_is_not_enough():
    """Two maps with one image and one derivative at a point: the neighbourhood is needed."""
    place = np.array([0.0, 0.0, -1.0])
    # In the plane from the other pole ζ ↦ ζ/(1 + ζ/2), which fixes 0 with derivative 1.
    other = three_points(*([on_sphere(z) for z in pair] for pair in ((0, 1, -1), (0, 1 / 1.5, -2))))
    assert np.allclose(other(place), place, atol=1e-15)
    assert other.scale_factor(place) == pytest.approx(1, rel=1e-12)
    ahead = on_sphere(1e-7)
    assert np.allclose((other(ahead) - place) / 1e-7, (ahead - place) / 1e-7, atol=1e-6)
    assert not other.is_close(MoebiusMap.identity(), tolerance=0.1)
    assert angular_distance(other(np.array([1.0, 0.0, 0.0])), [1.0, 0.0, 0.0]) > 10


def on_sphere(z):
    return Stereographic((0, -90)).inverse([2 * np.real(z), 2 * np.imag(z)])


def test_a_map_and_its_mirror_agree_on_a_circle_and_nowhere_else():
    """A circle is no neighbourhood: what turns angles round agrees on it with a map that does not."""
    lens, points = fisheye((20.0, 50.0), magnification=3), sets.sphere("unit").drawn(100)
    mirror = np.array([1.0, 1.0, -1.0])
    equator = points * [1, 1, 0]
    assert np.allclose(lens(equator), lens(equator * mirror), atol=1e-15)
    assert angular_distance(lens(points), lens(points * mirror)).min() > 1e-3
