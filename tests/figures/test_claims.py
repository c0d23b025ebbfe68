"""What each figure shows is what the paper says of it: statements about the drawn geometry, figure by figure."""

import sys

import numpy as np
import pytest

import stereodel as sd
from stereodel.drawing import Dots, Fill, Label, Stroke, View
from stereodel.sphere import angular_distance
from stereodel.triangulation import check_delaunay
from tests.figures.scripts import FIGURES, ROWS, arc_points, geometry, page, path_points, script
from tests.tiers import by_day


def test_figure_1_shows_dual_graphs():
    g = geometry("fig01_sphere")
    n = len(g["sites"])
    assert len(g["edges"]) == len(g["ridges"]) == 3 * n - 6
    assert len(g["vertices"]) == 2 * n - 4
    check_delaunay(sd.SphericalDelaunay(g["sites"]))
    # A Voronoi vertex has no site nearer than the three that it belongs to.
    nearest = np.sort(angular_distance(g["vertices"][:, None], g["sites"][None]), axis=1)
    assert np.allclose(nearest[:, 0], nearest[:, 2], atol=1e-9)
    assert (nearest[:, 3] > nearest[:, 2] + 1e-9).all()


def test_figure_1_marks_a_triangle_whose_bubble_is_empty():
    module, g, drawn = script("fig01_sphere"), geometry("fig01_sphere"), page("fig01_sphere")
    center, offset = g["circle"][:3], g["circle"][3]
    heights = g["sites"] @ center
    assert np.allclose(heights[g["triangle"]], offset, atol=1e-14)
    assert (np.delete(heights, g["triangle"]) < offset - 1e-3).all()
    assert angular_distance(g["vertices"], center).min() < 1e-9
    # All of it is on the near side, and the dot is where three Voronoi edges meet.
    assert (module["VIEW"].depth(g["sites"][g["triangle"]]) > 0.3).all()
    (dot,) = [item for item in drawn.items if item.name == "points"]
    ends = np.vstack([item.path[[0, -1], [0, -1]] for item in drawn.items if item.name == "voronoi"])
    assert np.count_nonzero(np.linalg.norm(ends - dot.centers, axis=1) < 1e-9) == 3


def test_figure_2_ridges_are_perpendicular_bisectors_inside_the_frame():
    module, g = script("fig02_plane"), geometry("fig02_plane")
    left, bottom, right, top = module["FRAME"]
    assert (g["ridges"] >= [left, bottom]).all()
    assert (g["ridges"] <= [right, top]).all()
    middles = g["ridges"].mean(axis=1)
    distances = np.sort(np.linalg.norm(middles[:, None] - g["sites"][None], axis=-1), axis=1)
    assert np.allclose(distances[:, 0], distances[:, 1], atol=1e-9)


def test_figure_3_section_is_the_ball_seen_along_its_plane():
    module, g, drawn = script("fig03_bubbles"), geometry("fig03_bubbles"), page("fig03_bubbles")
    items = {item.name: item for item in drawn.items if isinstance(item, Stroke | Dots)}
    center, plane = module["SECTION"], items["slicing_plane"].path
    small, large = (path_points(items[name].path) - center for name in ("small", "large"))
    assert np.allclose(np.linalg.norm(np.vstack([small, large]), axis=1), 1, atol=1e-6)
    assert np.allclose(small[[0, -1]], large[[-1, 0]])
    # The plane passes through the ends of the arcs, as far from the centre as the circle's; it separates the arcs.
    foot, tip = items["normal"].path[0, [0, 3]] - center
    normal = (tip - foot) / np.linalg.norm(tip - foot)
    assert np.linalg.norm(foot) == pytest.approx(g["offset"])
    assert np.allclose((plane.reshape(-1, 2) - center) @ normal, g["offset"])
    assert np.allclose(items["sites"].centers - center, small[[0, -1]])
    assert (small[1:-1] @ normal > g["offset"]).all()
    assert (large[1:-1] @ normal < g["offset"]).all()
    # It points as the axis of the circle on the left does.
    axis = module["VIEW"].project(g["normal"])
    assert np.allclose(axis / np.linalg.norm(axis), normal)


def test_figure_4_joins_the_corners_to_the_centre():
    module, g, drawn = script("fig04_triangles"), geometry("fig04_triangles"), page("fig04_triangles")
    corners = module["VIEW"].project(g["vertices"])
    radii = np.array([item.path[0, [0, 3]] for item in drawn.items if item.name == "radius"])
    assert np.allclose(radii[:, 0], 0)
    assert np.allclose(radii[:, 1], corners)


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


