"""Colours and sizes by value on globes and diagrams: areas and colours are true, keys are those of the map."""

from functools import partial

import numpy as np
import pytest

from stereodel import PlanarVoronoi, SphericalDelaunay, fisheye
from stereodel._arrays import DataWarning
from stereodel.curves.chart import Chart
from stereodel.curves.view import StereographicView, View
from stereodel.drawing import ColorScale, Dots, Polygons, Polylines, diagram_page, styled
from stereodel.drawing.page import Stroke
from stereodel.drawing.page.scales import MISSING
from stereodel.film import Film, Spin
from stereodel.globe import Globe, hemispheres
from stereodel.globe.layers import suited
from tests.globe.test_looks import SQUARE
from tests.io.test_shapes import feature
from tests.refused import refused

PLACES = [(-40.0, 0.0), (0.0, 0.0), (40.0, 0.0), (0.0, 40.0)]
AMOUNTS = [1e6, 4e6, 9e6, 16e6]
VALUES = [1.0, 10.0, np.nan, 1000.0]
LOG = ColorScale("viridis", 1.0, 1000.0, "log")


def of(page, kind, name):
    return [item for item in page.items if isinstance(item, kind) and item.name == name]


@pytest.fixture
def globe():
    globe = Globe(title="Amounts")
    globe.add_points(PLACES, size=AMOUNTS, size_legend="people", values=VALUES, scale=LOG, legend="people per km²")
    return globe


@pytest.mark.parametrize("renderer", ["gl", "agg"])
def test_pixels_have_the_areas_of_amounts_and_the_colours_of_values(globe, renderer):
    page = globe.page(view=View(0, 10), width=160)
    pixels = page.pixels(size=500, text=False, renderer=renderer).astype(int)
    bare = Globe(title="Amounts").page(view=View(0, 10), width=160).pixels(size=500, text=False, renderer=renderer)
    changed = (pixels != bare).any(axis=2)
    left, _, _, top = page.extent
    per_unit = 500 * page.points_per_unit / page.width
    radius = 12 * 500 / page.width
    for dots in of(page, Dots, "points"):
        x, y = (dots.centers[0] - (left, top)) * (per_unit, -per_unit)
        rows, columns = np.ogrid[: len(pixels), :500]
        near = (columns + 0.5 - x) ** 2 + (rows + 0.5 - y) ** 2 < (radius + 3) ** 2
        k = int(np.argmin(np.abs(12 * np.sqrt(np.array(AMOUNTS) / 16e6) - dots.radius)))
        round = radius * np.sqrt(AMOUNTS[k] / 16e6)  # half of the pixels that its edge crosses lie outside
        assert (changed & near).sum() - np.pi * round == pytest.approx(np.pi * round**2, rel=0.05)
        wanted = MISSING if np.isnan(VALUES[k]) else LOG(VALUES[k])
        assert np.abs(pixels[int(y), int(x)] - 255 * np.array(wanted[:3])).max() <= 1
        assert dots.color == tuple(wanted)
    assert len(of(page, Dots, "points")) == 4


def test_keys_are_those_of_the_map(globe):
    """Circles have the radii that the scale gives to their numbers, and the bar has its colours and a key of gray."""
    page = globe.page(legend=True)
    texts = [item.text.replace("\N{NO-BREAK SPACE}", " ") for item in page.labels]
    bar_texts = ["1", "10", "100", "1 000", "no value", "people per km²"]
    assert texts == ["Amounts", *bar_texts, "people", "10 M", "2 M", "0.5 M"]
    point = page.points_per_unit
    radii = [np.ptp(each.path[..., 0]) * point / 2 + each.width / 2 for each in of(page, Stroke, "legend-outline")]
    np.testing.assert_allclose(radii, [12 * np.sqrt(part) for part in (10 / 16, 2 / 16, 0.5 / 16)], rtol=0.01)
    bar, key = (item for item in page.items if item.name == "scale")
    assert key.color == MISSING
    places = [item.path[0, 0, 0] for item in of(page, Stroke, "tick")]
    np.testing.assert_allclose(places[:4], np.linspace(*bar.painter.ends, 4))
    np.testing.assert_allclose(bar.painter.colors, LOG(10 ** (3 * (np.arange(256) + 0.5) / 256)), atol=1e-6)
    assert page.description == globe.page().description
    assert page.description.splitlines() == [
        "people per km²: colours, logarithmic from 1 to 1\N{NO-BREAK SPACE}000; no value in gray.",
        "people: areas of dots in proportion to the amount, 16\N{NO-BREAK SPACE}M the largest.",
    ]


def test_large_dots_lie_below_small_ones_and_styles_keep_what_they_tell(globe, tmp_path):
    sheet = tmp_path / "a.toml"
    sheet.write_text('[dots.points]\nradius = 30\ncolor = "red"\n[lines.points-outline]\ncolor = "green"\n')
    before, after = (of(page, Dots, "points") for page in (globe.page(), styled(globe.page(), sheet)))
    assert [item.radius for item in before] == [12.0, 9.0, 6.0, 3.0]
    assert [(item.radius, item.color) for item in before] == [(item.radius, item.color) for item in after]
    one = Globe()
    one.add_points(PLACES, size=AMOUNTS, color="teal")
    page = one.page(legend=True, style=sheet)
    shown, keys = of(page, Dots, "points"), of(page, Dots, "legend-points")
    assert {item.color for item in (*shown, *keys)} == {(1.0, 0.0, 0.0, 1.0)}
    assert [item.radius for item in shown] == [12.0, 9.0, 6.0, 3.0]
    assert len(keys) == 3


