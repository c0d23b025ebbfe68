"""Every public class: an object comes back from `pickle`, `copy` and `deepcopy` as it was; values are equal."""

import copy
import dataclasses
import enum
import inspect
import pickle
from collections.abc import Mapping
from io import StringIO

import numpy as np
import pytest

import stereodel as sd
from stereodel import conformal, data, drawing, film, globe, interpolation, io, partitioned, relaxation, render, spatial
from tests.test_api import PACKAGES
from tools import names

LONLAT = [(0.0, 10.0), (90.0, 0.0), (180.0, -20.0), (-90.0, 5.0), (0.0, 80.0), (30.0, -70.0)]
PLANE = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0), (5.0, 6.0), (1.0, 1.5)]
CIRCLE = sd.SphereCircle.around((10, 48), 20.0)
LENS = sd.fisheye((10, 48), magnification=3.0)
PATH = conformal.GroupPath(sd.MoebiusMap.identity(), LENS)
BALLS = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0)]

NOT_COPIED = {
    *("Answers", "Run"),  # of a folder with results: tests/partitioned
    *("FisheyeAxes", "GlobeWidget", "StereodelAccessor"),  # of matplotlib, Jupyter and xarray, which copy them
}


def examples():
    """An object of each class."""
    hull = sd.HullInsertion(BALLS)
    sphere, plane = sd.SphericalDelaunay.from_lonlat(LONLAT), sd.PlanarDelaunay(PLANE)
    linear = interpolation.LinearInterpolator(plane, range(5))
    scene = drawing.Scene()
    scene.add_points(BALLS)
    solid = scene.solid(drawing.View(20, 35))
    earth = globe.Globe()
    earth.add_land(resolution="110m")
    earth.add_points(LONLAT)
    earth.add_cells(sd.SphericalVoronoi(sphere))
    sketch = drawing.Sketch().add_segment((0, 0), (1, 1), name="ray")
    relaxed = relaxation.lloyd(PLANE, bounds=(-1, -1, 7, 7), steps=2)
    grid = io.Grid.regular(90)
    yield from (sd.Gnomonic((0, 90)), sd.Orthographic((0, 90)), sd.Stereographic((0, 90)), sd.RectangleLift(3.0, 2.0))
    yield from (CIRCLE, LENS, PATH, hull, next(iter(hull)), sphere, sd.SphericalVoronoi(sphere), plane)
    yield from (sd.PlaneCircle([1, 2], 3.0), sd.PlaneLine([0, 1], 2.0), sd.Rotation.about((0, 90), 30.0))
    yield from (sd.PlanarVoronoi(PLANE), sd.SphereArc.great((0, 0), (90, 0)), sd.Orthographic((0, 30)).image_of(CIRCLE))
    yield sd.check_delaunay(PLANE, plane.simplices)
    yield from (data.airports(), data.borders(), data.cities(), data.stars())
    of_land = (data.coastlines, data.countries, data.lakes, data.land, data.rivers)
    yield from (load("110m") for load in of_land)
    yield from (drawing.Ball((0.0, 0.0), 1.0), drawing.CircleArc.great([1, 0, 0], [0, 1, 0]), scene, sketch)
    yield from (drawing.ColorScale("viridis", 1.0, 2.0), drawing.SizeScale(2.0))
    yield from (drawing.DotStyle("red", 1.0), drawing.LineStyle("red", 1.0))
    yield from (drawing.Graticule.regular(10), drawing.Label("a", (0, 0)), drawing.Segment.between(*BALLS[:2]))
    yield from (drawing.View(1, 2, 3), drawing.StereographicView(1, 2), solid, *solid.scenes, solid.page)
    yield from (*solid.page.items, *sketch.page((0, 1, 0, 1)).items, *earth.page(None, drawing.View(0, 0)).items)
    yield from (film.Flight([film.Stop((0, 0)), film.Stop((9, 9))]), film.Stop((0, 0)), film.Spin())
    yield from (film.Morph(PATH, drawing.View(0, 0)), film.Film(len, ["a"], fps=1))
    yield from (earth, globe.Panel(earth), globe.Raster(np.zeros((2, 4), np.uint8)))
    yield from (interpolation.Contour(0.5, np.array(PLANE), False), linear, linear.weights([(1, 1)]))
    others = ("NearestInterpolator", "SmoothInterpolator", "NaturalNeighborInterpolator")
    yield from (getattr(interpolation, name)(plane, range(5)) for name in others)
    named = ("CloughTocher2DInterpolator", "LinearNDInterpolator", "NearestNDInterpolator")
    yield from (getattr(interpolation, name)(plane, range(5), 0.0) for name in named)
    yield io.Grid(grid.lon, grid.lat, {"v": np.ones((3, 4))}, {"v": "m"})
    yield io.inspect(StringIO("lon,lat\n1,2"))
    yield io.PointTable(LONLAT[:2], {"name": ["a", "b"], "v": np.array([1, None], dtype=object)}, rows=[4, 7])
    yield from (relaxed, relaxed.quality(), relaxation.Progress(1, 2.0, 3.0))
    yield from (spatial.Delaunay(PLANE), spatial.Voronoi(PLANE), spatial.SphericalVoronoi(BALLS))
    yield from (render.Figure("empty", dict, len, renderer="agg"), partitioned.Execution(jobs=2))


