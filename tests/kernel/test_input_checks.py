"""The kernel's own border, for callers that are not our Python: what would give nonsense or crash is refused."""

import itertools
from operator import attrgetter

import numpy as np
import pytest

from stereodel import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, _kernel
from stereodel._spaces import space_of
from tests.refused import refused

RNG = np.random.default_rng(0)
PLANE, SPHERE = PlanarDelaunay(RNG.normal(size=(12, 2))), SphericalDelaunay(RNG.normal(size=(12, 3)))
CELLS = PlanarVoronoi(PLANE), SphericalVoronoi(SPHERE)
NONE = np.zeros((0, 2), dtype=np.int32)
EYE = np.vstack([np.eye(3)] * 2)


def triangles(t):
    return {"points": t.points, "simplices": t.simplices, "neighbors": t.neighbors}


def cells(diagram):
    names = "offsets", "vertices", "neighbors", "vertex_count"
    return {"points": diagram.points, **dict(zip(names, diagram._cells(), strict=True))}


def boxes(t):
    """A tree over boxes of blocks that were not read."""
    space = space_of(t.points)
    _, _, lows, highs = space.blocks(t.points, 5)
    lows, highs, first = space.box_tree(lows, highs)
    unread = _kernel.unread_counts(np.ones(first[1], bool), first)
    return {"lows": lows, "highs": highs, "first": first, "unread": unread}


def calls():
    """Name of the function, arguments that are right; from them wrong ones are made."""
    for place, t, d in (("plane", PLANE, CELLS[0]), ("sphere", SPHERE, CELLS[1])):
        queries = {"queries": t.points[:3] + 0.01}
        yield f"{place}.triangulate", {"points": t.points}
        yield f"{place}.Mesh", triangles(t)
        yield f"{place}.voronoi", triangles(t)
        yield f"{place}.find_simplex", triangles(t) | queries
        yield f"{place}.nearest", triangles(t) | queries
        yield f"{place}.k_nearest", triangles(t) | {"duplicates": NONE} | queries | {"k": 2}
        yield f"{place}.proximity", triangles(t) | {"graph": "gabriel"}
        yield f"{place}.spanning_tree", {"points": t.points, "edges": t.edges}
        yield f"{place}.compare_lengths", {"points": t.points, "numbers": np.full((2, 4), 11, dtype=np.int32)}
        yield f"{place}.diametral", {"points": t.points, "numbers": np.full((2, 3), 11, dtype=np.int32)}
        yield f"{place}.cell_areas", cells(d) | {"order": d._order}
        yield f"{place}.cell_centroids", cells(d) | {"order": d._order}
        yield f"{place}.delaunay_of", cells(d) | {"simplex_vertex": d.simplex_vertex}
        yield f"{place}.circumcenters", {"points": t.points, "triangles": t.simplices}
        rows = dict(zip("abcp" if place == "sphere" else "abcd", t.points[:12].reshape(4, 3, -1).copy(), strict=True))
        yield f"{place}.in_circle", rows
        ids = {"duplicates": NONE, "ids": np.arange(12)}
        yield f"{place}.part_of", {"points": t.points, "axis": np.zeros(1, np.int32), "value": np.zeros(1)}
        yield f"{place}.blocks", {"points": t.points, "size": 5}
        yield f"{place}.open_bubbles", {"points": t.points, "faces": t.simplices} | boxes(t)
        yield f"{place}.open_discs", {"centers": t.points, "rims": t.points[::-1].copy()} | boxes(t)
        yield f"{place}.open_targets", triangles(t) | queries | boxes(t) | {"natural": True}
        yield f"{place}.final_cells", triangles(t) | ids | {"rows": np.arange(12, dtype=np.int32)}
        final = ids | {"final": np.ones(12, bool)}
        yield f"{place}.final_triangles", {"points": t.points, "simplices": t.simplices} | final
        if place == "plane":
            yield "plane.natural_neighbors", triangles(t) | {"values": np.zeros((12, 1))} | queries
            yield "plane.natural_neighbor_weights", triangles(t) | queries
    yield "plane.turn", dict(zip("abc", PLANE.points.reshape(3, 4, -1).copy(), strict=True))
    yield "orient3d", dict(zip("abcd", SPHERE.points.reshape(4, 3, -1).copy(), strict=True))
    yield "sphere.closing", {"points": SPHERE.points, "simplices": SPHERE.simplices}
    units = {"units": SPHERE.points, "rests": 0 * SPHERE.points}
    asked = {"queries": SPHERE.points, "query_units": SPHERE.points, "query_rests": 0 * SPHERE.points}
    yield "sphere.natural_neighbors", triangles(SPHERE) | units | {"values": np.zeros((12, 1))} | asked
    yield "sphere.natural_neighbor_weights", triangles(SPHERE) | units | asked
    yield "lonlat_to_xyz", {"lonlat": PLANE.points}
    yield "xyz_to_lonlat", {"xyz": SPHERE.points}
    quaternion, vector = np.eye(2, 4), np.eye(2, 3)
    yield "rotation_product", {"then": quaternion, "first": quaternion}
    yield "rotation_between", {"start": vector, "end": vector}
    yield "rotation_matrix", {"quaternion": quaternion}
    yield "rotated", {"matrix": EYE, "vectors": SPHERE.points}
    for name in ("moebius_images", "moebius_scales"):
        yield name, {"left": EYE, "magnification": 2.0, "right": EYE, "xyz": SPHERE.points}


