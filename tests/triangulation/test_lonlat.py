"""Objects made from longitude and latitude remember which latitude it was, for queries and for results."""

import pickle

import numpy as np
import pytest

from stereodel import (
    Gnomonic,
    HullInsertion,
    PlanarDelaunay,
    PlanarVoronoi,
    SphericalDelaunay,
    SphericalVoronoi,
    angular_distance,
    fisheye,
    great_circle_points,
    lonlat_to_xyz,
    solid_angle,
    xyz_to_lonlat,
)
from stereodel.graphs import (
    gabriel_graph,
    hull,
    minimum_spanning_tree,
    relative_neighborhood_graph,
    urquhart_graph,
)
from stereodel.interpolation import (
    LinearInterpolator,
    NaturalNeighborInterpolator,
    NearestInterpolator,
    SmoothInterpolator,
    contours,
)
from stereodel.relaxation import lloyd
from stereodel.sphere.latitudes import KINDS

INTERPOLATORS = [LinearInterpolator, NaturalNeighborInterpolator, NearestInterpolator, SmoothInterpolator]
GRAPHS = [gabriel_graph, hull, minimum_spanning_tree, relative_neighborhood_graph, urquhart_graph]
MADE = [SphericalDelaunay.from_lonlat, SphericalVoronoi.from_lonlat, HullInsertion.from_lonlat]


def places(n, seed=0):
    """Uniform on the sphere, degrees."""
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.uniform(-180, 180, n), np.degrees(np.arcsin(rng.uniform(-1, 1, n)))])


def same(told, given):
    """Degrees within a few roundings, the longitudes modulo a turn."""
    turn = (told[:, 0] - given[:, 0] + 180) % 360 - 180
    return np.abs(turn).max() < 1e-12 and np.abs(told[:, 1] - given[:, 1]).max() < 1e-12


@pytest.mark.parametrize("latitude", KINDS)
@pytest.mark.parametrize("make", MADE)
def test_sites_are_remembered(make, latitude):
    lonlat = places(50)
    made = make(lonlat, latitude=latitude)
    assert made.latitude == latitude
    assert np.array_equal(made.points, lonlat_to_xyz(lonlat, latitude=latitude))
    assert same(made.lonlat, lonlat)


@pytest.mark.parametrize("latitude", KINDS)
def test_queries_are_those_of_the_same_latitude(latitude):
    lonlat, queries = places(300), places(2000, seed=1).reshape(40, 50, 2)
    triangulation = SphericalDelaunay.from_lonlat(lonlat, latitude=latitude)
    xyz = lonlat_to_xyz(queries, latitude=latitude)
    assert np.array_equal(triangulation.nearest(lonlat=queries), triangulation.nearest(xyz))
    assert np.array_equal(triangulation.nearest(lonlat=queries, k=3), triangulation.nearest(xyz, k=3))
    assert np.array_equal(triangulation.find_simplex(lonlat=queries), triangulation.find_simplex(xyz))
    assert triangulation.nearest(lonlat=lonlat[7]) == 7


def test_changes_speak_it_too():
    lonlat, more = places(60), places(30, seed=2)
    triangulation = SphericalDelaunay.from_lonlat(lonlat, latitude="geodetic")
    for few in np.split(more, [1, 3]):  # by the mesh, and from scratch
        triangulation.insert(lonlat=few)
    triangulation.remove([0, 4, 70])
    left = np.delete(np.concatenate([lonlat, more]), [0, 4, 70], axis=0)
    assert triangulation.latitude == "geodetic"
    assert same(triangulation.lonlat, left)
    again = SphericalDelaunay.from_lonlat(left, latitude="geodetic")
    assert np.array_equal(triangulation.points, again.points)
    assert sorted(map(tuple, triangulation.simplices.tolist())) == sorted(map(tuple, again.simplices.tolist()))


def test_hull_insertion_goes_on_with_it():
    lonlat = places(40)
    begun = HullInsertion.from_lonlat(lonlat[:10], latitude="authalic")
    begun.extend(lonlat=lonlat[10:])
    begun.run()
    assert same(begun.lonlat, lonlat)
    whole = SphericalDelaunay.from_lonlat(lonlat, latitude="authalic")
    assert sorted(map(tuple, begun.facets.tolist())) == sorted(map(tuple, whole.simplices.tolist()))


def test_results_are_told():
    lonlat = places(100)
    triangulation = SphericalDelaunay.from_lonlat(lonlat, latitude="geodetic")
    centers = lonlat_to_xyz(triangulation.circumcenters_lonlat, latitude="geodetic")
    assert angular_distance(centers, triangulation.circumcenters).max() < 1e-12
    diagram = SphericalVoronoi(triangulation)
    assert diagram.latitude == "geodetic"
    vertices = lonlat_to_xyz(diagram.vertices_lonlat, latitude="geodetic")
    assert angular_distance(vertices, diagram.vertices).max() < 1e-12
    assert diagram.delaunay().latitude == "geodetic"
    assert same(SphericalVoronoi.from_lonlat(lonlat[:2]).delaunay().lonlat, lonlat[:2])


