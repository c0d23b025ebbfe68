"""`stereodel.spatial` in the hands of others: SciPy's and matplotlib's functions, and scripts as people write them."""

import inspect

import matplotlib as mpl
import matplotlib.pyplot as plt
import matplotlib.tri
import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial

import stereodel
import stereodel.spatial

PAIRS = [(getattr(stereodel.spatial, name), getattr(scipy.spatial, name)) for name in ("Delaunay", "Voronoi")]
PAIRS.append((stereodel.spatial.SphericalVoronoi, scipy.spatial.SphericalVoronoi))


def random_points(n=60, seed=0):
    return np.random.default_rng(seed).random((n, 2))


@pytest.fixture(autouse=True)
def _agg():
    with mpl.rc_context({"backend": "Agg"}):
        yield
        plt.close("all")


@pytest.mark.parametrize(("ours", "theirs"), PAIRS)
def test_nothing_public_is_left_to_scipys_class(ours, theirs):
    """Otherwise a method of SciPy's would look for a Qhull that is not there."""
    public = {name for cls in theirs.__mro__[:-1] for name in vars(cls) if not name.startswith("_")}
    own = {name for cls in ours.__mro__ if cls.__module__.startswith("stereodel") for name in vars(cls)}
    assert public - own == set()


@pytest.mark.parametrize(("ours", "theirs"), PAIRS)
def test_every_attribute_of_an_object_is_there(ours, theirs):
    points = np.random.default_rng(0).normal(size=(30, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    points = points if ours.__name__ == "SphericalVoronoi" else points[:, :2]
    missing = {name for name in dir(theirs(points)) if not name.startswith("_") and not hasattr(ours(points), name)}
    assert missing == set()


@pytest.mark.parametrize(("ours", "theirs"), PAIRS)
def test_same_signatures(ours, theirs):
    def parameters(function):
        return [(p.name, p.default, p.kind) for p in inspect.signature(function).parameters.values()]

    names = {"__init__"} | {n for n in dir(theirs) if not n.startswith("_") and callable(getattr(theirs, n))}
    for name in names:
        assert parameters(getattr(ours, name)) == parameters(getattr(theirs, name)), name
    assert issubclass(ours, theirs)


def test_every_other_name_of_scipy_spatial():
    for name in scipy.spatial.__all__:
        assert hasattr(stereodel.spatial, name)
    from stereodel.spatial import KDTree, QhullError, tsearch, voronoi_plot_2d

    assert KDTree is scipy.spatial.KDTree
    assert QhullError is scipy.spatial.QhullError
    assert voronoi_plot_2d is scipy.spatial.voronoi_plot_2d
    tri = stereodel.spatial.Delaunay(random_points())
    assert tsearch(tri, [0.5, 0.5]) == tri.find_simplex([0.5, 0.5])
    with pytest.raises(AttributeError, match=r"neither stereodel\.spatial nor scipy\.spatial has 'NoSuchThing'"):
        _ = stereodel.spatial.NoSuchThing


def drawn(figure):
    """Every line and segment of a figure, without order and direction, rounded."""
    axes = figure.gca()
    segments = [segment for collection in axes.collections for segment in collection.get_segments()]
    lines = [np.column_stack(line.get_data()) for line in axes.lines]
    for line in lines:
        gaps = np.flatnonzero(np.isnan(line[:, 0]))  # triplot draws all edges as one line with gaps
        segments += [part for part in np.split(line, gaps) if len(part) < len(line)]
    rows = [sorted(map(tuple, np.round(s[~np.isnan(s).any(axis=1)], 6).tolist())) for s in map(np.asarray, segments)]
    return sorted(row for row in rows if row), [len(line) for line in lines], axes.get_xlim(), axes.get_ylim()


@pytest.mark.parametrize(
    ("plot", "name"),
    [("delaunay_plot_2d", "Delaunay"), ("voronoi_plot_2d", "Voronoi"), ("convex_hull_plot_2d", "Delaunay")],
)
def test_scipys_plots_show_the_same(plot, name):
    figures = [
        getattr(scipy.spatial, plot)(getattr(module, name)(random_points()), plt.figure().gca())
        for module in (stereodel.spatial, scipy.spatial)
    ]
    ours, theirs = map(drawn, figures)
    assert ours == theirs
    assert len(ours[0]) > 60


def test_a_picture_of_the_voronoi_diagram_that_scipy_has_had_wrong():
    """Cells far from square: the unbounded ridges of SciPy's own regression test."""
    points = [[245.06, 10.971011], [320.49, 10.970258], [239.79, 13.1085], [263.38, 12.9324], [219.53, 13.3461]]
    ours = scipy.spatial.voronoi_plot_2d(stereodel.spatial.Voronoi(points))
    theirs = scipy.spatial.voronoi_plot_2d(scipy.spatial.Voronoi(points))
    ends = [np.sort(np.concatenate(f.gca().collections[1].get_segments()), axis=0) for f in (ours, theirs)]
    np.testing.assert_allclose(*ends, rtol=1e-9)


def test_matplotlib_takes_the_triangles():
    tri = stereodel.spatial.Delaunay(random_points())
    mesh = matplotlib.tri.Triangulation(*tri.points.T, tri.simplices)
    np.testing.assert_array_equal(np.sort(mesh.edges, axis=1).shape, stereodel.PlanarDelaunay(tri.points).edges.shape)
    queries = random_points(500, 1)
    np.testing.assert_array_equal(mesh.get_trifinder()(*queries.T) < 0, tri.find_simplex(queries) < 0)


@pytest.mark.parametrize(
    "method", [scipy.interpolate.LinearNDInterpolator, scipy.interpolate.CloughTocher2DInterpolator]
)
def test_scipys_interpolators_take_the_triangulation(method):
    points = random_points(200)
    values = np.column_stack([np.sin(5 * points[:, 0]), points[:, 1] ** 2])
    ours, theirs = (method(module.Delaunay(points), values) for module in (stereodel.spatial, scipy.spatial))
    assert ours.tri.__class__ is stereodel.spatial.Delaunay
    queries = np.random.default_rng(2).uniform(-0.1, 1.1, (500, 2))
    np.testing.assert_allclose(ours(queries), theirs(queries), rtol=1e-6, atol=1e-9)


# Idioms as they are found in public scripts, in words of our own.


def weights(tri, queries):
    """Barycentric weights once, for values that change: corners and their weights."""
    found = tri.find_simplex(queries)
    corners = np.take(tri.simplices, found, axis=0)
    maps = np.take(tri.transform, found, axis=0)
    first = np.einsum("njk,nk->nj", maps[:, :2, :], queries - maps[:, 2])
    return corners, np.hstack([first, 1 - first.sum(axis=1, keepdims=True)])


def test_idiom_weights_that_are_kept():
    points = random_points(200)
    plane = points @ [3.0, -2.0] + 1
    queries = np.random.default_rng(3).uniform(0.2, 0.8, (400, 2))
    corners, share = weights(stereodel.spatial.Delaunay(points), queries)
    np.testing.assert_allclose(np.einsum("nj,nj->n", plane[corners], share), queries @ [3.0, -2.0] + 1)


def bounded_polygons(vor, reach):
    """Every cell as a polygon, unbounded ones cut at a distance: the ridges out of it are lengthened."""
    center = vor.points.mean(axis=0)
    far = {}
    for (p, q), (v, w) in zip(vor.ridge_points, vor.ridge_vertices, strict=True):
        far.setdefault(p, []).append((q, v, w))
        far.setdefault(q, []).append((p, v, w))
    for p, region in enumerate(vor.point_region):
        corners = [vor.vertices[v] for v in vor.regions[region] if v >= 0]
        for q, v, w in far[p]:
            v, w = (w, v) if w < 0 else (v, w)
            if v < 0:
                along = vor.points[q] - vor.points[p]
                normal = np.array([-along[1], along[0]]) / np.hypot(*along)
                outward = np.sign((vor.points[[p, q]].mean(axis=0) - center) @ normal) * normal
                corners.append(vor.vertices[w] + outward * reach)
        corners = np.array(corners)
        angles = np.arctan2(*(corners - corners.mean(axis=0)).T)
        yield corners[np.argsort(angles)]


def test_idiom_polygons_of_all_cells():
    points = random_points()
    ours, theirs = (list(bounded_polygons(m.Voronoi(points), 5.0)) for m in (stereodel.spatial, scipy.spatial))
    for mine, other in zip(ours, theirs, strict=True):
        np.testing.assert_allclose(np.sort(mine, axis=0), np.sort(other, axis=0), rtol=1e-6, atol=1e-9)


def test_idiom_triangles_around_a_vertex():
    tri = stereodel.spatial.Delaunay(random_points())
    for vertex in range(tri.npoints):
        queue, seen = [tri.vertex_to_simplex[vertex]], set()
        while queue:
            simplex = queue.pop()
            seen.add(int(simplex))
            corners = tri.simplices[simplex]
            beyond = [s for k, s in enumerate(tri.neighbors[simplex]) if corners[k] != vertex and s != -1]
            queue += [s for s in beyond if int(s) not in seen]
        assert seen == set(np.flatnonzero((tri.simplices == vertex).any(axis=1)).tolist())
        indptr, indices = tri.vertex_neighbor_vertices
        around = set(tri.simplices[list(seen)].ravel().tolist()) - {vertex}
        assert around == set(indices[indptr[vertex] : indptr[vertex + 1]].tolist())


def test_idiom_edges_of_long_triangles_left_out():
    """An alpha shape: edges that belong to one triangle only among those with a small circumcircle."""

    def boundary(tri, alpha):
        rows = set()
        for ia, ib, ic in tri.simplices:
            a, b, c = (np.hypot(*(tri.points[i] - tri.points[j])) for i, j in ((ia, ib), (ib, ic), (ic, ia)))
            half = (a + b + c) / 2
            area = np.sqrt(max(half * (half - a) * (half - b) * (half - c), 1e-300))
            if a * b * c / (4 * area) < alpha:
                for edge in ((ia, ib), (ib, ic), (ic, ia)):
                    rows ^= {tuple(sorted(map(int, edge)))}
        return rows

    points = random_points(150)
    assert boundary(stereodel.spatial.Delaunay(points), 0.1) == boundary(scipy.spatial.Delaunay(points), 0.1)


def test_idiom_polygons_on_the_sphere():
    """Cells drawn as polygons in space with their areas as colours, sorted first as SciPy's manual says."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    points = np.random.default_rng(0).normal(size=(80, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    sv = stereodel.spatial.SphericalVoronoi(points, 1, np.array([0, 0, 0]))
    sv.sort_vertices_of_regions()
    axes = plt.figure().add_subplot(111, projection="3d")
    for region, area in zip(sv.regions, sv.calculate_areas(), strict=True):
        axes.add_collection3d(Poly3DCollection([sv.vertices[region]], alpha=min(1.0, area)))
        arc = scipy.spatial.geometric_slerp(sv.vertices[region][0], sv.vertices[region][1], np.linspace(0, 1, 5))
        assert arc.shape == (5, 3)
    assert len(axes.collections) == 80