def test_amounts_that_have_no_area_are_said_and_left_out():
    globe = Globe()
    with pytest.warns(DataWarning, match="of 4 values of 'people' 1 are negative and 1 missing; points have no area"):
        globe.add_points(PLACES, size=[-1.0, np.nan, 0.0, 5.0], size_legend="people")
    assert len(of(globe.page(), Dots, "points")) == 1
    with pytest.warns(DataWarning, match="2 of 4 values of 'warmth' are beyond its scale, 0 to 10, and have"):
        globe.add_points(PLACES, values=[-1, 0, 10, 11], scale=ColorScale("magma", 0, 10), legend="warmth")


def test_looks_of_dots_without_values():
    globe = Globe()
    globe.add_points(PLACES, size="2mm", color="teal", legend="places")
    globe.add_points(PLACES, color=["red", "red", "blue", "red"], name="each")
    globe.add_points(PLACES, values=["b", "a", "", "b"], name="words")
    page = globe.page()
    (dots,) = of(page, Dots, "points")
    assert dots.radius == pytest.approx(72 / 25.4)
    assert globe.legend["places"].color == dots.color
    assert sorted(len(item.centers) for item in of(page, Dots, "each")) == [1, 3]
    assert [len(of(page, Dots, "words")), *globe.legend] == [3, "places", "a", "b", "no value"]


def test_a_column_colours_polygons_lines_and_points():
    """Isolines and places as regions, and what has no value in gray; a style changes none."""
    parts = [("Polygon", [SQUARE]), ("LineString", [[0, 9], [9, 9]]), ("Point", [20, 0])]
    shapes = [{"type": kind, "coordinates": coordinates} for kind, coordinates in parts]
    features = [feature(shape, v=value) for shape in shapes for value in (1.0, 4.0, None)]
    globe = Globe()
    classes = partial(ColorScale.classes, scheme=[0, 2, 5], colors=["navy", "gold"])
    globe.add_layer({"type": "FeatureCollection", "features": features}, column="v", scale=classes)
    page = globe.page(style=())
    wanted = {tuple(globe.legend["v"](value).tolist()) for value in (1.0, 4.0, np.nan)}
    found = {
        Polygons: {tuple(c) for item in of(page, Polygons, "layer") for c in item.colors.tolist()},
        Polylines: {item.color for item in of(page, Polylines, "layer")},
        Dots: {item.color for item in of(page, Dots, "layer")},
    }
    assert found == dict.fromkeys(found, wanted)


@pytest.mark.parametrize("mesh", [SphericalDelaunay.from_lonlat(PLACES), PlanarVoronoi(PLACES)])
def test_diagrams_show_values_of_their_points(mesh):
    page = diagram_page(mesh, size=AMOUNTS, size_legend="people", values=[1, 2, 3, 4], legend="rank", view=(0, 10))
    bare = diagram_page(mesh, view=(0, 10))
    radii = {tuple(item.centers[0]): item.radius for item in of(page, Dots, "sites")}
    assert list(radii.values()) == [12.0, 9.0, 6.0, 3.0]
    (dots,) = of(bare, Dots, "sites")
    assert set(radii) == set(map(tuple, dots.centers))
    assert page.height > bare.height
    assert page.description.count("\n") == 1


@pytest.mark.parametrize(
    ("resolution", "lens", "view", "radius", "tolerance"),
    [
        ("50m", None, View(0, 0), 234, 0.02),
        ("110m", None, View(0, 0), 100, 0.02),
        ("110m", None, hemispheres(0.0, flat=True)[0], 117, 0.02),
        ("10m", fisheye((0, 0), magnification=4.0), View(0, 0), 234, 0.02),
        ("10m", fisheye((0, 0), magnification=20.0), View(180, 0), 234, 0.02),  # the far side, large at its limb
        ("10m", None, View(0, 0), 234, 0.005),  # of a poster, whose curves are finer
        ("10m", None, StereographicView(0, 0, angular_radius=5), 100, 0.02),
    ],
)
def test_maps_suit_the_scale_on_the_page(resolution, lens, view, radius, tolerance):
    bend = fisheye((0, 0), magnification=1.0) if lens is None else lens
    assert suited(Chart(bend, view, scale=2.0, tolerance=2 * tolerance / radius, unit=radius / 2)) == resolution


def test_frames_of_films_have_the_legend_and_one_resolution(globe):
    globe.add_coastlines()
    with pytest.raises(ValueError, match="size is 40 × 30, which leaves no room for the globe beside its legend"):
        Film.of_globe(globe, Spin(), size=(40, 30), legend=True).page(0)
    film = Film.of_globe(globe, Spin(seconds=1), size=(200, 160), fps=3, legend=True)
    pages = [film.page(number) for number in (0, 2)]
    assert {item.text for item in pages[0].labels} >= {"people", "people per km²", "no value", "Amounts"}
    assert {page.pixels_up(200) for page in pages} == {160}
    assert film.picture(0).shape == (160, 200, 3)
    assert {layer.resolution for layer in film.draw.steady.layers if hasattr(layer, "resolution")} == {"110m"}


test_what_has_no_look_is_refused = refused(
    ({"size": [1.0, 2.0]}, r"size must have shape \(4, ...\)"),
    ({"size": [0.0, 0.0, 0.0, 0.0], "size_legend": "v"}, "size has no positive value"),
    ({"size": "wide"}, "size is 'wide'; give a length"),
    ({"color": "red", "values": VALUES}, "color and values both say the colours of points"),
    ({"color": ["red", "blue"]}, "color has 2 colours, but there are 4 items"),
    ({"values": [1.0]}, "values must have shape"),
    ({"values": [np.nan] * 4}, "values has no number for a scale"),
    call=lambda looks: Globe().add_points(PLACES, **looks),
)
