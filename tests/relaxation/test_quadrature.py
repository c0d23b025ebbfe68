"""The rules on triangles, and cells cut into them."""

from math import factorial

import numpy as np
import pytest

from stereodel.constants import QUADRATURE_CHORD
from stereodel.relaxation.flat_cells import as_polygon, flat_cells
from stereodel.relaxation.quadrature import MIDPOINTS, RADON, flat_nodes, spherical_nodes, split_long
from stereodel.relaxation.round_cells import RoundCells


@pytest.mark.parametrize(("rule", "degree"), [(MIDPOINTS, 2), (RADON, 5)])
def test_degree_of_rules(rule, degree):
    """∫ xⁱyʲ over the triangle (0, 0), (1, 0), (0, 1) is i! j!/(i + j + 2)!."""

    def error(i, j):
        nodes, weights = flat_nodes(np.array([[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]), rule)
        exact = factorial(i) * factorial(j) / factorial(i + j + 2)
        return (weights * nodes[..., 0] ** i * nodes[..., 1] ** j).sum() / exact - 1

    assert max(abs(error(i, k - i)) for k in range(degree + 1) for i in range(k + 1)) < 1e-14
    assert max(abs(error(i, degree + 1 - i)) for i in range(degree + 2)) > 1e-4


def test_octant_of_the_sphere():
    triangles, number = split_long(np.eye(3)[None], np.array([7]))
    sides = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=-1)
    nodes, weights = spherical_nodes(triangles, RADON)
    assert (number == 7).all()
    assert sides.max() <= QUADRATURE_CHORD
    assert weights.min() > 0
    assert weights.sum() == pytest.approx(np.pi / 2, rel=2e-7)
    assert np.einsum("tk,tkd->d", weights, nodes) == pytest.approx(np.pi / 4, rel=1e-6)


@pytest.mark.parametrize("size", [1, 2, 3, 4, 50])
def test_cells_of_the_sphere(size):
    """Areas and moments from the ridges are those of the triangles."""
    sites = np.random.default_rng(size).normal(size=(size, 3))
    cells = RoundCells(sites / np.linalg.norm(sites, axis=1)[:, None], None)
    triangles, site = cells.triangles()
    nodes, weights = spherical_nodes(triangles, RADON)
    assert np.bincount(site, weights.sum(axis=1)) == pytest.approx(cells.areas(), rel=1e-6)
    first = np.einsum("tk,tkd->td", weights, nodes)
    moments = np.column_stack([np.bincount(site, column) for column in first.T])
    assert moments == pytest.approx(cells.moments(), abs=2e-6)


@pytest.mark.parametrize("size", [1, 2, 3, 40])
def test_cells_of_a_polygon(size):
    """Their areas add up to that of the polygon; all corners lie in it."""
    polygon = as_polygon([(0, 0), (4, 0), (5, 3), (1, 4)])
    points = np.random.default_rng(size).uniform(0.5, 3, size=(size, 2))
    if size == 3:
        points = np.array([[0.5, 0.0], [0.5, 1.0], [0.5, 2.0]])  # on one line, the first one on a side
    triangles, site = flat_cells(points, polygon, None)
    _, weights = flat_nodes(triangles, MIDPOINTS)
    assert weights.sum() == pytest.approx(14.5)
    assert weights.min() >= -1e-12
    corners = triangles + points[site][:, None]
    assert corners.min() >= -1e-12
    assert (corners.max(axis=(0, 1)) <= [5 + 1e-12, 4 + 1e-12]).all()
