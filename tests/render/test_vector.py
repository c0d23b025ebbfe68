"""Vector files: true curves, exact size, the same bytes every time."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import partial
from unicodedata import normalize

import matplotlib as mpl
import numpy as np
import pypdf
import pytest

from stereodel.curves.view import View
from stereodel.drawing.page import Dots, Fill, Label, Page, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.items import Ramp, xml_name
from stereodel.drawing.page.style import BLACK
from stereodel.drawing.scene.scene import Scene
from stereodel.render.pixel_rows import LabelLayer, agg_rows
from stereodel.render.save import save_vector
from stereodel.sphere import SphereCircle, graticule

rasterize = partial(Page.pixels, renderer="agg")

SVG = "{http://www.w3.org/2000/svg}"
LINK = "{http://www.w3.org/1999/xlink}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


def tree_of(page, folder):
    return ET.parse(save_vector(page, folder / "page.svg")).getroot()


def sheet_of(page, folder):
    (sheet,) = pypdf.PdfReader(save_vector(page, folder / "page.pdf")).pages
    return sheet


def path_of(page, folder, name):
    """What the path of a name in the SVG of a page draws."""
    (path,) = (path for path in tree_of(page, folder).iter(f"{SVG}path") if path.get("id") == name)
    return path.get("d")


def globe():
    scene = Scene(style="glass")
    scene.add_arcs(graticule(30), name="graticule")
    scene.add_cap(SphereCircle.around((20, 10), 40), name="small_bubble")
    scene.add_points([[1, 0, 0]], name="sites")
    scene.add_label((0, 0, 1), r"$\varphi$ north", offset=(0, 6))
    return Page((-1.1, 1.1, -1.1, 1.2), scene.layout(View(20, 35)), width=200.0)


@pytest.mark.parametrize("kind", ["svg", "pdf"])
def test_bytes_are_the_same_twice_and_under_any_user_settings(tmp_path, kind):
    first = save_vector(globe(), tmp_path / f"a.{kind}").read_bytes()
    with mpl.rc_context({"font.size": 30, "font.family": "serif", "lines.linewidth": 9, "mathtext.fontset": "cm"}):
        again = save_vector(globe(), tmp_path / f"b.{kind}").read_bytes()
    assert first == again
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"a.{kind}", f"b.{kind}"]
    for word in (b"Date", b"matplotlib.org", b"/Producer", b"<dc:date"):
        assert word not in first


def test_svg_has_the_exact_size_and_a_group_for_each_name(tmp_path):
    root = tree_of(globe(), tmp_path)
    assert root.get("width") == "200pt"
    assert float(root.get("height").removesuffix("pt")) == pytest.approx(globe().height, abs=1e-4)
    names = [element.get("id") for element in root.iter() if element.get("id")]
    assert len(names) == len(set(names))
    assert {"graticule", "graticule-2", "ball", "limb", "small_bubble", "sites", "label"} <= set(names)


def test_ids_are_unique_whatever_items_are_called(tmp_path):
    line = np.linspace([0.0, 2.0], [4.0, 2.0], 4)[None]
    names = ["title", "a b", "a b", "a-b", "a-b-2", "", "item", "ground", "label-halo", 'x"<&']
    lines = [Stroke(line, BLACK, 1.0 + k, name=name) for k, name in enumerate(names)]
    page = Page((0, 4, 0, 4), (*lines, Label("text", (2.0, 2.0), halo=1.0)), title="Lines")
    root = tree_of(page, tmp_path)
    found = [element.get("id") for element in root.iter() if element.get("id")]
    assert len(list(root.iter(f"{SVG}path"))) == len(names) + 1
    assert len(found) == len(set(found))
    assert all(re.fullmatch(r"[^\W\d][\w.-]*", name) for name in found)
    assert {"title-2", "a-b", "a-b-2", "item", "item-2", "x"} <= set(found)


@pytest.mark.parametrize(
    ("text", "name"),
    [("Côte d’Ivoire", "Côte-d-Ivoire"), ("12 °c", "_12-c"), ("a:b", "a-b"), ("東京", "東京"), ("-", ""), ("²x", "x")],
)
def test_names_in_xml(text, name):
    """Those of XML Schema's type NCName, as close as may be."""
    assert xml_name(text) == name


