"""What the three classes of `stereodel.spatial` share with SciPy's: names, types, copies, errors."""

import inspect

import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial

import stereodel
import stereodel.spatial
from tests import sets
from tests.spatial.oracle import random_points

FLAT, ROUND = random_points(60), sets.sphere("unit").drawn(60)
POINTS = {"Delaunay": FLAT, "Voronoi": FLAT, "SphericalVoronoi": ROUND}


@pytest.fixture(params=POINTS)
def pair(request):
    """An object of ours and one of SciPy's, of the same points."""
    return [getattr(each, request.param)(POINTS[request.param]) for each in (stereodel.spatial, scipy.spatial)]


def test_nothing_public_is_left_to_scipys_class(pair):
    """Otherwise a method of SciPy's would look for a Qhull that is not there."""
    ours, theirs = map(type, pair)
    public = {name for cls in theirs.__mro__[:-1] for name in vars(cls) if not name.startswith("_")}
    own = {name for cls in ours.__mro__ if cls.__module__.startswith("stereodel") for name in vars(cls)}
    assert public - own == set()
    assert issubclass(ours, theirs)


def kind(value):
    """The type, of arrays and lists with what they hold."""
    if isinstance(value, np.ndarray):
        return value.dtype, value.ndim, value.flags.writeable, value.flags.c_contiguous
    if isinstance(value, dict):
        return {kind(key) for key in value}, {kind(each) for each in value.values()}
    if isinstance(value, list | tuple):
        return type(value), frozenset(map(kind, value))
    return type(value)


def test_every_attribute_is_there_and_of_scipys_type(pair):
    ours, theirs = pair
    for name in dir(theirs):
        if name.startswith("_") or (name in {"radius", "regions"} and hasattr(ours, "radius")):
            continue
        mine, other = getattr(ours, name), getattr(theirs, name)
        assert callable(mine) if callable(other) else kind(mine) == kind(other), name
    if isinstance(ours, stereodel.spatial.SphericalVoronoi):
        assert kind(ours._simplices) == kind(theirs._simplices)
        assert kind(ours.calculate_areas()) == kind(theirs.calculate_areas())
        assert type(ours.radius) is float
        assert {type(region) for region in ours.regions} == {list}


def test_same_signatures(pair):
    def parameters(function):
        return [(p.name, p.default, p.kind) for p in inspect.signature(function).parameters.values()]

    ours, theirs = map(type, pair)
    names = {n for n in dir(theirs) if not n.startswith("_") and callable(getattr(theirs, n))}
    for name in names:
        assert parameters(getattr(ours, name)) == parameters(getattr(theirs, name)), name
    more = [] if ours is stereodel.spatial.SphericalVoronoi else [("strict", False, inspect.Parameter.KEYWORD_ONLY)]
    assert parameters(ours.__init__) == parameters(theirs.__init__) + more


@pytest.mark.parametrize("name", POINTS)
def test_input_is_copied(name):
    points = POINTS[name].copy()
    one = getattr(stereodel.spatial, name)(points)
    points[:] = 0
    np.testing.assert_array_equal(one.points, POINTS[name])


SPACE = np.random.default_rng(3).normal(size=(30, 3))


@pytest.mark.parametrize(
    ("name", "points", "options", "what"),
    [
        ("Delaunay", SPACE, {}, "3 dimensions"),
        ("Voronoi", np.random.default_rng(4).normal(size=(20, 4)), {"qhull_options": "Qbb Qc Qx"}, "4 dimensions"),
        ("SphericalVoronoi", [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]], {}, "2 dimensions"),
        ("Delaunay", FLAT, {"furthest_site": True}, "furthest_site=True"),
        ("Voronoi", FLAT, {"furthest_site": True}, "furthest_site=True"),
    ],
)
def test_what_is_not_exact_is_handed_over_with_a_warning(name, points, options, what):
    """It is an object of SciPy's own class, and the warning points at who made it."""
    theirs = getattr(scipy.spatial, name)
    message = f"^points has {what}.*exactness ends here, scipy.spatial.{name} takes over"
    with pytest.warns(stereodel.spatial.InexactWarning, match=message) as said:
        found = getattr(stereodel.spatial, name)(points, **options)
    assert said[0].filename == __file__
    assert type(found) is theirs
    expected = theirs(points, **options)
    for attribute in ("simplices", "vertices", "neighbors", "points"):
        if hasattr(expected, attribute):
            np.testing.assert_array_equal(getattr(found, attribute), getattr(expected, attribute))


def test_space_grows_and_is_searched_as_scipys():
    with pytest.warns(stereodel.spatial.InexactWarning):
        found = stereodel.spatial.Delaunay(SPACE[:20], incremental=True)
    found.add_points(SPACE[20:])
    inside = found.points[found.simplices].mean(axis=1)
    assert found.npoints == 30
    assert np.array_equal(found.find_simplex(inside), np.arange(found.nsimplex))


@pytest.mark.parametrize("points", [[], [[1, 2]], [[0, 0], [1, 1]], [[0, 0], [1, 1], [3, 3]], [[1, 1]] * 4])
@pytest.mark.parametrize("name", ["Delaunay", "Voronoi"])
def test_what_has_no_triangle_raises_when_asked(name, points):
    points = np.reshape(points, (-1, 2))
    with pytest.raises((ValueError, scipy.spatial.QhullError)) as theirs:
        getattr(scipy.spatial, name)(points)
    with pytest.raises(theirs.type, match=f"points has {len(points)} rows, all on one line.*strict=False"):
        getattr(stereodel.spatial, name)(points, strict=True)
    assert getattr(stereodel.spatial, name)(points).npoints == len(points)
    assert getattr(stereodel.spatial, name)([[0, 0], [1, 1], [1, 1.5]], strict=True).npoints == 3


def test_every_other_name_of_scipy_spatial():
    for name in scipy.spatial.__all__:
        assert hasattr(stereodel.spatial, name)
    from stereodel.spatial import KDTree, QhullError, tsearch, voronoi_plot_2d

    assert KDTree is scipy.spatial.KDTree
    assert QhullError is scipy.spatial.QhullError
    assert voronoi_plot_2d is scipy.spatial.voronoi_plot_2d
    tri = stereodel.spatial.Delaunay(FLAT)
    assert tsearch(tri, [0.5, 0.5]) == tri.find_simplex([0.5, 0.5])
    with pytest.raises(AttributeError, match=r"neither stereodel\.spatial nor scipy\.spatial has 'NoSuchThing'"):
        _ = stereodel.spatial.NoSuchThing


def test_submodules_of_scipy_are_imported_by_their_paths():
    """A script changes `scipy.spatial` to `stereodel.spatial` wherever that stands."""
    import stereodel.spatial.distance
    from stereodel.spatial.distance import cdist
    from stereodel.spatial.kdtree import KDTree
    from stereodel.spatial.qhull import ConvexHull, Delaunay
    from stereodel.spatial.transform import Rotation, Slerp

    assert cdist is scipy.spatial.distance.cdist is stereodel.spatial.distance.cdist
    assert (KDTree, ConvexHull) == (scipy.spatial.KDTree, scipy.spatial.ConvexHull)
    assert (Rotation, Slerp) == (scipy.spatial.transform.Rotation, scipy.spatial.transform.Slerp)
    assert Delaunay is stereodel.spatial.Delaunay


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