@pytest.mark.parametrize("name", by_day(FIGURES, "fig05_projections", "fig09_scale"))
def test_nothing_leaves_the_page(name):
    drawn = page(name)
    left, right, bottom, top = np.array(drawn.extent)
    for item in drawn.items:
        match item:
            case Stroke():
                points, reach = path_points(item.path), item.width / 2
            case Fill():
                points, reach = np.vstack([path_points(path) for path in item.paths]), 0.0
            case Dots():
                points, reach = item.centers, item.radius
            case Label():
                continue
            case _:
                raise AssertionError(f"{type(item).__name__} is not looked at")
        reach /= drawn.points_per_unit
        assert (points >= [left + reach, bottom + reach]).all(), item.name
        assert (points <= [right - reach, top - reach]).all(), item.name


def test_figure_6_writes_radius_and_extent_into_each_circle():
    module, g, drawn = script("fig06_sphere_size"), geometry("fig06_sphere_size"), page("fig06_sphere_size")
    assert np.allclose(g["extents"], 4 * np.degrees(np.arctan(module["HALF_LENGTH"] / (2 * np.array(module["RADII"])))))
    names, extents = drawn.labels[:-1:2], drawn.labels[1:-1:2]
    for radius, extent, name, written in zip(module["RADII"], g["extents"], names, extents, strict=True):
        assert float(written.text.strip("$°")) == pytest.approx(extent, abs=0.05)
        assert {"2": 2.0, "1": 1.0, "½": 0.5}[name.text.strip("$R= ")] == radius
        # Inside its own circle, and outside the next.
        inside = [abs(name.anchor[1] - r) < r for r in module["RADII"]]
        assert sum(inside) == module["RADII"].index(radius) + 1


def test_figure_7_circle_cuts_the_diagonal_in_quarters():
    g, drawn = geometry("fig07_rectangle"), page("fig07_rectangle")
    lines = [item.path[0, [0, 3]] for item in drawn.items if item.name == "diagonal"]
    diagonal, radius = (lines[0], lines[3])  # each with two ticks
    assert np.linalg.norm(diagonal[1] - diagonal[0]) == pytest.approx(4 * g["radius"])
    assert np.allclose(radius[0], diagonal.mean(axis=0), atol=1e-15)
    assert np.allclose(radius[1], diagonal.T @ [0.25, 0.75])
    (circle,) = [item for item in drawn.items if item.name == "footprint"]
    assert np.linalg.norm(path_points(circle.path) - radius[1], axis=1).min() < 1e-2
    assert circle.dash


def test_figures_7_and_8_share_sites_and_the_corners_land_on_the_equator():
    plane, ball = geometry("fig07_rectangle"), geometry("fig08_hemisphere")
    sphere = sd.Stereographic((0, -90), radius=float(ball["radius"]))
    assert np.allclose(sphere.forward(ball["lifted"]), plane["sites"], atol=1e-14)
    assert np.array_equal(plane["edges"], ball["edges"])
    assert np.isclose(4 * plane["radius"], np.hypot(3, 2))
    corners = arc_points(ball["sides"])[:, [0, -1], 2]
    assert np.allclose(corners, 0, atol=1e-14)
    assert (arc_points(ball["sides"])[..., 2] <= 1e-14).all()
    # Brought back to the plane, each is a side of the rectangle.
    sides = np.abs(sphere.forward(arc_points(ball["sides"]))) / [1.5, 1.0]
    assert np.allclose(sides.max(axis=-1), 1, atol=1e-12)
    # The planar triangulation is the spherical one without the facets that see the pole (Theorem 1).
    spherical = sd.SphericalDelaunay(ball["lifted"])
    planar = {tuple(sorted(row)) for row in sd.PlanarDelaunay(plane["sites"]).simplices.tolist()}
    assert planar <= {tuple(sorted(row)) for row in spherical.simplices.tolist()}


