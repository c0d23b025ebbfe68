"""How answers of SciPy's classes are compared with ours: rows come in another order, cycles begin elsewhere."""

import numpy as np
import scipy.spatial
from hypothesis import strategies as st

SMALL_SETS = st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), max_size=14)


def random_points(n=200, seed=0, size=1.0, offset=0.0):
    return np.random.default_rng(seed).random((n, 2)) * size + offset


def as_sets(rows):
    return {frozenset(row) for row in np.asarray(rows).tolist()}


def cycle(region):
    """The same cycle from its lowest member on, in the direction of its lower neighbor."""
    start = region.index(min(region))
    turned = region[start:] + region[:start]
    return tuple(min(turned, turned[:1] + turned[:0:-1]))


def vertex_numbers(theirs, ours):
    """Our number of each of their Voronoi vertices; their -1 stays."""
    distance, match = scipy.spatial.cKDTree(ours.vertices).query(theirs.vertices)
    assert distance.max() < 1e-7 * np.abs(theirs.vertices).max()
    assert len(np.unique(match)) == len(ours.vertices) == len(theirs.vertices)
    return [*match.tolist(), -1]