def test_words_are_one_run_in_their_own_family_and_halos_the_same_once_more(tmp_path):
    page = Page((0, 4, 0, 4), (Label("Wave AV", (2.0, 2.0), halo=1.0, rotation=30.0, font=("DejaVu Sans",)),))
    root = tree_of(page, tmp_path)
    (words,), (halo,) = root.iter(f"{SVG}text"), root.iter(f"{SVG}use")
    assert (words.text, len(words), len(words.get("x").split())) == ("Wave AV", 0, 1)
    first, second = words.get("font-family").split(",")[:2]
    assert first == "'DejaVu Sans'"
    assert f"@font-face{{font-family:{second};" in root.find(f"{SVG}style").text
    held = next(element for element in root.iter() if f"#{element.get('id')}" == halo.get(f"{LINK}href"))
    assert words in list(held)
    assert words.get("fill") is None  # the halo's or the label's


def test_words_beside_a_formula_are_one_run(tmp_path):
    page = Page((0, 4, 0, 4), (Label("centre of $N$ here", (2.0, 2.0)),))
    assert [span.text for span in tree_of(page, tmp_path).iter(f"{SVG}tspan")] == ["centre of ", "N", " here"]


def test_names_are_layers_as_inkscape_knows_them(tmp_path):
    line, dots = Stroke(bent(1.0), BLACK, 1.0, name="way"), Dots(np.ones((1, 2)), 2.0, BLACK, name="legend-way")
    shown = (line, replace(line, width=2.0), replace(line, name="way-outline"), dots, replace(dots, name="legend"))
    root = tree_of(Page((0, 4, 0, 4), (Label("words", (2.0, 2.0)), *shown)), tmp_path)
    layers = [group for group in root if group.get(f"{INKSCAPE}groupmode") == "layer"]
    assert [group.get(f"{INKSCAPE}label") for group in layers] == ["ground", "way", "legend", "labels"]
    assert [element.tag for element in root if element not in layers] == [f"{SVG}style"]


def test_bars_of_colour_scales_are_gradients(tmp_path):
    """Of the fewest colours that are right to half a level: one where all are on a line, many of viridis."""
    viridis = Ramp((0, 4), np.insert(mpl.colormaps["viridis"].colors, 3, 1.0, axis=1))
    assert len(Ramp((0, 4), np.linspace(0, 1, 256)[:, None] * np.ones(4)).stops) == 2  # of colours on a line
    assert 8 < len(viridis.stops) < 60
    places, colors = (np.array(part) for part in zip(*viridis.stops, strict=True))
    middles = (np.arange(256) + 0.5) / 256
    shown = np.stack([np.interp(middles, places, colors[:, k]) for k in range(3)], axis=1)
    assert np.abs(shown - viridis.colors[:, :3]).max() <= 0.5 / 255
    root = tree_of(Page((0, 4, 0, 4), (Picture((square(0, 4),), viridis, "bar"),)), tmp_path)
    assert len(list(root.iter(f"{SVG}linearGradient"))) == 1
    assert [path.get("id") for path in root.iter(f"{SVG}path")] == ["ground", "bar"]


def test_pdf_has_the_exact_size_and_text_that_can_be_searched(tmp_path):
    page = sheet_of(globe(), tmp_path)
    assert [float(side) for side in page.mediabox] == pytest.approx([0.0, 0.0, 200.0, globe().height], abs=1e-3)
    assert page.extract_text() == "φ north"
    fonts = [font.get_object()["/BaseFont"].partition("+")[2] for font in page["/Resources"]["/Font"].values()]
    assert fonts == ["STIXGeneral-Italic", "STIXGeneral-Regular"]


def test_a_whole_circle_is_twelve_cubics_and_no_line(tmp_path):
    scene = Scene(style="none")
    scene.add_circles([SphereCircle.around((0, 90), 30)])
    page = Page((-1, 1, -1, 1), scene.layout(View(0, 60)))
    path = path_of(page, tmp_path, "circle")
    assert path.count("c") == 12
    assert "l" not in path


