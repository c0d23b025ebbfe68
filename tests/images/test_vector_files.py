"""SVG and PDF hold what their page holds: Chromium and PDFium show our picture, and the words can be read."""

import xml.etree.ElementTree as ET

import numpy as np
import pypdf

from stereodel.drawing.page import Ball, Dots, Fill, Label, Page, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.items import Ramp
from stereodel.render.save import region_pictures, save_vector
from tests.images.foreign import DPI, FIGURES, LARGE, by_chromium, by_pdfium, disagreements
from tests.images.scripts import cases, thorough_but_for
from tests.render.test_pages import box, circle, disc, gradient_level, lines

BLACK, WHITE, RED = (0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0), (0.8, 0.1, 0.0, 1.0)


def wrong_in_files(page, browser, folder, renderer="gl", limits=FIGURES):
    """Where the files of a page show something else than the page, a line each."""
    width = round(page.width / 72 * DPI)
    ours = page.pixels(size=width, renderer=renderer)
    found = shown_files(page, ours.shape, browser, folder)
    return [f"{kind}: {what}" for kind, theirs in found.items() for what in disagreements(page, ours, theirs, limits)]


def shown_files(page, shape, browser, folder):
    """What Chromium and PDFium show of the files of a page."""
    drawn = region_pictures(page, shape[1])
    svg, pdf = (save_vector(page, folder / f"page.{kind}", pictures=drawn) for kind in ("svg", "pdf"))
    return {"svg": by_chromium(browser, svg, shape), "pdf": by_pdfium(pdf, shape)}


@thorough_but_for("fig03_bubbles", "fig11_fisheye4")
def test_the_files_of_a_script_show_its_picture(script, browser, tmp_path):
    """Of a film that of its last frame."""
    case = cases(script)[-1]
    assert wrong_in_files(case.page, browser, tmp_path, case.renderer) == []


class Checks:
    """A painter of squares in many colours, of which every other one is seen through."""

    def paint(self, place, pixels):
        left, top, width, height = place
        columns, rows = pixels
        x, y = np.meshgrid(left + width * (np.arange(columns) + 0.5), top - height * (np.arange(rows) + 0.5))
        odd = (np.floor(2 * x) + np.floor(2 * y)) % 2 == 1
        return np.stack([200 * odd, 20 * x * odd, 20 * y * odd, 255 * odd], axis=-1).astype(np.uint8)


def fan(middle, turn, radius, **more):
    """A ring, or a part of one, of many points."""
    angle = np.linspace(0.0, turn, 1301)
    arc = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    whole = turn == 2 * np.pi
    arc[-1] = arc[0] if whole else arc[-1]
    outer, inner = np.array(middle) + radius * arc, np.array(middle) + 0.6 * radius * arc[::-100]
    loops = [outer, inner] if whole else [np.concatenate([outer, inner, outer[:1]])]
    return polygons(loops, np.zeros(len(loops), np.intp), np.array([(0.3, 0.6, 0.2, 0.5)]), **more)


def polygons(loops, owner, colors, **more):
    return Polygons(np.concatenate(loops), np.cumsum([0, *map(len, loops)]), owner, colors, **more)


def checkerboard(left, bottom):
    """More colours than paths are made of, side by side in a box."""
    x, y = left + np.linspace(0, 0.8, 10), bottom + np.linspace(0, 0.8, 9)
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)])
    loops = [np.stack([x[i + corners[:, 0]], y[j + corners[:, 1]]], axis=1) for i in range(9) for j in range(8)]
    count = np.arange(len(loops))
    return polygons(loops, count, np.stack([count / 100, 1 - count / 100, 0 * count, 0 * count + 1], axis=1))