def flat_calls():
    """The same for points of a line and directions of a great circle, of which not all need be in the order."""
    steps = np.arange(5.0)
    for place, points in (
        ("plane", np.column_stack([steps, 2 * steps])),
        ("sphere", np.column_stack([np.cos(steps), np.sin(steps), 0 * steps])),
    ):
        right = {"points": points, "order": np.arange(5, dtype=np.int32)}
        yield f"{place}.nearest_flat", right | {"duplicates": NONE, "queries": points, "k": 2}
        for name in ("flat_diagram", "flat_areas", "flat_centroids")[: 1 if place == "plane" else 3]:
            yield f"{place}.{name}", right


CALLS = dict(calls())
EACH = pytest.mark.parametrize(("name", "right"), CALLS.items(), ids=CALLS)
ORDERED = dict(flat_calls()) | {name: right for name, right in CALLS.items() if "order" in right}
UNCHECKED = {"values", "value", "lows", "highs"}  # boxes that are not finite touch all bubbles
VECTORS = {*"abcp", "points", "centers", "rims", "queries", "units", "query_units", "xyz"}
ANSWERED = {"moebius_images", "moebius_scales"}  # which tell by a flag that a row has no image


def call(name, arguments):
    return attrgetter(name)(_kernel)(**arguments)


def with_entry(array, place, value):
    changed = np.array(array)
    changed[place] = value
    return changed


@EACH
def test_right_arguments_are_accepted_and_numbers_that_are_not_finite_refused(name, right):
    call(name, right)
    for key, array in right.items():
        answered = key == "xyz" and name in ANSWERED
        if key in UNCHECKED or answered or not isinstance(array, np.ndarray) or array.dtype != float:
            continue
        shown = key if key not in ("left", "right") else "rotation"
        for value, place in itertools.product((np.nan, np.inf, -np.inf), ((0, 0), (-1, -1))):
            row = place[0] % len(array)
            with pytest.raises(ValueError, match=rf"{shown}\[{row}, \d\] is -?(nan|inf), not a finite number"):
                call(name, right | {key: with_entry(array, place, value)})


@EACH
def test_vectors_without_a_direction_are_refused(name, right):
    for key, array in right.items():
        if key in VECTORS and array.shape[1] == 3 and name not in {*ANSWERED, "orient3d"}:
            with pytest.raises(ValueError, match=rf"{key}\[2\] is the zero vector"):
                call(name, right | {key: with_entry(array, 2, -0.0)})
            small = [0.0, 5e-324, 0.0]
            if key == "points" and name in ("sphere.triangulate", "sphere.circumcenters"):
                call(name, right | {key: with_entry(array, 2, small)})


@EACH
def test_numbers_of_what_is_not_there_are_refused(name, right):
    for key, array in right.items():
        if key not in {"simplices", "neighbors", "vertices", "triangles", "edges", "numbers", "order"}:
            continue
        open_border = key == "neighbors" and "plane" in name.lower() and "offsets" not in right
        least = -2 if open_border or key == "vertices" else -1
        for value, end in itertools.product((least, 10_000, 2**31 - 1, -(2**31)), (0, -1)):
            with pytest.raises(ValueError, match=r"out of range|not those of|each site with entries|does not fit"):
                call(name, right | {key: with_entry(array, (end,) * array.ndim, value)})