@pytest.mark.parametrize("kind", INTERPOLATORS)
@pytest.mark.parametrize("latitude", KINDS)
def test_interpolators(kind, latitude):
    lonlat, queries = places(200), places(60, seed=3).reshape(3, 20, 2)
    values = np.cos(np.radians(lonlat[:, 1]))
    function = kind.from_lonlat(lonlat, values, latitude=latitude)
    plain = kind(lonlat_to_xyz(lonlat, latitude=latitude), values)
    xyz = lonlat_to_xyz(queries, latitude=latitude)
    assert function.latitude == latitude
    assert plain.latitude is None
    np.testing.assert_array_equal(function(lonlat=queries), plain(xyz))
    np.testing.assert_array_equal(function.gradient(lonlat=queries), plain.gradient(xyz))
    again = pickle.loads(pickle.dumps(function))
    np.testing.assert_array_equal(again(lonlat=queries), plain(xyz))


@pytest.mark.parametrize("latitude", KINDS)
@pytest.mark.parametrize("graph", GRAPHS)
def test_graphs(graph, latitude):
    lonlat = places(80) / [9, 3]  # in a hemisphere, so that there is a hull
    expected = graph(lonlat_to_xyz(lonlat, latitude=latitude))
    assert np.array_equal(graph(lonlat=lonlat, latitude=latitude), expected)
    assert np.array_equal(graph(SphericalDelaunay.from_lonlat(lonlat, latitude=latitude)), expected)
    assert np.array_equal(graph(lonlat=lonlat), graph(lonlat_to_xyz(lonlat)))
    assert graph(lonlat=[]).size == 0


@pytest.mark.parametrize("latitude", KINDS)
def test_relaxation(latitude):
    lonlat = places(50)
    expected = lloyd(lonlat_to_xyz(lonlat, latitude=latitude), steps=3)
    of_triangulation = lloyd(SphericalDelaunay.from_lonlat(lonlat, latitude=latitude), steps=3)
    for relaxed in (lloyd(lonlat=lonlat, latitude=latitude, steps=3), of_triangulation):
        assert np.array_equal(relaxed.points, expected.points)
        assert relaxed.latitude == latitude
        assert angular_distance(lonlat_to_xyz(relaxed.lonlat, latitude=latitude), relaxed.points).max() < 1e-12


def test_contours():
    lonlat = places(200)
    pieces = contours(SphericalDelaunay.from_lonlat(lonlat, latitude="geodetic"), lonlat[:, 1], [0, 40])
    assert len(pieces) > 1
    for piece in pieces:
        assert angular_distance(lonlat_to_xyz(piece.lonlat, latitude="geodetic"), piece.points).max() < 1e-12
        assert pickle.loads(pickle.dumps(piece)) == piece
    plain = contours(lonlat_to_xyz(lonlat, latitude="geodetic"), lonlat[:, 1], [0, 40])
    assert plain != pieces  # the latitude is a part of the value
    assert [piece.points.tolist() for piece in plain] == [piece.points.tolist() for piece in pieces]


PLANE = np.array([[0.0, 0], [4, 0], [0, 4], [4, 5]])
ROUND = np.vstack([np.eye(3), -np.eye(3)])
NAMED = SphericalDelaunay.from_lonlat([(0, 0), (90, 0), (0, 90)])
FUNCTION = LinearInterpolator(NAMED, [0, 1, 2])


