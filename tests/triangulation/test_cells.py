"""Combinatorics of diagrams: integers only."""

import numpy as np
import pytest

from stereodel.triangulation.cells import (
    Cycles,
    canonical_names,
    circle_half_ridges,
    from_ridges,
    half_ridges,
    polygons,
    regions,
    ridges,
    spread_triples,
    twins,
)
from stereodel.triangulation.polygon_diagonals import triangulate_polygons

SQUARE = np.array([[0, 1, 2], [0, 2, 3]])
OTHER = np.array([[3, 0, 1], [1, 2, 3]])
TETRAHEDRON = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])


def square(simplices):
    twin = twins(simplices)
    return half_ridges(simplices, twin, twin >= 0)[0]


def test_twins_are_mutual_and_opposite():
    twin = twins(TETRAHEDRON)
    assert (twin[twin] == np.arange(12)).all()
    assert twins(np.array([[0, 1, 2]])).tolist() == [-1, -1, -1]


def test_two_triangles_that_share_all_edges():
    both = np.array([[0, 1, 2], [0, 2, 1]])
    half, labels = half_ridges(both, twins(both), np.zeros(6, dtype=bool))
    assert labels.tolist() == [0, 1]
    assert polygons(half).as_lists() == [[0, 1, 2], [0, 2, 1]]
    assert sorted(map(sorted, regions(half, 3).as_lists())) == [[0, 1]] * 3


@pytest.mark.parametrize("simplices", [SQUARE, OTHER])
def test_a_square_is_one_vertex_whatever_its_diagonal(simplices):
    half = square(simplices)
    assert polygons(half).as_lists() == [[0, 1, 2, 3]]
    assert regions(half, 5).as_lists() == [[-1, 0]] * 4 + [[]]
    points, vertices = ridges(half)
    assert points.tolist() == [[0, 1], [0, 3], [1, 2], [2, 3]]
    # The ridge between 0 and 1 comes in from below, that between 0 and 3 leaves to the left: site 0 is on the left.
    assert vertices.tolist() == [[-1, 0], [0, -1], [-1, 0], [-1, 0]]


def test_ridges_lead_back_to_half_ridges():
    half, _ = half_ridges(TETRAHEDRON, twins(TETRAHEDRON), np.zeros(12, dtype=bool))
    back = from_ridges(*ridges(half))
    assert polygons(back).as_lists() == polygons(half).as_lists()
    assert regions(back, 4).as_lists() == regions(half, 4).as_lists()
    assert (back.twin[back.twin] == np.arange(12)).all()


def test_canonical_names_order_by_the_three_lowest_sites():
    half, labels = half_ridges(TETRAHEDRON[[3, 1, 0, 2]], twins(TETRAHEDRON[[3, 1, 0, 2]]), np.zeros(12, dtype=bool))
    assert canonical_names(polygons(half))[labels].tolist() == [3, 2, 0, 1]


def test_both_sides_of_a_circle():
    half = circle_half_ridges(np.array([0, 2, 1, 3]))
    names = canonical_names(polygons(half))
    assert names.tolist() == [1, 0]  # around vertex 0 of the half-ridges 0, 1, 2 are clockwise
    assert polygons(half.relabelled(names)).as_lists() == [[0, 3, 1, 2], [0, 2, 1, 3]]
    assert regions(half, 4).as_lists() == [[0, 1]] * 4


def test_spread_triples():
    cycles = Cycles(np.array([0, 5, 6, 7, 8, 9, 1, 2, 3]), np.array([0, 6, 9]))
    assert spread_triples(cycles).tolist() == [[0, 6, 8], [1, 2, 3]]


def test_diagonals_by_rank():
    pentagon = Cycles(np.array([0, 1, 2, 3, 4]), np.array([0, 5]))
    rank = np.array([3, 0, 4, 1, 2])
    fan = triangulate_polygons(pentagon, rank, np.array([True]))
    assert fan.tolist() == [[0, 1, 4], [1, 2, 3], [1, 3, 4]]
    ears = triangulate_polygons(pentagon, rank, np.array([False]))
    assert ears.tolist() == [[0, 1, 2], [0, 2, 4], [2, 3, 4]]
