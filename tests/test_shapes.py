"""Arrays of a wrong shape are refused at every door, also when one of their sides is empty; `[]` is no points."""

import numpy as np
import pytest

import stereodel as s
from stereodel import conformal, graphs, interpolation, io, relaxation, spatial

PLANE = np.array([[0.0, 0], [4, 0], [0, 4], [4, 5], [2, 1]])
SPHERE = np.vstack([np.eye(3), -np.eye(3)])
LINE = s.RectangleLift(2, 2)
VALUES = np.arange(5.0)


def values_on(make):
    """An object made of points and one value each."""
    return lambda points: make(points, np.zeros(len(points)))


LISTS = {  # (n, width), and [] for none
    "PlanarDelaunay": (2, s.PlanarDelaunay),
    "PlanarDelaunay.insert": (2, lambda a: s.PlanarDelaunay(PLANE).insert(a)),
    "SphericalDelaunay": (3, s.SphericalDelaunay),
    "SphericalDelaunay.insert": (3, lambda a: s.SphericalDelaunay(SPHERE).insert(a)),
    "SphericalDelaunay.from_lonlat": (2, s.SphericalDelaunay.from_lonlat),
    "PlanarVoronoi": (2, s.PlanarVoronoi),
    "SphericalVoronoi": (3, s.SphericalVoronoi),
    "SphericalVoronoi.from_lonlat": (2, s.SphericalVoronoi.from_lonlat),
    "HullInsertion.extend, plane": (2, lambda a: s.HullInsertion(PLANE).extend(a)),
    "HullInsertion.extend, sphere": (3, lambda a: s.HullInsertion(SPHERE).extend(a)),
    "PointTable": (2, io.PointTable),
    "spatial.Delaunay": (2, spatial.Delaunay),
    "spatial.Voronoi": (2, spatial.Voronoi),
    "spatial.SphericalVoronoi": (3, spatial.SphericalVoronoi),
}
PLANE_OR_SPHERE = {  # (n, 2) or (n, 3), and [] for none
    "HullInsertion": s.HullInsertion,
    "check_delaunay": lambda a: s.check_delaunay(a, np.zeros((0, 3), dtype=int)),
    "gabriel_graph": graphs.gabriel_graph,
    "urquhart_graph": graphs.urquhart_graph,
    "relative_neighborhood_graph": graphs.relative_neighborhood_graph,
    "minimum_spanning_tree": graphs.minimum_spanning_tree,
    "hull": graphs.hull,
    "lloyd": lambda a: relaxation.lloyd(a, bounds=None if np.shape(a)[-1] == 3 else (-9, -9, 9, 9)),
    "contours": lambda a: interpolation.contours(a, np.zeros(len(a)), 0.5),
    "estimate_gradients": values_on(interpolation.estimate_gradients),
    "LinearInterpolator": values_on(interpolation.LinearInterpolator),
    "NaturalNeighborInterpolator": values_on(interpolation.NaturalNeighborInterpolator),
    "NearestInterpolator": values_on(interpolation.NearestInterpolator),
    "SmoothInterpolator": values_on(interpolation.SmoothInterpolator),
}
AXES = {  # (..., width)
    "PlanarDelaunay.find_simplex": (2, s.PlanarDelaunay(PLANE).find_simplex),
    "PlanarDelaunay.nearest": (2, s.PlanarDelaunay(PLANE).nearest),
    "PlanarDelaunay.nearest, k": (2, lambda a: s.PlanarDelaunay(PLANE).nearest(a, k=2)),
    "SphericalDelaunay.find_simplex": (3, s.SphericalDelaunay(SPHERE).find_simplex),
    "SphericalDelaunay.nearest": (3, s.SphericalDelaunay(SPHERE).nearest),
    "SphericalDelaunay.nearest, k": (3, lambda a: s.SphericalDelaunay(SPHERE).nearest(a, k=2)),
    "an interpolator": (2, lambda a: interpolation.LinearInterpolator(PLANE, VALUES)(a)),
    "an interpolator, sphere": (3, lambda a: interpolation.NaturalNeighborInterpolator(SPHERE, np.arange(6.0))(a)),
    "its gradient": (2, lambda a: interpolation.NaturalNeighborInterpolator(PLANE, VALUES).gradient(a)),
    "lonlat_to_xyz": (2, s.lonlat_to_xyz),
    "xyz_to_lonlat": (3, s.xyz_to_lonlat),
    "orient2d": (2, lambda a: s.orient2d(a, [0, 0], [1, 0])),
    "incircle": (2, lambda a: s.incircle([0, 0], [1, 0], [0, 1], a)),
    "orient3d": (3, lambda a: s.orient3d(a, [0, 0, 0], [1, 0, 0], [0, 1, 0])),
    "in_bubble": (3, lambda a: s.in_bubble([1, 0, 0], [0, 1, 0], [0, 0, 1], a)),
    "angular_distance": (3, lambda a: s.angular_distance(a, [0, 0, 1])),
    "solid_angle": (3, lambda a: s.solid_angle(a, [0, 0, 1], [0, 1, 0])),
    **{f"{cls.__name__}.forward": (3, cls((0, 0)).forward) for cls in (s.Stereographic, s.Gnomonic, s.Orthographic)},
    **{f"{cls.__name__}.inverse": (2, cls((0, 0)).inverse) for cls in (s.Stereographic, s.Gnomonic, s.Orthographic)},
    "Stereographic.scale_factor": (3, s.Stereographic(center=(0, 0)).scale_factor),
    "RectangleLift.forward": (2, LINE.forward),
    "RectangleLift.scale_factor": (2, LINE.scale_factor),
    "MoebiusMap": (3, s.MoebiusMap.identity()),
    "MoebiusMap.scale_factor": (3, s.MoebiusMap.identity().scale_factor),
    "Rotation": (3, s.Rotation.identity()),
    "SphereCircle.contains": (3, s.SphereCircle([0, 0, 1], 0.5).contains),
}
ONE_A_POINT = {  # (n, ...) of the five points of PLANE
    "contours": lambda a: interpolation.contours(PLANE, a, 0.5),
    "estimate_gradients": lambda a: interpolation.estimate_gradients(PLANE, a),
    "LinearInterpolator": lambda a: interpolation.LinearInterpolator(PLANE, a),
    "SmoothInterpolator": lambda a: interpolation.SmoothInterpolator(PLANE, a),
    "SmoothInterpolator, gradients": lambda a: interpolation.SmoothInterpolator(PLANE, VALUES, gradients=a),
    "density": lambda a: relaxation.lloyd(PLANE, bounds=(-9, -9, 9, 9), density=lambda _: a),
}
INTEGERS = {  # (k,), or (k, width), and [] for none
    "remove": (0, lambda a: s.PlanarDelaunay(PLANE).remove(a)),
    "check_delaunay, simplices": (3, lambda a: s.check_delaunay(PLANE[:1], a)),
    "check_delaunay, duplicates": (2, lambda a: s.check_delaunay(PLANE[:1], [], duplicates=a)),
}
ONE = {  # a point, numbers, a matrix, of a fixed shape that is not empty
    "PlanarVoronoi.segments": lambda a: s.PlanarVoronoi(PLANE).segments(a),
    "lloyd, bounds": lambda a: relaxation.lloyd(PLANE, bounds=a),
    "PlanarVoronoi.areas": lambda a: s.PlanarVoronoi(PLANE).areas(radius=a),
    "SphericalVoronoi.areas": lambda a: s.SphericalVoronoi(SPHERE).areas(radius=a),
    "Stereographic": lambda a: s.Stereographic(center=a),
    "fisheye": lambda a: s.fisheye(a, magnification=2),
    "three_points": lambda a: conformal.three_points(a, SPHERE[:3]),
    "Rotation.from_matrix": s.Rotation.from_matrix,
    "MoebiusMap.from_matrix": s.MoebiusMap.from_matrix,
    "SphereCircle": lambda a: s.SphereCircle(a, 0.5),
    "SphereCircle.through": lambda a: s.SphereCircle.through(a, [0, 1, 0], [0, 0, 1]),
    "great_circle_points": lambda a: s.great_circle_points(a, [0, 1, 0], 3),
}
# Empty sides, before and behind others; some have as many entries as a right shape, none.
EMPTY = [(5, 0), (0, 5), (0, 0), (1, 0), (0, 1), (0, 4), (3, 2, 0), (3, 3, 0), (0, 3, 7), (0, 2, 1)]
WRONG_LISTS = [*EMPTY, (0, 2, 2), (0, 3, 3), (1, 0, 2), (1, 0, 3), (), (4,), (5, 4), (2, 5, 3)]
REFUSED = r"shape|must have|must be|needs|single number|one-dimensional|got"


