"""What is refused, a line each: the message names the argument, its value and what it should be."""

from itertools import chain

import numpy as np

from stereodel import graphs, interpolation, spatial, sphere
from stereodel.conformal import MoebiusMap, bubble_to_bubble, fisheye, flight, three_points
from stereodel.interpolation import LinearInterpolator, contours
from stereodel.projections import Gnomonic, RectangleLift, Stereographic
from stereodel.relaxation import lloyd
from stereodel.sphere import Rotation, SphereArc, SphereCircle, lonlat_to_xyz, xyz_to_lonlat
from stereodel.triangulation import HullInsertion, PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from tests import sets
from tests.interpolation.known import KINDS
from tests.refused import refused

XYZ, INF, NAN = np.eye(3), np.inf, np.nan
THREE, VALUES = [[0, 0], [1, 0], [0, 1]], [1.0, 2.0, 3.0]
PLANE = np.array([[0.0, 0], [4, 0], [0, 4], [4, 5]])
LON, LAT = np.array([0.0, 90.0, 40.0, -50.0]), np.array([0.0, 10.0, 60.0, 20.0])

# The sphere ----------------------------------------------------------------------------------------------------------

EQUATOR = SphereCircle((1, 0, 0), 0.0)
ON_THE_SPHERE = [
    (lambda: lonlat_to_xyz([0, 91]), r"lonlat\[1\] is latitude 91"),
    (lambda: lonlat_to_xyz([NAN, 0]), r"lonlat\[0\] is nan"),
    (lambda: xyz_to_lonlat([[1, 0, 0], [0, 0, 0]]), r"xyz\[1\] is the zero vector"),
    (lambda: lonlat_to_xyz([0, 0], latitude="flat"), "latitude is 'flat', but must be one of 'spherical', 'geod"),
    (lambda: xyz_to_lonlat([1, 0, 0], latitude="flat"), "latitude is 'flat', but must be one of 'spherical', 'geod"),
    (lambda: sphere.coordinates.as_direction([1, 2, 3, 4], "focus"), r"focus must be \(lon, lat\)"),
    (lambda: sphere.coordinates.as_direction([0, 0, 0], "focus"), "focus is the zero vector"),
    (lambda: SphereArc.great((1, 0, 0), (3, 0, 0)), "equal or antipodal"),
    (lambda: SphereArc.great((1, 0, 0), (-2, 0, 0)), "equal or antipodal"),
    (lambda: sphere.graticule(7), "spacing is 7, but 180 must be a whole multiple"),
    (lambda: sphere.graticule(0), "spacing is 0.0"),
    (lambda: sphere.graticule_patch((0, 85), 5, 1), "half_width is 5.0, outside"),
    (lambda: sphere.graticule_patch((0, 40), 8, 3), "spacing is 3, but 16"),
    (lambda: sphere.great_circle_points([1, 0, 0], [-1, 0, 0], 3), "antipodal"),
    (lambda: sphere.great_circle_points([1, 0, 0], [0, 1, 0], 1), "n is 1"),
    (lambda: SphereCircle((1, 0, 0), 1.0), "offset is 1.0: the circle is a point"),
    (lambda: SphereCircle((1, 0, 0), 1.5), r"offset is 1.5, outside \[-1, 1\]"),
    (lambda: SphereCircle((1, 0, 0), 0.5, 0.5), "radius is 0.5, but offset 0.5 belongs to radius 0.866"),
    (lambda: SphereCircle((0, 0, 0), 0.5), "normal is the zero vector"),
    (lambda: SphereCircle.around((0, 0), 0.0), "angular_radius is 0.0"),
    (lambda: SphereCircle.around((0, 0), 180.0), "angular_radius is 180.0"),
    (lambda: SphereCircle.through((1, 0, 0), (3, 0, 0), (0, 1, 0)), "two of them are the same point"),
    (lambda: EQUATOR.contains([0, 0, 0]), "xyz is the zero vector"),
    (lambda: EQUATOR.sample(0), "n is 0"),
    (lambda: Rotation((0, 0, 0, 0)), "zero quaternion"),
    (lambda: Rotation((1, 0, 0)), r"quaternion must have shape \(4,\)"),
    (lambda: Rotation.from_matrix(np.diag([1, 1, -1])), "not a rotation"),
    (lambda: Rotation.from_matrix(np.diag([1, 1, 2])), "not a rotation"),
    (lambda: Rotation.from_matrix(np.eye(4)), r"shape \(3, 3\)"),
    (lambda: Rotation.about((0, 0, 0), 3), "axis is the zero vector"),
    (lambda: Rotation.about((0, 0), INF), "angle"),
]

