"""Voronoi diagrams as combinatorics: which sites surround a vertex, which vertices surround a site. Integers only.

A ridge between the cells of sites i and j is two half-ridges, i→j and j→i. Each belongs to the Voronoi vertex on the
left of the directed Delaunay edge. The half-ridges of one vertex form a cycle, the polygon of its sites, those out of
one site another, the polygon of its vertices; both are read off the same table in O(n).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, IntArray

Indices = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Cycles:
    """Cycles of different lengths, one after the other.

    Attributes
    ----------
    members : (k,) array of int
    offsets : (c + 1,) array of int
        Cycle i is ``members[offsets[i]:offsets[i + 1]]``.
    """

    members: Indices
    offsets: Indices

    def as_lists(self) -> list[list[int]]:
        """The cycles as lists."""
        members = self.members.tolist()
        return [members[a:b] for a, b in zip(self.offsets[:-1].tolist(), self.offsets[1:].tolist(), strict=True)]


@dataclass(frozen=True, eq=False)
class HalfRidges:
    """Half-ridges of a diagram.

    Attributes
    ----------
    origin, target : (h,) arrays of int
        Sites on both sides.
    vertex : (h,) array of int
        Voronoi vertex on the left of the edge from origin to target, -1 at infinity.
    twin : (h,) array of int
        The half-ridge of the same ridge in the other direction.
    """

    origin: Indices
    target: Indices
    vertex: Indices
    twin: Indices

    @cached_property
    def following(self) -> Indices:
        """Next half-ridge around the same vertex, counterclockwise: the one out of this one's target."""
        size = int(max(self.origin.max(initial=0), self.target.max(initial=0))) + 1
        keys = self.vertex * size + self.origin
        order = np.argsort(keys)
        return order[np.searchsorted(keys[order], self.vertex * size + self.target)]

    def relabelled(self, names: Indices) -> HalfRidges:
        """The same half-ridges with vertex v called names[v]; infinity stays -1."""
        vertex = np.where(self.vertex < 0, -1, names[self.vertex])
        return HalfRidges(self.origin, self.target, vertex, self.twin)


def twins(simplices: IntArray) -> Indices:
    """Half-edge 3u + l opposite to half-edge 3t + k (the one opposite corner k of triangle t), -1 on the boundary.

    Found by the directed edges, which are unique: two triangles can share all three edges (three points on the sphere).
    """
    origin, target = (np.roll(simplices, -k, axis=1).ravel().astype(np.intp) for k in (1, 2))
    size = int(simplices.max(initial=0)) + 1
    keys = origin * size + target
    order = np.argsort(keys)
    place = np.searchsorted(keys[order], target * size + origin)
    candidate = order[np.minimum(place, len(order) - 1)]
    return np.where(keys[candidate] == target * size + origin, candidate, -1)


def half_ridges(simplices: IntArray, twin: Indices, tied: BoolArray) -> tuple[HalfRidges, Indices]:
    """Half-ridges of the dual of a triangulation, and each triangle's vertex, numbered in no particular order.

    Parameters
    ----------
    simplices : (m, 3) array of int
    twin : (3m,) array of int
        From `twins`.
    tied : (3m,) array of bool
        Whether the triangles on both sides of a half-edge share one vertex.
    """
    labels = _merged(len(simplices), np.flatnonzero(tied) // 3, twin[tied] // 3)
    kept = np.flatnonzero(~tied)
    rim = kept[twin[kept] < 0]
    number = np.empty(len(tied), dtype=np.intp)
    number[kept] = np.arange(len(kept))
    partner = number[twin[kept]]
    partner[twin[kept] < 0] = len(kept) + np.arange(len(rim))
    origin, target = (np.roll(simplices, -k, axis=1).ravel().astype(np.intp) for k in (1, 2))
    half = HalfRidges(
        np.concatenate([origin[kept], target[rim]]),
        np.concatenate([target[kept], origin[rim]]),
        np.concatenate([labels[kept // 3], np.full(len(rim), -1)]),
        np.concatenate([partner, number[rim]]),
    )
    return half, labels


def _merged(size: int, a: Indices, b: Indices) -> Indices:
    """Numbers of the groups of triangles that the pairs (a, b) join."""
    if len(a) == 0:
        return np.arange(size)
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(a), dtype=np.int8), (a, b)), shape=(size, size))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.intp)