@pytest.mark.parametrize("name", ORDERED)
def test_orders_that_hold_a_site_twice_are_refused(name):
    """Whose cells would not be written, or be written twice at a time."""
    right = ORDERED[name]
    order = right["order"]
    call(name, right)
    for place, value in ((1, order[0]), (-1, order[2])):
        with pytest.raises(ValueError, match=rf"order\[{place % len(order)}\] is {value} a second time"):
            call(name, right | {"order": with_entry(order, place, value)})
    with pytest.raises(ValueError, match=r"order\[\d+\] is \d+, out of range"):
        call(name, right | {"order": with_entry(order, 0, 99)})
    with pytest.raises(ValueError, match=r"order\[\d+\] is \d+ a second time"):
        call(name, right | {"order": np.concatenate([order, order])})


@pytest.mark.parametrize("name", [name for name, right in CALLS.items() if {"simplices", "neighbors"} <= set(right)])
def test_triangles_and_neighbors_that_do_not_fit_are_refused(name):
    """Numbers that are there, but not beyond that edge: to turn around a point would never end."""
    right = CALLS[name]
    inside = np.argwhere(right["neighbors"] >= 0)
    for place in map(tuple, inside[[0, 5, -1]]):
        for wrong in {0, 3, len(right["simplices"]) - 1} - {int(right["neighbors"][place])}:
            with pytest.raises(ValueError, match="does not fit"):
                call(name, right | {"neighbors": with_entry(right["neighbors"], place, wrong)})
        with pytest.raises(ValueError, match=r"does not fit|closed surface"):
            call(name, right | {"neighbors": with_entry(right["neighbors"], place, -1)})
    for key in ("simplices", "neighbors"):
        with pytest.raises(ValueError, match="does not fit"):
            call(name, right | {key: right[key][::-1].copy()})


@EACH
def test_arrays_of_other_lengths_are_refused(name, right):
    """Each array that has to fit others, shortened: it is refused for its length or for what it no longer holds."""
    alone = {"queries", "duplicates", "edges", "numbers", "triangles", "xyz", "lonlat", "faces", "rows", "vectors"}
    keys = [k for k, a in right.items() if isinstance(a, np.ndarray) and k not in alone]
    if "simplices" in keys and "neighbors" not in keys:
        keys.remove("simplices")
    for key in keys:
        if key == "points" and name.endswith(("triangulate", "part_of", "blocks")):
            continue
        said = r"length|has \d rows|out of range|not those|each site with|(six|two) rows|not that|what box_tree gives"
        with pytest.raises(ValueError, match=said):
            call(name, right | {key: right[key][:-1]})


def test_changes_of_a_mesh():
    for cls, t in ((_kernel.plane.Mesh, PLANE), (_kernel.sphere.Mesh, SPHERE)):
        mesh = cls(t.points, t.simplices, t.neighbors)
        with pytest.raises(ValueError, match=r"points\[1, 0\] is nan"):
            mesh.insert(with_entry(t.points, (1, 0), np.nan))
        with pytest.raises(ValueError, match=r"indices\[1\] is 12, out of range"):
            mesh.remove(np.array([0, 12], dtype=np.int32))
        assert mesh.size == 12
        assert np.array_equal(mesh.read()[2], t.simplices)
    with pytest.raises(ValueError, match=r"points\[0\] is the zero vector"):
        mesh.insert(np.zeros((1, 3)))


@pytest.mark.parametrize("name", sorted(ANSWERED))
def test_points_without_an_image_are_told_by_a_flag(name):
    for row in (0.0, np.nan, np.inf):
        assert call(name, CALLS[name])[1]
        assert not call(name, CALLS[name] | {"xyz": with_entry(SPHERE.points, 3, row)})[1]


def numbers(*rows):
    return np.array(rows, dtype=np.int32)


