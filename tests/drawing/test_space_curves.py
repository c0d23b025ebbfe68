"""Curves against their definitions: the error of the Béziers, and the roots of everything that cuts them."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from stereodel.curves.view import View
from stereodel.drawing.scene.space_curves import CircleArc, Segment, linear_roots, page_path, trigonometric_roots
from stereodel.sphere import SphereArc, SphereCircle
from tests.figures.scripts import path_points

unit_floats = st.floats(-1, 1)
vectors = st.tuples(unit_floats, unit_floats, unit_floats).map(np.array)
angles = st.floats(-10, 10)
sweeps = st.floats(0.01, 2 * np.pi)


@st.composite
def arcs(draw):
    u, other, radius, start = draw(vectors), draw(vectors), draw(st.floats(0.1, 3)), draw(angles)
    assume(np.linalg.norm(u) > 0.1)
    u = u / np.linalg.norm(u)
    v = other - (other @ u) * u
    assume(np.linalg.norm(v) > 0.1)
    return CircleArc(2 * draw(vectors), radius * u, radius * v / np.linalg.norm(v), start, start + draw(sweeps))


@given(arcs())
def test_beziers_stay_within_the_derived_error_of_the_circle(arc):
    path = arc.beziers()
    radius = np.linalg.norm(arc.u)
    error = np.linalg.norm(path_points(path) - arc.center, axis=1) / radius - 1
    assert error.min() >= -1e-13
    assert error.max() <= 3.8e-7
    assert np.array_equal(path[1:, 0], path[:-1, 3])
    assert np.allclose(path[0, 0], arc.sample(arc.start), rtol=0, atol=1e-12)
    assert np.allclose(path[-1, 3], arc.sample(arc.stop), rtol=0, atol=1e-12)


@given(angles)
def test_a_whole_turn_is_closed_from_any_start(start):
    e = np.eye(3)
    assert CircleArc(np.zeros(3), e[0], e[1], start, start + 2 * np.pi).closed
    assert not CircleArc(np.zeros(3), e[0], e[1], start, start + 2 * np.pi - 1e-9).closed
    path = CircleArc.circle(SphereCircle((10, 20), 0.3)).beziers()
    assert len(path) == 12
    assert np.array_equal(path[0, 0], path[-1, 3])


@given(arcs(), st.builds(View, angles, st.floats(-90, 90)), vectors)
def test_moving_a_curve_moves_its_points(arc, view, origin):
    t = np.linspace(arc.start, arc.stop, 7)
    assert np.allclose(arc.moved(view.matrix, origin).sample(t), view.axes(arc.sample(t) - origin), rtol=0, atol=1e-13)


@given(arcs(), vectors, unit_floats)
def test_level_parameters_are_all_sign_changes(arc, normal, level):
    assume(np.linalg.norm(normal) > 0.1)
    assert_cuts_separate_signs(arc, arc.level_parameters(normal, level), lambda x: x @ normal - level)


@given(arcs(), st.sampled_from([(1, 1, 1), (1, 1, 0), (0, 1, 2), (1, 0, 0)]), st.floats(0.1, 4))
def test_quadric_parameters_are_all_sign_changes_of_an_arc(arc, weights, level):
    weights = np.array(weights, dtype=float)
    assert_cuts_separate_signs(arc, arc.quadric_parameters(weights, level), lambda x: x**2 @ weights - level)


@given(vectors, vectors, st.sampled_from([(1, 1, 1), (1, 1, 0)]), st.floats(0.01, 2))
def test_quadric_parameters_are_all_sign_changes_of_a_segment(a, b, weights, level):
    weights = np.array(weights, dtype=float)
    segment = Segment.between(2 * a, 2 * b)
    assert_cuts_separate_signs(segment, segment.quadric_parameters(weights, level), lambda x: x**2 @ weights - level)
    assert_cuts_separate_signs(segment, segment.level_parameters(weights, level), lambda x: x @ weights - level)


def assert_cuts_separate_signs(curve, cuts, function):
    """Between neighbouring cuts the function keeps its sign, up to touching roots that rounding may lose."""
    assert np.all(np.diff(cuts) > 0)
    assert np.all((cuts > curve.start) & (cuts < curve.stop))
    bounds = [curve.start, *cuts, curve.stop]
    for low, high in pairwise(bounds):
        values = function(curve.sample(np.linspace(low, high, 203)[1:-1]))
        values = values[np.abs(values) > 1e-9]
        assert len(values) == 0 or np.all(values > 0) or np.all(values < 0)


def test_roots_where_there_are_none_and_of_a_circle_seen_face_on():
    assert linear_roots(2.0, 1.0, 1.0) == linear_roots(0.0, 0.0, 0.0) == trigonometric_roots(9.0, 1 + 0j, 1j) == []
    assert trigonometric_roots(0.0, 0.5 + 0j, 1e-17j) == pytest.approx([-np.pi / 2, np.pi / 2])


def test_great_arcs_are_the_short_way_at_any_distance():
    arc = CircleArc.great([1, 0, 0], [-1, 1e-3, 0])
    assert arc.stop == pytest.approx(np.pi - 1e-3, abs=1e-9)
    assert np.allclose(arc.sample(arc.stop / 2), [5e-4, 1, 0], atol=1e-6)
    tiny = CircleArc.great([1, 0, 0], [1, 1e-13, 0])
    assert tiny.stop == pytest.approx(1e-13, rel=1e-6)


@pytest.mark.parametrize("end", [(2, 0, 0), (-3, 0, 0)])
def test_great_arcs_refuse_equal_and_opposite_ends(end):
    with pytest.raises(ValueError, match="equal or antipodal"):
        CircleArc.great((1, 0, 0), end)


def test_arcs_of_the_library_are_followed_in_their_sense():
    arc = SphereArc(SphereCircle((0, 0, 1), 0.0), (1, 0, 0), (0, -1, 0))
    curve = CircleArc.of(arc)
    assert curve.stop == pytest.approx(3 * np.pi / 2)
    t = np.linspace(0, curve.stop, 9)
    assert np.allclose(curve.sample(t), arc.sample(9), rtol=0, atol=1e-15)
    assert np.allclose(curve.scaled(2, np.array([1, 2, 3])).sample(t), 2 * arc.sample(9) + [1, 2, 3], atol=1e-14)


def test_page_paths_are_connected_exactly():
    a, b, c = np.array([0.1, 0.7, 0.3]), np.array([1 / 3, 0.2, 0.1]), np.array([0.9, -0.2, 0.4])
    path = page_path([Segment.between(a, b), Segment.between(b, c)], (0.3, 0.1), 1.7)
    assert np.array_equal(path[0, 3], path[1, 0])
    assert path.shape == (2, 4, 2)
    assert np.allclose(path[0, 0], 1.7 * a[:2] + [0.3, 0.1])
