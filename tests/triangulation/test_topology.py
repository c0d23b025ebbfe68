"""Surfaces of triangles as integers."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from stereodel.triangulation.topology import (
    Surface,
    boundary_of,
    canonical,
    edges_of,
    neighbors_of,
)

TETRAHEDRON = [(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]
FAN = np.array([[4, 0, 1], [4, 1, 2], [4, 2, 3]])


def test_a_surface_knows_the_other_side_of_each_edge():
    surface = Surface()
    for facet in TETRAHEDRON:
        surface.add(*facet)
    assert len(surface) == 4
    assert surface.apex[0, 1] == 2
    assert surface.apex[1, 0] == 3
    assert surface.facets().tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
    surface.remove(3, 2, 1)
    assert surface.facets().tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 1]]


def test_ghosts_come_first():
    surface = Surface()
    surface.add(5, 2, -1)
    assert surface.facets().tolist() == [[-1, 5, 2]]
    assert Surface().facets().shape == (0, 3)


@given(st.permutations(TETRAHEDRON), st.lists(st.integers(0, 2), min_size=4, max_size=4))
def test_canonical_rows(facets, turns):
    turned = np.array([np.roll(facet, k) for facet, k in zip(facets, turns, strict=True)])
    assert canonical(turned).tolist() == [list(f) for f in TETRAHEDRON]
    assert canonical(np.zeros((0, 3), dtype=int)).shape == (0, 3)


def test_neighbors_are_opposite_their_corner():
    assert neighbors_of(FAN).tolist() == [[-1, 1, -1], [-1, 2, 0], [-1, -1, 1]]
    across = neighbors_of(np.array(TETRAHEDRON))
    for t, facet in enumerate(TETRAHEDRON):
        for k, corner in enumerate(facet):
            other = TETRAHEDRON[across[t, k]]
            assert set(facet) - {corner} == set(facet) & set(other)
            assert t in across[across[t, k]]


def test_two_sides_of_one_triangle():
    assert neighbors_of(np.array([[0, 1, 2], [0, 2, 1]])).tolist() == [[1, 1, 1], [0, 0, 0]]


def test_edges_and_boundary():
    assert edges_of(FAN).tolist() == [[0, 1], [0, 4], [1, 2], [1, 4], [2, 3], [2, 4], [3, 4]]
    everything = np.ones(3, dtype=bool)
    assert boundary_of(FAN, neighbors_of(FAN), everything).tolist() == [[0, 1], [1, 2], [2, 3], [3, 4], [4, 0]]
    part = np.array([True, False, False])
    assert boundary_of(FAN, neighbors_of(FAN), part).tolist() == [[0, 1], [1, 4], [4, 0]]


def test_nothing():
    none = np.zeros((0, 3), dtype=np.int32)
    assert neighbors_of(none).shape == (0, 3)
    assert edges_of(none).shape == (0, 2)
    assert boundary_of(none, none, np.zeros(0, dtype=bool)).shape == (0, 2)