LON, LAT = np.array([0.0, 90.0, 40.0, -50.0]), np.array([0.0, 10.0, 60.0, 20.0])
ROWS = r"give rows \(longitude, latitude\), as np\.column_stack\(\[lon, lat\]\) makes them"
BY_NAME = r"give longitude and latitude by name, lonlat=np\.column_stack\(\[lon, lat\]\)"
XYZ = r"shape \(\.\.\., 3\), got \(2,\), which means the plane; make directions of longitude .* by lonlat_to_xyz"
FIRST_CALLS = [  # that a newcomer writes
    (lambda: NAMED.nearest(10, 50), rf"nearest\(\) takes 1 argument by position, got 2; {BY_NAME}"),
    (lambda: NAMED.find_simplex(10, 50), BY_NAME),
    (lambda: FUNCTION(LON, LAT), BY_NAME),
    (lambda: lonlat_to_xyz(10, 50), r"give longitude and latitude as one pair \(lon, lat\), or rows"),
    (lambda: fisheye((10, 50), 4), r"fisheye\(\) takes 1 argument by position, got 2; magnification= is a keyword"),
    (lambda: SphericalDelaunay.from_lonlat(LON, LAT), ROWS),
    (lambda: SphericalVoronoi.from_lonlat(LON, LAT), ROWS),
    (lambda: LinearInterpolator.from_lonlat(LON, LAT, LAT), rf"takes 2 arguments by position, got 3; {ROWS}"),
    (lambda: SphericalDelaunay.from_lonlat(LON), ROWS),
    (lambda: SphericalDelaunay.from_lonlat(np.stack([LON, LAT])), ROWS),
    (lambda: angular_distance((10, 50), (20, 60)), f"a must have {XYZ}"),
    (lambda: great_circle_points((10, 50), (20, 60), 3), f"a must have {XYZ}"),
    (lambda: solid_angle((0, 0), (90, 0), (0, 90)), f"a must have {XYZ}"),
    (lambda: xyz_to_lonlat((10, 50)), f"xyz must have {XYZ}"),
    (lambda: Gnomonic((0, 0)).forward((10, 50)), f"xyz must have {XYZ}"),
    (lambda: fisheye((10, 50), magnification=4)((10, 50)), "for longitude and latitude call its method lonlat"),
]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        *FIRST_CALLS,
        (lambda: SphericalDelaunay(PLANE), r"\(4, 2\), which means the plane; .* use SphericalDelaunay\.from_lonlat"),
        (lambda: PlanarDelaunay(ROUND), r"\(6, 3\), which means directions; .* SphericalDelaunay"),
        (lambda: NAMED.insert(PLANE), r"means the plane; .* use insert\(lonlat=…\)"),
        (lambda: HullInsertion(ROUND).extend(PLANE), r"means the plane; .* use extend\(lonlat=…\)"),
        (lambda: HullInsertion(PLANE).extend(ROUND), "means directions; triangulate directions by SphericalDelaunay"),
        (lambda: NAMED.nearest((9.0, 48.0)), "means the plane; for longitude and latitude write lonlat="),
        (lambda: NAMED.find_simplex(PLANE), "means the plane; for longitude and latitude write lonlat="),
        (lambda: PlanarDelaunay(PLANE).nearest(ROUND), "means directions; .* are of the plane"),
        (lambda: FUNCTION(PLANE), "means the plane; for longitude and latitude write lonlat="),
        (lambda: LinearInterpolator(PLANE, [0, 1, 2, 3])(ROUND), "means directions; .* are of the plane"),
        (lambda: SphericalDelaunay(ROUND).nearest(lonlat=(0, 0)), "make the object by from_lonlat"),
        (lambda: PlanarDelaunay(PLANE).find_simplex(lonlat=(0, 0)), "make the object by from_lonlat"),
        (lambda: PlanarDelaunay(PLANE).insert(lonlat=[(0, 0)]), "make the object by from_lonlat"),
        (lambda: HullInsertion(PLANE).extend(lonlat=[(0, 0)]), "make the object by from_lonlat"),
        (lambda: LinearInterpolator(PLANE, [0, 1, 2, 3])(lonlat=(0, 0)), "make the object by from_lonlat"),
        (lambda: NAMED.nearest(lonlat=(0, 95)), "latitude 95"),
        (lambda: NAMED.insert(lonlat=[0, 0, 0]), r"lonlat must have shape \(n, 2\)"),
        (lambda: gabriel_graph(lonlat=ROUND), r"lonlat must have shape \(n, 2\)"),
        (lambda: SphericalDelaunay.from_lonlat(PLANE, latitude="geocentric"), "latitude is 'geocentric'"),
        (lambda: NAMED.nearest(), "queries are missing; give queries, or longitude and latitude by lonlat="),
        (lambda: NAMED.nearest([1, 0, 0], lonlat=(0, 0)), "queries and lonlat= were both given"),
        (lambda: NAMED.insert(), "points are missing"),
        (lambda: gabriel_graph(), "points are missing; give points, or longitude and latitude by lonlat="),
        (lambda: gabriel_graph(NAMED, lonlat=PLANE), "points and lonlat= were both given"),
        (lambda: gabriel_graph(PLANE, latitude="geodetic"), "write lonlat=…, latitude='geodetic'"),
        (lambda: hull(NAMED, latitude="geodetic"), "write lonlat=…, latitude='geodetic'"),
        (lambda: lloyd(PLANE, latitude="geodetic", bounds=(0, 0, 9, 9)), "write lonlat=…, latitude='geodetic'"),
        (lambda: lloyd(NAMED, latitude="geodetic"), "write lonlat=…, latitude='geodetic'"),
    ],
)
def test_the_message_names_the_right_call(call, message):
    with pytest.raises((TypeError, ValueError), match=message):
        call()


@pytest.mark.parametrize(
    "made",
    [
        PlanarDelaunay(PLANE),
        PlanarVoronoi(PLANE),
        SphericalDelaunay(ROUND),
        SphericalVoronoi(ROUND),
        HullInsertion(ROUND),
        lloyd(ROUND, steps=1),
        contours(ROUND, ROUND[:, 2], 0.5)[0],
    ],
    ids=lambda made: type(made).__name__,
)
def test_directions_have_no_latitude(made):
    assert made.latitude is None
    assert not hasattr(made, "lonlat")
    if not type(made).__name__.startswith("Planar"):
        with pytest.raises(AttributeError, match="from_lonlat"):
            _ = made.lonlat


@pytest.mark.parametrize("radius", [0, -1, np.inf])
def test_areas_need_a_radius(radius):
    for diagram in (PlanarVoronoi(PLANE), SphericalVoronoi(ROUND)):
        with pytest.raises(ValueError, match="radius"):
            diagram.areas(radius=radius)
