"""Halos in the colour of the ground, names inside the disc, the sea about the land."""

import numpy as np
import pytest

from stereodel import fisheye
from stereodel.drawing import Label, View, styled
from stereodel.drawing.page.colors import as_color, contrast
from stereodel.drawing.page.items import painted
from stereodel.drawing.page.labels import LEGIBLE_ON_SEVERAL, VEIL, legible
from stereodel.drawing.page.sheets import GROUND, dark_color
from stereodel.drawing.page.style import HALO_OPACITY, MAP_FILLS
from stereodel.globe import Globe, Raster


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
    page = globe.page(fisheye((10.0, 50.0), magnification=3.0), View(10, 40))
    size = 1000
    picture = page.pixels(size=size, renderer="agg") / 255
    places = np.random.default_rng(4).uniform(0.1, 1.9, size=(300, 2))
    row = ((page.extent[3] - places[:, 1]) / page.extent[1] * size).astype(int)
    column = (places[:, 0] / page.extent[1] * size).astype(int)
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
        ((-2.5, 0.0), (6.0, 0.0), MAP_FILLS["ocean"]),  # a little of the first letter
        ((0.0, 0.0), (0.0, 0.0), None),
    ],
)
@pytest.mark.parametrize("ink", ["black", "white"])
def test_a_halo_is_tinted_as_the_ground_under_the_words(place, offset, expected, ink):
    """Not as that of the place; and where much of the words is on another ground it has the colour of neither."""
    globe = Globe(ocean=MAP_FILLS["ocean"] if ink == "black" else tuple(0.2 * c for c in MAP_FILLS["ocean"][:3]))
    globe.add_polygons(WEST, color=(1.0, 0.9, 0.6) if ink == "black" else (0.2, 0.18, 0.12), outline=None)
    globe.add_labels([place], ["some words"], offset=offset, color=ink)
    (label,) = globe.page(view=View(0, 0)).labels
    factor = 1.0 if ink == "black" else 0.2
    if expected is not None:
        wanted = (*(factor * c for c in expected[:3]), HALO_OPACITY)
        assert label.halo_color == pytest.approx(wanted, abs=1e-3)
        return
    # Between the two, with as much white or black as type needs, here none.
    ends = factor * np.array([MAP_FILLS["ocean"][:3], (1.0, 0.9, 0.6)])
    assert (ends.min(axis=0) - 1e-3 <= label.halo_color[:3]).all()
    assert (label.halo_color[:3] <= ends.max(axis=0) + 1e-3).all()
    assert label.halo_color[3] == VEIL


def test_a_halo_of_a_label_that_moved_is_tinted_as_the_ground_where_it_went():
    globe = Globe()
    globe.add_polygons(WEST, color=(1.0, 0.9, 0.6), outline=None)
    globe.add_labels([(1.0, 0.0), (1.0, 0.0)], ["first", "second"], offset=(6.0, 0.0), movable=True)
    first, second = globe.page(view=View(0, 0)).labels
    assert (first.align, second.align) == ("left", "right")
    assert first.halo_color[:3] == pytest.approx(MAP_FILLS["ocean"][:3], abs=1e-3)
    assert second.halo_color[:3] == pytest.approx((1.0, 0.9, 0.6), abs=1e-3)


def test_type_on_a_veil_is_legible_whatever_is_below():
    grounds = np.array([*np.eye(3), [0.0] * 3, [1.0] * 3])
    for ink in ((0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0)):
        for mean in grounds:
            halo = legible(mean, ink, grounds, VEIL, LEGIBLE_ON_SEVERAL)
            assert contrast(VEIL * halo + (1 - VEIL) * grounds, ink[:3]).min() >= LEGIBLE_ON_SEVERAL
    for ink in ((0, 0, 0, 1.0), (1.0, 1.0, 1.0, 1.0), (0.4, 0.1, 0.1, 1.0)):  # or as far from the ink as can be
        for ground in np.random.default_rng(1).uniform(size=(50, 3)):
            found = legible(ground, ink, ground[None], 1.0, 7.0)
            farthest = max(([0.0] * 3, [1.0] * 3), key=lambda far: contrast(far, ink[:3]))
            assert contrast(found, ink[:3]) >= 7.0 or found.tolist() == farthest
            assert contrast(ground, ink[:3]) < 7.0 or found == pytest.approx(ground)


@pytest.mark.parametrize("movable", [False, True])
def test_ink_contrasts_with_the_ground_under_the_words(movable, tmp_path):
    """White on dark and black on light, also beside a coast, in another style and for inks of one's own."""
    globe = Globe(ocean="#0b2440")
    globe.add_polygons(WEST, color=(1.0, 0.9, 0.6), outline=None)
    for color in ({}, {"color": ("#402010", "#ffe0c0")}, {"color": "red"}, {"color": ("red", 0.5)}):
        globe.layers[2:] = []
        # Where they move to, the second is west of the first: on land.
        globe.add_labels([(1.0, 0.0), (1.0, 0.0)], ["sea", "land"], offset=(9.0, 0.0), movable=movable, **color)
        if not movable:
            globe.add_labels([(-1.0, 10.0)], ["land"], offset=(-9.0, 0.0), **color)
        inks = color.get("color", ("black", "white"))
        dark, light = inks if isinstance(inks, tuple) and isinstance(inks[1], str) else (inks, inks)
        assert {label.text: label.color for label in globe.page(view=View(0, 0)).labels} == {
            "sea": as_color(light),
            "land": as_color(dark),
        }
    file = tmp_path / "green.toml"
    file.write_text("[labels]\ncolor = 'green'\nfont = ['bold']")
    (label, _) = globe.page(view=View(0, 0), style=file).labels
    assert (label.color, label.font) == (as_color("green"), ("bold",))


def test_labels_are_above_what_is_added_after_them():
    globe = Globe()
    globe.add_labels([(0.0, 0.0)], ["here"])
    globe.add_polygons([[[(-60, -60), (60, -60), (60, 60), (-60, 60)]]], color="#ffe0a0", outline=None)
    (label,) = globe.page(view=View(0, 0)).labels
    assert label.halo_color == pytest.approx((1.0, 0xE0 / 255, 0xA0 / 255, HALO_OPACITY), abs=1e-3)
