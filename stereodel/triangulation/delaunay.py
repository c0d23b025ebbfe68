"""What the Delaunay triangulations of plane and sphere have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, IntArray, as_count, as_indices, as_workers, locked, private
from stereodel._kernel import PlaneMesh, SphereMesh
from stereodel._threads import thread_count
from stereodel.constants import REBUILD_INSERTING, REBUILD_REMOVING
from stereodel.triangulation.topology import boundary_of, edges_of, neighbors_of

Mesh = PlaneMesh | SphereMesh
Built = tuple[IntArray, IntArray | None, IntArray, int, dict[str, int]]
"""What the kernel returns: simplices, neighbors or None, duplicates, dimension, inconclusive tests."""


class Delaunay(ABC):
    """A triangulation that depends on the set of points alone; see the two subclasses.

    After `insert` and `remove` the kernel's mesh is what is up to date; arrays are made from it when asked for.
    """

    dimension: int
    _workers: int | None
    _eager: bool  # whether neighbors are wanted with the simplices
    _chunks: list[FloatArray]  # the points, in pieces until asked for
    _simplices: IntArray | None
    _neighbors: IntArray | None
    _duplicates: IntArray | None
    _mesh: Mesh | None
    _inconclusive: dict[str, int]

    def __init__(self, points: npt.ArrayLike, *, workers: int | None = None, neighbors: bool = True) -> None:
        self._workers = as_workers(workers)
        self._eager = bool(neighbors)
        self._build(private(self._as_points(points), points))

    @classmethod
    def _from_simplices(cls, points: FloatArray, simplices: IntArray, duplicates: IntArray) -> Self:
        """The triangulation of `points` whose simplices are known already, as from the dual diagram; not checked."""
        self = cls.__new__(cls)
        self._workers, self._eager = None, True
        self._take(points, (simplices, None, duplicates, 2, dict.fromkeys(self._stages(), 0)))
        return self

    def _build(self, points: FloatArray) -> None:
        """Triangulate from scratch; arrays handed out before stay as they are."""
        self._take(points, self._triangulate(points, thread_count(self._workers, len(points)), self._eager))

    def _take(self, points: FloatArray, built: Built) -> None:
        self._chunks = [points]
        self._mesh = None
        self._forget()
        simplices, neighbors, duplicates, self.dimension, self._inconclusive = built
        self._simplices, self._duplicates = locked(simplices), locked(duplicates)
        self._neighbors = None if neighbors is None else locked(neighbors)

    def _forget(self) -> None:
        self._simplices = self._neighbors = self._duplicates = None
        for name in ("edges", "convex_hull", "circumcenters", "closing", "_open"):
            self.__dict__.pop(name, None)

    @property
    def points(self) -> FloatArray:
        """The points, in the order given, inserted ones at the end."""
        if len(self._chunks) > 1:
            self._chunks = [locked(np.concatenate(self._chunks))]
        return self._chunks[0]

    @property
    def simplices(self) -> IntArray:
        """Triangles (m, 3) int32, counterclockwise, smallest index first."""
        if self._simplices is None and self._mesh is None:
            self._build(self.points)  # a change was interrupted
        elif self._simplices is None and self._mesh is not None:
            simplices, neighbors = self._mesh.arrays()
            self._simplices, self._neighbors = locked(simplices), locked(neighbors)
        assert self._simplices is not None
        return self._simplices

    @property
    def neighbors(self) -> IntArray:
        """Triangle opposite each corner, (m, 3) int32, -1 where there is none."""
        simplices = self.simplices
        if self._neighbors is None:
            self._neighbors = locked(neighbors_of(simplices))
        return self._neighbors

    @property
    def duplicates(self) -> IntArray:
        """Pairs [dropped, kept] of equal points, (k, 2) int32."""
        if self._duplicates is None and self._mesh is not None:
            self._duplicates = locked(self._mesh.duplicates)
        elif self._duplicates is None:
            self._build(self.points)  # a change was interrupted
        assert self._duplicates is not None
        return self._duplicates

    @property
    def inconclusive(self) -> dict[str, int]:
        """Tests that each stage left open, in construction and changes."""
        changes = self._mesh.inconclusive if self._mesh is not None else {}
        return {stage: count + changes.get(stage, 0) for stage, count in self._inconclusive.items()}

    @cached_property
    def edges(self) -> IntArray:
        """Edges (e, 2) int32 with i < j, in lexicographic order."""
        return locked(edges_of(self.simplices))

    @cached_property
    def convex_hull(self) -> IntArray:
        """Directed edges (h, 2) int32 around the triangles, which lie on the left, in lexicographic order."""
        return locked(boundary_of(self.simplices, self.neighbors, self._open))

    @cached_property
    def circumcenters(self) -> FloatArray:
        """Centre of each triangle's circle, (m, 2) or (m, 3)."""
        return locked(self._circumcenters(self._thread_count()))

    @cached_property
    def _open(self) -> BoolArray:
        """Triangles that a query can lie in."""
        return locked(np.ones(len(self.simplices), dtype=np.bool_))

    def insert(self, points: npt.ArrayLike) -> IntArray:
        """Add points.

        Parameters
        ----------
        points : array_like of shape (k, 2) or (k, 3)
            As for the constructor.

        Returns
        -------
        (k,) int32 array
            Indices of the new points, which follow the old ones.

        Raises
        ------
        ValueError, TypeError
            As the constructor does; nothing is added then.

        Notes
        -----
        The triangles equal those of all points from scratch; the order of their rows may not. Arrays handed out
        earlier do not change.
        """
        added = private(self._as_points(points), points)
        size = sum(map(len, self._chunks))
        if self.dimension < 2 or REBUILD_INSERTING * len(added) > size:
            self._build(locked(np.concatenate([self.points, added])))
        else:
            self._change(lambda mesh: mesh.insert(added))
            self._chunks = [*self._chunks, added]
        return np.arange(size, size + len(added), dtype=np.int32)

    def remove(self, indices: npt.ArrayLike) -> IntArray:
        """Take out points; the others keep their order and are numbered anew.

        Parameters
        ----------
        indices : array_like of int
            Points to take out; repetitions count once.

        Returns
        -------
        (n,) int32 array
            New index of each old point, -1 for those removed.

        Raises
        ------
        ValueError, TypeError
            For indices out of range or not integer; nothing is removed then.

        Notes
        -----
        The triangles equal those of the rest from scratch; the order of their rows may not. If the kept one of several
        duplicates goes, the lowest remaining one takes its place. Arrays handed out earlier do not change.
        """
        points = self.points
        gone = as_indices(indices, len(points))
        stays = np.ones(len(points), dtype=np.bool_)
        stays[gone] = False
        left = np.flatnonzero(stays)
        number = np.full(len(points), -1, dtype=np.int32)
        number[left] = np.arange(len(left), dtype=np.int32)
        rest = locked(points.take(left, axis=0))  # four times as fast as points[stays]
        if self.dimension < 2 or REBUILD_REMOVING * (len(points) - len(left)) > len(left):
            self._build(rest)
        elif len(gone):
            self._change(lambda mesh: mesh.remove(gone.astype(np.int32)))
            self._chunks = [rest]
            if self._mesh is not None and self._mesh.is_flat:
                self._build(rest)
        return number

    def find_simplex(self, queries: npt.ArrayLike, *, workers: int | None = None) -> IntArray | int:
        """Triangle that holds each query, exactly.

        Parameters
        ----------
        queries : array_like of shape (..., 2) or (..., 3)
            Points of the plane, or directions.
        workers : int, optional
            Threads; -1 for all processors. By default those of the constructor, for many queries.

        Returns
        -------
        int32 array of the leading shape, or int for a single query
            Index into `simplices`; the lowest one on a shared edge or vertex; -1 outside `convex_hull`.

        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors, or another last axis.
        """
        array, flat, threads = self._as_queries(queries, workers)
        return _shaped(self._locate(flat, threads), array)

    def nearest(self, queries: npt.ArrayLike, *, k: int | None = None, workers: int | None = None) -> IntArray | int:
        """Nearest point of each query, or the k nearest, exactly.

        Parameters
        ----------
        queries : array_like of shape (..., 2) or (..., 3)
            Points of the plane, or directions.
        k : int, optional
            How many points are wanted, 1 to the number of points; by default the nearest alone, without an axis of its
            own.
        workers : int, optional
            Threads; -1 for all processors. By default those of the constructor, for many queries.

        Returns
        -------
        int32 array of the leading shape, or int for a single query; (..., k) with `k`
            Index of the nearest point, the lowest one if several are equally near. With `k` the nearest points in the
            order of their distances (angles on the sphere), equally near ones in the order of their indices; duplicates
            are points like all others.

        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors, another last axis, a triangulation without
            points, or `k` below 1 or above the number of points.

        Notes
        -----
        A walk through the triangulation, then outward along its edges: after the nearest ones, the next nearest point
        is always a neighbour of one that was found before. Source: M. Dickerson, R. Drysdale, J.-R. Sack, "Simple
        algorithms for enumerating interpoint distances and finding k nearest neighbors" (1992). Without triangles
        (`dimension` below 2) all points are compared. Distances are those of the points of the answer:
        `np.linalg.norm(points[found] - queries[..., None, :], axis=-1)`, `angular_distance` on the sphere.

        Examples
        --------
        >>> from stereodel import PlanarDelaunay
        >>> square = PlanarDelaunay([[0, 0], [2, 0], [2, 2], [0, 2], [2, 2]])
        >>> square.nearest([1.5, 1.0])
        1
        >>> square.nearest([[1.5, 1.0], [0.1, 1.9]], k=4).tolist()
        [[1, 2, 4, 0], [3, 0, 2, 4]]
        """
        size = sum(map(len, self._chunks))
        if size == 0:
            raise ValueError("nearest needs at least one point; this triangulation has none")
        array, flat, threads = self._as_queries(queries, workers)
        if k is None:
            return _shaped(self._nearest(flat, threads), array)
        found = self._k_nearest(flat, as_count(k, "k", high=size), threads)
        return found.reshape(*array.shape[:-1], found.shape[1])

    def _as_queries(self, queries: npt.ArrayLike, workers: int | None) -> tuple[FloatArray, FloatArray, int]:
        array = self._check_queries(queries)
        flat = array.reshape(-1, array.shape[-1])
        return array, flat, self._thread_count(workers, len(flat))

    def _thread_count(self, workers: int | None = None, size: int | None = None) -> int:
        """How many threads a task of `size` points takes, by default of all points."""
        chosen = self._workers if workers is None else workers
        return thread_count(chosen, len(self.points) if size is None else size)

    def _change(self, change: Callable[[Mesh], object]) -> None:
        """Change the mesh; if that fails or is interrupted, the triangulation stays that of before."""
        mesh = self._mesh or self._make_mesh()
        self._mesh = None
        change(mesh)
        self._mesh = mesh
        self._forget()

    def __getstate__(self) -> dict[str, Any]:
        """Arrays alone; a copy makes its own mesh when it is changed."""
        state = self.__dict__ | {"_inconclusive": self.inconclusive}
        state["_chunks"] = [self.points]
        state["_simplices"], state["_neighbors"], state["_duplicates"] = (
            self.simplices,
            self._neighbors,
            self.duplicates,
        )
        state["_mesh"] = None
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        for array in (*state["_chunks"], state["_simplices"], state["_neighbors"], state["_duplicates"]):
            if array is not None:
                array.flags.writeable = False  # unpickled arrays are not
        self.__dict__.update(state)

    def __len__(self) -> int:
        return len(self.simplices)

    def __repr__(self) -> str:
        return (
            f"{type(self).__name__}({sum(map(len, self._chunks))} points, {len(self.simplices)} simplices, "
            f"{len(self.duplicates)} duplicates, dimension {self.dimension})"
        )

    @staticmethod
    @abstractmethod
    def _as_points(points: npt.ArrayLike) -> FloatArray: ...

    @staticmethod
    @abstractmethod
    def _check_queries(queries: npt.ArrayLike) -> FloatArray: ...

    @abstractmethod
    def _circumcenters(self, workers: int) -> FloatArray: ...

    @staticmethod
    @abstractmethod
    def _triangulate(points: FloatArray, workers: int, neighbors: bool) -> Built: ...

    @staticmethod
    @abstractmethod
    def _stages() -> tuple[str, ...]:
        """Keys of `inconclusive`."""

    @abstractmethod
    def _make_mesh(self) -> Mesh: ...

    @abstractmethod
    def _locate(self, queries: FloatArray, workers: int) -> IntArray: ...

    @abstractmethod
    def _nearest(self, queries: FloatArray, workers: int) -> IntArray: ...

    @abstractmethod
    def _k_nearest(self, queries: FloatArray, k: int, workers: int) -> IntArray: ...


def _shaped(found: IntArray, queries: FloatArray) -> IntArray | int:
    """One number for each query, in the queries' leading shape."""
    return found.reshape(queries.shape[:-1]) if queries.ndim > 1 else int(found[0])