def doors(table):
    return pytest.mark.parametrize("door", table.values(), ids=table)


def refuses(call, shape, dtype=float):
    with pytest.raises((ValueError, TypeError), match=REFUSED):
        call(np.ones(shape, dtype=dtype))


@doors(LISTS)
def test_lists_of_points(door):
    width, call = door
    for shape in [*WRONG_LISTS, (0, 5 - width), (4, 5 - width)]:
        other = len(shape) == 2 and 0 not in shape and shape[1] > 1
        if not (call.__module__.startswith("stereodel.spatial") and other):  # or it is handed over to SciPy
            refuses(call, shape)
    call([])
    call(np.zeros((0, width)))


@doors(PLANE_OR_SPHERE)
def test_points_of_plane_or_sphere(door):
    for shape in [w for w in WRONG_LISTS if w]:
        refuses(door, shape)
    for nothing in ([], np.zeros((0, 2)), np.zeros((0, 3))):
        door(nothing)


@doors(AXES)
def test_last_axes(door):
    width, call = door
    for shape in [*(w for w in EMPTY if w[-1] != width), (0,), (), (5, 5 - width), (5, 4)]:
        refuses(call, shape)
    assert np.shape(call(np.zeros((0, width))))[0] == 0
    assert np.shape(call(np.zeros((4, 0, width))))[:2] == (4, 0)
    rows = np.random.default_rng(2).normal(size=(3, 2501, width))
    found, last = call(rows), call(rows[-1, -1])
    assert np.shape(found) == (3, 2501, *np.shape(last))
    assert np.array_equal(found[-1, -1], last, equal_nan=True)


@doors(ONE_A_POINT)
def test_one_entry_a_point(door):
    for shape in [*EMPTY[1:], (0,), (), (4,), (6,), (6, 5)]:
        refuses(door, shape)


def test_no_value_a_point_is_a_value_of_an_empty_shape():
    assert interpolation.LinearInterpolator(PLANE, np.zeros((5, 0)))([[1, 1], [2, 2]]).shape == (2, 0)


@doors(INTEGERS)
def test_integers(door):
    width, call = door
    right = [(0,), (0, width)] if width else [(0,)]
    for shape in [*EMPTY, (0, 3), (0, 2), (4,), (2, 7), (2, 3, 2)]:
        if shape not in right and not (shape == (4,) and width == 0):
            refuses(call, shape, int)
    for shape in right:
        call(np.zeros(shape, dtype=int))
    call([])


@doors(ONE)
def test_fixed_shapes(door):
    for shape in [*EMPTY, (0,), (5,), (3, 7)]:
        refuses(door, shape)
