"""What the pictures of what the paper says and does not draw show: computed once more, in another way."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from stereodel import SphericalDelaunay, Stereographic
from stereodel.drawing.scene.sketch import arc_through
from stereodel.sphere import great_circle_points
from tests.figures.scripts import arc_points, geometry, path_points, script

# P24: claim_edges.


def over_chord(points, a, b):
    """Points of the plane as complex numbers, a chord from 0 to 1 being the unit."""
    return ((points - a) @ [1, 1j]) / ((b - a) @ [1, 1j])


def test_edges_and_their_images_coincide_only_through_the_point_of_contact():
    module, g = script("claim_edges"), geometry("claim_edges")
    projection = Stereographic((0, -90), radius=module["RADIUS"])
    own = {frozenset(pair) for pair in SphericalDelaunay(g["lifts"]).edges.tolist()}
    for (i, j), middle, bent in zip(g["edges"].tolist(), g["middles"], g["bent"], strict=True):
        assert {i, j} in own
        a, b = g["sites"][[i, j]]
        drawn = over_chord(path_points(arc_through(a, middle, b), 500), a, b)
        true = over_chord(projection.forward(great_circle_points(*g["lifts"][[i, j]], 33)), a, b)
        assert np.abs(drawn[:, None] - true).min(axis=0).max() < 3e-3
        assert (np.abs(true.imag).max() > 1e-3) == (np.abs(drawn.imag).max() > 1e-3) == bent
        assert bent == np.hypot(*g["sites"][[i, j]].T).all()


def test_lifts_of_segments_are_arcs_of_circles_through_the_pole():
    module, g = script("claim_edges"), geometry("claim_edges")
    projection = Stereographic((0, -90), radius=module["RADIUS"])
    for points, (a, b) in zip(arc_points(g["lifted"]), g["sites"][g["edges"]], strict=True):
        along = over_chord(projection.forward(points), a, b)
        assert along.imag == pytest.approx(0, abs=1e-12)
        assert (np.diff(along.real) > 0).all()
        normal = np.cross(points[8] - points[0], points[16] - points[0])
        assert (np.array([0, 0, 1]) - points[0]) @ normal == pytest.approx(0, abs=1e-12)


# P2: claim_closing.


def test_the_larger_bubble_of_the_tinted_facet_is_empty_and_the_hull_is_beside_the_centre():
    g = geometry("claim_closing")
    *normal, offset = g["circle"]
    heights, corners = g["sites"] @ normal - offset, g["facets"][g["shown"]]
    assert heights[corners] == pytest.approx(0, abs=1e-14)
    assert np.delete(heights, corners).max() < -0.01
    assert -0.9 < offset < -0.2  # the empty side, beyond the centre, is larger than a hemisphere
    hull = ConvexHull(g["sites"])
    assert hull.equations[:, 3].max() == pytest.approx(-offset, rel=1e-12)  # the centre is above this facet
    assert {frozenset(facet) for facet in g["facets"].tolist()} == {frozenset(f) for f in hull.simplices.tolist()}