def circle_half_ridges(order: Indices) -> HalfRidges:
    """Half-ridges of sites on one circle, in counterclockwise order around vertex 0; vertex 1 is its antipode."""
    after = np.roll(order, -1)
    n = len(order)
    number = np.arange(n)
    return HalfRidges(
        np.concatenate([order, after]),
        np.concatenate([after, order]),
        np.repeat([0, 1], n),
        np.concatenate([number + n, number]),
    )


def polygons(half: HalfRidges) -> Cycles:
    """Sites around each vertex, counterclockwise from the lowest one; infinity is left out."""
    inner = np.flatnonzero(half.vertex >= 0)
    order = inner[np.lexsort((half.origin[inner], half.vertex[inner]))]
    cycles = _cycles(half.following, order[_firsts(half.vertex[order])])
    return Cycles(half.origin[cycles.members], cycles.offsets)


def regions(half: HalfRidges, size: int) -> Cycles:
    """Vertices around each of `size` sites, counterclockwise from the lowest one (-1 if the cell is unbounded).

    After the half-ridge h out of a site comes the reverse of the one that leads to the site around h's vertex.
    """
    leading = np.empty(len(half.origin), dtype=np.intp)
    leading[half.following] = np.arange(len(half.origin))
    order = np.lexsort((half.vertex, half.origin))
    cycles = _cycles(half.twin[leading], order[_firsts(half.origin[order])])
    offsets = np.zeros(size + 1, dtype=np.intp)
    np.cumsum(np.bincount(half.origin, minlength=size), out=offsets[1:])
    return Cycles(half.vertex[cycles.members], offsets)


def ridges(half: HalfRidges) -> tuple[IntArray, IntArray]:
    """Pairs of sites i < j in lexicographic order, and the vertices of each ridge, with i on the left of the ridge."""
    forward = np.flatnonzero(half.origin < half.target)
    start, end = half.vertex[half.twin[forward]], half.vertex[forward]
    order = np.lexsort((start, half.target[forward], half.origin[forward]))
    points = np.column_stack([half.origin[forward], half.target[forward]])[order]
    return points.astype(np.int32), np.column_stack([start, end])[order].astype(np.int32)


def from_ridges(ridge_points: IntArray, ridge_vertices: IntArray) -> HalfRidges:
    """The inverse of `ridges`."""
    (i, j), (start, end) = ridge_points.T.astype(np.intp), ridge_vertices.T.astype(np.intp)
    k = np.arange(len(i))
    return HalfRidges(
        np.concatenate([i, j]), np.concatenate([j, i]), np.concatenate([end, start]), np.concatenate([k + len(i), k])
    )


def canonical_names(cycles: Cycles) -> Indices:
    """A number for each vertex that depends on its polygon alone: by the three lowest sites, then by their turn.

    Three sites fix a circle; both sides of it are vertices only if all sites lie on it, and then the one around which
    the three lowest sites are counterclockwise comes first.
    """
    lengths = np.diff(cycles.offsets)
    label = np.repeat(np.arange(len(lengths)), lengths)
    place = np.arange(len(cycles.members)) - cycles.offsets[label]
    order = np.lexsort((cycles.members, label))
    first = cycles.offsets[:-1]
    lowest = [order[np.minimum(first + k, first + lengths - 1)] for k in range(3)]
    clockwise = place[lowest[1]] > place[lowest[2]]
    a, b, c = (cycles.members[k] for k in lowest)
    names = np.empty(len(lengths), dtype=np.intp)
    names[np.lexsort((clockwise, c, b, a))] = np.arange(len(lengths))
    return names


