"""Loops as triangles: what they cover, holes in the right shell, the owner of each triangle."""

import numpy as np
import pytest

from stereodel.curves.clip import signed_areas
from stereodel.curves.fill import triangles
from stereodel.curves.ragged import Ragged


def square(x, y, side, clockwise=False):
    loop = np.array([(x, y), (x + side, y), (x + side, y + side), (x, y + side), (x, y)], dtype=float)
    return loop[::-1] if clockwise else loop


def areas(corners):
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return np.abs(ax * by - ay * bx) / 2


def test_holes_belong_to_the_smallest_shell_of_their_region():
    loops = Ragged.of(
        [
            square(0, 0, 10),
            square(1, 1, 8, clockwise=True),
            square(2, 2, 6),
            square(3, 3, 1, clockwise=True),
            square(20, 0, 2),
            square(2.5, 2.5, 5),
        ]
    )
    owner = np.array([0, 0, 0, 0, 0, 1])
    corners, owners = triangles(loops, owner)
    covered = np.bincount(owners, areas(corners))
    assert covered == pytest.approx([100 - 64 + 36 - 1 + 4, 25])
    assert covered == pytest.approx(np.bincount(owner, signed_areas(loops)[0]))
    middles = corners[owners == 0].mean(axis=1)
    in_gap = ((middles > 1) & (middles < 9)).all(axis=1) & ~((middles > 2) & (middles < 8)).all(axis=1)
    assert not in_gap.any()


def test_nothing_has_no_triangles():
    corners, owners = triangles(Ragged(np.zeros((0, 2)), np.zeros(1, dtype=np.intp)), np.zeros(0, dtype=np.intp))
    assert corners.shape == (0, 3, 2)
    assert owners.shape == (0,)
