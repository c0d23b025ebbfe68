"""The common part of the Delaunay triangulations of plane and sphere."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Final, Self, TypeVar

import numpy as np
import numpy.typing as npt

from stereodel._arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    as_count,
    as_indices,
    as_points,
    as_workers,
    locked,
    private,
)
from stereodel._calls import by_name
from stereodel._docs import shared
from stereodel._threads import thread_count
from stereodel.constants import REBUILD_INSERTING, REBUILD_REMOVING
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.lonlat import BY_NAME, LONLAT, as_asked
from stereodel.triangulation.topology import adjacency_of, boundary_of, edges_of, neighbors_of
from stereodel.triangulation.versions import Versioned, kept

if TYPE_CHECKING:
    from stereodel._kernel.space import Mesh, Space

_T = TypeVar("_T")

FAMILY: Final = {
    "options": """
        workers : int, optional
            Threads; -1 for all processors. By default all of them from 20 000 points on. Does not affect the result.
        neighbors : bool, optional
            Whether to compute `neighbors` at once, which costs little; otherwise on first use.
        """,
    "edges": """
        edges : (e, 2) array of int32
            Edges with i < j, in lexicographic order.
        vertex_neighbor_vertices : tuple of two int32 arrays, (n + 1,) and (2e,)
            ``indptr, indices``: edges join point k to ``indices[indptr[k]:indptr[k + 1]]``, in order; a dropped
            duplicate to none.
        """,
    "changes": """
        Arrays are read-only; `insert` and `remove` replace them. Several threads may query at the same time. While one
        of them changes the triangulation, queries and changes by the others raise a RuntimeError; copies (`copy.copy`)
        share the arrays and are independent.
        """,
}
"""What the docstrings of both triangulations have in common."""


class Delaunay(Versioned, ABC):
    """A triangulation that depends only on the set of points; see the two subclasses.

    After `insert` and `remove` the kernel's mesh is what is up to date, and arrays are made from it when asked for. It
    goes from version to version; one that has lost it starts from its points.
    """

    _space: ClassVar[Space]

    _latitude: Latitude | None = None
    _workers: int | None
    _eager: bool  # whether neighbors are wanted with the simplices

    # Of a version, beside what is kept:
    _chunks: tuple[FloatArray, ...]  # the points, in pieces until asked for
    _size: int  # number of points
    _mesh: Mesh  # if it has one
    _changes: int  # of the mesh, up to this version
    _counts: dict[str, int]  # inconclusive tests before the mesh was made

    def __init__(self, points: npt.ArrayLike, *, workers: int | None = None, neighbors: bool = True) -> None:
        self._workers = as_workers(workers)
        self._eager = bool(neighbors)
        self._hold(self._fresh(private(self._as_points(points, f"{type(self).__name__}.from_lonlat"), points)))

    @classmethod
    def _from_simplices(cls, points: FloatArray, simplices: IntArray, duplicates: IntArray) -> Self:
        """The triangulation of `points` whose simplices are known already, as from the dual diagram; not checked."""
        self = cls.__new__(cls)
        self._workers, self._eager = None, True
        version = self._new_version((points,))
        version.__dict__["_built"] = simplices, None, duplicates, 2, dict.fromkeys(self._space.stages, 0)
        self._hold(version)
        return self

    def _new_version(self, chunks: tuple[FloatArray, ...]) -> Self:
        version = type(self).__new__(type(self))
        version._workers, version._eager = self._workers, self._eager
        version._chunks, version._size = chunks, sum(map(len, chunks))
        return version

    def _fresh(self, points: FloatArray) -> Self:
        """A version that starts from its points."""
        version = self._new_version((points,))
        _ = version._built
        return version

    def _changed(self, change: Callable[[Mesh], _T], chunks: tuple[FloatArray, ...]) -> tuple[Self, _T]:
        """The version after a change of this one's mesh, and what the change returns.

        The mesh is lost to this version, whether the change succeeds or not.
        """
        version = self._new_version(chunks)
        tests = self._tests  # before the mesh goes on, which knows what earlier changes cost
        mesh = self.__dict__.pop("_mesh", None)  # in one step: a copy that shares this version cannot have it, too
        version._counts = tests if mesh is None else self._counts
        version._mesh = mesh or self._space.Mesh(*self._triangles(), self.duplicates, True)
        result = change(version._mesh)
        version._changes = version._mesh.changes
        version.__dict__["dimension"] = 2
        return version, result

    @kept
    def _built(self) -> tuple[IntArray, IntArray | None, IntArray, int, dict[str, int]]:
        """Simplices, neighbors or None, duplicates, dimension and inconclusive tests, from the points alone."""
        return self._space.triangulate(self.points, thread_count(self._workers, self._size), self._eager)

    def _from_mesh(self, read: Callable[[Mesh], _T]) -> _T | None:
        """What the mesh says of this version, None if there is none."""
        mesh = self.__dict__.get("_mesh")
        if mesh is None:
            return None
        try:
            value = read(mesh)
        except RuntimeError:
            if "_mesh" in self.__dict__:
                raise
            return None
        return value if mesh.changes == self._changes else None  # None: it has gone on meanwhile

    @kept
    def _rows(self) -> tuple[IntArray, IntArray | None]:
        """Simplices, and neighbors if known: of one origin, as the order of rows depends on it."""
        simplices, neighbors = self._from_mesh(lambda mesh: mesh.arrays()) or self._built[:2]
        return locked(simplices), None if neighbors is None else locked(neighbors)

    @kept
    def dimension(self) -> int:
        """Dimension of the point set: -1 without points, 0, 1, or 2 when there are triangles."""
        return self._built[3]

    @kept
    def points(self) -> FloatArray:
        """The points, in the order given, inserted ones at the end."""
        return self._chunks[0] if len(self._chunks) == 1 else locked(np.concatenate(self._chunks))

    @kept
    def simplices(self) -> IntArray:
        """Triangles (m, 3) int32, counterclockwise, smallest index first."""
        return self._rows[0]

    @kept
    def neighbors(self) -> IntArray:
        """Triangle opposite each corner, (m, 3) int32, -1 where there is none."""
        simplices, neighbors = self._rows
        return locked(neighbors_of(simplices)) if neighbors is None else neighbors

    @kept
    def duplicates(self) -> IntArray:
        """Pairs [dropped, kept] of equal points, (k, 2) int32."""
        pairs = self._from_mesh(lambda mesh: mesh.duplicates)
        return locked(self._built[2] if pairs is None else pairs)

    @property
    def inconclusive(self) -> dict[str, int]:
        """Number of tests that each stage left open, in construction and changes."""
        return dict(self._present()._tests)

    @kept
    def _tests(self) -> dict[str, int]:
        changes = self._from_mesh(lambda mesh: mesh.inconclusive)
        if changes is None:
            return self._built[4]
        return {stage: count + changes.get(stage, 0) for stage, count in self._counts.items()}

    @kept
    def edges(self) -> IntArray:
        """Edges (e, 2) int32 with i < j, in lexicographic order."""
        return locked(edges_of(self.simplices))

    @kept
    def vertex_neighbor_vertices(self) -> tuple[IntArray, IntArray]:
        """Neighbours of each point: ``indices[indptr[k]:indptr[k + 1]]`` of the tuple (indptr, indices)."""
        indptr, indices = adjacency_of(self.edges, self._size)
        return locked(indptr), locked(indices)

    @kept
    def convex_hull(self) -> IntArray:
        """Directed edges (h, 2) int32 around the triangles, which lie on the left, in lexicographic order."""
        return locked(boundary_of(self.simplices, self.neighbors, self._open))

    @kept
    def circumcenters(self) -> FloatArray:
        """Centre of each triangle's circle, (m, 2) or (m, 3)."""
        return locked(self._space.circumcenters(self.points, self.simplices, None, self._thread_count(), True))

    @kept
    def _open(self) -> BoolArray:
        """Triangles that a query can lie in."""
        return locked(np.ones(len(self.simplices), dtype=np.bool_))

    @kept
    def _flat_order(self) -> IntArray:
        """The distinct points in the order along their line or great circle, without triangles."""
        return locked(self._space.flat_order(self.points, checked=True))

    @property
    def latitude(self) -> Latitude | None:
        """The kind of latitude by which the points were given, None if they were not given by one."""
        return self._latitude

    def insert(self, points: npt.ArrayLike | None = None, *, lonlat: npt.ArrayLike | None = None) -> IntArray:
        """Add points.

        Parameters
        ----------
        points : array_like of shape (k, 2) or (k, 3)
            As for the constructor.
        lonlat : array_like of shape (k, 2), optional
            In place of `points`: (longitude, latitude) in degrees, with the same kind of latitude as the other points.

        Returns
        -------
        (k,) int32 array
            Indices of the new points, which follow the old ones.

        Raises
        ------
        ValueError, TypeError
            As in the constructor; then nothing is added.

        Notes
        -----
        The triangles equal those of a triangulation of all points; the order of their rows may differ. Arrays handed
        out earlier do not change.
        """
        pairs = None if lonlat is None else as_points(lonlat, 2, "lonlat")
        given = as_asked(points, pairs, self._latitude, "points")
        added = private(self._as_points(given, "insert(lonlat=…)"), given)
        with self._change():
            before = self._latest()
            if before.dimension < 2 or REBUILD_INSERTING * len(added) > before._size:
                self._put(before._fresh(locked(np.concatenate([before.points, added]))))
            else:
                version, _ = before._changed(lambda mesh: mesh.insert(added), (*before._chunks, added))
                self._put(version)
        return np.arange(before._size, before._size + len(added), dtype=np.int32)

    def remove(self, indices: npt.ArrayLike) -> IntArray:
        """Remove points; the others keep their order and are renumbered.

        Parameters
        ----------
        indices : array_like of int
            Points to remove; repetitions count once.

        Returns
        -------
        (n,) int32 array
            New index of each old point, -1 for those removed.

        Raises
        ------
        ValueError, TypeError
            For indices out of range or not integer; then nothing is removed.

        Notes
        -----
        The triangles equal those of a triangulation of the rest; the order of their rows may differ. If the kept one of
        several duplicates is removed, the lowest remaining one takes its place. Arrays handed out earlier do not
        change.
        """
        with self._change():
            before = self._latest()
            points = before.points
            gone = as_indices(indices, len(points))
            if not len(gone):
                return np.arange(len(points), dtype=np.int32)
            stays = np.ones(len(points), dtype=np.bool_)
            stays[gone] = False
            left = np.flatnonzero(stays)
            rest = locked(points.take(left, axis=0))  # four times as fast as points[stays]
            if before.dimension < 2 or REBUILD_REMOVING * (len(points) - len(left)) > len(left):
                self._put(before._fresh(rest))
                return np.where(stays, np.cumsum(stays, dtype=np.int32) - np.int32(1), np.int32(-1))
            version, number = before._changed(lambda mesh: mesh.remove(gone.astype(np.int32)), (rest,))
            self._put(before._fresh(rest) if version._mesh.is_flat else version)
        return number

    @by_name(BY_NAME)
    @shared(**LONLAT)
    def find_simplex(
        self,
        queries: npt.ArrayLike | None = None,
        *,
        lonlat: npt.ArrayLike | None = None,
        workers: int | None = None,
    ) -> IntArray | int:
        """Triangle that contains each query, exactly.

        Parameters
        ----------
        queries : array_like of shape (..., 2) or (..., 3)
            Points of the plane, or directions.
        {asked}
        workers : int, optional
            Threads; -1 for all processors. By default those of the constructor, for many queries.

        Returns
        -------
        int32 array of the leading shape, or int for a single query
            Index into `simplices`; the lowest one on a shared edge or vertex; -1 outside `convex_hull`.

        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors, or another last axis; for `lonlat` where the
            points were not given by longitude and latitude.
        """
        now = self._present()
        array, flat, threads = now._as_queries(as_asked(queries, lonlat, self._latitude), workers)
        return _shaped(now._space.find_simplex(*now._triangles(), flat, now._closed(), threads, True), array)

    @by_name(BY_NAME)
    @shared(**LONLAT)
    def nearest(
        self,
        queries: npt.ArrayLike | None = None,
        *,
        lonlat: npt.ArrayLike | None = None,
        k: int | None = None,
        workers: int | None = None,
    ) -> IntArray | int:
        """Nearest point of each query, or the k nearest, exactly.

        Parameters
        ----------
        queries : array_like of shape (..., 2) or (..., 3)
            Points of the plane, or directions.
        {asked}
        k : int, optional
            Number of points, 1 to the number of all points; by default only the nearest, without an axis of its
            own.
        workers : int, optional
            Threads; -1 for all processors. By default those of the constructor, for many queries.

        Returns
        -------
        int32 array of the leading shape, or int for a single query; (..., k) with `k`
            Index of the nearest point, the lowest one if several are equally near. With `k` the nearest points in the
            order of their distances (angles on the sphere), equally near ones in the order of their indices; duplicates
            count like all other points.

        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors, another last axis, a triangulation without
            points, or `k` below 1 or above the number of points; for `lonlat` where the points were not given by
            longitude and latitude.

        Notes
        -----
        A walk through the triangulation, then outward along its edges: after the nearest ones, the next nearest point
        is always a neighbour of one that was found before. Source: M. Dickerson, R. Drysdale, J.-R. Sack, "Simple
        algorithms for enumerating interpoint distances and finding k nearest neighbors" (1992). Points without
        triangles (`dimension` below 2) are sorted along their line or great circle on the first query. Distances
        follow from the points found: `np.linalg.norm(points[found] - queries[..., None, :], axis=-1)`,
        `angular_distance` on the sphere.

        Examples
        --------
        >>> from stereodel import PlanarDelaunay
        >>> square = PlanarDelaunay([[0, 0], [2, 0], [2, 2], [0, 2], [2, 2]])
        >>> square.nearest([1.5, 1.0])
        1
        >>> square.nearest([[1.5, 1.0], [0.1, 1.9]], k=4).tolist()
        [[1, 2, 4, 0], [3, 0, 2, 4]]
        """
        now = self._present()
        if now._size == 0:
            raise ValueError("nearest needs at least one point; this triangulation has none")
        array, flat, threads = now._as_queries(as_asked(queries, lonlat, self._latitude), workers)
        count = 1 if k is None else as_count(k, "k", high=now._size)
        if now.dimension < 2:
            found = now._space.nearest_flat(now.points, now._flat_order, now.duplicates, flat, count, threads, True)
        elif k is None:
            found = now._space.nearest(*now._triangles(), flat, now._closed(), threads, True)
        else:
            found = now._space.k_nearest(*now._triangles(), now.duplicates, flat, count, now._closed(), threads, True)
        return _shaped(found.ravel(), array) if k is None else found.reshape(*array.shape[:-1], count)

    def _triangles(self) -> tuple[FloatArray, IntArray, IntArray]:
        return self.points, self.simplices, self.neighbors

    def _closed(self) -> BoolArray | None:
        """Triangles that no query can lie in, None if there is none."""
        return None

    def _as_queries(self, queries: npt.ArrayLike, workers: int | None) -> tuple[FloatArray, FloatArray, int]:
        array = self._check_queries(queries)
        flat = array.reshape(-1, array.shape[-1])
        return array, flat, self._thread_count(workers, len(flat))

    def _thread_count(self, workers: int | None = None, size: int | None = None) -> int:
        """How many threads a task of `size` points takes, by default of all points."""
        chosen = self._workers if workers is None else workers
        return thread_count(chosen, self._present()._size if size is None else size)

    def __getstate__(self) -> dict[str, Any]:
        """Only arrays; a copy makes its own mesh when it is changed."""
        now = self._present()
        own = {name: value for name, value in self.__dict__.items() if name not in {"_turn", "_version"}}
        return own | {"_arrays": (now.points, (*now._rows, now.duplicates, now.dimension, now._tests))}

    def __setstate__(self, state: dict[str, Any]) -> None:
        points, built = state["_arrays"]
        for array in (points, *built):
            if isinstance(array, np.ndarray):
                array.flags.writeable = False  # unpickled arrays are not
        self.__dict__.update((name, value) for name, value in state.items() if name != "_arrays")
        version = self._new_version((points,))
        version.__dict__["_built"] = built
        self._hold(version)

    def __len__(self) -> int:
        return len(self.simplices)

    def __repr__(self) -> str:
        now = self._present()
        return (
            f"{type(self).__name__}({now._size} points, {len(now.simplices)} simplices, "
            f"{len(now.duplicates)} duplicates, dimension {now.dimension})"
        )

    @staticmethod
    @abstractmethod
    def _as_points(points: npt.ArrayLike, lonlat_door: str) -> FloatArray:
        """Checked points; the message about those of the other space names the door for longitude and latitude."""

    @staticmethod
    @abstractmethod
    def _check_queries(queries: npt.ArrayLike) -> FloatArray:
        """Checked queries of any leading shape."""


def _shaped(found: IntArray, queries: FloatArray) -> IntArray | int:
    """One number for each query, in the queries' leading shape."""
    return found.reshape(queries.shape[:-1]) if queries.ndim > 1 else int(found[0])
