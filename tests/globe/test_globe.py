"""Globes: layers, lenses and views on pages and in files."""

from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import example, given

from stereodel import MoebiusMap, SphericalDelaunay, SphericalVoronoi, data, fisheye, lonlat_to_xyz
from stereodel.curves.clip import signed_areas
from stereodel.curves.fill import triangles
from stereodel.drawing import StereographicView, View
from stereodel.drawing.page import Dots, Polygons, Polylines, Stroke
from stereodel.globe import Globe, Panel, Raster, hemispheres, panels
from stereodel.sphere import SphereCircle
from tests.examples import examples
from tests.globe.sights import views
from tests.refused import refused
from tests.strategies import LONLAT, decades

PARIS = (2.35, 48.86)


VIEWS = [View(*PARIS), StereographicView(*PARIS, angular_radius=150)]


def items_of(page, kind):
    return [item for item in page.items if isinstance(item, kind)]


@examples(0.5)
@given(focus=LONLAT, size=decades(-1, 3), view=views)
@example(focus=(0.0, 2.5), size=1.0, view=View(112.0, 0.0))  # a pole on the rim
def test_paper_and_pixels_fill_the_same_land(focus, size, view):
    """What the loops bound is what the triangles cover, each place once, and within the disc."""
    globe = Globe()
    globe.add_land(resolution="110m")
    page = globe.page(fisheye(focus, magnification=size), view)
    for land in items_of(page, Polygons):
        corners, _ = triangles(land.loops, land.owner)
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        covered = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2
        assert covered == pytest.approx(signed_areas(land.loops)[0].sum(), abs=2e-5)
        assert (np.hypot(*(land.points - 1.03).T) <= 1 + 1e-9).all()


def test_what_is_out_of_sight_is_not_there():
    globe = Globe()
    globe.add_points([[1e-200, 0, 0], [-1e200, 0, 0]])  # whatever the lengths of directions
    globe.add_labels([(0, 0), (180, 0)], ["front", "back"])
    globe.add_polygons([[[(170, -5), (190, -5), (190, 5), (170, 5)]]], name="behind")
    page = globe.page()
    assert [len(item.centers) for item in items_of(page, Dots)] == [1]
    assert [label.text for label in page.labels] == ["front"]
    assert not [item for item in page.items if item.name == "behind"]


def test_circles_are_the_images_of_their_points():
    lens, circle = fisheye(PARIS, magnification=20.0), SphereCircle.around((2.40, 48.88), 0.06)
    globe = Globe()
    globe.add_circles([circle])
    page = globe.page(lens, VIEWS[0])
    (line,) = items_of(page, Polylines)
    axes = VIEWS[0].raised(line.points - np.array(page.extent[1::2]) / 2) @ VIEWS[0].matrix
    assert len(axes) > 10
    np.testing.assert_allclose(axes @ lens.image_of(circle).normal, lens.image_of(circle).offset, atol=1e-9)


def test_labels_make_room_for_those_that_matter_more_and_stay_on_the_page():
    globe, edge = Globe(), Globe()
    globe.add_labels([(0, 0), (0.5, 0.2), (40, 40)], ["first", "second", "far"])
    assert [label.text for label in globe.page().labels] == ["first", "far"]
    names = [label.text for label in globe.page(fisheye((0, 0), magnification=50.0)).labels]
    assert names == ["first", "second"]
    edge.add_labels([(89.0, 0.0)], ["a long name at the very edge"], size=60.0)
    assert edge.page().labels == ()


def test_the_view_follows_the_focus():
    """By default the focus is in the middle, also where the map moves it."""
    lens = MoebiusMap.rotation((0.0, 90.0), 25.0) @ fisheye(PARIS, magnification=5.0)
    globe = Globe()
    globe.add_points([PARIS])
    page = globe.page(lens)
    (dots,) = items_of(page, Dots)
    np.testing.assert_allclose(dots.centers, [np.array(page.extent[1::2]) / 2], atol=1e-12)


def test_hemispheres_show_everything_once(rng):
    places = np.stack([rng.uniform(-180, 180, 100), np.degrees(np.arcsin(rng.uniform(-1, 1, 100)))], axis=1)
    globe = Globe()
    globe.add_points(places)
    for flat in (False, True):
        page = globe.page(view=hemispheres(20.0, 30.0, flat=flat))
        assert sum(len(item.centers) for item in items_of(page, Dots)) == 100
        assert len([item for item in page.items if item.name == "limb"]) == 2


