"""Triangulated surfaces as integers: nothing here depends on coordinates."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import AnyIndices, BoolArray, IntArray, LongArray

Facet = tuple[int, int, int]
Edge = tuple[int, int]


def as_rows(rows: list[Facet] | list[Edge], width: int) -> IntArray:
    """Tuples of indices as an int32 array (k, width), also for none."""
    return np.array(rows, dtype=np.int32).reshape(-1, width)


def neighbors_of(simplices: AnyIndices) -> IntArray:
    """Triangle opposite each corner, (m, 3), -1 where there is none."""
    # Edge number 3t + k is opposite corner k of triangle t. Both sides of an edge have the same packed ends and are
    # next to each other when sorted: each is the other's neighbour.
    both = _packed(_directed_edges(simplices))
    order = np.argsort(both, kind="stable")
    shared = both[order[1:]] == both[order[:-1]]
    one, other = order[:-1][shared], order[1:][shared]
    result = np.full(3 * len(simplices), -1, dtype=np.int32)
    result[one], result[other] = other // 3, one // 3
    return result.reshape(-1, 3)


def edges_of(simplices: AnyIndices) -> IntArray:
    """Edges (e, 2) with i < j, in lexicographic order."""
    return _unpacked(_packed(_directed_edges(simplices)))


def as_edges(one: AnyIndices, other: AnyIndices) -> IntArray:
    """Pairs of vertices as edges (e, 2), each once, with i < j, in lexicographic order."""
    return _unpacked(_packed(np.stack([one, other], axis=-1)))


def _unpacked(edges: LongArray) -> IntArray:
    both = np.sort(edges)
    once = both[np.concatenate([[True], both[1:] != both[:-1]])] if len(both) else both
    return np.column_stack([once >> 32, once & 0xFFFFFFFF]).astype(np.int32)


def adjacency_of(edges: AnyIndices, size: int) -> tuple[IntArray, IntArray]:
    """Neighbours of each of `size` vertices in a graph of edges, each given once: offsets (size + 1,), neighbours.

    Those of vertex k are ``indices[indptr[k]:indptr[k + 1]]`` of the two, in order.
    """
    ends = edges.astype(np.int64)
    directed = np.sort(np.concatenate([ends[:, 0] << 32 | ends[:, 1], ends[:, 1] << 32 | ends[:, 0]]))
    indptr = np.zeros(size + 1, dtype=np.int32)
    np.cumsum(np.bincount(directed >> 32, minlength=size), out=indptr[1:])
    return indptr, (directed & 0xFFFFFFFF).astype(np.int32)


def boundary_of(simplices: AnyIndices, neighbors: AnyIndices, inside: BoolArray) -> IntArray:
    """Directed edges (h, 2) of the triangles `inside` that border others or nothing, in lexicographic order."""
    bordering = inside[:, None] & ((neighbors < 0) | ~inside[neighbors])
    edges = _directed_edges(simplices)[bordering.ravel()]
    return np.ascontiguousarray(edges[np.lexsort(edges.T[::-1])], dtype=np.int32)


def _directed_edges(simplices: AnyIndices) -> AnyIndices:
    """Edge opposite each corner, (3m, 2), in counterclockwise direction."""
    return np.stack([np.roll(simplices, -1, axis=1), np.roll(simplices, -2, axis=1)], axis=-1).reshape(-1, 2)


def _packed(edges: AnyIndices) -> LongArray:
    """One number for both ends of each edge (e, 2), which is sorted a hundred times as fast as rows."""
    one, other = edges.T.astype(np.int64)
    return np.minimum(one, other) << 32 | np.maximum(one, other)
