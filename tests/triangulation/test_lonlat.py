"""Objects made from longitude and latitude remember which latitude it was, for queries and for results."""

import pickle

import numpy as np
import pytest

from stereodel import SphericalDelaunay, SphericalVoronoi, angular_distance, graphs, lonlat_to_xyz
from stereodel.interpolation import contours
from stereodel.relaxation import lloyd
from stereodel.sphere.latitudes import KINDS
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi
from tests import sets
from tests.graphs.test_proximity import FROM_THE_INSIDE
from tests.interpolation.known import KINDS as INTERPOLATORS


def places(n, seed=0):
    """Uniform on the sphere, degrees."""
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.uniform(-180, 180, n), np.degrees(np.arcsin(rng.uniform(-1, 1, n)))])


def same(told, given):
    """Degrees within a few roundings, the longitudes modulo a turn."""
    turn = (told[:, 0] - given[:, 0] + 180) % 360 - 180
    return np.abs(turn).max() < 1e-12 and np.abs(told[:, 1] - given[:, 1]).max() < 1e-12


@pytest.mark.parametrize("latitude", KINDS)
@pytest.mark.parametrize("make", [SphericalDelaunay.from_lonlat, SphericalVoronoi.from_lonlat])
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


@pytest.mark.parametrize("kind", INTERPOLATORS.values())
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
@pytest.mark.parametrize("graph", [graphs.hull, *FROM_THE_INSIDE])
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


FLAT, ROUND = sets.grid(3, 3), sets.AXES
WITHOUT = [cls(FLAT) for cls in (PlanarDelaunay, PlanarVoronoi)]
WITHOUT += [cls(ROUND) for cls in (SphericalDelaunay, SphericalVoronoi)]
WITHOUT += [lloyd(ROUND, steps=1), contours(ROUND, ROUND[:, 2], 0.5)[0]]


@pytest.mark.parametrize("made", WITHOUT, ids=lambda made: type(made).__name__)
def test_directions_have_no_latitude(made):
    assert made.latitude is None
    assert not hasattr(made, "lonlat")
    if not type(made).__name__.startswith("Planar"):
        with pytest.raises(AttributeError, match="from_lonlat"):
            _ = made.lonlat