def test_panels_have_titles_and_rows():
    globe = Globe()
    globe.add_graticule(30)
    page = panels([Panel(globe, fisheye(PARIS, magnification=s), title=f"$S = {s}$") for s in (1, 4, 20)], columns=2)
    assert [label.text for label in page.labels] == ["$S = 1$", "$S = 4$", "$S = 20$"]
    left, right, bottom, top = page.extent
    discs = [item.path.reshape(-1, 2).mean(axis=0) for item in items_of(page, Stroke)]
    assert len(discs) == 3
    assert discs[0][1] > discs[2][1]
    assert all(left < x < right and bottom < y < top for x, y in discs)
    with pytest.raises(ValueError, match="contents must have at least one panel"):
        panels([])


def test_few_colours_are_paths_and_many_are_a_picture(rng):
    sites = data.airports().lonlat[::100]
    voronoi = SphericalVoronoi.from_lonlat(sites)
    for colors, pictured in (
        (np.tile([0.5, 0.6, 0.7], (len(sites), 1)), [False]),
        (rng.random((len(sites), 3)), [True]),
        (rng.integers(0, 2, (len(sites), 4)) * [0.5, 0.5, 0.5, 0.0] + [0, 0, 0, 1.0], [False] * 8),
    ):
        globe = Globe()
        globe.add_cells(voronoi, colors=colors)
        page = globe.page()
        assert [item.pictured for item in items_of(page, Polygons)] == pictured
        assert items_of(page, Polylines)


def test_triangulations_are_drawn_without_their_far_side():
    triangulation = SphericalDelaunay.from_lonlat([(0, 0), (20, 0), (10, 20), (10, 8)])
    globe = Globe()
    globe.add_triangulation(triangulation, colors=np.tile([0.2, 0.4, 0.6], (len(triangulation.simplices), 1)))
    (filled,) = items_of(globe.page(view=View(10, 8)), Polygons)
    assert len(filled.offsets) - 1 == (~triangulation.closing).sum()
    (lines,) = items_of(globe.page(view=View(10, 8)), Polylines)
    assert len(lines.offsets) - 1 == len(triangulation.edges)


test_mistakes_are_named = refused(
    (lambda g: g.add_tissot(30, 0), "radius"),
    (lambda g: g.add_points([(0, 91)]), "latitude 91"),
    (lambda g: g.add_labels([(0, 0), (1, 1)], ["a"]), "texts has 1 entries"),
    (lambda g: g.add_polygons([[[(0, 0), (1, 1)]]]), "needs three"),
    (lambda g: g.add_land(resolution="1m"), "resolution"),
    (lambda g: g.add_raster(np.zeros((2, 4), np.uint8), opacity=1.5), "opacity is 1.5"),
    (lambda g: g.add_raster(Raster(np.zeros((2, 4), np.uint8)), bounds=(0, 0, 1, 1)), "bounds belong to pixels"),
    (lambda g: g.page(width=0), "width"),
    (lambda g: g.page(tolerance=-1), "tolerance"),
    (lambda g: g.save("x.png", size=0), "size"),
    (lambda g: Globe(latitude="north"), "latitude"),
    call=lambda draw: draw(Globe()),
)


def test_cells_of_sites_on_a_circle_are_refused():
    voronoi = SphericalVoronoi(lonlat_to_xyz([(0, 0), (90, 0), (180, 0)]))
    globe = Globe()
    globe.add_cells(voronoi)
    with pytest.raises(ValueError, match="draw its ridges"):
        globe.add_cells(voronoi, colors=np.ones((3, 3)))
    assert items_of(globe.page(view=View(0, 40)), Polylines)


def test_latitudes_are_those_of_the_globe():
    for latitude in ("spherical", "geodetic", "authalic"):
        globe = Globe(latitude=latitude)
        globe.add_points([(0, 45)])
        (dots,) = items_of(globe.page(view=View(0, 0)), Dots)
        expected = lonlat_to_xyz((0, 45), latitude=latitude)[2]
        assert dots.centers[0, 1] - 1.03 == pytest.approx(expected, abs=1e-12)


def test_more_colours_than_paths_show_only_where_there_are_regions(tmp_path):
    """In vector files too: what lies between many coloured regions is not painted over."""
    shapes = [
        [[(x, y), (x + 5, y), (x + 5, y + 5), (x, y + 5)]] for x in range(-50, 50, 10) for y in range(-40, 40, 10)
    ]
    colors = np.random.default_rng(2).random((len(shapes), 4))
    colors[:, 3] = 1.0
    globe = Globe()
    globe.add_polygons(shapes, color=colors, outline=None)
    page = globe.page()
    (squares,) = items_of(page, Polygons)
    assert squares.pictured
    root = ET.parse(globe.save(tmp_path / "globe.svg", size=300)).getroot()
    clips = [node for node in root.iter() if node.tag.endswith("clipPath")]
    runs = [path.get("d").count("M") for clip in clips for path in clip if path.get("d")]
    assert max(runs) == len(shapes)