# Maps and projections ------------------------------------------------------------------------------------------------

IDENTITY, LENS, CAP = MoebiusMap.identity(), fisheye((10, 20), magnification=3), SphereCircle.around((20, 50), 10)
TINY = SphereCircle.around((3.0, 4.0), 1e-30)
MATRICES = [
    (np.eye(3), r"shape \(4, 4\)"),
    ([[1, 2], [2, 4]], "singular"),
    ([[0, 0], [0, 0]], "singular"),
    ([[2e6, 0], [0, 1]], r"magnification 2e\+06, above 1e\+06"),
    ([[NAN, 0], [0, 1]], "nan"),
    ([[1j, 0], [0, complex(0, INF)]], "inf"),
    (np.diag([1.0, 1, 1, -1]), "orthochronous"),
    (np.diag([1.0, 1, -1, 1]), "is a reflection"),
    (np.eye(4) + 1e-3, "Lorentz"),
    (1.001 * LENS.matrix, "Lorentz"),
    (fisheye((10, 20), magnification=1e7).matrix, "magnification"),
]
NO_DIRECTIONS = [[0, 0, 0], [1, NAN, 0], [1, 0, -INF], [NAN, 0, 1]]
OF_MAPS = [
    (lambda: fisheye((0, 0, 0), magnification=2), "focus is the zero vector"),
    (lambda: fisheye((0, 91), magnification=2), "latitude 91"),
    (lambda: IDENTITY([0, 0, 0]), "xyz is the zero vector"),
    (lambda: LENS.lonlat([(0, 90.5)]), r"lonlat\[0, 1\] is latitude 90.5"),
    (lambda: LENS.lonlat([(INF, 0)]), r"lonlat\[0, 0\] is inf"),
    (lambda: IDENTITY.power(NAN), "exponent is nan"),
    (lambda: IDENTITY.power(2e6), "exponent is 2000000.0, outside"),
    (lambda: fisheye((0, 0), magnification=1e9).power(20), "magnification above 1e"),
    (lambda: IDENTITY.fixed_points, "fixed point of the identity"),
    (lambda: three_points(XYZ[:2], XYZ), "sources must be three points, got 2"),
    (lambda: three_points(XYZ, XYZ[[0, 1, 1]]), r"targets\[1\] and targets\[2\] are the same"),
    (lambda: flight((0, 0), (1, 1), magnification=0.0), "magnification is 0"),
    (lambda: flight((0, 0), (1, 95), magnification=2.0), "latitude 95"),
    (lambda: flight((0, 0), (1, 1), magnification=2.0)(1.01), "t is 1.01, outside"),
    (lambda: flight((0, 0), (1, 1), magnification=2.0, arrival=INF), "inf"),
    (lambda: bubble_to_bubble(CAP, CAP, source_point=(20.0, 60.1)), "source_point must lie strictly inside"),
    (lambda: bubble_to_bubble(CAP, CAP, source_point=(200.0, -50.0)), "source_point must lie strictly inside"),
    (lambda: bubble_to_bubble(CAP, CAP, target_point=(20.0, 60.0)), "target_point must lie strictly inside"),
    (lambda: bubble_to_bubble(TINY, CAP), "source has the radius .* cannot be told from a point"),
    (lambda: bubble_to_bubble(CAP, TINY.complement), "target has the radius .* cannot be told from a point"),
    *(
        (lambda size=size: fisheye((0, 0), magnification=size), "magnification")
        for size in (0.0, -2.0, NAN, INF, 1e200, 1e-200)
    ),
    *((lambda matrix=matrix: MoebiusMap.from_matrix(matrix), message) for matrix, message in MATRICES),
    *(
        (lambda row=row, function=function: function([*np.ones((300, 3)), row]), r"xyz\[300")
        for row in NO_DIRECTIONS
        for function in (LENS, LENS.scale_factor)
    ),
    (lambda: Stereographic((0, 95)), "latitude 95"),
    (lambda: Stereographic((0, 0), radius=0), "radius is 0.0"),
    (lambda: Stereographic((0, 0), plane="oblique"), "plane is 'oblique', but must be one of 'tangent'"),
    (lambda: Stereographic((0, 0)).forward([0, 0, 0]), "xyz is the zero vector"),
    (lambda: Stereographic((0, 0)).inverse([INF, 0]), r"xy\[0\] is inf"),
    (lambda: Stereographic((0, 0)).angular_radius(-1), "cannot be negative"),
    (lambda: RectangleLift(0, 0), "width and height are both 0"),
    (lambda: RectangleLift(-1, 2), "width is -1.0"),
    (lambda: RectangleLift(1, NAN), "height"),
    (lambda: RectangleLift(1, 2, center=(0, 0, 0)), "center"),
    (lambda: RectangleLift.fit([]), "points is empty"),
    (lambda: RectangleLift.fit([[1, 2]]), "both 0"),
    (lambda: RectangleLift(3, 4).separation_bounds(6), "no two points are farther apart than 5"),
    (lambda: RectangleLift(3, 4).separation_bounds([1, -1]), r"d\[1\] is -1.0"),
]

