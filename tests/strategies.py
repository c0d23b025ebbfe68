"""What properties of sphere and maps are tried on."""

import numpy as np
from hypothesis import strategies as st

from stereodel.conformal import MoebiusMap
from stereodel.sphere import Rotation

SEEDS = st.integers(0, 10**9)
LONLAT = st.tuples(st.floats(-180, 180), st.floats(-90, 90))
BETWEEN_POLES = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
"""Where north and south are told to some digits."""
DIRECTIONS = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.abs(v).max() > 1e-3)
GRID_DIRECTIONS = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)
"""Many of them equal, opposite and on common circles."""
ROTATIONS = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 1e-3).map(Rotation)


def decades(low, high):
    return st.floats(low, high).map(lambda k: 10.0**k)


def maps(sizes):
    return st.builds(MoebiusMap, ROTATIONS, sizes, ROTATIONS)