def everything():
    """A page with each kind of item in each of its ways, large, so that a small change of it shows."""
    bent = np.array(
        [[[0.1, 0.2], [0.3, 0.9], [0.8, 0.9], [1.0, 0.2]], [[1.0, 0.2], [1.1, -0.1], [1.2, -0.1], [1.3, 0.2]]]
    )
    zigzag = lines((0.0, 0.0), (0.9, 0.1), (0.0, 0.35), (0.9, 0.6))
    many = np.array([(0.0, 0.1), (1.2, 0.15), (0.1, 0.3), (0.2, 0.5), (1.2, 0.5), (0.7, 0.9), (0.2, 0.5), (0.05, 0.8)])
    offsets = np.array([0, 3, 7, 8])
    ring = (box(0, 0.8, 0, 0.8), box(0.2, 0.6, 0.2, 0.6))
    veil, fading = (0.0, 0.3, 0.0, 0.5), np.linspace([0.9, 0.9, 0.2, 1.0], [0.3, 0.3, 0.5, 1.0], 200)
    items = (
        Fill(tuple(part + [0.1, 1.1] for part in ring), (0.9, 0.6, 0.1, 0.4)),
        Fill((*(part + [0.3, 1.0] for part in ring), box(0.6, 0.8, 1.3, 1.5)), RED),
        checkerboard(2.3, 2.0),
        Picture((box(4.2, 5.4, 3.5, 3.7),), Ramp((4.2, 5.4), fading ** [[1, 2, 1, 1]])),
        Picture((circle((3.6, 2.4), 0.4),), Checks()),
        fan((1.8, 1.5), 1.5 * np.pi, 0.35),
        fan((1.9, 1.5), 2.0 * np.pi, 0.4),
        Stroke(bent + [2.3, 1.1], RED, 2.0, dash=(6.0, 4.0), cap="butt"),
        Stroke(bent + [2.3, 1.2], RED, 0.5, dash=(6.0, 4.0), cap="butt"),
        Stroke(bent + [2.3, 1.3], RED, 1.0, dash=(6.0, 4.0)),
        Stroke(zigzag + [0.1, 0.2], BLACK, 4.0, cap="butt"),
        Stroke(zigzag + [1.2, 0.2], veil, 4.0, cap="butt"),
        Stroke(zigzag + [1.5, 0.2], veil, 4.0),
        Stroke(box(-0.1, 6.4, -0.1, 0.1), BLACK, 1.5, closed=True),
        Polylines(many + [2.6, 0.15], offsets, (0.0, 0.0, 1.0, 0.6), 1.6),
        Polylines(many + [3.9, 1.0], offsets, BLACK, 0.8),
        Dots(np.array([[4.2, 2.5], [4.5, 2.3], [4.55, 2.35]]), 8.0, RED, rim_width=2.0),
        Dots(np.array([[4.8, 2.8]]), 3.0, BLACK),
        Label("North", (0.1, 4.0), (3.0, 4.0), align="left", valign="top", size=100.0, color=RED),
        Label(r"$\frac{\varphi}{2}$ and $\sqrt{2\pi}$", (4.4, 3.0), size=30.0, rotation=-10.0),
        Label("", (2.0, 0.7)),
        Label(
            "Lea & Anne", (6.1, 0.5), align="right", size=20.0, color=WHITE, halo=4.0, halo_color=(0.1, 0.2, 0.6, 0.6)
        ),
        Label("שלום", (5.4, 1.4), size=50.0),
        Label("سلام עולם", (5.4, 2.2), size=30.0),
    )
    told = {"title": "Everything & “all”", "description": "A page <of> tests.\n\nφ = 5°."}
    return Page((0.0, 6.2, 0.0, 4.0), items, width=396.8, background=(0.98, 0.97, 0.9, 1.0), **told)


def test_files_show_each_kind_of_item(browser, tmp_path):
    assert wrong_in_files(everything(), browser, tmp_path, limits=LARGE) == []


def test_files_show_the_light_of_balls(browser, tmp_path):
    """On a whole ball and on land; in SVG to a level as the gradient of the page says, by PDFium in 256 steps."""
    ball = Ball((1.0, 1.0), 0.9)
    items = (
        Fill((circle(ball.center, 0.9),), WHITE, ball=ball),
        fan((3.0, 1.0), 1.3 * np.pi, 0.8, ball=Ball((3.0, 1.0), 0.9)),
    )
    page = Page((0.0, 4.0, 0.0, 2.0), items, width=144.0)
    assert wrong_in_files(page, browser, tmp_path, limits=LARGE) == []
    x, y, inside = disc(540)
    for kind, theirs in shown_files(page, page.pixels(size=1200).shape, browser, tmp_path).items():
        found = theirs[30:570, 30:570, 0][inside]
        apart = np.abs(found - 255 * gradient_level(x, y))[x**2 + y**2 < 0.95]
        assert apart.max() < {"svg": 1.5, "pdf": 6.0}[kind]
        assert apart.mean() < 0.55


def test_words_can_be_read_and_say_what_the_labels_say(tmp_path):
    """In SVG and PDF alike, letter by letter: others of the same look would not be found."""
    page = everything()
    words = [label.text for label in page.labels if label.text and "$" not in label.text]
    svg, pdf = (
        save_vector(page, tmp_path / f"page.{kind}", pictures=[np.zeros((10, 20, 3), dtype=np.uint8)])
        for kind in ("svg", "pdf")
    )
    root = ET.parse(svg).getroot()
    in_svg = ["".join(text.itertext()) for text in root.iter("{http://www.w3.org/2000/svg}text")]
    assert [text for text in in_svg if text in words] == words
    in_pdf = pypdf.PdfReader(pdf).pages[0].extract_text()
    assert all(word in in_pdf for word in words if word.isascii())
    told = pypdf.PdfReader(pdf).metadata
    assert (told["/Title"], told["/Subject"]) == (page.title, page.description)
    assert [root.find(f"{{http://www.w3.org/2000/svg}}{name}").text for name in ("title", "desc")] == [
        page.title,
        page.description,
    ]