# Triangulations and diagrams -----------------------------------------------------------------------------------------

NAMED = SphericalDelaunay.from_lonlat([(0, 0), (90, 0), (0, 90)])
FUNCTION = LinearInterpolator(NAMED, [0, 1, 2])
ROWS = r"give rows \(longitude, latitude\), as np\.column_stack\(\[lon, lat\]\) makes them"
BY_NAME = r"give longitude and latitude by name, lonlat=np\.column_stack\(\[lon, lat\]\)"
DIRECTIONS = r"shape \(\.\.\., 3\), got \(2,\), which means the plane; make directions of longitude .* by lonlat_to_xyz"
OF_PLACES = [  # many of them what a newcomer writes first
    (lambda: SphericalDelaunay.from_lonlat(LON), ROWS),
    (lambda: SphericalDelaunay.from_lonlat(np.stack([LON, LAT])), ROWS),
    (lambda: sphere.angular_distance((10, 50), (20, 60)), f"a must have {DIRECTIONS}"),
    (lambda: sphere.great_circle_points((10, 50), (20, 60), 3), f"a must have {DIRECTIONS}"),
    (lambda: sphere.solid_angle((0, 0), (90, 0), (0, 90)), f"a must have {DIRECTIONS}"),
    (lambda: xyz_to_lonlat((10, 50)), f"xyz must have {DIRECTIONS}"),
    (lambda: Gnomonic((0, 0)).forward((10, 50)), f"xyz must have {DIRECTIONS}"),
    (lambda: fisheye((10, 50), magnification=4)((10, 50)), "for longitude and latitude call its method lonlat"),
    (lambda: SphericalDelaunay(PLANE), r"\(4, 2\), which means the plane; .* use SphericalDelaunay\.from_lonlat"),
    (lambda: PlanarDelaunay(sets.AXES), r"\(6, 3\), which means directions; .* SphericalDelaunay"),
    (lambda: NAMED.insert(PLANE), r"means the plane; .* use insert\(lonlat=…\)"),
    (lambda: HullInsertion(sets.AXES).extend(PLANE), r"means the plane; .* use lonlat_to_xyz"),
    (lambda: HullInsertion(PLANE).extend(sets.AXES), "means directions; triangulate directions by SphericalDelaunay"),
    (lambda: NAMED.nearest((9.0, 48.0)), "means the plane; for longitude and latitude write lonlat="),
    (lambda: NAMED.find_simplex(PLANE), "means the plane; for longitude and latitude write lonlat="),
    (lambda: PlanarDelaunay(PLANE).nearest(sets.AXES), "means directions; .* are of the plane"),
    (lambda: FUNCTION(PLANE), "means the plane; for longitude and latitude write lonlat="),
    (lambda: LinearInterpolator(PLANE, [0, 1, 2, 3])(sets.AXES), "means directions; .* are of the plane"),
    (lambda: SphericalDelaunay(sets.AXES).nearest(lonlat=(0, 0)), "make the object by from_lonlat"),
    (lambda: PlanarDelaunay(PLANE).find_simplex(lonlat=(0, 0)), "make the object by from_lonlat"),
    (lambda: PlanarDelaunay(PLANE).insert(lonlat=[(0, 0)]), "make the object by from_lonlat"),
    (lambda: LinearInterpolator(PLANE, [0, 1, 2, 3])(lonlat=(0, 0)), "make the object by from_lonlat"),
    (lambda: NAMED.nearest(lonlat=(0, 95)), "latitude 95"),
    (lambda: NAMED.insert(lonlat=[0, 0, 0]), r"lonlat must have shape \(n, 2\)"),
    (lambda: graphs.gabriel_graph(lonlat=sets.AXES), r"lonlat must have shape \(n, 2\)"),
    (lambda: SphericalDelaunay.from_lonlat(PLANE, latitude="geocentric"), "latitude is 'geocentric'"),
]
OF_TRIANGULATIONS = [
    (lambda: PlanarDelaunay([[0, 0], [1, NAN]]), r"points\[1, 1\] is nan"),
    (lambda: PlanarDelaunay([1, 2]), r"points must have shape \(n, 2\), got \(2,\)"),
    (lambda: PlanarDelaunay(np.ma.masked_equal([[1.0, 2.0]], 2)), r"points\[0, 1\] is masked"),
    (lambda: SphericalDelaunay([[0, 0, 0]]), r"points\[0\] is the zero vector"),
    (lambda: SphericalDelaunay.from_lonlat([[0, 91]]), r"lonlat\[0, 1\] is latitude 91"),
    (lambda: HullInsertion([[0, 0, 0]]), "points"),
    (lambda: HullInsertion([[1, NAN]]), "points"),
    (lambda: HullInsertion([[1, 2], [3]]), "points"),
    (lambda: PlanarDelaunay(THREE).nearest([0, 0], k=0), "k is 0, but must be at least 1"),
    (lambda: PlanarDelaunay(THREE).nearest([0, 0], k=4), "k is 4, but must be at most 3"),
    (lambda: PlanarDelaunay([]).nearest([0, 0]), "at least one point"),
    (lambda: SphericalDelaunay([]).nearest([0, 0, 1]), "at least one point"),
    (lambda: graphs.hull_area(sets.AXES), "points have no hull: on the sphere"),
    (lambda: graphs.hull_perimeter(sets.AXES), "points have no hull: on the sphere"),
    (lambda: graphs.hull_area(lonlat=[[0, 0], [120, 0], [240, 0]]), "open hemisphere"),
    (lambda: graphs.hull_perimeter(lonlat=[[0, 0], [120, 0], [240, 0]]), "open hemisphere"),
    *(
        (lambda bounds=bounds: PlanarVoronoi(PLANE).segments(bounds), r"bounds .*\(xmin, ymin, xmax, ymax\)")
        for bounds in ((0, 1, 2), (1, 0, 0, 1), (0, 1, 1, 1))
    ),
    *(
        (lambda radius=radius, diagram=diagram: diagram.areas(radius=radius), "radius")
        for radius in (0, -1, INF)
        for diagram in (PlanarVoronoi(PLANE), SphericalVoronoi(sets.AXES))
    ),
]

