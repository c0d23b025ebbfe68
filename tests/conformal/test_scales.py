"""The largest scale of a lens near a place."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from stereodel import fisheye
from stereodel.conformal.distortions import largest_scale
from stereodel.sphere import SphereArc

lonlats = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
sizes = st.floats(-6, 6).map(lambda e: 10.0**e)


@given(focus=lonlats, size=sizes, at=lonlats, radius=st.floats(0, 3), seed=st.integers(0, 100))
def test_no_scale_nearby_is_larger_than_the_bound(focus, size, at, radius, seed):
    lens = fisheye(focus, magnification=size)
    rng = np.random.default_rng(seed)
    center = SphereArc.great(at, (at[0] + 1.0, at[1] * 0.5)).start
    other = rng.normal(size=(200, 3))
    side = other - np.outer(other @ center, center)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    angle = (radius * rng.random(200))[:, None]
    points = np.cos(angle) * center + np.sin(angle) * side
    bound = largest_scale(lens, center[None], np.array([radius]))[0]
    assert lens.scale_factor(points).max() <= bound * (1 + 1e-6)
    assert bound <= max(size, 1 / size) * (1 + 1e-12)
