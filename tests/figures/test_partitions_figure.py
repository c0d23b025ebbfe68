"""The picture of the partitions: what its two rounds find is what all airports have together."""

import numpy as np
import pytest

from stereodel.triangulation import SphericalDelaunay
from tests.figures.scripts import geometry, script


@pytest.fixture(scope="module")
def g():
    return geometry("earth_partitions")


def turned(triangles):
    """Triangles with their lowest corner first, in order."""
    first = np.argmin(triangles, axis=1)[:, None]
    rows = np.take_along_axis(triangles, (np.arange(3) + first) % 3, axis=1)
    return np.unique(rows, axis=0).tolist()


def test_triangles_are_those_of_all_airports_about_its_own(g):
    whole = SphericalDelaunay(g["points"]).simplices
    assert turned(g["triangles"]) == turned(whole[np.isin(whole, g["own"]).any(axis=1)])


def test_every_bubble_drawn_meets_a_box_and_every_box_a_bubble(g):
    """By points of the boxes' parts of the sphere, close together: a bubble that the boxes' balls let by has none."""
    meet = script("earth_partitions")["meet"](g["planes"], g["boxes"])
    assert meet.any(axis=1).all()
    assert meet.any(axis=0).all()
    inside = g["points"][g["new"]] @ g["planes"][:, :3].T >= g["planes"][:, 3]
    assert 0 < inside.any(axis=0).sum() < len(g["planes"])  # that a box is met does not say that a point is
