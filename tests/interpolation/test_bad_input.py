"""What interpolation refuses: the message names the argument, its value and what to write instead."""

import numpy as np
import pytest

from stereodel.interpolation import LinearInterpolator, SmoothInterpolator, contours, griddata
from tests.interpolation.known import KINDS

THREE, VALUES = [[0, 0], [1, 0], [0, 1]], [1.0, 2.0, 3.0]
LINEAR = LinearInterpolator(THREE, VALUES)
WEIGHTS = LINEAR.weights([0, 0])


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([1.0, 2.0], r"values must have shape \(3, \.\.\.\), one entry for each point, got \(2,\)"),
        (5.0, r"values must have shape \(3, \.\.\.\)"),
        ([1.0, np.inf, 2.0], r"values\[1\] is inf; every value must be finite, or NaN where it is not known"),
        ([1.0, "a", 2.0], "values must hold real numbers"),
        (np.zeros((24, 3)), r"shape \(3, \.\.\.\).*got \(24, 3\)"),
    ],
)
@pytest.mark.parametrize("kind", KINDS)
def test_values_that_are_none(kind, values, message):
    with pytest.raises((ValueError, TypeError), match=message):
        KINDS[kind](THREE, values)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: LinearInterpolator(THREE, VALUES, extrapolate="linear"),
            "extrapolate is .linear., but must be",
        ),
        (lambda: LINEAR([1, 2, 3]), r"queries must have shape \(\.\.\., 2\), got \(3,\)"),
        (lambda: LinearInterpolator(np.eye(3), VALUES)([0, 0, 0]), "queries is the zero vector"),
        (
            lambda: SmoothInterpolator(THREE, VALUES, gradients=np.zeros((3, 3))),
            r"gradients must have shape \(3, 2\), a vector for each value, got \(3, 3\)",
        ),
        (lambda: WEIGHTS @ np.zeros((24, 3)), r"got \(24, 3\)"),
        (
            lambda: WEIGHTS.apply(np.zeros((3, 24)), axis=-1),
            r"shape \(\.\.\., 3\), one entry for each point, got \(3, 24\)",
        ),
        (lambda: WEIGHTS.apply(np.zeros(3), axis=7), "3 along axis 7"),
        (
            lambda: contours(THREE, np.zeros((3, 2)), 0.0),
            r"values must be one number for each point, got shape \(3, 2\)",
        ),
        (lambda: contours(THREE, VALUES, [0.0, np.nan]), r"levels\[1\] is nan"),
        (lambda: contours(THREE, VALUES, [[0.0]]), r"levels must be a number or a list of numbers, got shape \(1, 1"),
        (lambda: griddata(THREE, VALUES, THREE, method="best"), "method is 'best', but must be one of 'nearest'"),
    ],
)
def test_bad_input(call, message):
    with pytest.raises(ValueError, match=message):
        call()
