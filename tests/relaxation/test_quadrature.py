"""The rules on triangles, and cells cut into them."""

from math import factorial

import numpy as np
import pytest

from stereodel.relaxation.quadrature import MIDPOINTS, RADON, flat_nodes


@pytest.mark.parametrize(("rule", "degree"), [(MIDPOINTS, 2), (RADON, 5)])
def test_degree_of_rules(rule, degree):
    """∫ xⁱyʲ over the triangle (0, 0), (1, 0), (0, 1) is i! j!/(i + j + 2)!."""

    def error(i, j):
        nodes, weights = flat_nodes(np.array([[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]), rule)
        exact = factorial(i) * factorial(j) / factorial(i + j + 2)
        return (weights * nodes[..., 0] ** i * nodes[..., 1] ** j).sum() / exact - 1

    assert max(abs(error(i, k - i)) for k in range(degree + 1) for i in range(k + 1)) < 1e-14
    assert max(abs(error(i, degree + 1 - i)) for i in range(degree + 2)) > 1e-4
