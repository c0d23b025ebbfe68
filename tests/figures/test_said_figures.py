"""What the pictures of what the paper says and does not draw show: computed once more, in another way."""

import re

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from stereodel import PlanarDelaunay, SphereCircle, SphericalDelaunay, Stereographic, fisheye
from stereodel.conformal import three_points
from stereodel.drawing import Fill
from stereodel.drawing.scene.sketch import arc_through
from stereodel.sphere import angular_distance, great_circle_points
from tests.figures.scripts import arc_points, geometry, page, path_points, script


def over_chord(points, a, b):
    """Points of the plane as complex numbers, a chord from 0 to 1 being the unit."""
    return ((points - a) @ [1, 1j]) / ((b - a) @ [1, 1j])


def test_edges_and_their_images_coincide_only_through_the_point_of_contact():
    module, g = script("claim_edges"), geometry("claim_edges")
    projection = Stereographic((0, -90), radius=module["RADIUS"])
    own = {frozenset(pair) for pair in SphericalDelaunay(g["lifts"]).edges.tolist()}
    for (i, j), middle, bent in zip(g["edges"].tolist(), g["middles"], g["bent"], strict=True):
        assert {i, j} in own
        a, b = g["sites"][[i, j]]
        drawn = over_chord(path_points(arc_through(a, middle, b), 500), a, b)
        true = over_chord(projection.forward(great_circle_points(*g["lifts"][[i, j]], 33)), a, b)
        assert np.abs(drawn[:, None] - true).min(axis=0).max() < 3e-3
        assert (np.abs(true.imag).max() > 1e-3) == (np.abs(drawn.imag).max() > 1e-3) == bent
        assert bent == np.hypot(*g["sites"][[i, j]].T).all()


def test_lifts_of_segments_are_arcs_of_circles_through_the_pole():
    module, g = script("claim_edges"), geometry("claim_edges")
    projection = Stereographic((0, -90), radius=module["RADIUS"])
    for points, (a, b) in zip(arc_points(g["lifted"]), g["sites"][g["edges"]], strict=True):
        along = over_chord(projection.forward(points), a, b)
        assert along.imag == pytest.approx(0, abs=1e-12)
        assert (np.diff(along.real) > 0).all()
        normal = np.cross(points[8] - points[0], points[16] - points[0])
        assert (np.array([0, 0, 1]) - points[0]) @ normal == pytest.approx(0, abs=1e-12)


def test_the_larger_bubble_of_the_tinted_facet_is_empty_and_the_hull_is_beside_the_centre():
    g = geometry("claim_closing")
    *normal, offset = g["circle"]
    heights, corners = g["sites"] @ normal - offset, g["facets"][g["shown"]]
    assert heights[corners] == pytest.approx(0, abs=1e-14)
    assert np.delete(heights, corners).max() < -0.01
    assert -0.9 < offset < -0.2  # the empty side, beyond the centre, is larger than a hemisphere
    hull = ConvexHull(g["sites"])
    assert hull.equations[:, 3].max() == pytest.approx(-offset, rel=1e-12)  # the centre is above this facet
    assert {frozenset(facet) for facet in g["facets"].tolist()} == {frozenset(f) for f in hull.simplices.tolist()}


