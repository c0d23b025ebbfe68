"""Halos in the colour of the ground, names inside the disc, the sea about the land."""

from dataclasses import replace

import numpy as np
import pytest

from stereodel import fisheye
from stereodel.drawing import Label, View, styled
from stereodel.drawing.page.colors import contrast
from stereodel.drawing.page.items import painted
from stereodel.drawing.page.labels import VEIL, label_box, legible, within_disc
from stereodel.drawing.page.sheets import GROUND, dark_color
from stereodel.drawing.page.style import HALO_OPACITY, MAP_FILLS
from stereodel.globe import Globe, Raster

LENS = fisheye((10.0, 50.0), magnification=3.0)


@pytest.mark.parametrize("layers", ["land", "cells", "raster"])
def test_what_is_painted_is_what_is_drawn(layers):
    """Colours at random places against the pixels of the page, which Agg draws without light."""
    globe = Globe()
    if layers == "land":
        globe.add_land(resolution="110m")
        globe.add_polygons([[[(0, 40), (30, 40), (30, 60), (0, 60)]]], color=(0.5, 0.1, 0.1, 0.5), outline=None)
    elif layers == "cells":
        globe.add_ocean(color=(0.1, 0.2, 0.3, 1.0), resolution="110m")
    else:
        pixels = np.zeros((18, 36, 4), dtype=np.uint8)
        pixels[..., 0], pixels[..., 1], pixels[..., 3] = np.arange(36) * 7, 90, 255
        globe.add_raster(Raster(pixels), opacity=0.5)
    page = globe.page(LENS, View(10, 40))
    size = 1000
    picture = page.pixels(size=size, renderer="agg") / 255
    places = np.random.default_rng(4).uniform(0.1, 1.9, size=(300, 2))
    row, column = (
        ((page.extent[3] - places[:, 1]) / page.extent[1] * size).astype(int),
        (places[:, 0] / page.extent[1] * size).astype(int),
    )
    items = [item for item in page.items if not isinstance(item, Label)]
    off = np.abs(painted(items, places) - picture[row, column]).max(axis=1)
    # A few places lie on a border, or on the limb.
    assert np.mean(off < 0.02) > 0.97


@pytest.mark.parametrize("explicit", [False, True])
def test_a_halo_is_tinted_as_the_ground_of_the_style(tmp_path, explicit):
    """Whether the style is given with the page or applied to it later."""
    file = tmp_path / "mine.toml"
    file.write_text("[fills]\nball = '#ffe0a0'" + ("\n[labels]\nhalo_color = 'lime'" if explicit else ""))
    globe = Globe()
    globe.add_labels([(0.0, 0.0), (0.0, 40.0)], ["here", "there"])
    globe.add_labels([(0.0, -40.0)], ["own"], halo_color=(0.0, 0.0, 1.0, 0.5))
    view = View(0, 0)
    plain = globe.page(view=view)
    for page in (globe.page(view=view, style=file), styled(plain, file)):
        assert len(page.labels) == 3
        for label in page.labels:
            tinted = (0.0, 0.0, 1.0, 0.5) if label.text == "own" else (1.0, 0xE0 / 255, 0xA0 / 255, HALO_OPACITY)
            assert label.halo_color == pytest.approx((0.0, 1.0, 0.0, 1.0) if explicit else tinted, abs=1e-3)


def test_a_halo_on_a_dark_page_is_as_dark_as_its_ground():
    globe = Globe()
    globe.add_labels([(0.0, 0.0)], ["here"])
    (label,) = styled(globe.page(view=View(0, 0)), "dark").labels
    assert label.halo_color == pytest.approx((*dark_color(MAP_FILLS["ocean"])[:3], HALO_OPACITY), abs=1e-3)
    # Outside the disc the ground is the background.
    assert painted([], np.zeros((1, 2)), GROUND)[0] == pytest.approx(GROUND[:3])


WEST = [[[(-60, -60), (0, -60), (0, 60), (-60, 60)]]]