# Interpolation and relaxation ----------------------------------------------------------------------------------------

LINEAR = LinearInterpolator(THREE, VALUES)
WEIGHTS = LINEAR.weights([0, 0])
OF_VALUES = [
    ([1.0, 2.0], r"values must have shape \(3, \.\.\.\), one entry for each point, got \(2,\)"),
    (5.0, r"values must have shape \(3, \.\.\.\)"),
    ([1.0, INF, 2.0], r"values\[1\] is inf; every value must be finite, or NaN where it is not known"),
    (np.zeros((24, 3)), r"shape \(3, \.\.\.\).*got \(24, 3\)"),
]
ALONG = r"shape \(\.\.\., 3\), one entry for each point, got \(3, 24\)"
TWO_FOR_THREE = r"gradients must have shape \(3, 2\), a vector for each value, got \(3, 3\)"
OF_INTERPOLATORS = [
    *((lambda k=k, values=values: k(THREE, values), message) for k in KINDS.values() for values, message in OF_VALUES),
    (lambda: LinearInterpolator(THREE, VALUES, extrapolate="linear"), "extrapolate is .linear., but must be"),
    (lambda: LINEAR([1, 2, 3]), r"queries must have shape \(\.\.\., 2\), got \(3,\)"),
    (lambda: LinearInterpolator(np.eye(3), VALUES)([0, 0, 0]), "queries is the zero vector"),
    (lambda: interpolation.SmoothInterpolator(THREE, VALUES, gradients=np.zeros((3, 3))), TWO_FOR_THREE),
    (lambda: WEIGHTS @ np.zeros((24, 3)), r"got \(24, 3\)"),
    (lambda: WEIGHTS.apply(np.zeros((3, 24)), axis=-1), ALONG),
    (lambda: WEIGHTS.apply(np.zeros(3), axis=7), "3 along axis 7"),
    (lambda: contours(THREE, np.zeros((3, 2)), 0.0), r"values must be one number for each point, got shape \(3, 2\)"),
    (lambda: contours(THREE, VALUES, [0.0, NAN]), r"levels\[1\] is nan"),
    (lambda: contours(THREE, VALUES, [[0.0]]), r"levels must be a number or a list of numbers, got shape \(1, 1"),
    (lambda: interpolation.LinearNDInterpolator(XYZ * [1, 2, 3], VALUES), "space.*scipy.interpolate.LinearNDInterpol"),
    (lambda: interpolation.griddata(THREE, VALUES, THREE, method="best"), "method is 'best', but must be one of 'nea"),
]
SQUARE = (0, 0, 8, 8)
STAR = [(np.cos(t), np.sin(t)) for t in np.arange(5) * 4 * np.pi / 5]  # not convex, though it always turns left
OF_RELAXATION = [
    (lambda: lloyd([[0, 0]]), "bounds are needed"),
    (lambda: lloyd([[0, 0, 1]], bounds=SQUARE), "leave them out"),
    (lambda: lloyd([[0, 0], [9, 1]], bounds=SQUARE), r"points\[1\] is \[9.0, 1.0\], outside bounds"),
    (lambda: lloyd([[0, 0]], bounds=(8, 0, 0, 8)), "xmin < xmax"),
    (lambda: lloyd([[0, 0]], bounds=[(0, 0), (0, 1), (1, 0)]), "counterclockwise"),
    (lambda: lloyd([[0, 0]], bounds=[(0, 0), (1, 1)]), "shape"),
    (lambda: lloyd([[0, 0]], bounds=STAR), "convex"),
    *((lambda factor=factor: lloyd([[1, 0, 0]], factor=factor), "factor") for factor in (0.0, 2.0, -1.0, NAN)),
    (lambda: lloyd([[0, 0]], bounds=SQUARE, steps=-1), "steps is -1"),
    (lambda: lloyd([[0, 0]], bounds=SQUARE, tolerance=-1), "tolerance"),
    (lambda: lloyd([[0, 0]], bounds=SQUARE, density=lambda x: -x[:, 0]), "weight cannot be negative"),
    (lambda: lloyd([[0, 0]], bounds=SQUARE, density=lambda x: x), "a number for each point"),
    (lambda: lloyd([[0, 0, 1]], density=lambda x: x[:, 0] * NAN), "must be a finite number"),
]

