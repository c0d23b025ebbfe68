"""The common part of the Delaunay triangulations of plane and sphere."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Final, Generic, Self, TypeVar, cast

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
from stereodel._docs import by_name, shared
from stereodel._notebook import Displayed
from stereodel._spaces import SPHERE, PlaneOrSphere, surface_of
from stereodel._tasks.threads import thread_count
from stereodel.constants import REBUILD_INSERTING, REBUILD_REMOVING
from stereodel.sphere.coordinates import BY_NAME, LONLAT, as_asked, as_sites, refuse_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.topology import adjacency_of, boundary_of, edges_of, neighbors_of

if TYPE_CHECKING:
    from stereodel._kernel.space import Mesh

_T = TypeVar("_T")

Made = tuple[IntArray, IntArray | None, IntArray, int, dict[str, int]]
"""Simplices, neighbors or None, duplicates, dimension and inconclusive tests, as the kernel gives them."""

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
        surface : object
            The plane or the sphere; its `name` is "plane" or "sphere".
        """,
    "changes": """
        Arrays are read-only; `insert` and `remove` replace them. Several threads may query at the same time. While one
        of them changes the triangulation, queries and changes by the others wait; each answer is that of one state.
        Copies (`copy.copy`) share the arrays and are independent.
        """,
}
"""What the docstrings of both triangulations have in common."""


class _kept(Generic[_T]):  # noqa: N801  # a decorator, like `property`
    """What follows from a state. Of threads that compute it at the same time, the first decides what all have.

    `functools.cached_property` promises the last, and up to Python 3.11 lets other states wait meanwhile.
    """

    def __init__(self, compute: Callable[[_State], _T]) -> None:
        self._compute = compute
        self._name = compute.__name__

    def __get__(self, state: _State, _: type) -> _T:
        # Found in the instance from then on: this has no __set__.
        return cast("_T", state.__dict__.setdefault(self._name, self._compute(state)))


class _State:
    """A triangulation between two changes: arrays that never change, and what follows from these alone."""

    def __init__(self, surface: PlaneOrSphere, workers: int | None, points: FloatArray, made: Made) -> None:
        simplices, neighbors, duplicates, self.dimension, self.inconclusive = made
        self.points, self.simplices, self.duplicates = points, locked(simplices), locked(duplicates)
        self.known_neighbors = None if neighbors is None else locked(neighbors)
        self._surface, self._workers = surface, workers

    @_kept
    def neighbors(self) -> IntArray:
        return locked(neighbors_of(self.simplices)) if self.known_neighbors is None else self.known_neighbors

    @_kept
    def edges(self) -> IntArray:
        return locked(edges_of(self.simplices))

    @_kept
    def vertex_neighbor_vertices(self) -> tuple[IntArray, IntArray]:
        indptr, indices = adjacency_of(self.edges, len(self.points))
        return locked(indptr), locked(indices)

    @_kept
    def convex_hull(self) -> IntArray:
        return locked(boundary_of(self.simplices, self.neighbors, self.open))

    @_kept
    def circumcenters(self) -> FloatArray:
        threads = thread_count(self._workers, len(self.points))
        return locked(self._surface.kernel.circumcenters(self.points, self.simplices, None, threads, True))

    @_kept
    def closing(self) -> BoolArray | None:
        """Whether no query can lie in a triangle, (m,), as the kernel takes it; None in the plane, where any can."""
        return locked(SPHERE.kernel.closing(self.points, self.simplices)) if self._surface is SPHERE else None

    @_kept
    def open(self) -> BoolArray:
        """Whether a query can lie in a triangle, (m,)."""
        return locked(np.ones(len(self.simplices), dtype=np.bool_) if self.closing is None else ~self.closing)

    @_kept
    def flat_order(self) -> IntArray:
        """The distinct points in the order along their line or great circle, without triangles."""
        return locked(self._surface.kernel.flat_order(self.points, checked=True))

    @property
    def triangles(self) -> tuple[FloatArray, IntArray, IntArray]:
        """As the kernel's queries take them."""
        return self.points, self.simplices, self.neighbors


def _of_now(name: str, doc: str) -> Any:
    """A property: what the present state has by that name."""
    return property(lambda triangulation: getattr(triangulation._now(), name), doc=doc)


