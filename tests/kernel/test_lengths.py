"""The kernel's comparison of lengths and diametral circles against exact numbers."""

import numpy as np
import pytest

from stereodel import _kernel_probe as probe
from tests import sets
from tests.graphs.definitions import Exact
from tests.spaces import BOTH, SPHERE, space_of


def prove(points, numbers=None, seed=0, rows=300):
    """Rows of random numbers, some of them twice in a row. The signs of the diametral circles."""
    if numbers is None:
        numbers = np.random.default_rng(seed).integers(0, len(points), size=(rows, 4)).astype(np.int32)
    kernel, exact = space_of(points).kernel, Exact(points)
    if numbers.shape[1] == 4:
        wanted = [exact.compare_lengths(*row) for row in numbers.tolist()]
        assert kernel.compare_lengths(points, numbers).tolist() == wanted
    found = kernel.diametral(points, np.ascontiguousarray(numbers[:, :3])).tolist()
    assert found == [exact.diametral(*row[:3]) for row in numbers.tolist()]
    return found


@BOTH
@pytest.mark.parametrize("spread", [1.0, 1e-4, 1e-8, 1e-12, 1e-15])
def test_clusters(rng, space, spread):
    points = space.cluster(rng, spread, 40)
    prove(points)
    if space is SPHERE:
        points = sets.unit(points)
        assert probe.all_unit(points)
        prove(points)
        prove(points * (1 + 0.6 * 2.0**-49 * rng.choice([-1, 1], size=(40, 1))))


@BOTH
def test_ties(space):
    points = space.lattice(np.random.default_rng(3), 3, 60)
    for changed in (points, points * 0.1, points * 2.0**-200, *([sets.unit(points)] if space is SPHERE else [])):
        prove(changed)


@BOTH
@pytest.mark.parametrize("exponent", [-1074, -540, -500, 300, 500])
def test_extreme_coordinates(space, exponent):
    prove(np.ldexp(space.lattice(np.random.default_rng(4), 9, 40), exponent))


def test_nearly_right_angles(rng):
    """Third points on the diametral circle, rounded."""
    circle = sets.on_circle(rng, 60)
    points = np.concatenate([circle, -circle])
    numbers = np.column_stack([np.arange(60), np.arange(60, 120), rng.permutation(60)]).astype(np.int32)
    assert len(set(prove(points, numbers))) > 1
    assert len(set(prove(sets.unit(np.column_stack([points * 1e-3, np.ones(120)])), numbers))) > 1


def test_opposite_directions_have_every_point_on_their_circle():
    points = np.array([[1.0, 2, 3], [-2, -4, -6], [0, 1, 5], [7, 0, 0]])
    assert prove(points, np.array([[0, 1, 2], [0, 1, 3]], dtype=np.int32)) == [0, 0]


@pytest.mark.parametrize("size", [1e-14, 1e-16, 1e-40, 1e-200])
def test_beside_an_axis(size):
    """Directions far closer than 1e-16, many of them mirror images: chords in doubles tell nothing."""
    steps = size * (sets.grid(5, 5) - 2)
    prove(np.column_stack([steps, np.ones(25)]))
    prove(np.column_stack([steps, np.full(25, 3.0)]), seed=1)
