"""Arcs through a lens, many at once: the same curves as those of the library's exact images."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stereodel import SphereArc, SphericalDelaunay, SphericalVoronoi, fisheye, lonlat_to_xyz
from stereodel.cli.globe_arcs import Arcs, edges_of, ridges_of
from stereodel.render import CircleArc, View


def on_sphere(n, seed):
    points = np.random.default_rng(seed).normal(size=(n, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def same_curve(curve, exact, tolerance=1e-9):
    """Whether two arcs run through the same points in the same order, seen at 17 equal steps of angle."""
    other = CircleArc.of(exact)
    steps = (arc.points(np.linspace(arc.start, arc.stop, 17)) for arc in (curve, other))
    return np.allclose(*steps, atol=tolerance)


@settings(max_examples=30)
@given(st.integers(0, 10**6), st.sampled_from([0.05, 0.5, 1.0, 4.0, 50.0]))
def test_images_are_those_of_the_map(seed, magnification):
    points = on_sphere(12, seed)
    lens = fisheye(points[0] + 0.1 * points[1], magnification=magnification)
    exact = [lens.image_of(SphereArc.great(a, b)) for a, b in zip(points[2:7], points[7:], strict=True)]
    curves = Arcs.great(points[2:7], points[7:]).through(lens).curves()
    assert all(same_curve(*pair, tolerance=1e-6) for pair in zip(curves, exact, strict=True))


@pytest.mark.parametrize("n", [2, 3, 4, 40])
def test_ridges_are_those_of_the_diagram(n):
    diagram = SphericalVoronoi(on_sphere(n, n))
    curves = ridges_of(diagram).curves()
    assert all(same_curve(*pair) for pair in zip(curves, diagram.ridge_arcs(), strict=True))


def test_half_circles_between_antipodal_vertices():
    """All sites on the equator: the ridges are meridians, told apart by their normals alone."""
    diagram = SphericalVoronoi(lonlat_to_xyz([(0, 0), (90, 0), (180, 0)]))
    middles = {tuple((curve.points(curve.stop / 2) * 2**0.5).round(9) + 0.0) for curve in ridges_of(diagram).curves()}
    assert middles == {(1.0, 1.0, 0.0), (-1.0, 1.0, 0.0), (0.0, -(2**0.5).__round__(9), 0.0)}


def test_clusters_give_short_arcs_not_circles():
    rng = np.random.default_rng(5)
    cluster = np.array([1.0, 0.0, 0.0]) + 1e-12 * rng.normal(size=(30, 3))
    triangulation = SphericalDelaunay(cluster)
    unit = cluster / np.linalg.norm(cluster, axis=1, keepdims=True)
    curves = edges_of(unit, triangulation.edges).through(fisheye((0, 0), magnification=3.0)).curves()
    assert curves
    assert max(curve.stop - curve.start for curve in curves) < 1e-9


def test_opposite_ends_are_left_out():
    assert Arcs.great(np.array([[1.0, 0.0, 0.0]]), np.array([[-1.0, 0.0, 0.0]])).curves() == []


@given(st.integers(0, 10**6), st.sampled_from([0.2, 1.0, 5.0]))
def test_no_arc_that_shows_is_left_out(seed, magnification):
    points = on_sphere(20, seed)
    arcs = Arcs.great(points[:10], points[10:]).through(fisheye(points[0], magnification=magnification))
    toward = View(20, 30).matrix[2]
    kept = {tuple(start) for start in arcs.facing(toward).start}
    for curve, start in zip(arcs.curves(), arcs.start, strict=True):
        shows = (curve.points(np.linspace(curve.start, curve.stop, 200)) @ toward).max() > 0
        assert not shows or tuple(start) in kept
