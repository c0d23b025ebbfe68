"""Well-known binary by NumPy is that of Shapely."""

import numpy as np
import pytest
import shapely

from stereodel.curves.ragged import Ragged
from stereodel.io.formats import wkb

RNG = np.random.default_rng(3)
GEOMETRIES = [
    shapely.Point(1, 2),
    shapely.Point(1, 2, 3),
    shapely.LineString([(0, 0), (1, 1)]),
    shapely.box(0, 0, 1, 1),
    shapely.MultiPoint([(0, 0), (1, 1)]),
    shapely.MultiLineString([[(0, 0), (1, 1)]]),
    shapely.MultiPolygon([shapely.box(0, 0, 1, 1)]),
]


def binary(geometries):
    return np.asarray(shapely.to_wkb(geometries, byte_order=1, flavor="iso"), dtype=object)


def test_points_and_polygons_are_written_as_by_shapely():
    places = np.concatenate([RNG.normal(size=(20, 2)) * 1e3, [[-0.0, 1e-310]]])
    assert wkb.points(places).tolist() == binary(shapely.points(places)).tolist()
    assert wkb.points(places[:0]).shape == (0,)
    rings = Ragged.of([RNG.normal(size=(size, 2)) for size in (3, 5, 4, 3)])
    assert wkb.polygons(rings).tolist() == binary([shapely.Polygon(ring) for ring in rings]).tolist()


def test_points_of_any_length_are_read():
    places = RNG.normal(size=(3, 2))
    cells = [*wkb.points(places[:1]), *binary(shapely.points(np.column_stack([places, places[:, :1]])))[1:]]
    offsets = np.cumsum([0, *map(len, cells)])
    assert np.array_equal(wkb.xy(np.frombuffer(b"".join(cells), np.uint8), offsets, range(1, 4)), places)


@pytest.mark.parametrize("other", [binary([GEOMETRIES[2]])[0], b"\1\1\0\0", bytes([0, 0, 0, 0, 1]) + bytes(16)])
def test_another_geometry_is_refused_with_its_row(other):
    cells = [*wkb.points(np.ones((2, 2))), other]
    with pytest.raises(ValueError, match="row 13: a Point is needed"):
        wkb.xy(np.frombuffer(b"".join(cells), np.uint8), np.cumsum([0, *map(len, cells)]), [11, 12, 13])


def test_kinds_and_parts_are_those_of_shapely():
    cells = np.array([*binary(GEOMETRIES), None], dtype=object)
    names = ["Point", "LineString", "Polygon", "MultiPoint", "MultiLineString", "MultiPolygon", "Point Z"]
    assert wkb.kinds(cells) == names
    assert wkb.is_there(cells).tolist() == [True] * 7 + [False]
    *found, nothing = wkb.several(cells[[0, 2, 3, 4, 5, 6, 7]])
    assert nothing is None
    plain = [GEOMETRIES[k] for k in (0, 2, 3)]
    of_one = [shapely.MultiPoint, shapely.MultiLineString, shapely.MultiPolygon]
    expected = [kind([geometry]) for kind, geometry in zip(of_one, plain, strict=True)] + GEOMETRIES[4:]
    assert shapely.from_wkb(found).tolist() == expected
