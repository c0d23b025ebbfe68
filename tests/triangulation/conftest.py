"""What the tests of both triangulations share."""

import numpy as np
import pytest

from stereodel.triangulation import check_delaunay


def in_lexicographic_order(triangulation):
    """The arrays that follow the rows of `simplices`, with these in lexicographic order."""
    order = np.lexsort(triangulation.simplices.T[::-1])
    number = np.append(np.argsort(order), -1)  # the last one for no neighbour
    arrays = {
        "simplices": triangulation.simplices[order],
        "neighbors": number[triangulation.neighbors[order]],
        "circumcenters": triangulation.circumcenters[order],
    }
    if hasattr(triangulation, "closing"):
        arrays["closing"] = triangulation.closing[order]
    return arrays


@pytest.fixture(scope="session")
def assert_same():
    """Check that two triangulations are the same but for the order of their rows, and valid."""

    def check(first, second):
        check_delaunay(first)
        for name in ("points", "duplicates", "edges", "convex_hull"):
            assert np.array_equal(getattr(first, name), getattr(second, name)), name
        assert first.dimension == second.dimension
        ones, others = in_lexicographic_order(first), in_lexicographic_order(second)
        for name, array in ones.items():
            assert np.array_equal(array, others[name]), name

    return check