def test_figure_8_shows_rays_from_lifted_corners_to_their_corners():
    module, g, drawn = script("fig08_hemisphere"), geometry("fig08_hemisphere"), page("fig08_hemisphere")
    radius, view, shown = float(g["radius"]), module["VIEW"], module["SHOWN"]
    lifted, corners = radius * g["corners"], g["plane"]
    north = np.array([0.0, 0.0, radius])
    assert np.allclose(np.cross(lifted - north, corners - north), 0, atol=1e-12)
    assert (view.depth(lifted)[shown] > 0.1).all()  # two are seen, and the others are not
    assert (np.delete(view.depth(lifted), shown) < -0.1).all()
    rays = np.array([item.path[0, [0, 3]] for item in drawn.items if item.name == "ray"])
    for start, end in np.stack(view.project([lifted[shown], corners[shown]]), axis=1):
        assert covered(rays, start, end) == pytest.approx(1)
    (south,) = [item for item in drawn.items if item.name == "ring"]
    assert np.allclose(south.centers, view.project([-north]))
    assert g["plane"].mean(axis=0) == pytest.approx(-north)


def covered(pieces, a, b):
    """The share of a segment of the page that pieces (n, 2, 2) of lines, which do not overlap, have of it."""
    way = (b - a) / np.linalg.norm(b - a)
    on_it = (np.abs((pieces - a) @ [-way[1], way[0]]) < 1e-12).all(axis=1)
    return np.abs(np.diff((pieces[on_it] - a) @ way, axis=1)).sum() / np.linalg.norm(b - a)


def test_figure_8_shows_rectangle_and_equator_as_they_are_seen():
    """The sides of the rectangle, and the ellipse of the equator, whose half axes are 1 and sin 55°."""
    module, g, drawn = script("fig08_hemisphere"), geometry("fig08_hemisphere"), page("fig08_hemisphere")
    radius, places = float(g["radius"]), module["VIEW"].project(g["plane"])
    sides = np.vstack([item.path[:, [0, 3]] for item in drawn.items if item.name == "rectangle"])
    for a, b in zip(places, np.roll(places, -1, axis=0), strict=True):
        assert covered(sides, a, b) == pytest.approx(1)
    equator = np.vstack([path_points(item.path) for item in drawn.items if item.name == "equator"]) / radius
    away = np.linalg.norm(equator / [1.0, np.sin(np.radians(55))], axis=1)
    assert np.abs(away - 1).max() * radius * drawn.points_per_unit < 1e-2


def test_figure_9_scale_is_that_of_the_similar_triangles():
    module, g = script("fig09_scale"), geometry("fig09_scale")
    phi = np.radians(module["KNOTS"])
    assert np.allclose(g["scale"], (1 + np.sin(phi)) / 2)
    radius = module["RADIUS"]
    height = 2 * radius - g["point"][1]
    assert np.isclose(height / (2 * radius), g["point"][0] / g["projected"][0])
    assert np.isclose(height, radius + radius * np.sin(np.radians(module["PHI"])))


def test_figure_9_draws_the_scale_and_its_rate_as_the_library_has_them():
    module, g, drawn = script("fig09_scale"), geometry("fig09_scale"), page("fig09_scale")
    # The rate by central differences of the scale along a meridian.
    lift, step = sd.RectangleLift(4 * module["RADIUS"], 0.0), 1e-3
    inner = module["KNOTS"][1:-1]

    def scale(phi):
        return lift.scale_factor(lift.inverse(sd.lonlat_to_xyz(np.stack([np.full_like(phi, 90.0), -phi], axis=-1))))

    differences = (scale(inner + step) - scale(inner - step)) / np.radians(2 * step)
    assert np.allclose(g["rate"][1:-1], differences, atol=1e-9)
    # Both curves between their knots too, within a hundredth of a point.
    graphs = {item.name: item for item in drawn.items if isinstance(item, Stroke) and item.name.startswith("accent")}
    for name, value in (("accent1", lambda phi: (1 + np.sin(phi)) / 2), ("accent2", lambda phi: np.cos(phi) / 2)):
        across, up = ((path_points(graphs[name].path) - module["ORIGIN"]) / [module["WIDTH"], module["HEIGHT"]]).T
        assert (across.min(), across.max()) == pytest.approx((0, 1))
        away = np.abs(up - value(across * np.pi / 2)) * module["HEIGHT"] * drawn.points_per_unit
        assert away.max() < 1e-3
    # The dots are those of φ on the left.
    for name, value in (("accent1", (1 + np.sin(np.radians(25))) / 2), ("accent2", np.cos(np.radians(25)) / 2)):
        (dot,) = [item for item in drawn.items if isinstance(item, Dots) and item.name == name]
        place = (dot.centers[0] - module["ORIGIN"]) / [module["WIDTH"], module["HEIGHT"]]
        assert place == pytest.approx([25 / 90, value], abs=1e-12)


