"""The first filter of the sphere: determinants of rounded projected points stay within their bounds."""

import numpy as np
import pytest
from mpmath import mpf, workdps

from stereodel import _kernel_probe as probe
from tests import sets
from tests.digits import norm, vector

POLE = (0, -1)


def fours(size, seed, near_ties):
    """Quadruples within `size` of each other, all over the sphere, close to the pole and to its antipode."""
    rng = np.random.default_rng(seed)
    centers = sets.unit(rng.normal(size=(60, 3)))
    centers[:10] = sets.unit([-1, 0, 0] + 10.0 ** rng.uniform(-9, -1, (10, 1)) * rng.normal(size=(10, 3)))
    centers[10:20] = sets.unit([1, 0, 0] + 10.0 ** rng.uniform(-9, -1, (10, 1)) * rng.normal(size=(10, 3)))
    across = sets.unit(np.cross(centers, rng.normal(size=(60, 3))))
    third = np.cross(centers, across)
    angle = 2 * np.pi * rng.random((60, 4)) if near_ties else rng.random((60, 4))
    x, y = (np.cos(angle), np.sin(angle)) if near_ties else rng.normal(size=(2, 60, 4))
    offsets = x[..., None] * across[:, None] + y[..., None] * third[:, None]
    return sets.unit((centers[:, None] + size * offsets).reshape(-1, 3)).reshape(60, 4, 3)


def true_image(p):
    x, y, z = p = vector(p)
    return y / (norm(p) + x), z / (norm(p) + x)


def true_values(quad):
    a, b, c, d = (true_image(p) for p in quad)
    turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    rows = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    (ax, ay), (bx, by), (cx, cy) = rows
    aa, bb, cc = (x * x + y * y for x, y in rows)
    return turn, aa * (bx * cy - by * cx) + bb * (cx * ay - cy * ax) + cc * (ax * by - ay * bx)


@pytest.mark.parametrize("near_ties", [False, True])
@pytest.mark.parametrize("length", [1.0, 6371.0])
@pytest.mark.parametrize("size", [1.0, 1e-2, 1e-5, 1e-8, 1e-11, 1e-14])
def test_estimates_keep_their_bounds(size, length, near_ties):
    quads = fours(size, 1, near_ties) * length
    estimates = probe.projected_estimates(quads.reshape(-1, 3), *POLE)
    used = 0.0
    with workdps(60):
        for quad, (turn, turn_bound, circle, bound, wide) in zip(quads.tolist(), estimates.tolist(), strict=True):
            true_turn, true_circle = true_values(quad)
            for value, truth, limit in ((turn, true_turn, turn_bound), (circle, true_circle, min(bound, wide))):
                if not np.isnan(value):
                    assert abs(value - truth) <= limit
                    used = max(used, float(abs(value - truth) / limit)) if limit else used
    assert used > 1e-4  # a bound far above all errors would let everything through to the slow stages


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-6])
def test_what_is_wide_is_decided_without_a_root(size):
    _, _, circle, bound, wide = probe.projected_estimates(fours(size, 2, False).reshape(-1, 3), *POLE)[20:].T
    assert (bound <= wide).all()
    if size > 1e-4:
        assert (np.abs(circle) > wide).mean() > 0.9
    assert (np.abs(circle) > bound).mean() > 0.9


@pytest.mark.parametrize("length", [1.0, 3.0])
def test_projected_points_are_within_eight_roundoffs(length):
    points = np.vstack([fours(s, 3, False).reshape(-1, 3) for s in (1.0, 1e-6, 1e-15)]) * length
    images = probe.projected(points, *POLE)
    with workdps(60):
        for p, image in zip(points.tolist(), images.tolist(), strict=True):
            for value, truth in zip(image, true_image(p), strict=True):
                assert np.isnan(value) or abs(value - truth) <= 8 * mpf(2) ** -53 * abs(truth)


def test_coordinates_out_of_range_decide_nothing():
    points = np.array([[1.0, 1e-30, 0.0], [1.0, 0.0, 0.0], [-1.0, 1e-25, 1e-25], [1.0, 1e-20, -1e-20]])
    images = probe.projected(points, *POLE)
    assert np.isnan(images[0, 0])
    assert images[1].tolist() == [0.0, 0.0]
    assert np.isnan(images[2]).all()
    assert np.isfinite(images[3]).all()
    estimates = probe.projected_estimates(points, *POLE)[0]
    assert not (np.abs(estimates[[0, 2]]) > estimates[[1, 3]]).any()