@pytest.mark.parametrize(
    ("place", "offset", "expected"),
    [
        ((-1.0, 0.0), (6.0, 0.0), MAP_FILLS["ocean"]),
        ((1.0, 0.0), (-6.0, 0.0), (1.0, 0.9, 0.6)),
        ((-4.0, 0.0), (6.0, 0.0), MAP_FILLS["ocean"]),  # a little of the first letter
        ((0.0, 0.0), (0.0, 0.0), None),
    ],
)
@pytest.mark.parametrize(("ink", "veil"), [("black", 1.0), ("white", 0.0)])
def test_a_halo_is_tinted_as_the_ground_under_the_words(place, offset, expected, ink, veil):
    """Not as that of the place; and where much of the words is on another ground it has the colour of neither."""
    globe = Globe(ocean=MAP_FILLS["ocean"] if ink == "black" else tuple(0.2 * c for c in MAP_FILLS["ocean"][:3]))
    globe.add_polygons(WEST, color=(1.0, 0.9, 0.6) if ink == "black" else (0.2, 0.18, 0.12), outline=None)
    globe.add_labels([place], ["some words"], offset=offset, color=ink)
    (label,) = globe.page(view=View(0, 0)).labels
    factor = 1.0 if ink == "black" else 0.2
    wanted = (veil, veil, veil, VEIL) if expected is None else (*(factor * c for c in expected[:3]), HALO_OPACITY)
    assert label.halo_color == pytest.approx(wanted, abs=1e-3)


def test_a_halo_of_a_label_that_moved_is_tinted_as_the_ground_where_it_went():
    globe = Globe()
    globe.add_polygons(WEST, color=(1.0, 0.9, 0.6), outline=None)
    globe.add_labels([(1.0, 0.0), (1.0, 0.0)], ["first", "second"], offset=(6.0, 0.0), movable=True)
    first, second = globe.page(view=View(0, 0)).labels
    assert (first.align, second.align) == ("left", "right")
    assert first.halo_color[:3] == pytest.approx(MAP_FILLS["ocean"][:3], abs=1e-3)
    assert second.halo_color[:3] == pytest.approx((1.0, 0.9, 0.6), abs=1e-3)


def test_type_on_a_veil_is_legible_whatever_is_below():
    for ink, away in (((0.0, 0.0, 0.0), 1.0), ((1.0, 1.0, 1.0), 0.0)):
        for ground in np.eye(3).tolist() + [[0.0] * 3, [1.0] * 3]:
            seen = [VEIL * away + (1 - VEIL) * part for part in ground]
            assert contrast(seen, ink) > 5.5


def test_labels_are_above_what_is_added_after_them():
    globe = Globe()
    globe.add_labels([(0.0, 0.0)], ["here"])
    globe.add_polygons([[[(-60, -60), (60, -60), (60, 60), (-60, 60)]]], color="#ffe0a0", outline=None)
    (label,) = globe.page(view=View(0, 0)).labels
    assert label.halo_color == pytest.approx((1.0, 0xE0 / 255, 0xA0 / 255, HALO_OPACITY), abs=1e-3)


def test_a_halo_is_as_light_or_dark_as_reading_needs():
    for ink in ((0, 0, 0, 1.0), (1.0, 1.0, 1.0, 1.0), (0.4, 0.1, 0.1, 1.0)):
        for ground in np.random.default_rng(1).uniform(size=(50, 3)):
            found = legible(ground, ink)
            assert contrast(found, ink[:3]) > 6.9 or found.tolist() in ([1.0] * 3, [0.0] * 3)
            assert contrast(ground, ink[:3]) < 7.1 or found == pytest.approx(ground)


def test_names_turn_to_where_the_disc_has_room():
    unit, anchor = 100.0, (0.9, 0.0)
    label = Label("a name", anchor, (4.0, 0.0), "left", "center", 9.0, halo=1.0)
    turned = within_disc(label, ((0.0, 0.0), 1.0, unit))
    assert (turned.align, turned.offset, turned.halo) == ("right", (-4.0, 0.0), 1.0)
    assert np.hypot(*np.abs(label_box(turned, unit)).max(axis=0)) < unit
    assert within_disc(replace(label, anchor=(0.0, 0.0)), ((0.0, 0.0), 1.0, unit)).align == "left"
    # Near the top of the disc there is room below the place alone.
    top = within_disc(replace(label, anchor=(0.0, 0.94)), ((0.0, 0.0), 1.0, unit))
    assert (top.align, top.valign, top.offset, top.halo) == ("center", "top", (0.0, -4.0), 1.0)
    # Without room on any side a halo would cut the limb.
    assert within_disc(label, ((0.0, 0.0), 0.2, unit)).halo == 0
