"""Plain vectors, many at once."""

import numpy as np
import pytest

from stereodel.sphere.vectors import crossed


@pytest.mark.parametrize("shape", [(3,), (0, 3), (7, 3), (2, 5, 3)])
def test_cross_products_are_those_of_numpy(shape):
    """To the last bit, one against many too."""
    a, b = np.random.default_rng(1).normal(size=(2, *shape))
    np.testing.assert_array_equal(crossed(a, b), np.cross(a, b))
    np.testing.assert_array_equal(crossed(np.array([1.0, -2.0, 0.5]), b), np.cross([1.0, -2.0, 0.5], b))
