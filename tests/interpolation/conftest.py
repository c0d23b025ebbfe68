"""What the tests of the interpolators share: points, known functions, differences."""

import numpy as np
import pytest


def plane_points(rng, n):
    return rng.random((n, 2))


def sphere_points(rng, n):
    return rng.normal(size=(n, 3))


def differences(function, queries, step):
    """Central differences along the axes, on the sphere of the function of directions: (..., d)."""
    sides = [(queries + step * e, queries - step * e) for e in np.eye(queries.shape[-1])]
    return np.stack([(function(ahead) - function(behind)) / (2 * step) for ahead, behind in sides], axis=-1)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.fixture(params=[plane_points, sphere_points], ids=["plane", "sphere"])
def make_points(request):
    return request.param


@pytest.fixture
def slopes():
    return differences


def smooth_function(x):
    """A function of the plane, or of directions through their unit vectors."""
    if x.shape[-1] == 3:
        x = x / np.linalg.norm(x, axis=-1, keepdims=True)
        return np.exp(x[..., 0]) * np.sin(2 * x[..., 1]) + x[..., 2] ** 2
    return np.exp(x[..., 0]) * np.sin(3 * x[..., 1])


@pytest.fixture
def known():
    return smooth_function
