"""What the Delaunay triangulations of plane and sphere have in common."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from functools import cached_property
from typing import Self

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, IntArray, as_count, as_indices, read_only
from stereodel.triangulation.hull_insertion import HullInsertion
from stereodel.triangulation.location import Side, landmarks, lowest_containing, walk
from stereodel.triangulation.topology import boundary_of, canonical, edges_of, lowest_incident, neighbors_of


class Delaunay(ABC):
    """A triangulation that depends on the set of points alone; see the two subclasses."""

    points: FloatArray
    simplices: IntArray
    duplicates: IntArray
    dimension: int
    inconclusive: dict[str, int]

    def __init__(self, points: npt.ArrayLike, *, workers: int | None = None, neighbors: bool = True) -> None:
        if workers is not None:
            as_count(workers, "workers")
        self._eager = bool(neighbors)
        self._set_engine(self._as_points(points))

    @classmethod
    def _from_simplices(cls, points: FloatArray, simplices: npt.ArrayLike) -> Self:
        """The triangulation of `points` whose simplices are known already, as from the dual diagram; not checked."""
        self = cls.__new__(cls)
        self._eager = True
        engine = HullInsertion(points, spatial=True)
        self._set(engine, canonical(np.asarray(simplices)))
        return self

    def _set_engine(self, points: FloatArray) -> None:
        engine = HullInsertion(points, spatial=True)
        engine.run()
        self._set(engine, engine.simplices)

    def _set(self, engine: HullInsertion, simplices: IntArray) -> None:
        """Take the state of an engine; arrays handed out before stay as they are."""
        self._engine = engine
        self.points = read_only(engine.points)
        self.simplices = read_only(simplices)
        self.duplicates = read_only(engine.duplicates)
        self.dimension = engine.dimension
        self.inconclusive = engine.inconclusive
        for name in ("neighbors", "edges", "convex_hull", "circumcenters", "closing", "_open", "_kept"):
            self.__dict__.pop(name, None)
        if self._eager:
            _ = self.neighbors

    @cached_property
    def neighbors(self) -> IntArray:
        """Triangle opposite each corner, (m, 3) int32, -1 where there is none."""
        return read_only(neighbors_of(self.simplices))

    @cached_property
    def edges(self) -> IntArray:
        """Edges (e, 2) int32 with i < j, in lexicographic order."""
        return read_only(edges_of(self.simplices))

    @cached_property
    def convex_hull(self) -> IntArray:
        """Directed edges (h, 2) int32 around the triangles, which lie on the left, in lexicographic order."""
        return read_only(boundary_of(self.simplices, self.neighbors, self._open))

    @cached_property
    def circumcenters(self) -> FloatArray:
        """Centre of each triangle's circle, (m, 2) or (m, 3)."""
        return read_only(self._circumcenters(self.points[self.simplices]))

    @cached_property
    def _open(self) -> BoolArray:
        """Triangles that a query can lie in."""
        return np.ones(len(self.simplices), dtype=np.bool_)

    @cached_property
    def _kept(self) -> npt.NDArray[np.intp]:
        """Points that repeat no earlier one."""
        return np.setdiff1d(np.arange(len(self.points)), self.duplicates[:, 0])

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
        The result equals the triangulation of all points from scratch. Arrays handed out earlier do not change.
        """
        added = self._as_points(points)
        size = len(self.points)
        self._engine.extend(added)
        self._engine.run()
        self._set(self._engine, self._engine.simplices)
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
        The rest is triangulated from scratch. If the kept one of several duplicates goes, the lowest remaining one
        takes its place. Arrays handed out earlier do not change.
        """
        stays = np.ones(len(self.points), dtype=np.bool_)
        stays[as_indices(indices, len(self.points))] = False
        self._set_engine(self.points[stays])
        return np.where(stays, np.cumsum(stays) - 1, -1).astype(np.int32)

    def find_simplex(self, queries: npt.ArrayLike) -> IntArray | int:
        """Triangle that holds each query, exactly.

        Parameters
        ----------
        queries : array_like of shape (..., 2) or (..., 3)
            Points of the plane, or directions.

        Returns
        -------
        int32 array of the leading shape, or int for a single query
            Index into `simplices`; the lowest one on a shared edge or vertex; -1 outside `convex_hull`.

        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors, or another last axis.
        """
        array, flat = self._as_queries(queries)
        found = np.full(len(flat), -1, dtype=np.int32)
        if len(self.simplices) and len(flat):
            found = self._locate(flat)
        return found.reshape(array.shape[:-1]) if array.ndim > 1 else int(found[0])

    def _locate(self, queries: FloatArray) -> IntArray:
        neighbors = np.where(self._open[self.neighbors], self.neighbors, -1).astype(np.int32)
        side = self._side(queries)
        places = self._places(self.points)[self.simplices].mean(axis=1)
        start = landmarks(places, np.flatnonzero(self._open), self._places(queries))
        found = walk(self.simplices, neighbors, side, start)
        lowest = lowest_incident(self.simplices, self._open, len(self.points))
        return lowest_containing(self.simplices, neighbors, lowest, side, found)

    def nearest(self, queries: npt.ArrayLike) -> IntArray | int:
        """Nearest point of each query, exactly.

        Parameters
        ----------
        queries : array_like of shape (..., 2) or (..., 3)
            Points of the plane, or directions.

        Returns
        -------
        int32 array of the leading shape, or int for a single query
            Index of the nearest point; the lowest one if several are equally near.

        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors, another last axis, or a triangulation without
            points.

        Notes
        -----
        All distances are compared, n for each query: the squares in doubles, near ties in integers.
        """
        if len(self.points) == 0:
            raise ValueError("nearest needs at least one point; this triangulation has none")
        array, flat = self._as_queries(queries)
        found = self._kept[self._nearest(self.points[self._kept], flat)].astype(np.int32)
        return found.reshape(array.shape[:-1]) if array.ndim > 1 else int(found[0])

    def _as_queries(self, queries: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        array = self._check_queries(queries)
        return array, array.reshape(-1, array.shape[-1])

    def __copy__(self) -> Self:
        """A deep copy: the copies' engines must not share points."""
        return copy.deepcopy(self)

    def __len__(self) -> int:
        return len(self.simplices)

    def __repr__(self) -> str:
        return (
            f"{type(self).__name__}({len(self.points)} points, {len(self.simplices)} simplices, "
            f"{len(self.duplicates)} duplicates, dimension {self.dimension})"
        )

    @staticmethod
    @abstractmethod
    def _as_points(points: npt.ArrayLike) -> FloatArray: ...

    @staticmethod
    @abstractmethod
    def _check_queries(queries: npt.ArrayLike) -> FloatArray: ...

    @staticmethod
    @abstractmethod
    def _places(points: FloatArray) -> FloatArray:
        """Where points lie, for a rough comparison of distances."""

    @staticmethod
    @abstractmethod
    def _circumcenters(triangles: FloatArray) -> FloatArray: ...

    @staticmethod
    @abstractmethod
    def _nearest(points: FloatArray, queries: FloatArray) -> IntArray: ...

    @abstractmethod
    def _side(self, queries: FloatArray) -> Side: ...
