"""Combinatorial checks for `check_delaunay`: integers only, no coordinates, no code of the engines."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, LongArray


class InvalidTriangulation(ValueError):  # noqa: N818 - the name says what is wrong, like SciPy's LinAlgError family
    """The error of `check_delaunay`; the message names the simplex, edge or point."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """A manifold of counterclockwise triangles.

    Half-edge 3t + k is the directed edge of triangle t opposite its corner k.

    simplices: (m, 3).
    origin, target, apex: (3m,), ends of each half-edge and the corner of its triangle opposite to it.
    twin: (3m,), the same edge in the other direction, -1 on the boundary.
    """

    simplices: LongArray
    origin: LongArray
    target: LongArray
    apex: LongArray
    twin: LongArray

    @property
    def inner(self) -> LongArray:
        """One half-edge of every edge between two triangles."""
        half_edges = np.arange(len(self.twin))
        return half_edges[self.twin > half_edges]

    @property
    def boundary(self) -> LongArray:
        """Half-edges without a twin."""
        return np.flatnonzero(self.twin < 0)

    def edge(self, half_edge: int) -> str:
        """The edge as a message shows it."""
        return f"({self.origin[half_edge]}, {self.target[half_edge]})"


def as_simplices(simplices: npt.ArrayLike, size: int) -> LongArray:
    """Check that `simplices` is an (m, 3) array of three different point numbers each."""
    array = np.asarray(simplices)
    if array.shape in ((0,), (0, 3)):
        return np.zeros((0, 3), dtype=np.int64)
    if array.shape[1:] != (3,):
        raise InvalidTriangulation(f"simplices must have shape (m, 3), got {array.shape}")
    if array.dtype.kind not in "iu":
        raise InvalidTriangulation(f"simplices must hold integers, not {array.dtype}")
    array = array.astype(np.int64)
    outside = np.asarray(((array < 0) | (array >= size)).any(axis=1))
    _refuse(outside, lambda t: f"simplex {t} = {array[t].tolist()} names a point outside 0 to {size - 1}")
    repeated = np.asarray((array == np.roll(array, 1, axis=1)).any(axis=1))
    _refuse(repeated, lambda t: f"simplex {t} = {array[t].tolist()} names a point twice")
    return array


def build_mesh(simplices: LongArray, size: int) -> Mesh:
    """Join the half-edges in pairs of opposite direction, or say which edge cannot be joined."""
    origin, target = np.roll(simplices, -1, axis=1).ravel(), np.roll(simplices, -2, axis=1).ravel()
    key = np.minimum(origin, target) * size + np.maximum(origin, target)
    order = np.argsort(key, kind="stable")
    same = key[order[1:]] == key[order[:-1]]
    first, second = order[:-1][same], order[1:][same]
    twin = np.full(len(key), -1)
    twin[first], twin[second] = second, first
    mesh = Mesh(simplices, origin, target, simplices.ravel(), twin)
    crowded = same[1:] & same[:-1]
    _refuse(crowded, lambda i: f"edge {mesh.edge(int(order[i]))} belongs to more than two simplices")
    parallel = origin[first] == origin[second]
    _refuse(
        parallel,
        lambda i: (
            f"edge {mesh.edge(int(first[i]))} has the same direction in simplices "
            f"{first[i] // 3} and {second[i] // 3}: they are turned opposite ways"
        ),
    )
    return mesh


def check_manifold(mesh: Mesh, kept: LongArray, euler: int) -> None:
    """One connected surface around single vertex fans, using exactly the points `kept`, V - E + F = `euler`."""
    used = np.unique(mesh.simplices)
    missing, extra = (np.setdiff1d(*pair, assume_unique=True) for pair in ((kept, used), (used, kept)))
    if len(missing):
        raise InvalidTriangulation(f"point {missing[0]} is used by no simplex ({len(missing)} such points)")
    if len(extra):
        raise InvalidTriangulation(f"point {extra[0]} is used by a simplex although it repeats an earlier point")
    _check_fans(mesh)
    triangles = np.arange(len(mesh.twin)) // 3
    inner = mesh.inner
    # All hang together where the first triangle is the smallest of every one's component.
    if _labels(len(mesh.simplices), triangles[inner], triangles[mesh.twin[inner]]).any():
        raise InvalidTriangulation("the simplices are not connected: they form several surfaces")
    edges = len(inner) + len(mesh.boundary)
    found = len(kept) - edges + len(mesh.simplices)
    if found != euler:
        raise InvalidTriangulation(f"V - E + F is {found} for the simplices, not {euler}: the surface has handles")


def check_neighbors(mesh: Mesh, neighbors: npt.ArrayLike) -> None:
    """`neighbors[t, k]` is the simplex across the edge opposite corner k, -1 for none."""
    array = np.asarray(neighbors)
    expected = np.where(mesh.twin < 0, -1, mesh.twin // 3).reshape(-1, 3)
    if array.shape != expected.shape:
        raise InvalidTriangulation(f"neighbors must have shape {expected.shape}, got {array.shape}")
    wrong = (array != expected).any(axis=1)
    _refuse(wrong, lambda t: f"neighbors[{t}] is {array[t].tolist()}, but the edges say {expected[t].tolist()}")


def link_of(mesh: Mesh, vertex: int) -> LongArray:
    """Directed edges (k, 2) opposite `vertex` in its triangles, in cyclic order."""
    around = np.flatnonzero(mesh.apex == vertex)
    following = dict(zip(mesh.origin[around].tolist(), mesh.target[around].tolist(), strict=True))
    edges, here = [], int(mesh.origin[around[0]])
    for _ in range(len(around)):
        edges.append((here, following[here]))
        here = following[here]
    return np.array(edges)


def _check_fans(mesh: Mesh) -> None:
    """The triangles around each vertex form one cycle or, on the boundary, one path.

    Corners are joined across edges: the corner at the origin of a half-edge with the corner at the target of its twin.
    """
    inner = np.flatnonzero(mesh.twin >= 0)
    # Half-edge k of a triangle starts at its corner k + 1 and ends at its corner k + 2.
    twin = mesh.twin[inner]
    corner, other = inner - inner % 3 + (inner + 1) % 3, twin - twin % 3 + (twin + 2) % 3
    labels = _labels(len(mesh.twin), corner, other)
    first = labels == np.arange(len(labels))
    vertices, fans = np.unique(mesh.apex[first], return_counts=True)
    _refuse(fans > 1, lambda i: f"the simplices around point {vertices[i]} form {fans[i]} separate fans")


def _labels(size: int, a: LongArray, b: LongArray) -> LongArray:
    """The smallest node of the component that each node is in, in the graph of the edges between `a` and `b`."""
    kind: npt.DTypeLike = np.int32 if size < 2**31 else np.int64  # half the memory is half the time
    labels = np.arange(size, dtype=kind)
    a, b = a.astype(kind), b.astype(kind)
    # The ends of an edge are labels of themselves. The larger one is hooked to the smallest across from it; then all
    # labels follow the hooks to their ends, and edges within one component fall out. A label that is still its own
    # after two rounds has at least one other hooked to it, so the rounds are as many as the number of nodes has bits.
    while len(a):
        low, high = np.minimum(a, b), np.maximum(a, b)
        np.minimum.at(labels, high, low)
        while not np.array_equal(further := labels[labels], labels):
            labels = further
        a, b = labels[low], labels[high]
        apart = a != b
        a, b = a[apart], b[apart]
    return labels


def _refuse(wrong: BoolArray, message: Callable[[int], str]) -> None:
    """Raise with the message for the first wrong row, if there is one."""
    if wrong.any():
        raise InvalidTriangulation(message(int(np.argmax(wrong))))