# Classes of SciPy's names --------------------------------------------------------------------------------------------

FLAT, ROUND = sets.plane("random").drawn(60), sets.sphere("unit").drawn(60)
INCONSISTENT = r"Radius inconsistent .*: points\[\d+\] is 1.* but radius is 0.98; scale"
TRIANGULATION = spatial.Delaunay(FLAT)
AS_SCIPY = [
    (lambda: spatial.Delaunay(np.zeros((4, 1))), r"points must have shape \(n, 2\), got \(4, 1\)"),
    (lambda: spatial.SphericalVoronoi(np.zeros((4, 1))), r"points must have shape \(n, 3\), got \(4, 1\)"),
    (lambda: spatial.Delaunay(FLAT, False, True, "Qbb Qz Qc"), "'Qbb', 'Qz' cannot be used with incremental=True"),
    (lambda: spatial.Delaunay(FLAT, False, False, "Qc QG0"), "'QG0'; known here are"),
    (lambda: spatial.Voronoi(FLAT, False, False, "Qu"), "'Qu'; known here are"),
    (lambda: spatial.Delaunay([[0, NAN]]), r"points\[0, 1\] is nan"),
    (lambda: spatial.Voronoi([[0, INF]]), r"points\[0, 1\] is inf"),
    (lambda: spatial.SphericalVoronoi([[0, 0, NAN]]), r"points\[0, 2\] is nan"),
    (lambda: spatial.Delaunay(np.ma.masked_all((3, 2))), "masked"),
    (lambda: spatial.SphericalVoronoi(ROUND, None), "`radius` is `None`"),
    (lambda: spatial.SphericalVoronoi(ROUND, 0.98), INCONSISTENT),
    (lambda: spatial.SphericalVoronoi(ROUND, 1, [0.1, 0, 0]), "Radius inconsistent"),
    (lambda: spatial.SphericalVoronoi(ROUND, -1), "radius is -1"),
    (lambda: spatial.SphericalVoronoi(ROUND, 1, [0, 0]), r"center must have shape \(3,\)"),
    (lambda: spatial.SphericalVoronoi(ROUND, 1, None, -1e-6), "threshold is -1e-06"),
    (lambda: TRIANGULATION.find_simplex([1, 2, 3]), r"xi must have shape \(\.\.\., 2\), got \(3,\)"),
    (lambda: TRIANGULATION.find_simplex([0, 0], tol=-1), "tol is -1"),
    (lambda: TRIANGULATION.find_simplex(np.ma.masked_all((1, 2))), r"xi\[0, 0\] is masked"),
]

