"""Charts: the circle that bounds what is seen is that of the lens's inverse, however large or small it is."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import fisheye
from stereodel.curves.chart import Chart
from stereodel.drawing import StereographicView, View
from stereodel.sphere import SphereCircle
from tests.strategies import LONLAT


@given(LONLAT, LONLAT, st.floats(-9, 9), st.floats(-7, 2.2) | st.just(None))
def test_the_circle_of_what_is_seen(focus, toward, power, size):
    """Its normal and radius are those that twice the precision gives, to a few roundings of the radius."""
    lens = fisheye(focus, magnification=10.0**power)
    view = View(*toward) if size is None else StereographicView(*toward, angular_radius=10.0**size)
    exact = lens.inverse().image_of(SphereCircle.around(view.matrix[2], view.angular_radius))
    found = Chart(lens, view).source
    assert found.radius == pytest.approx(np.radians(exact.angular_radius), rel=1e-9)
    # As far as the double precision of the view's direction lets it be known, which the lens magnifies.
    assert np.linalg.norm(found.normal - exact.normal) < 1e-14 * max(1.0, 10.0 ** abs(power))
    assert np.hypot(found.cosine, found.sine) == pytest.approx(1, abs=1e-12)
