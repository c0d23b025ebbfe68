"""What each figure shows is what the paper says of it: statements about the drawn geometry, figure by figure."""

import runpy
import sys
from pathlib import Path

import numpy as np
import pytest

from stereodel import MoebiusMap, PlanarDelaunay, SphericalDelaunay, Stereographic, fisheye, lonlat_to_xyz
from stereodel.drawing import View
from stereodel.sphere import angular_distance, graticule
from stereodel.triangulation import check_delaunay

FOLDER = Path(__file__).parents[2] / "figures"
ROWS = ("fig10_earth", "fig11_fisheye4", "fig12_fisheye20")


def script(name):
    sys.path.insert(0, str(FOLDER))
    try:
        return runpy.run_path(str(FOLDER / f"{name}.py"))
    finally:
        sys.path.remove(str(FOLDER))


def geometry(name):
    return script(name)["geometry"]() if name not in ROWS else script(name)["FIGURE"].geometry()


def arc_points(rows, steps=33):
    """Points (n, steps, 3) of arcs given as centre, two radii and sweep."""
    t = np.linspace(0, 1, steps)[None, :, None] * rows[:, None, 9:]
    return rows[:, None, 0:3] + np.cos(t) * rows[:, None, 3:6] + np.sin(t) * rows[:, None, 6:9]


def test_figure_1_shows_dual_graphs():
    g = geometry("fig01_sphere")
    n = len(g["sites"])
    assert len(g["edges"]) == len(g["ridges"]) == 3 * n - 6
    assert len(g["vertices"]) == 2 * n - 4
    check_delaunay(SphericalDelaunay(g["sites"]))
    # A Voronoi vertex has no site nearer than the three that it belongs to.
    nearest = np.sort(angular_distance(g["vertices"][:, None], g["sites"][None]), axis=1)
    assert np.allclose(nearest[:, 0], nearest[:, 2], atol=1e-9)
    assert (nearest[:, 3] > nearest[:, 2] + 1e-9).all()


def test_figure_2_ridges_are_perpendicular_bisectors_inside_the_frame():
    module = script("fig02_plane")
    g = module["geometry"]()
    left, bottom, right, top = module["FRAME"]
    assert (g["ridges"] >= [left, bottom]).all()
    assert (g["ridges"] <= [right, top]).all()
    middles = g["ridges"].mean(axis=1)
    distances = np.sort(np.linalg.norm(middles[:, None] - g["sites"][None], axis=-1), axis=1)
    assert np.allclose(distances[:, 0], distances[:, 1], atol=1e-9)


def test_figure_5_points_images_and_centre_of_projection_are_on_one_line():
    g = geometry("fig05_projections")
    for name in ("normal", "oblique"):
        tangent, points, images = (g[f"{name}_{key}"] for key in ("tangent", "points", "images"))
        rays, lines = points + tangent, images + tangent
        assert np.allclose(np.cross(rays, lines), 0, atol=1e-12)
        assert np.allclose(images @ tangent, 1.0)
        center, u, v = g[f"{name}_image_circle"]
        assert np.allclose(np.linalg.norm(images - center, axis=1), np.linalg.norm(u))
        assert np.isclose(u @ v, 0, atol=1e-12)


def test_figure_6_smaller_spheres_have_larger_extents():
    module = script("fig06_sphere_size")
    g = module["geometry"]()
    expected = 4 * np.degrees(np.arctan(module["HALF_LENGTH"] / (2 * np.array(module["RADII"]))))
    assert np.allclose(g["extents"], expected)
    assert (np.diff(g["extents"]) > 0).all()
    for radius, ends in zip(module["RADII"], g["lifted"], strict=True):
        assert np.allclose(np.linalg.norm(ends - [0, radius], axis=1), radius)