def test_lines_of_no_length_are_not_drawn(tmp_path):
    """As what is left of arcs that touch the limb from behind; a point alone among lines is a dot."""
    speck = np.full((1, 4, 2), 2.0)
    lines = Polylines(np.array([[1.0, 1.0]]), np.array([0, 1]), BLACK, 2.0, "dot")
    page = Page((0, 4, 0, 4), (Stroke(speck, BLACK, 9.0, name="speck"), lines), width=72.0)
    text = save_vector(page, tmp_path / "page.svg").read_text(encoding="utf-8")
    assert "speck" not in text
    assert text.count("a1 1 ") == 2
    for draw in (Page.pixels, rasterize):
        picture = draw(page, size=72)
        assert (picture[30:42, 30:42] == 255).all()
        assert picture[53, 18, 0] < 128


def test_ligatures_are_found_as_letters(tmp_path):
    page = Page((0, 4, 0, 4), (Label("fi & <fl>", (2.0, 2.0)),))
    assert sheet_of(page, tmp_path).extract_text() == "fi & <fl>"
    text = "".join(next(tree_of(page, tmp_path).iter(f"{SVG}text")).itertext())
    assert normalize("NFKC", text) == "fi & <fl>"


def test_words_that_no_font_has_are_written_all_the_same(tmp_path, no_other_fonts):
    """As boxes, as matplotlib does; with the letters that were meant."""
    page = Page((0, 4, 0, 4), (Label("a\u6f22\U0001f30d\u6f22", (2.0, 2.0)), Label("two\nlines", (1.0, 1.0))))
    assert sheet_of(page, tmp_path).extract_text().splitlines() == ["a\u6f22\U0001f30d\u6f22", "two", "lines"]


def square(low, high):
    corners = np.array([(low, low), (high, low), (high, high), (low, high), (low, low)], dtype=float)
    return np.linspace(corners[:-1], corners[1:], 4, axis=1)


@pytest.mark.parametrize("size", [1, 7, 199, 2008])
def test_pixel_sizes_are_whole_and_agree(size):
    page = Page((0, 3, 0, 2), (Label("x", (1, 1)),), width=481.89)
    height = page.pixels_up(size)
    assert rasterize(page, size=size).shape == (height, size, 3)
    assert LabelLayer(page, size).rows().shape == (height, size, 4)


def test_the_label_layer_holds_the_labels_alone():
    page = globe()
    bare, (full,), layer = rasterize(page, size=400, text=False), agg_rows(page, 400), LabelLayer(page, 400)
    ink = layer.rows()[..., 3]
    touched = np.any(bare != full, axis=2)
    assert touched.any()
    assert not (touched & (ink == 0)).any()
    assert np.abs(layer.over(bare).astype(int) - full).max() <= 3
    assert np.array_equal(layer.over(bare), rasterize(page, size=400))
    assert LabelLayer(page.without_labels(), 400).over(bare) is bare


def test_labels_are_laid_over_a_picture_to_the_nearest_level():
    """Not to the one below, which is a level darker; each channel by itself."""
    layer = LabelLayer(globe(), 300)
    picture = np.random.default_rng(3).integers(0, 256, (layer.height, 300, 3)).astype(np.uint8)
    ink, share = layer.rows()[..., :3].astype(float), layer.rows()[..., 3:] / 255
    assert ((share > 0) & (share < 1)).sum() > 100
    assert np.array_equal(layer.over(picture), np.floor(share * ink + (1 - share) * picture + 0.5))


def bent(by):
    """A curve 72 points long whose controls stray from a straight line by so many points."""
    return np.array([[[0.0, 2.0], [4 / 3, 2.0 + by / 18], [8 / 3, 2.0 + by / 18], [4.0, 2.0]]])


@pytest.mark.parametrize(("by", "letter"), [(0.01, "c"), (0.001, "c"), (0.0002, "l")])
def test_what_is_straight_to_a_thousandth_of_a_point_is_a_line(tmp_path, by, letter):
    page = Page((0, 4, 0, 4), (Stroke(bent(by), BLACK, 1.0, name="line"),), width=72.0)
    path = path_of(page, tmp_path, "line")
    assert path.startswith(f"M0 36{letter}")


