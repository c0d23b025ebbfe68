import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation as Oracle

from stereodel.sphere import Rotation, angular_distance
from tests.exact import mp, rotate

COMPONENT = st.floats(-1, 1).filter(lambda v: v == 0 or abs(v) > 1e-30)
VECTORS = st.tuples(*[COMPONENT] * 3).filter(any)
QUATERNIONS = st.tuples(*[COMPONENT] * 4).filter(any)


@given(QUATERNIONS, VECTORS)
def test_exact_up_to_one_rounding(quaternion, vector):
    length = float(np.linalg.norm(vector))
    got = Rotation(quaternion)(vector)
    for a, b in zip(got, rotate(quaternion, mp(vector)), strict=True):
        assert abs(mpmath.mpf(float(a)) - b) <= 2.0**-53 * abs(b) + 2.0**-98 * length


@given(QUATERNIONS, QUATERNIONS, VECTORS)
def test_composition(p, q, vector):
    a, b = Rotation(p), Rotation(q)
    assert np.abs((a @ b)(vector) - a(b(vector))).max() < 4e-15


@given(QUATERNIONS)
def test_inverse_is_exact_and_matrices_come_back(quaternion):
    turn = Rotation(quaternion)
    assert np.abs(Rotation.from_matrix(turn.matrix).matrix - turn.matrix).max() < 1e-15
    assert turn.inverse().inverse() == turn
    assert (turn.inverse().matrix == turn.matrix.T).all()
    assert Rotation.identity() @ turn == turn


@given(QUATERNIONS, st.integers(-300, 300))
def test_only_the_direction_of_the_quaternion_counts(quaternion, exponent):
    turn, other = Rotation(quaternion), Rotation(-np.array(quaternion) * 2.0**exponent)
    assert turn == other
    assert hash(turn) == hash(other)
    assert turn != Rotation(np.array(quaternion) + np.array([0, 0, 1.5, 3.25]))


@given(VECTORS, VECTORS)
def test_between_takes_one_to_the_other(a, b):
    turn = Rotation.between(a, b)
    assert angular_distance(turn(a), b) < 1e-13
    # The axis is normal to both: the rotation is the shortest.
    assert abs(np.dot(turn.quaternion[1:], a)) / np.linalg.norm(a) < 1e-15
    assert turn.quaternion[0] >= 0


@pytest.mark.parametrize("gap", [0.0, 1e-300, 1e-20, 1e-12, 1e-8])
def test_between_nearly_equal_and_nearly_opposite(gap):
    for b in ([1.0, gap, 0.0], [-1.0, gap, 0.0]):
        assert np.abs(Rotation.between([1.0, 0.0, 0.0], b)([1.0, 0.0, 0.0]) - b).max() <= 2.0**-52


def test_quarter_turns_are_exact():
    assert Rotation.about((0, 90), 90)([[1, 0, 0], [0, 1, 0]]).tolist() == [[0, 1, 0], [-1, 0, 0]]
    assert Rotation.about((0, 0, 1), 180)([1, 2, 3]).tolist() == [-1, -2, 3]
    assert Rotation.about((90, 0), -90)([0, 0, 1]).tolist() == [-1, 0, 0]


@given(VECTORS, st.floats(-720, 720))
def test_about_agrees_with_scipy(axis, angle):
    axis = np.array(axis) / np.linalg.norm(axis)
    oracle = Oracle.from_rotvec(np.radians(angle) * axis).as_matrix()
    assert np.abs(Rotation.about(axis, angle).matrix - oracle).max() < 1e-14


def test_vectors_of_any_length_and_many_of_them():
    turn = Rotation.about((0, 90), 90)
    assert turn([1e300, 0, 0]).tolist() == [0, 1e300, 0]
    assert turn([0, 5e-324, 0]).tolist() == [-5e-324, 0, 0]
    assert turn(np.zeros((2, 0, 3))).shape == (2, 0, 3)
    points = np.random.default_rng(3).normal(size=(5000, 3))
    assert (turn(points) == np.array([turn(p) for p in points[:10]] + list(turn(points[10:])))).all()


def test_matrices_with_subnormal_entries_are_taken_without_a_warning():
    matrix = np.eye(3)
    matrix[0, 1], matrix[1, 0] = 2.2e-309, -2.2e-309
    assert Rotation.from_matrix(matrix)([0.0, 0.0, 1.0]).tolist() == [0.0, 0.0, 1.0]
    with pytest.raises(ValueError, match="matrix"):
        Rotation.from_matrix(-matrix)
