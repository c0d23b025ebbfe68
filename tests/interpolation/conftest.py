"""What the tests of the interpolators share: random points of both spaces."""

import pytest


@pytest.fixture(params=["plane", "sphere"])
def make_points(request):
    return {"plane": lambda rng, n: rng.random((n, 2)), "sphere": lambda rng, n: rng.normal(size=(n, 3))}[request.param]