def spread_triples(cycles: Cycles) -> Indices:
    """Three sites of each polygon, (v, 3), counterclockwise and a third of the way apart: its circle, well conditioned.

    They depend on the polygon alone, not on the diagonals that some tie rule drew in it.
    """
    lengths, first = np.diff(cycles.offsets), cycles.offsets[:-1]
    return np.column_stack([cycles.members[first + k * lengths // 3] for k in range(3)])


class Diagram:
    """What planar and spherical Voronoi diagrams share: cells, ridges and vertices as arrays that cannot be changed.

    Attributes
    ----------
    points : (n, d) array
        The sites as given.
    vertices : (v, d) array
        Circumcentres, numbered by the three lowest sites of each.
    ridge_points : (r, 2) array of int32
        Sites i < j on both sides of each ridge, in lexicographic order.
    ridge_vertices : (r, 2) array of int32
        Start and end of each ridge, with site i on its left; -1 at infinity.
    region_indices, region_offsets : (k,) and (n + 1,) arrays of int
        The cell of site i has the vertices ``region_indices[region_offsets[i]:region_offsets[i + 1]]``.
    point_region : (n,) array of int32
        The region of each point: its own number, for a duplicate that of the kept point.
    simplex_vertex : (m,) array of int32
        The vertex of each Delaunay triangle; exactly cocircular neighbours share one.
    """

    points: FloatArray
    vertices: FloatArray
    ridge_points: IntArray
    ridge_vertices: IntArray
    region_indices: IntArray
    region_offsets: Indices
    point_region: IntArray
    simplex_vertex: IntArray

    @property
    def regions(self) -> list[list[int]]:
        """Vertices of each cell, counterclockwise (on the sphere: seen from outside); empty for duplicates."""
        return Cycles(self.region_indices.astype(np.intp), self.region_offsets).as_lists()

    def _set_cells(self, half: HalfRidges) -> None:
        """Ridges and regions from half-ridges whose vertices have their final numbers."""
        self.ridge_points, self.ridge_vertices = ridges(half)
        cells = regions(half, len(self.points))
        self.region_indices, self.region_offsets = cells.members.astype(np.int32), cells.offsets

    def _set_point_region(self, duplicates: IntArray) -> None:
        self.point_region = np.arange(len(self.points), dtype=np.int32)
        self.point_region[duplicates[:, 0]] = duplicates[:, 1]

    def _duplicates(self) -> IntArray:
        """Pairs [dropped, kept] of equal points, (k, 2)."""
        dropped = np.flatnonzero(self.point_region != np.arange(len(self.points)))
        return np.column_stack([dropped, self.point_region[dropped]]).astype(np.int32)

    def _next_in_region(self) -> Indices:
        """For each place in `region_indices` the following place of the same cell, cyclically."""
        following = np.arange(1, len(self.region_indices) + 1)
        filled = np.flatnonzero(np.diff(self.region_offsets))
        following[self.region_offsets[filled + 1] - 1] = self.region_offsets[filled]
        return following

    def _freeze(self) -> None:
        for name, value in vars(self).items():
            if name != "points" and isinstance(value, np.ndarray):
                value.flags.writeable = False

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self.points)} points, {len(self.vertices)} vertices)"


def _firsts(sorted_keys: Indices) -> BoolArray:
    """Whether an entry differs from the one before it."""
    result = np.ones(len(sorted_keys), dtype=np.bool_)
    result[1:] = sorted_keys[1:] != sorted_keys[:-1]
    return result


def _cycles(successor: Indices, starts: Indices) -> Cycles:
    """The cycles of a permutation that hold `starts`, each beginning there; all are walked in step."""
    steps, owners = [], []
    alive, here = np.arange(len(starts)), starts
    while len(alive):
        steps.append(here)
        owners.append(alive)
        here = successor[here]
        onward = here != starts[alive]
        alive, here = alive[onward], here[onward]
    if not steps:
        return Cycles(np.zeros(0, dtype=np.intp), np.zeros(1, dtype=np.intp))
    owner = np.concatenate(owners)
    offsets = np.zeros(len(starts) + 1, dtype=np.intp)
    np.cumsum(np.bincount(owner, minlength=len(starts)), out=offsets[1:])
    return Cycles(np.concatenate(steps)[np.argsort(owner, kind="stable")], offsets)