OF_ANOTHER_TYPE = [
    (lambda: lloyd([[0, 0]], bounds=SQUARE, density=np.ones(1)), "a function of points, not ndarray; .*Interpolator."),
    (lambda: Rotation.identity() @ 3.0, "unsupported operand"),
    (lambda: IDENTITY @ 3, "unsupported operand"),
    (lambda: NAMED.nearest(10, 50), rf"nearest\(\) takes 1 argument by position, got 2; {BY_NAME}"),
    (lambda: NAMED.find_simplex(10, 50), BY_NAME),
    (lambda: FUNCTION(LON, LAT), BY_NAME),
    (lambda: lonlat_to_xyz(10, 50), r"give longitude and latitude as one pair \(lon, lat\), or rows"),
    (lambda: fisheye((10, 50), 4), r"fisheye\(\) takes 1 argument by position, got 2; magnification= is a keyword"),
    (lambda: SphericalDelaunay.from_lonlat(LON, LAT), ROWS),
    (lambda: SphericalVoronoi.from_lonlat(LON, LAT), ROWS),
    (lambda: LinearInterpolator.from_lonlat(LON, LAT, LAT), rf"takes 2 arguments by position, got 3; {ROWS}"),
    (lambda: NAMED.nearest(), "queries are missing; give queries, or longitude and latitude by lonlat="),
    (lambda: NAMED.nearest([1, 0, 0], lonlat=(0, 0)), "queries and lonlat= were both given"),
    (lambda: NAMED.insert(), "points are missing"),
    (lambda: graphs.gabriel_graph(), "points are missing; give points, or longitude and latitude by lonlat="),
    (lambda: graphs.gabriel_graph(NAMED, lonlat=PLANE), "points and lonlat= were both given"),
    (lambda: graphs.gabriel_graph(PLANE, latitude="geodetic"), "write lonlat=…, latitude='geodetic'"),
    (lambda: graphs.hull(NAMED, latitude="geodetic"), "write lonlat=…, latitude='geodetic'"),
    (lambda: lloyd(PLANE, latitude="geodetic", bounds=(0, 0, 9, 9)), "write lonlat=…, latitude='geodetic'"),
    (lambda: lloyd(NAMED, latitude="geodetic"), "write lonlat=…, latitude='geodetic'"),
    (lambda: PlanarDelaunay([[1j, 0]]), "points must hold real numbers, not complex128"),
    (lambda: HullInsertion("points"), "points"),
    (lambda: PlanarDelaunay(THREE).nearest([0, 0], k=1.5), "k must be one integer"),
    (lambda: PlanarDelaunay(THREE).nearest([0, 0], k=True), "k must be one integer"),
    (lambda: spatial.Delaunay(FLAT, qhull_options=b"Qc"), "qhull_options must be a string or None"),
    (lambda: TRIANGULATION.find_simplex([["a", "b"]]), "xi must hold real numbers"),
    (lambda: fisheye((0, 0), magnification="two"), "magnification"),
    (lambda: interpolation.LinearNDInterpolator(THREE, [1j, 0, 0]), "values must hold real numbers"),
    *((lambda k=k: k(THREE, [1.0, "a", 2.0]), "values must hold real numbers") for k in KINDS.values()),
]


VALUE_ERRORS = ON_THE_SPHERE, OF_MAPS, OF_PLACES, OF_TRIANGULATIONS, OF_INTERPOLATORS, OF_RELAXATION, AS_SCIPY
test_refusals = refused(*chain(*VALUE_ERRORS), *((*row, TypeError) for row in OF_ANOTHER_TYPE))
