"""Proximity graphs and hulls, as subgraphs of a Delaunay triangulation, decided exactly.

Each is a subgraph of the next: minimum spanning tree, relative neighbourhood graph, Urquhart graph, Gabriel graph,
Delaunay triangulation.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Literal, ParamSpec, TypeVar

import numpy as np

from stereodel import _kernel
from stereodel._arrays import AnyIndices, FloatArray, IntArray, locked
from stereodel._docs import shared
from stereodel._spaces import PLANE
from stereodel.sphere.coordinates import LONLAT
from stereodel.sphere.vectors import units
from stereodel.triangulation.delaunay import Triangulation, as_triangulation, state_of, threads_of
from stereodel.triangulation.topology import as_edges

__all__ = [
    "gabriel_graph",
    "hull",
    "hull_area",
    "hull_perimeter",
    "minimum_spanning_tree",
    "relative_neighborhood_graph",
    "urquhart_graph",
]

_SHARED = LONLAT | {
    "points": """
        Parameters
        ----------
        points : array_like (n, 2) or (n, 3), PlanarDelaunay or SphericalDelaunay
            Points of the plane, directions, or a triangulation of them.
        {instead}
        workers : int, optional
            Threads; -1 for all processors. By default those of the triangulation. Does not affect the result.
        """,
    "raises": """
        Raises
        ------
        ValueError, TypeError
            For points that cannot be triangulated: see `PlanarDelaunay` and `SphericalDelaunay`; for points and
            `lonlat` together, and `latitude` without `lonlat`.
        """,
    "graph": """
        {points}

        Returns
        -------
        (e, 2) array of int32
            Edges i < j, in lexicographic order; read-only. Dropped duplicates have none. All decisions are those of
            exact arithmetic on the given doubles.

        {raises}
        """,
    "hull_raises": """
        Raises
        ------
        ValueError, TypeError
            As for `hull`; for points of the sphere that lie in no open hemisphere.
        """,
}


_T = TypeVar("_T")
_P = ParamSpec("_P")
_Decorator = Callable[[Callable[[Triangulation], _T]], Callable[_P, _T]]


def _with_parameters_of(triangulate: Callable[_P, Triangulation]) -> _Decorator[_T, _P]:
    """Decorate a function of a triangulation: it becomes one of the points of which this makes a triangulation."""

    def decorated(function: Callable[[Triangulation], _T]) -> Callable[_P, _T]:
        @wraps(function)
        def of_points(*args: _P.args, **options: _P.kwargs) -> _T:
            found = function(triangulate(*args, **options))
            if isinstance(found, np.ndarray):
                locked(found)
            return found

        given = signature(triangulate).replace(return_annotation=signature(function).return_annotation)
        of_points.__signature__ = given  # type: ignore[attr-defined]
        return shared(**_SHARED)(of_points)

    return decorated


_of_points = _with_parameters_of(as_triangulation)


@_of_points
def gabriel_graph(triangulation: Triangulation) -> IntArray:
    """Edges whose diametral circle contains no other point, neither inside nor on it.

    {graph}

    Notes
    -----
    The diametral circle of an edge ab has it as diameter; on the sphere it is the smallest circle through a and b, and
    holds p exactly if (â − p̂)·(b̂ − p̂) ≤ 0. Antipodal directions have none and are joined only if they are the only
    ones. The disc is closed: a point on the circle excludes the edge, so a square has its sides and no diagonal. Hence
    the graph is a subgraph of every Delaunay triangulation of the points, however ties are decided, and does not depend
    on the order of the points.

    Source: K. Gabriel, R. Sokal, "A new statistical approach to geographic variation analysis" (1969); D. Matula,
    R. Sokal, "Properties of Gabriel graphs relevant to geographic variation research and the clustering of points in
    the plane" (1980): of a Delaunay edge the opposite corners alone decide.

    Examples
    --------
    >>> from stereodel.graphs import gabriel_graph
    >>> gabriel_graph([[0, 0], [2, 0], [2, 2], [0, 2]]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    >>> gabriel_graph([[0, 0], [3, 0], [0, 4]]).tolist()
    [[0, 1], [0, 2]]
    """
    return _proximity_edges(triangulation, "gabriel")


@_of_points
def urquhart_graph(triangulation: Triangulation) -> IntArray:
    """Delaunay edges that are not strictly the longest edge of a triangle.

    {graph}

    Notes
    -----
    A triangle with two or three equally long longest edges loses none: so the relative neighbourhood graph is always
    a part. All facets count on the sphere, those that are closing too. The graph depends on the triangulation where
    more than three points lie on one empty circle; their triangulation depends on the points alone, so no order of the
    points changes it. Without triangles it is the Gabriel graph.

    Source: R. Urquhart, "Algorithms for computation of relative neighbourhood graph" (1980): close to the relative
    neighbourhood graph, and found in linear time.

    Examples
    --------
    >>> from stereodel.graphs import urquhart_graph
    >>> urquhart_graph([[0, 0], [4, 0], [1, 2], [4, 3]]).tolist()
    [[0, 2], [1, 3], [2, 3]]
    """
    return _proximity_edges(triangulation, "urquhart")


@_of_points
def relative_neighborhood_graph(triangulation: Triangulation) -> IntArray:
    """Pairs of points without a third that is strictly nearer to both than they are to each other.

    {graph}

    Notes
    -----
    Equally near points exclude nothing: an equilateral triangle has its three sides. Distances on the sphere
    are angles. The graph depends on the points alone.

    Source: G. Toussaint, "The relative neighbourhood graph of a finite planar set" (1980). It is sought among the
    edges of the Urquhart graph. A third point in the lune of ab is reached from a along Delaunay edges between points
    that are nearer to a than b is, and likewise from b; both searches alternate until one of them is exhausted.

    Examples
    --------
    >>> from stereodel.graphs import relative_neighborhood_graph
    >>> relative_neighborhood_graph([[0, 0], [4, 0], [1, 2], [4, 3]]).tolist()
    [[0, 2], [1, 3], [2, 3]]
    """
    return _proximity_edges(triangulation, "relative")


@_of_points
def minimum_spanning_tree(triangulation: Triangulation) -> IntArray:
    """The spanning tree of least total length.

    {graph}

    Notes
    -----
    Lengths are distances in the plane, angles on the sphere; any increasing function of them, as the chord, has the
    same tree. Edges are compared exactly, equally long ones by their ends: the one with the lexicographically lower
    first end comes first (on the sphere in the order of the unit vectors), then the one with the lower second end. So
    of several trees of the same length the points alone determine which is chosen; their order does not matter. Of
    k distinct points it has k - 1 edges.

    Source: J. Kruskal, "On the shortest spanning subtree of a graph and the traveling salesman problem" (1956), on the
    edges of the Urquhart graph, which holds every minimum spanning tree (M. Shamos, D. Hoey, "Closest-point problems",
    1975; G. Toussaint, 1980).

    Examples
    --------
    >>> from stereodel.graphs import minimum_spanning_tree
    >>> minimum_spanning_tree([[0, 0], [2, 0], [2, 1], [0, 1]]).tolist()
    [[0, 1], [0, 3], [1, 2]]
    """
    edges = _proximity_edges(triangulation, "urquhart")
    return triangulation.surface.kernel.spanning_tree(triangulation.points, edges)


@_of_points
def hull(triangulation: Triangulation) -> IntArray:
    """Corners of the convex hull, counterclockwise.

    {points}

    Returns
    -------
    (h,) array of int32
        Indices of the corners, the smallest first, counterclockwise (seen from outside the sphere); read-only. One
        corner for one point, the two ends for points of a line or of an arc. On the sphere none if the points do not
        lie in an open hemisphere.

    {raises}

    Notes
    -----
    The hull on the sphere is bounded by arcs of great circles; there is one if and only if the points lie in an open
    hemisphere. Points within a side are not corners, unlike the ends of the edges of `convex_hull`.
    A dropped duplicate is never a corner. All decisions are those of exact arithmetic on the given doubles.

    Examples
    --------
    >>> from stereodel.graphs import hull
    >>> hull([[1, 0], [0, 0], [2, 0], [2, 2], [1, 1], [0, 2]]).tolist()
    [1, 2, 3, 5]
    >>> hull(lonlat=[[0, 40], [20, 40], [20, 60], [10, 50], [0, 60]]).tolist()
    [0, 1, 2, 4]
    >>> hull([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]).tolist()
    []
    """
    corners = _corners(triangulation) if triangulation.dimension == 2 else _ends(triangulation)
    return corners.astype(np.int32)


@_of_points
def hull_area(triangulation: Triangulation) -> float:
    """Area of the convex hull.

    {points}

    Returns
    -------
    float
        In squares of the plane's unit, on the sphere in steradians; multiply by the square of the radius.
        0 without triangles.

    {hull_raises}

    Notes
    -----
    The sum of the triangles of the first corner and each side not at it. SciPy's `ConvexHull` calls it
    volume.

    Examples
    --------
    >>> from stereodel.graphs import hull_area
    >>> hull_area([[1, 0], [0, 0], [2, 0], [2, 2], [1, 1], [0, 2]])
    4.0
    >>> round(hull_area(lonlat=[[0, 0], [90, 0], [0, 90]]) / np.pi, 15)
    0.5
    """
    corners = _hull_points(triangulation)
    first = np.broadcast_to(corners[:1], corners[2:].shape)
    return float(triangulation.surface.areas(first, corners[1:-1], corners[2:]).sum())


@_of_points
def hull_perimeter(triangulation: Triangulation) -> float:
    """Length of the boundary of the convex hull.

    {points}

    Returns
    -------
    float
        In the plane's unit, on the sphere in degrees. For points of a line or an arc, twice its length.

    {hull_raises}

    Examples
    --------
    >>> from stereodel.graphs import hull_perimeter
    >>> hull_perimeter([[1, 0], [0, 0], [2, 0], [2, 2], [1, 1], [0, 2]])
    8.0
    >>> hull_perimeter(lonlat=[[0, 0], [90, 0], [0, 90]])
    270.0
    """
    corners = _hull_points(triangulation)
    return float(triangulation.surface.distances(corners, np.roll(corners, -1, axis=0)).sum())


def _hull_points(triangulation: Triangulation) -> FloatArray:
    """Corners of the hull in their order, (h, 2) or (h, 3)."""
    corners = triangulation.points[hull(triangulation)]
    if len(triangulation.points) and not len(corners):
        raise ValueError("points have no hull: on the sphere there is one if they lie in an open hemisphere")
    return corners


def _proximity_edges(triangulation: Triangulation, kind: Literal["gabriel", "urquhart", "relative"]) -> IntArray:
    """Edges (e, 2) with i < j, in lexicographic order."""
    points, space = triangulation.points, triangulation.surface.kernel
    if triangulation.dimension == 2:
        mesh = points, triangulation.simplices, triangulation.neighbors
        return space.proximity(*mesh, kind, threads_of(triangulation, None), True)
    order = state_of(triangulation).flat_order
    if triangulation.surface is PLANE or len(order) < 3:
        return as_edges(order[:-1], order[1:])
    steps = _short_steps(points, order)
    if kind == "relative":
        steps = steps[[_has_empty_lune(points, order, step) for step in steps]]
    return as_edges(*steps.T)


def _short_steps(points: FloatArray, circle: AnyIndices) -> AnyIndices:
    """Steps (e, 2) around three or more different directions of a great circle that are less than half-turns.

    A step of less than a half-turn has all other points outside its diametral circle, a longer one inside, a half-turn
    on it: the next point tells.
    """
    three = np.column_stack([circle, np.roll(circle, -1), np.roll(circle, -2)]).astype(np.int32)
    return three[_kernel.sphere.diametral(points, three) > 0, :2]


def _has_empty_lune(points: FloatArray, circle: AnyIndices, step: AnyIndices) -> bool:
    """Whether no point of a great circle is strictly nearer to both ends of a step than these are to each other.

    That takes a step of more than a third of the circle, the squared chord of which is 3: two steps at most.
    """
    a, b = step
    chord = np.subtract(*units(points[[a, b]]))
    if chord @ chord < 2.99:
        return True
    others = circle[(circle != a) & (circle != b)]
    rows = np.array([(end, other, a, b) for end in (a, b) for other in others], dtype=np.int32)
    nearer = _kernel.sphere.compare_lengths(points, rows).reshape(2, -1) < 0
    return not nearer.all(axis=0).any()


def _corners(triangulation: Triangulation) -> AnyIndices:
    """The hull of points with triangles."""
    if (closing := state_of(triangulation).closing) is not None:
        # The points lie in an open hemisphere exactly if the hull of the vectors' tips has a facet with the centre
        # strictly on its outer side.
        a, b, c = triangulation.points[triangulation.simplices[closing].T]
        if not (_kernel.sphere.turn(a, b, c) < 0).any():
            return np.zeros(0, dtype=np.int32)
    # The directed edges of the hull, one from each vertex, in one cycle; what lies within a side does not turn.
    after = dict(triangulation.convex_hull.tolist())
    cycle = [min(after)]
    while (vertex := after[cycle[-1]]) != cycle[0]:
        cycle.append(vertex)
    before, here, following = (triangulation.points[np.roll(cycle, shift)] for shift in (1, 0, -1))
    corners = np.array(cycle)[triangulation.surface.kernel.turn(before, here, following) != 0]
    return np.roll(corners, -int(np.argmin(corners)))


def _ends(triangulation: Triangulation) -> AnyIndices:
    """The hull of points of one line or great circle."""
    order, points = state_of(triangulation).flat_order, triangulation.points
    if len(order) < 2:
        return order
    ends = np.sort(order[[0, -1]])
    if triangulation.surface is PLANE:
        return ends
    # On a great circle the ends of the one step of more than a half-turn, if there is one.
    if len(order) > 2:
        steps = _short_steps(points, order)
        if len(steps) != len(order) - 1:
            return np.zeros(0, dtype=np.int32)
        ends = np.setxor1d(*steps.T)
    a, b = points[ends]
    are_opposite = _kernel.sphere.compare(a[None], -b[None])[0] == 0
    return ends[:0] if are_opposite else ends