def test_angles_of_one_colour_are_equal_and_p_lies_on_all_circles_that_the_proof_speaks_of():
    g = geometry("claim_inscribed")
    ends = {"-": g["N"] - [1, 0, 0], "+": g["N"] + [1, 0, 0]}
    for angles in script("claim_inscribed")["ANGLES"].values():
        arms = [[(g | ends)[name] for name in re.findall(".'?", angle)] for angle in angles]
        assert len({float(angular_distance(a - vertex, b - vertex).round(9)) for vertex, a, b in arms}) == 1
    projection, normal = Stereographic((0, -90)), np.cross(g["B"] - g["A"], [0, 1, 0])
    circle = SphereCircle(normal, normal @ g["A"] / np.linalg.norm(normal))
    image = projection.image_of(circle)
    center = projection.in_space(image.center)
    assert center == pytest.approx((g["A'"] + g["B'"]) / 2, abs=1e-12)
    assert np.linalg.norm(g["P"] - center) == pytest.approx(image.radius, rel=1e-12)
    ray = g["P"] - g["N"]
    assert (g["N"] - 2 * (g["N"] @ ray) / (ray @ ray) * ray) @ circle.normal == pytest.approx(circle.offset, abs=1e-12)
    assert np.linalg.norm(g["P"] - (g["D"] + g["E"]) / 2) == pytest.approx(np.linalg.norm(g["E"] - g["D"]) / 2)
    assert np.cross(g["E"] - g["D"], g["B"] - g["A"]) == pytest.approx(0, abs=1e-12)


def test_signs_are_wrong_in_the_strip_alone_and_nowhere_after_the_lift():
    module, g = script("claim_signs"), geometry("claim_signs")
    square = (g["grid"] ** 2).sum(axis=1)
    assert (np.abs(square - 1) > 1e-4).all()  # so that which are above the plane is known without any test
    for kinds in g["kinds"]:
        assert (square[kinds == 0] < 1).all()
        assert (square[kinds == 1] > 1).all()
    for kinds, size in zip(g["kinds"][:2], module["SIZES"], strict=False):
        heights = size**2 * np.abs(1 - square) / 2
        assert heights[kinds < 2].min() > 0.5 * module["STRIP"]
        assert heights[kinds == 3].max() < module["STRIP"] < 2 * heights[kinds == 2].max()
    uncertain = (g["kinds"] >= 2).sum(axis=1) / len(square)
    assert uncertain[2:].tolist() == [1, 0]
    assert (np.diff(uncertain[:3]) > 0.05).all()
    texts = [label.text for label in page("claim_signs").labels if "wrong" in label.text][:4]
    assert [int(text.split()[0]) for text in texts] == (g["kinds"] == 3).sum(axis=1).tolist()
    assert 0.1 < (g["kinds"][2] == 3).mean() < 0.5
    assert (g["flat"].max(axis=1) / module["THICK"]).tolist() == pytest.approx(
        module["SIZES"] ** 2 / 2 / module["STRIP"]
    )


def test_the_grid_in_the_bubble_is_perpendicular_to_its_rim_and_becomes_the_polar_one():
    module, g = script("claim_interior"), geometry("claim_interior")
    bubble, (p, c), (south, other) = module["BUBBLE"], g["bubble_points"], g["hemisphere_points"]
    assert south == pytest.approx([0, 0, -1], abs=1e-14)
    assert p @ c > bubble.offset
    assert p @ c < 0.9
    assert other[2] > -0.9
    inside, on_hemisphere = arc_points(g["bubble_sides"]), arc_points(g["hemisphere_sides"])
    assert (inside @ bubble.normal > bubble.offset - 1e-12).all()
    assert (on_hemisphere[..., 2] < 1e-12).all()
    # One map has these images of p, of c and of a point of the rim; it is that of all points.
    conformal = three_points([p, c, inside[0, 0]], [south, other, on_hemisphere[0, 0]])
    assert conformal(inside[:, ::32]) == pytest.approx(on_hemisphere[:, ::32], abs=1e-12)
    parallels = conformal(inside[::2])[..., 2]
    assert np.ptp(parallels, axis=1) == pytest.approx(0, abs=1e-9)
    # Meridians: their circles hold p, and they meet the rim at right angles.
    axes = np.cross(inside[1::4, 16] - inside[1::4, 0], inside[1::4, 32] - inside[1::4, 0])
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    offsets = (axes * inside[1::4, 0]).sum(axis=1)
    assert axes @ p == pytest.approx(offsets, abs=1e-9)
    assert axes @ bubble.normal == pytest.approx(offsets * bubble.offset, abs=1e-9)  # perpendicular circles