class Triangulation(Displayed):
    """A triangulation that depends only on the set of points; see the two subclasses.

    The first change makes a mesh of the kernel, from which changes and states come from then on; its lock lets one
    thread at a time change it. A query takes a state once, so it never mixes two, and holds no lock while it works.
    """

    surface: ClassVar[PlaneOrSphere]

    _mimes = "stereodel.drawing.scene.diagrams"
    _latitude: Latitude | None = None
    _workers: int | None
    _eager: bool  # whether neighbors are wanted with the simplices
    _mesh: Mesh | None = None  # from the first change on
    _last: tuple[int, _State]  # the state that was asked for last, and after how many changes of the mesh it is

    def __init_subclass__(cls, *, surface: PlaneOrSphere | None = None) -> None:
        super().__init_subclass__()
        if surface is not None:
            cls.surface, surface.delaunay = surface, cls

    def __init__(self, points: npt.ArrayLike, *, workers: int | None = None, neighbors: bool = True) -> None:
        self._workers = as_workers(workers)
        self._eager = bool(neighbors)
        own = private(self.surface.as_points(points, f"{type(self).__name__}.from_lonlat"), points)
        threads = thread_count(self._workers, len(own))
        self._begin(own, self.surface.kernel.triangulate(own, threads, self._eager))

    @classmethod
    def _from_simplices(cls, points: FloatArray, simplices: IntArray, duplicates: IntArray) -> Self:
        """The triangulation of `points` whose simplices are known already, as from the dual diagram; not checked."""
        self = cls.__new__(cls)
        self._workers, self._eager = None, True
        self._begin(points, (simplices, None, duplicates, 2, dict.fromkeys(self.surface.kernel.stages, 0)))
        return self

    def _begin(self, points: FloatArray, made: Made) -> None:
        self._last = 0, _State(self.surface, self._workers, points, made)

    def _now(self) -> _State:
        """The present state; waits while another thread changes the triangulation."""
        # The order matters: the number of changes is read after `_last`. If it is that of the state, no change had
        # ended since. Whichever of two threads leaves its state, its number tells whether it is out of date.
        mesh = self._mesh
        changes, state = self._last
        if mesh is not None and mesh.changes != changes:
            found = mesh.read(thread_count(self._workers, mesh.size))
            state = _State(self.surface, self._workers, found[1], found[2:])
            self._last = found[0], state
        return state

    def _changing(self) -> Mesh:
        """The mesh to be changed. Of threads that make it at the same time, one sets it for all, in one step."""
        if self._mesh is None:
            state = self._last[1]
            rows = state.simplices, state.neighbors, state.duplicates
            made = self.surface.kernel.Mesh(state.points, *rows, state.inconclusive, checked=True)
            self.__dict__.setdefault("_mesh", made)
        return cast("Mesh", self._mesh)

    dimension: int = _of_now(
        "dimension", "Dimension of the point set: -1 without points, 0, 1, or 2 when there are triangles."
    )
    points: FloatArray = _of_now("points", "The points, in the order given, inserted ones at the end.")
    simplices: IntArray = _of_now("simplices", "Triangles (m, 3) int32, counterclockwise, smallest index first.")
    neighbors: IntArray = _of_now("neighbors", "Triangle opposite each corner, (m, 3) int32, -1 where there is none.")
    duplicates: IntArray = _of_now("duplicates", "Pairs [dropped, kept] of equal points, (k, 2) int32.")
    edges: IntArray = _of_now("edges", "Edges (e, 2) int32 with i < j, in lexicographic order.")
    vertex_neighbor_vertices: tuple[IntArray, IntArray] = _of_now(
        "vertex_neighbor_vertices",
        "Neighbours of each point: ``indices[indptr[k]:indptr[k + 1]]`` of the tuple (indptr, indices).",
    )
    convex_hull: IntArray = _of_now(
        "convex_hull",
        "Directed edges (h, 2) int32 around the triangles, which lie on the left, in lexicographic order.",
    )
    circumcenters: FloatArray = _of_now("circumcenters", "Centre of each triangle's circle, (m, 2) or (m, 3).")

    @property
    def inconclusive(self) -> dict[str, int]:
        """Number of tests that each stage left open, in construction and changes."""
        return dict(self._now().inconclusive)

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
        added = private(self.surface.as_points(given, "insert(lonlat=…)"), given)
        mesh = self._changing()
        threads = thread_count(self._workers, mesh.size + len(added))
        first = mesh.insert(added, threads, REBUILD_INSERTING)
        return np.arange(first, first + len(added), dtype=np.int32)

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
        size = len(self._now().points) if self._mesh is None else self._mesh.size
        gone = as_indices(indices, size)  # and once more by the kernel, for another thread may have removed some
        if not len(gone):
            return np.arange(size, dtype=np.int32)
        return self._changing().remove(gone.astype(np.int32), thread_count(self._workers, size), REBUILD_REMOVING)

    @by_name(BY_NAME)
    @shared(**LONLAT)
    def find_simplex(
        self, queries: npt.ArrayLike | None = None, *, lonlat: npt.ArrayLike | None = None, workers: int | None = None
    ) -> IntArray | int:
        """Triangle that contains each query, exactly.

        {asked}

        Returns
        -------
        int32 array of the leading shape, or int for a single query
            Index into `simplices`; the lowest one on a shared edge or vertex; -1 outside `convex_hull`.

        {asked_raises}
        """
        now = self._now()
        array, flat, threads = self._as_queries(as_asked(queries, lonlat, self._latitude), workers)
        return _shaped(self.surface.kernel.find_simplex(*now.triangles, flat, now.closing, threads, True), array)

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

        {asked}
        k : int, optional
            Number of points, 1 to the number of all points; by default only the nearest, without an axis of its
            own.

        Returns
        -------
        int32 array of the leading shape, or int for a single query; (..., k) with `k`
            Index of the nearest point, the lowest one if several are equally near. With `k` the nearest points in the
            order of their distances (angles on the sphere), equally near ones in the order of their indices; duplicates
            count like all other points.

        {asked_raises}
            For a triangulation without points, and `k` below 1 or above the number of points.

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
        now, space = self._now(), self.surface.kernel
        size = len(now.points)
        if size == 0:
            raise ValueError("nearest needs at least one point; this triangulation has none")
        array, flat, threads = self._as_queries(as_asked(queries, lonlat, self._latitude), workers)
        count = 1 if k is None else as_count(k, "k", high=size)
        if now.dimension < 2:
            found = space.nearest_flat(now.points, now.flat_order, now.duplicates, flat, count, threads, True)
        elif k is None:
            found = space.nearest(*now.triangles, flat, now.closing, threads, True)
        else:
            found = space.k_nearest(*now.triangles, now.duplicates, flat, count, now.closing, threads, True)
        return _shaped(found.ravel(), array) if k is None else found.reshape(*array.shape[:-1], count)

    def _as_queries(self, queries: npt.ArrayLike, workers: int | None) -> tuple[FloatArray, FloatArray, int]:
        array = self.surface.as_queries(queries)
        flat = array.reshape(-1, array.shape[-1])
        return array, flat, threads_of(self, workers, len(flat))

    def __copy__(self) -> Self:
        """An object of its own that shares the present state, and makes its own mesh when it is changed."""
        twin = type(self).__new__(type(self))
        twin.__dict__.update(self._own())
        twin._last = 0, self._now()
        return twin

    def _own(self) -> dict[str, Any]:
        """What it holds beside state and mesh."""
        own = self.__dict__.copy()  # in one step: another thread may be setting the mesh
        return {name: value for name, value in own.items() if name not in {"_mesh", "_last"}}

    def __getstate__(self) -> dict[str, Any]:
        """Only arrays; a copy makes its own mesh when it is changed."""
        now = self._now()
        made = now.simplices, now.known_neighbors, now.duplicates, now.dimension, now.inconclusive
        return self._own() | {"_arrays": (now.points, made)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        points, made = state["_arrays"]
        self.__dict__.update((name, value) for name, value in state.items() if name != "_arrays")
        self._begin(locked(points), made)

    def __len__(self) -> int:
        return len(self.simplices)

    def __repr__(self) -> str:
        now = self._now()
        return (
            f"{type(self).__name__}({len(now.points)} points, {len(now.simplices)} simplices, "
            f"{len(now.duplicates)} duplicates, dimension {now.dimension})"
        )


def _shaped(found: IntArray, queries: FloatArray) -> IntArray | int:
    """One number for each query, in the queries' leading shape."""
    return found.reshape(queries.shape[:-1]) if queries.ndim > 1 else int(found[0])


def as_triangulation(
    points: npt.ArrayLike | Triangulation | None = None,
    *,
    lonlat: npt.ArrayLike | None = None,
    latitude: Latitude | None = None,
    workers: int | None = None,
) -> Triangulation:
    """The triangulation given, as it is now, or that of points of the plane, of directions, or of `lonlat`."""
    if isinstance(points, Triangulation):
        refuse_lonlat(lonlat, latitude)
        given = copy.copy(points)
        given._workers = points._workers if workers is None else as_workers(workers)
        return given
    array, kind = as_sites(points, lonlat, latitude)
    triangulation: Triangulation = surface_of(array).delaunay(array, workers=workers)
    triangulation._latitude = kind
    return triangulation


def threads_of(triangulation: Triangulation, workers: int | None, size: int | None = None) -> int:
    """How many threads a task of `size` points takes, by default of all points; without `workers` as for the points."""
    chosen = triangulation._workers if workers is None else workers
    return thread_count(chosen, len(triangulation.points) if size is None else size)


def state_of(triangulation: Triangulation) -> _State:
    """The triangulation as it is now, with what the other modules of the library want of it."""
    return triangulation._now()