PLACE, NO_TRIANGLES = numbers(*range(len(PLANE.simplices))), np.zeros((0, 3), dtype=np.int32)
NO_RIDGES = {"offsets": np.zeros(0, np.int64), "vertices": numbers(), "neighbors": numbers(), "vertex_count": 0}
test_other_arguments = refused(
    *(("sphere.triangulate", {"axis": k, "sign": sign}, "axis") for k, sign in ((3, 1), (-1, 1), (0, 0), (0, 2))),
    *(
        ("moebius_images", {"magnification": size}, "magnification must be")
        for size in (0.0, -1.0, np.nan, np.inf, 1e101, 1e-101)
    ),
    ("plane.circumcenters", {"place": with_entry(PLACE, 3, 1)}, r"place\[3\] is 1 a second time"),
    ("plane.circumcenters", {"place": with_entry(PLACE, 3, len(PLACE))}, r"place\[3\] is \d+, out of range"),
    ("plane.circumcenters", {"place": PLACE[:-1]}, "place and triangles must have the same length"),
    *(("plane.open_bubbles", {"faces": numbers(face)}, "faces") for face in ((0, 1, 3000), (-1, 0, 1), (0, 1, -2))),
    ("sphere.open_bubbles", {"faces": numbers((0, 1, -1))}, "faces"),
    ("plane.blocks", {"size": 0}, "size"),
    ("plane.part_of", {"axis": numbers(2)}, "axis"),
    ("plane.part_of", {"axis": numbers(0, 0)}, "axis"),
    ("plane.Mesh", {"duplicates": numbers((3, 20))}, "dropped, kept"),
    ("plane.nearest", dict.fromkeys(("simplices", "neighbors"), NO_TRIANGLES), "no triangles"),
    ("plane.nearest_flat", {"order": numbers()}, "must hold a point"),
    ("plane.nearest_flat", {"order": numbers(-1, 1), "k": 1}, "out of range"),
    ("plane.nearest_flat", {"order": numbers(1)}, "every point"),
    ("plane.nearest_flat", {"k": 0}, "k must be"),
    ("plane.nearest_flat", {"k": 6}, "k must be"),
    ("sphere.flat_order", {"points": np.eye(3)}, "must lie on one great circle"),
    ("sphere.flat_order", {"points": np.array([[1, 0, 0], [0, 1, 0], [1, 1, 1e-300]])}, "must lie on one great circle"),
    ("vector_angles", {"y": np.zeros(2), "x": np.zeros(3)}, "one length"),
    ("voronoi_ridges", NO_RIDGES, "offsets"),
    call=lambda name, wrong: call(name, {**CALLS, **ORDERED}.get(name, {}) | wrong),
)


@pytest.mark.parametrize("place", [0, 4, 8])
def test_maps_of_other_numbers_are_refused(place):
    right = np.array([1.0, 0.0, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0])
    wrong = [
        (with_entry(right, place, np.nan), rf"\[{place}\] is nan, not a finite number"),
        (right[:-1], "nine numbers"),
        (with_entry(right, 4, 0.0), "magnification must be"),
        (with_entry(right, 5 * (place > 4), 0.0), "a quaternion of a map is zero"),
    ]
    for numbers, said in wrong:
        for arguments in ((numbers, right), (right, numbers)):
            with pytest.raises(ValueError, match=said):
                _kernel.moebius_product(*arguments)
        with pytest.raises(ValueError, match=said):
            _kernel.moebius_element(numbers)
    element = _kernel.moebius_element(right)[:4].copy()
    with pytest.raises(ValueError, match="four rows"):
        _kernel.moebius_decomposed(element[:3])
    with pytest.raises(ValueError, match=r"element\[2, 1\] is inf"):
        _kernel.moebius_decomposed(with_entry(element, (2, 1), np.inf))


@pytest.mark.parametrize("size", [1, 2, 3, 7, 8, 9, 1000, 4097])
def test_every_place_of_long_arrays_is_seen(size):
    """Loops in vector registers have rests: a wrong number in the first, the middle or the last row."""
    points = RNG.normal(size=(size, 3))
    for row in {0, size // 2, size - 1}:
        with pytest.raises(ValueError, match=rf"points\[{row}, 1\] is nan"):
            _kernel.sphere.triangulate(with_entry(points, (row, 1), np.nan))
        with pytest.raises(ValueError, match=rf"points\[{row}\] is the zero vector"):
            _kernel.sphere.triangulate(with_entry(points, row, 0.0))
        with pytest.raises(ValueError, match=rf"points\[{row}, 1\] is inf"):
            _kernel.plane.triangulate(with_entry(points[:, :2], (row, 1), np.inf))