def test_runs_of_no_length_are_left_out_of_regions(tmp_path):
    page = Page((0, 4, 0, 4), (Fill((square(1, 2), square(3, 3.00001)), BLACK, "region"),), width=72.0)
    path = path_of(page, tmp_path, "region")
    assert path == "M18 54l18 0l0-18l-18 0Z"


def test_numbers_have_no_exponent(tmp_path):
    """PDF knows none."""
    faint = (1e-7, 0.5, 1.0, 1e-5)
    turned = Label("turned", (2.0, 2.0), rotation=90.0, color=faint)
    page = Page((0, 4, 0, 4), (Stroke(bent(9.0), faint, 1.0), turned), width=72.0)
    sheet = sheet_of(page, tmp_path)
    assert not re.search(rb"\de[-+]?\d", sheet.get_contents().get_data())
    assert "e-" not in str(sheet["/Resources"]["/ExtGState"])
    assert sheet.extract_text(orientations=90) == "turned"


def test_many_dots_and_lines_are_small_files_of_paths_that_programs_open(rng, tmp_path):
    """Ten thousand dots in half a megabyte, in parts that no program refuses; an opaque line as well."""
    places, corners = rng.uniform(0, 4, (10_000, 2)), rng.uniform(0, 4, (60_000, 2))
    offsets = np.arange(0, 60_001, 2)
    dots, lines = Dots(places, 0.4, BLACK, name="dots"), Polylines(corners, offsets, BLACK, 0.1, "lines")
    veil = replace(lines, color=(0.0, 0.0, 0.0, 0.5), name="veil")
    page = Page((0, 4, 0, 4), (dots, lines, veil), width=400.0)
    named = {element.get("id"): element for element in tree_of(page, tmp_path).iter()}
    text = {name: [path.get("d") for path in named[name].iter(f"{SVG}path")] for name in ("dots", "lines", "veil")}
    assert sum(map(len, text["dots"])) < 550_000
    assert max(map(len, text["dots"] + text["lines"])) < 201_000
    assert len(text["veil"]) == 1  # in parts it would be darker where they cross
    assert sum(part.count("M") for part in text["dots"]) == 10_000
    assert "".join(text["lines"]) == text["veil"][0]


def corners_of(path):
    """Where the corners of a path of straight lines lie, from the upper left, (n, 2)."""
    return np.array(re.findall(r"-?(?:\d+\.?\d*|\.\d+)", path), dtype=float).reshape(-1, 2).cumsum(axis=0)


def test_errors_of_relative_places_do_not_add_up(tmp_path):
    """Of a line of ten thousand corners, each is within half a step of its place."""
    corners = np.cumsum(np.random.default_rng(2).normal(0, 0.003, (10_000, 2)), axis=0) + 2
    page = Page((0, 4, 0, 4), (Polylines(corners, np.array([0, len(corners)]), BLACK, 0.1, "line"),), width=400.0)
    drawn = corners_of(path_of(page, tmp_path, "line"))
    assert np.abs(drawn - 100 * np.array([[0, 4]]) - 100 * corners * [1, -1]).max() <= 0.5e-3 + 1e-9


def test_regions_of_many_corners_are_round_though_most_corners_are_left_out(tmp_path):
    turn = np.linspace(0, 2 * np.pi, 2001)
    loop = 2 + np.stack([np.cos(turn), np.sin(turn)], axis=1)
    loop[-1] = loop[0]
    region = Polygons(loop, np.array([0, len(loop)]), np.array([0]), np.array([BLACK]), name="disc")
    drawn = corners_of(path_of(Page((0, 4, 0, 4), (region,), width=100.0), tmp_path, "disc")) - 50
    assert 100 < len(drawn) < 1200
    # The middles of chords are what lies farthest inside.
    off = 25 - np.linalg.norm((drawn + np.roll(drawn, 1, axis=0)) / 2, axis=1)
    assert np.abs(off).max() < 3e-3