def test_the_map_of_the_patch_is_the_composition_of_the_lenses_everywhere():
    module, g = script("claim_rigid"), geometry("claim_rigid")
    found, places = three_points(g["points"], g["images"]), np.random.default_rng(7).normal(size=(200, 3))
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    assert angular_distance(places, module["PATCH"].center).max() > 160
    once, scale = places, 1.0
    for focus, magnification in module["LENSES"]:
        lens = fisheye(focus, magnification=magnification)
        once, scale = lens(once), scale * lens.scale_factor(once)
    assert found(places) == pytest.approx(once, abs=1e-12)
    assert found.scale_factor(places) == pytest.approx(scale, rel=1e-10)
    assert found.inverse()(once) == pytest.approx(places, abs=1e-12)
    # The mirror image: the same on the equator, and nowhere else.
    apart = angular_distance(found(places), found(places * [1, 1, -1]))
    assert (apart > 0.5 * np.degrees(np.abs(places[:, 2]) * scale)).all()
    equator = module["EQUATOR"].sample(50)
    assert found(equator * [1, 1, -1]).tolist() == found(equator).tolist()


def test_each_still_follows_from_the_one_before():
    g = geometry("claim_steps")
    points, new = g["points"], g["points"][g["inserted"]]

    def rows(facets):
        return {tuple(np.roll(row, -np.argmin(row))) for row in np.asarray(facets).tolist()}

    def heights(facets, place):
        a, b, c = np.moveaxis(points[np.asarray(facets)], 1, 0)
        return ((place - a) * np.cross(b - a, c - a)).sum(axis=1)

    seen = heights(g["before"], new) > 0
    assert rows(g["before"][seen]) == rows(g["visible"])
    sides = {(a, b) for row in g["visible"].tolist() for a, b in zip(row, np.roll(row, -1), strict=True)}
    assert {tuple(pair) for pair in g["horizon"].tolist()} == {(a, b) for a, b in sides if (b, a) not in sides}
    after = np.vstack([g["before"][~seen], g["new"]])
    used = np.unique(g["before"])
    assert rows(g["new"]) == rows([(a, b, g["inserted"]) for a, b in g["horizon"]])
    assert all((heights(after, points[other]) < 1e-15).all() for other in used)  # so normals point away from the hull
    used = np.append(used, g["inserted"])
    assert rows(after) == rows(used[SphericalDelaunay(points[used]).simplices])
    assert rows(g["last"]) == rows(SphericalDelaunay(points).simplices)
    names = [item.name for item in page("claim_steps").items if isinstance(item, Fill)]
    assert [names.count(kind) for kind in ("visible", "shade")] == [len(g["visible"]), 1]
    assert names.count("new") == 2 * len(g["new"])


def test_no_least_angle_is_larger_than_that_of_delaunay():
    module, g = script("claim_angles"), geometry("claim_angles")
    texts = [label.text for label in page("claim_angles").labels if " with an angle " in label.text]
    count = len(PlanarDelaunay(g["points"]).simplices)
    least = []
    for name, text in zip(module["COLORS"], texts, strict=True):
        triangles = g[f"{name}_triangles"]
        a, b, c = np.moveaxis(g["points"][triangles] @ [1, 1j], 1, 0)
        doubled = ((b - a).conj() * (c - a)).imag
        assert (doubled > 0).all()
        assert doubled.sum() == pytest.approx(2 * 3.0 * 2.0)
        sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        assert np.unique(sides, axis=0, return_counts=True)[1].max() == 2
        angles = np.abs(np.angle([(b - a) / (c - a), (c - b) / (a - b), (a - c) / (b - c)], deg=True)).min(axis=0)
        assert np.sort(angles) == pytest.approx(g[f"{name}_angles"], abs=1e-9)
        assert re.findall(r"\d+", text) == [str((angles < 10).sum()), str(count), "10"]
        assert len(triangles) == count
        least.append(angles.min())
    assert least[0] == max(least) > 1 > 100 * least[2]
    assert g["points"].tolist() == geometry("claim_terrain")["points"].tolist()