EXAMPLES = {type(example): example for example in examples()}


def same(one, other):
    """Whether two objects have the same contents, down to arrays."""
    if isinstance(one, np.ndarray):
        return (one.dtype, one.shape) == (other.dtype, other.shape) and np.array_equal(
            one, other, equal_nan=one.dtype == float
        )
    if isinstance(one, Mapping):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if type(one).__module__.startswith("stereodel.") and not isinstance(one, type):
        return type(one) is type(other) and same(contents(one), contents(other))
    return one == other or type(one).__module__ == "stereodel._kernel"


def contents(thing):
    """Attributes of an object: its fields, or what it holds."""
    if dataclasses.is_dataclass(thing):
        return {field.name: getattr(thing, field.name) for field in dataclasses.fields(thing)}
    if isinstance(thing, sd.PlanarDelaunay | sd.SphericalDelaunay):
        return {name: getattr(thing, name) for name in ("points", "simplices", "neighbors", "duplicates", "latitude")}
    return getattr(thing, "__dict__", {})


def test_there_is_an_example_of_every_class():
    public = {getattr(package, name) for package in PACKAGES.values() for name in names.public_names(package)}
    classes = {thing for thing in public if inspect.isclass(thing) and not issubclass(thing, Exception | enum.Enum)}
    assert {thing.__name__ for thing in classes - EXAMPLES.keys()} == NOT_COPIED


@pytest.mark.parametrize("kind", EXAMPLES, ids=lambda kind: kind.__name__)
def test_an_object_comes_back(kind):
    thing = EXAMPLES[kind]
    for again in (pickle.loads(pickle.dumps(thing)), copy.copy(thing), copy.deepcopy(thing)):
        assert type(again) is kind
        assert same(contents(thing), contents(again))


def test_what_is_read_only_stays_so():
    for thing in (EXAMPLES[io.PointTable], EXAMPLES[io.Grid]):
        again = pickle.loads(pickle.dumps(thing))
        values = again.columns if isinstance(again, io.PointTable) else again.values
        with pytest.raises(TypeError):
            values["v"] = 1
        assert not values["v"].flags.writeable


VALUES = {
    "MoebiusMap": lambda x: sd.fisheye((0, 40), magnification=x),
    "GroupPath": lambda x: conformal.GroupPath(LENS, sd.fisheye((0, 40), magnification=x)),
    "SphereCircle": lambda x: sd.SphereCircle((0, 0, 1), x / 4),
    "SphereArc": lambda x: sd.SphereArc.whole(sd.SphereCircle((0, 0, 1), x / 4)),
    "Rotation": lambda x: sd.Rotation.about((0, 90), x),
    "RectangleLift": lambda x: sd.RectangleLift(x, 1.0),
    "Stereographic": lambda x: sd.Stereographic((10, 20), radius=x, plane="equatorial"),
    "Gnomonic": lambda x: sd.Gnomonic((x, 2)),
    "Orthographic": lambda x: sd.Orthographic((x, 2)),
    "Conic": lambda x: sd.Orthographic((0, 0)).image_of(sd.SphereCircle.around((10, 20), 30 * x)),
    "PlaneCircle": lambda x: sd.PlaneCircle([0.0, 1.0], x),
    "PlaneLine": lambda x: sd.PlaneLine([0.0, 1.0], x),
    "Contour": lambda x: interpolation.Contour(1.0, [[0.0, 0.0], [1.0, x]], False),
}


@pytest.mark.parametrize("make", VALUES.values(), ids=VALUES)
def test_values_are_equal_and_hash_alike(make):
    one, same, other = make(1.0), make(1.0), make(2.0)
    assert one.__dataclass_params__.frozen
    assert one == same
    assert one != other
    assert one != "one"
    assert len({one, same, other}) == 2


def test_values_cannot_be_changed():
    made = {name: VALUES[name](1.0) for name in ("Conic", "Contour", "Rotation")}
    for array in (made["Conic"].center, made["Contour"].points, made["Rotation"].quaternion):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 5.0
    with pytest.raises(AttributeError):
        PATH.start = PATH.end