@pytest.mark.parametrize(
    ("name", "magnification", "coarse", "fine", "half_width"),
    [("fig10_earth", 1, 10, 2, 8), ("fig11_fisheye4", 4, 5, 1, 8), ("fig12_fisheye20", 20, 5, 0.5, 1.5)],
)
def test_the_numbers_of_figures_10_to_12(name, magnification, coarse, fine, half_width):
    """The paper's S, graticule and fine step, and our half-width, read off the drawn arcs by undoing the fisheye."""
    back, g = sd.fisheye((0, 40), magnification=magnification).inverse(), geometry(name)
    coarse_rows, fine_rows = (np.concatenate([g[f"{kind}_{view}"] for view in range(5)]) for kind in ("coarse", "fine"))
    parallels, meridians = straightened(back, coarse_rows)
    # Where neighbours have no room some lines end, and on their far side a few are left out altogether.
    for found, lines in ((parallels, np.arange(coarse - 90, 90, coarse)), (meridians, np.arange(-180, 180, coarse))):
        assert np.isin(found, lines).all()
        assert np.diff(found).min() == coarse
        assert len(found) > (len(lines) / 2 if magnification == 20 else len(lines) - 1)
    parallels, meridians = straightened(back, fine_rows)
    steps = np.arange(-half_width, half_width + fine / 2, fine)
    assert parallels == pytest.approx(40 + steps)
    assert meridians == pytest.approx(steps, abs=1e-9)
    lon, lat = np.moveaxis(sd.xyz_to_lonlat(back(arc_points(fine_rows))), -1, 0)
    assert (lon.min(), lon.max()) == pytest.approx((-half_width, half_width))
    assert (lat.min(), lat.max()) == pytest.approx((40 - half_width, 40 + half_width))
    if name == "fig12_fisheye20":  # and fainter ones between them, where the focus is seen
        faint = [g[f"between_{view}"] for view in range(5)]
        assert [len(rows) > 0 for rows in faint] == [True, True, False, True, False]
        for lines in straightened(back, np.concatenate(faint)):
            assert np.allclose(lines, np.round(lines), atol=1e-6)
            assert np.diff(lines).min() == pytest.approx(1)
    assert {f"$S = {magnification}$", "40° N"} <= {label.text for label in page(name).labels}


def straightened(back, rows):
    """The latitudes and longitudes of arcs that are images of parallels and meridians."""
    parallels, meridians = [], []
    for points in back(arc_points(rows)[:, 1:-1]):
        lon, lat = sd.xyz_to_lonlat(points).T
        turns = np.exp(1j * np.radians(lon))
        if np.ptp(lat) < 1e-9:
            parallels.append(lat.mean())
        else:
            assert np.abs(turns - turns[0]).max() < 1e-9, "neither a parallel nor a meridian"
            meridians.append((np.degrees(np.angle(turns[0])) + 180 + 1e-9) % 360 - 180 - 1e-9)
    return np.unique(np.round(parallels, 6)), np.unique(np.round(meridians, 6))


@pytest.mark.parametrize("name", ROWS)
def test_fine_region_is_hidden_in_panels_3_and_5_and_seen_whole_in_panel_4(name):
    script(name)
    g, views = geometry(name), sys.modules["_five_views"].VIEWS
    visible = [view.depth(arc_points(g[f"fine_{number}"])) > 0 for number, view in enumerate(views)]
    assert not visible[2].any()
    assert not visible[4].any()
    assert visible[3].all()


def test_figure_13_measures_d_and_relates_the_latitudes():
    module, g, drawn = script("fig13_latitudes"), geometry("fig13_latitudes"), page("fig13_latitudes")
    (d,) = [label for label in drawn.labels if label.text == "$d$"]
    (measure,) = [i for i in drawn.items if i.name == "frame" and np.allclose(i.path.mean(axis=(0, 1)), d.anchor)]
    assert np.ptp(measure.path[..., 0]) == pytest.approx(module["DISTANCE"])
    assert np.divide(*g["radii"]) == module["S"]
    half_arcs = np.radians(g["arcs"]) / 2
    assert np.allclose(np.tan(half_arcs), module["DISTANCE"] / (2 * g["radii"]))
    assert np.isclose(np.tan(half_arcs[1]), module["S"] * np.tan(half_arcs[0]))


def test_views_of_the_five_panels():
    script("fig10_earth")
    expected = (View(0, 0), View(0, 90), View(0, -90), View(0, 40), View(180, -40))
    assert expected == sys.modules["_five_views"].VIEWS