def test_figures_7_and_8_share_sites_and_the_corners_land_on_the_equator():
    plane, ball = geometry("fig07_rectangle"), geometry("fig08_hemisphere")
    sphere = Stereographic((0, -90), radius=float(ball["radius"]))
    assert np.allclose(sphere.forward(ball["lifted"]), plane["sites"], atol=1e-14)
    assert np.array_equal(plane["edges"], ball["edges"])
    assert np.isclose(4 * plane["radius"], np.hypot(3, 2))
    corners = arc_points(ball["sides"])[:, [0, -1], 2]
    assert np.allclose(corners, 0, atol=1e-14)
    assert (arc_points(ball["sides"])[..., 2] <= 1e-14).all()
    # The planar triangulation is the spherical one without the facets that see the pole (Theorem 1).
    spherical = SphericalDelaunay(ball["lifted"])
    planar = {tuple(sorted(row)) for row in PlanarDelaunay(plane["sites"]).simplices.tolist()}
    assert planar <= {tuple(sorted(row)) for row in spherical.simplices.tolist()}


def test_figure_9_scale_is_that_of_the_similar_triangles():
    module = script("fig09_scale")
    g = module["geometry"]()
    phi = np.radians(module["KNOTS"])
    assert np.allclose(g["scale"], (1 + np.sin(phi)) / 2)
    radius = module["RADIUS"]
    height = 2 * radius - g["point"][1]
    assert np.isclose(height / (2 * radius), g["point"][0] / g["projected"][0])
    assert np.isclose(height, radius + radius * np.sin(np.radians(module["PHI"])))


@pytest.mark.parametrize("name", ROWS)
def test_fine_region_is_hidden_in_panels_3_and_5_and_seen_whole_in_panel_4(name):
    module = script(name)
    views = sys.modules["_five_views"].VIEWS
    points = arc_points(module["FIGURE"].geometry()["fine"])
    visible = [view.depth(points) > 0 for view in views]
    assert not visible[2].any()
    assert not visible[4].any()
    assert visible[3].all()


@pytest.mark.parametrize("name", ROWS)
def test_prime_meridian_is_a_vertical_line_in_the_middle_of_each_view(name):
    module = script(name)
    bend = fisheye((0, 40), magnification=module["PANELS"].magnification)
    meridian = bend(lonlat_to_xyz(np.stack([np.zeros(37), np.linspace(-90, 90, 37)], axis=-1)))
    for view in sys.modules["_five_views"].VIEWS:
        assert np.allclose(view.project(meridian)[:, 0], 0, atol=1e-12)


@pytest.mark.parametrize("name", ROWS)
def test_graticule_images_are_the_images_of_its_points(name):
    panels = script(name)["PANELS"]
    bend = fisheye((0, 40), magnification=panels.magnification)
    for arc, row in zip(graticule(panels.coarse), panels.geometry()["coarse"], strict=True):
        drawn = arc_points(row[None])[0]
        image = bend(arc.sample(5))
        center, u, v = row[0:3], row[3:6], row[6:9]
        axis = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
        assert np.allclose((image - center) @ axis, 0, atol=1e-12)
        assert np.allclose(drawn[[0, -1]], image[[0, -1]], atol=1e-12)


def test_figure_10_is_the_earth_itself():
    assert script("fig10_earth")["PANELS"].magnification == 1
    assert fisheye((0, 40), magnification=1).is_close(MoebiusMap.identity())


def test_figure_13_relates_the_latitudes():
    module = script("fig13_latitudes")
    g = module["geometry"]()
    half_arcs = np.radians(g["arcs"]) / 2
    assert np.allclose(np.tan(half_arcs), module["DISTANCE"] / (2 * g["radii"]))
    assert np.isclose(np.tan(half_arcs[1]), module["S"] * np.tan(half_arcs[0]))


def test_views_of_the_five_panels():
    script("fig10_earth")
    expected = (View(0, 0), View(0, 90), View(0, -90), View(0, 40), View(180, -40))
    assert expected == sys.modules["_five_views"].VIEWS
