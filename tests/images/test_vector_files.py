"""SVG and PDF hold what their page holds, item by item: paths, colours, light, widths, pictures, type, words, title."""

from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing.page import Ball, Dots, Fill, Label, Page, Picture, Polygons, Polylines, Stroke
from stereodel.render.save import region_pictures, save_vector
from tests.images.marks import path_of
from tests.images.page_marks import differences, expected
from tests.images.read_pdf import read_pdf
from tests.images.read_svg import read_svg
from tests.images.scripts import by_script, cases
from tests.images.type_marks import type_differences
from tools.baselines import SIZE
from tools.image import ink_boxes

READERS = {"svg": read_svg, "pdf": read_pdf}


def wrong_in_files(page, ink, folder):
    """What is wrong with the files of a page, a line each."""
    drawn = region_pictures(page, SIZE)
    wanted = expected(page, drawn)
    wrong, sheets, type_marks = [], {}, {}
    for kind, read in READERS.items():
        sheets[kind] = read(save_vector(page, folder / f"page.{kind}", pictures=drawn))
        found, type_marks[kind] = differences(page, sheets[kind], wanted)
        wrong += [f"{kind}: {what}" for what in found]
    return wrong or type_differences(page, ink, sheets, type_marks)


@by_script
def test_the_files_of_a_script_hold_what_its_pages_hold(script, tmp_path):
    assert {
        case.name: wrong for case in cases(script) if (wrong := wrong_in_files(case.page, case.ink, tmp_path))
    } == {}


BLACK, RED = (0.0, 0.0, 0.0, 1.0), (0.8, 0.1, 0.0, 1.0)


def lines(*points):
    points = np.array(points, dtype=float)
    return np.linspace(points[:-1], points[1:], 4, axis=1)


def box(left, right, bottom, top):
    return lines((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom))


class Checks:
    """A painter of squares in many colours, of which every other one is seen through."""

    def paint(self, place, pixels):
        left, top, width, height = place
        columns, rows = pixels
        x, y = np.meshgrid(left + width * (np.arange(columns) + 0.5), top - height * (np.arange(rows) + 0.5))
        odd = (np.floor(4.7 * x) + np.floor(4.7 * y)) % 2 == 1
        return np.stack([200 * odd, 99.3 * x * odd, 99.3 * y * odd, 255 * odd], axis=-1).astype(np.uint8)

    def arrays(self):
        return {}


def fan(turn, radius=0.4):
    """A ring, or a part of one, of many points, with a speck; the outside is an arc."""
    angle = np.linspace(0.0, turn, 1301)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    whole = turn == 2 * np.pi
    circle[-1] = circle[0] if whole else circle[-1]
    middle = np.array([3.0, 0.5])
    outer, inner = middle + radius * circle, middle + 0.3 * circle[::-100]
    speck = np.array([[3.4, 0.9], [3.40001, 0.9], [3.4, 0.90001], [3.4, 0.9]])
    loops = [outer, inner, speck] if whole else [np.concatenate([outer, inner, outer[:1]]), speck]
    return polygons(loops, np.zeros(len(loops), np.intp), np.array([(0.3, 0.6, 0.2, 0.5)]), "fan")


def polygons(loops, owner, colors, name):
    return Polygons(np.concatenate(loops), np.cumsum([0, *map(len, loops)]), owner, colors, name=name)


def checkerboard(name):
    """More colours than paths are made of, side by side in a box."""
    x, y = np.linspace(2.6, 3.4, 10), np.linspace(1.1, 1.9, 9)
    loops = [
        np.array([(x[i], y[j]), (x[i + 1], y[j]), (x[i + 1], y[j + 1]), (x[i], y[j + 1]), (x[i], y[j])])
        for i in range(9)
        for j in range(8)
    ]
    count = np.arange(len(loops))
    colors = np.stack([count / 100, 1 - count / 100, 0 * count, 0 * count + 1], axis=1)
    return polygons(loops, count, colors, name)


def everything():
    """A page with each kind of item, in each of its ways."""
    bent = np.array(
        [[[0.2, 1.2], [0.4, 1.9], [0.9, 1.9], [1.1, 1.2]], [[1.1, 1.2], [1.2, 0.9], [1.3, 0.9], [1.4, 1.2]]]
    )
    outline = (box(1.6, 2.4, 1.1, 1.9), box(1.8, 2.2, 1.3, 1.7))
    polylines = np.array(
        [(0.2, 0.2), (1.8, 0.3), (0.3, 0.5), (2.5, 0.5), (3.8, 0.5), (3.1, 1.8), (2.5, 0.5), (1.0, 1.5)]
    )
    items = (
        Fill((box(0.1, 1.5, 0.1, 1.9),), (0.9, 0.95, 1.0, 1.0), "ball", Ball((0.8, 1.0), 0.7)),
        checkerboard("cells"),
        Picture((box(0.3, 1.2, 0.2, 1.0),), Checks(), "checks"),
        Fill(outline, (0.9, 0.6, 0.1, 0.4), "ring"),
        replace(fan(0.7 * np.pi, radius=0.35), ball=Ball((3.0, 0.5), 0.45), name="lit land"),
        Fill((*outline, box(1.9, 2.1, 1.4, 1.6)), RED, "island"),
        fan(1.5 * np.pi),
        fan(2.0 * np.pi, radius=0.45),
        Stroke(bent, RED, 2.0, dash=(6.0, 4.0), cap="butt", name="dashed"),
        Stroke(bent - [0.0, 0.1], RED, 0.5, dash=(6.0, 4.0), name="dashed"),
        Stroke(bent - [0.0, 0.2], RED, 1.0, dash=(6.0, 4.0), closed=True, name="dashed"),
        Stroke(box(-0.5, 4.5, 0.4, 2.5), BLACK, 1.5, closed=True, name="beyond"),
        Stroke(bent + [0.1, 0.0], BLACK, 1.5, name="beyond"),
        Stroke(lines((1.0, 1.0), (1.0, 1.0)), BLACK, 1.5, name="speck"),
        *(Stroke(bent + [0.1 * k, -0.5], (0.0, 0.3, 0.0, 0.5), 3.0, cap="butt", name="veil") for k in range(2)),
        Polylines(polylines, np.array([0, 3, 7, 8]), (0.0, 0.0, 1.0, 0.6), 0.8, "coast"),
        Polylines(polylines + 0.05, np.array([0, 3, 7, 8]), BLACK, 0.8, "border"),
        Dots(np.array([[0.5, 1.5], [2.0, 1.0], [2.05, 1.02]]), 4.0, RED, rim_width=1.0, name="sites"),
        Dots(np.array([[3.9, 0.1]]), 2.0, BLACK),
        Label("north", (1.0, 1.0), (3.0, 4.0), align="left", valign="bottom", color=RED),
        Label(r"$\frac{\varphi}{2}$ and $\sqrt{2\pi}$", (2.0, 0.7), size=14.0, rotation=30.0),
        Label("", (2.0, 0.7)),
        Label("West Point", (3.0, 1.0), align="right", halo=1.2, halo_color=(0.9, 0.9, 0.7, 1.0), valign="top"),
    )
    told = {"title": "Everything & “all”", "description": "A page <of> tests.\n\nφ = 5°."}
    return Page((0.0, 4.0, 0.0, 2.0), items, width=300.0, background=(0.98, 0.97, 0.9, 1.0), **told)


def test_files_hold_each_kind_of_item(tmp_path):
    page = everything()
    assert wrong_in_files(page, ink_boxes(page), tmp_path) == []


@pytest.mark.parametrize("kind", READERS)
def test_dashes_have_the_same_length_whatever_the_width(kind, tmp_path):
    dashed = [item for item in everything().items if item.name == "dashed"]
    sheet = READERS[kind](save_vector(replace(everything(), items=tuple(dashed)), tmp_path / f"page.{kind}"))
    assert [(mark.width, mark.dash) for mark in sheet.marks[1:]] == [(width, (6.0, 4.0)) for width in (2.0, 0.5, 1.0)]


def without(page, name):
    return replace(page, items=tuple(item for item in page.items if item.name != name))


def changed(page, name, **fields):
    """A page of whose items those of a name differ in some fields, each a value or a function of what there is."""
    items = []
    for item in page.items:
        if item.name == name:
            new = {name: value(getattr(item, name)) if callable(value) else value for name, value in fields.items()}
            item = replace(item, **new)
        items.append(item)
    return replace(page, items=tuple(items))


NEAR = 2e-3 * 4 / 300
"""Two thousandths of a point in the units of `everything`."""

CHANGES = {
    "the ground": lambda page: replace(page, background=(0.98, 0.97, 0.91, 1.0)),
    "the size": lambda page: replace(page, width=300.01),
    "another order": lambda page: replace(page, items=page.items[::-1]),
    **{
        f"{name} missing": lambda page, name=name: without(page, name)
        for name in ("ball", "cells", "checks", "ring", "fan", "dashed", "beyond", "veil", "coast", "sites", "lit land")
    },
    **{
        f"{name} paler": lambda page, name=name: changed(
            page, name, color=lambda c: (*(v - 2 / 255 if v > 0.5 else v + 2 / 255 for v in c[:3]), c[3])
        )
        for name in ("ball", "ring", "dashed", "beyond", "veil", "coast", "border", "sites")
    },
    **{
        f"{name} more opaque": lambda page, name=name: changed(page, name, color=lambda c: (*c[:3], c[3] + 2 / 255))
        for name in ("ring", "veil", "coast")
    },
    **{
        f"{name} wider": lambda page, name=name: changed(page, name, width=lambda width: width + 2e-3)
        for name in ("dashed", "beyond", "veil", "coast", "border")
    },
    "rim wider": lambda page: changed(page, "sites", rim_width=1.002),
    "rim of another colour": lambda page: changed(page, "sites", rim=(1.0, 1.0, 0.99, 1.0)),
    "dots larger": lambda page: changed(page, "sites", radius=4.002),
    "a dot elsewhere": lambda page: changed(page, "sites", centers=lambda c: c + [[0, 0], [NEAR, 0], [0, 0]]),
    "dashes longer": lambda page: changed(page, "dashed", dash=(6.002, 4.0)),
    "no dashes": lambda page: changed(page, "dashed", dash=None),
    "other ends": lambda page: changed(page, "veil", cap="round"),
    "open": lambda page: changed(page, "dashed", closed=False),
    "a curve elsewhere": lambda page: changed(page, "veil", path=lambda path: path + [0.0, NEAR]),
    "a bend elsewhere": lambda page: changed(
        page, "dashed", path=lambda path: path + 3 * NEAR * np.eye(4)[1][None, :, None] * [0.0, 1.0]
    ),
    "a fill elsewhere": lambda page: changed(page, "ring", paths=lambda paths: (paths[0] + [NEAR, 0.0], paths[1])),
    "a hole filled": lambda page: changed(page, "ring", paths=lambda paths: paths[:1]),
    "a corner elsewhere": lambda page: changed(page, "coast", points=lambda points: points + [[0.0, NEAR]]),
    "a line missing": lambda page: changed(
        page, "coast", points=lambda points: points[:7], offsets=np.array([0, 3, 7])
    ),
    "lines joined": lambda page: changed(page, "coast", offsets=np.array([0, 7, 8])),
    "polygons paler": lambda page: changed(page, "fan", colors=lambda colors: colors + [[2 / 255, 0, 0, 0]]),
    "polygons more opaque": lambda page: changed(page, "fan", colors=lambda colors: colors + [[0, 0, 0, 2 / 255]]),
    "a corner of a polygon missing": lambda page: changed(
        page, "fan", points=lambda points: np.where(np.arange(len(points))[:, None] == 1308, points[1307], points)
    ),
    "a corner of a polygon elsewhere": lambda page: changed(
        page, "fan", points=lambda points: points + 20 * NEAR * (np.arange(len(points)) == 1308)[:, None] * [-1.0, 0.0]
    ),
    "cells on a smaller place": lambda page: changed(page, "cells", points=lambda points: points * [1.0, 0.99]),
    "a label elsewhere": lambda page: changed(page, "label", offset=lambda offset: (offset[0] + 0.4, offset[1])),
    "a label larger": lambda page: changed(page, "label", size=lambda size: 1.05 * size),
    "a label of another colour": lambda page: changed(page, "label", color=(0.0, 0.0, 0.01, 1.0)),
    "a label missing": lambda page: replace(page, items=page.items[:-1]),
    "no halo": lambda page: changed(page, "label", halo=0.0),
    "a wider halo": lambda page: changed(page, "label", halo=lambda halo: halo and halo + 0.01),
    "another halo": lambda page: changed(page, "label", halo_color=(0.9, 0.9, 0.71, 1.0)),
    "light from a ball aside": lambda page: changed(page, "ball", ball=Ball((0.8 + NEAR, 1.0), 0.7)),
    "light from a larger ball": lambda page: changed(page, "lit land", ball=Ball((3.0, 0.5), 0.45 + NEAR)),
    "no light": lambda page: changed(page, "lit land", ball=None),
    "light on what is flat": lambda page: changed(page, "ring", ball=Ball((2.0, 1.5), 0.6)),
    "lit colours paler": lambda page: changed(page, "lit land", colors=lambda colors: colors + [[2 / 255, 0, 0, 0]]),
    "lit colours more opaque": lambda page: changed(
        page, "lit land", colors=lambda colors: colors + [[0, 0, 0, 2 / 255]]
    ),
    "another title": lambda page: replace(page, title="Everything and all"),
    "no title": lambda page: replace(page, title=""),
    "no description": lambda page: replace(page, description=""),
    "a description on one line": lambda page: replace(page, description=page.description.replace("\n", " ")),
    "letters of the same outline": lambda page: changed(
        page, "label", text=lambda text: text.replace("West", "W\u0435st")
    ),
    "another text": lambda page: changed(page, "label", text=lambda text: text.replace("north", "morth")),
}


@pytest.fixture(scope="module")
def as_it_is(tmp_path_factory):
    """What the files of `everything` show, the marks of their type, and the ink of its labels."""
    folder, page = tmp_path_factory.mktemp("files"), everything()
    sheets, type_marks = {}, {}
    for kind, read in READERS.items():
        sheets[kind] = read(save_vector(page, folder / f"a.{kind}", pictures=pictures(page)))
        wrong, type_marks[kind] = differences(page, sheets[kind], expected(page, pictures(page)))
        assert wrong == []
    ink = ink_boxes(page)
    assert type_differences(page, ink, sheets, type_marks) == []
    return page, sheets, type_marks, ink


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("kind", READERS)
def test_a_file_of_another_page_is_told_apart(kind, change, as_it_is, tmp_path):
    """One of the two files shows a page that differs a little."""
    page, sheets, type_marks, ink = as_it_is
    other = CHANGES[change](page)
    file = save_vector(other, tmp_path / f"b.{kind}", pictures=pictures(other))
    sheet = READERS[kind](file)
    wrong, marks = differences(page, sheet, expected(page, pictures(page)))
    assert wrong or type_differences(page, ink, {**sheets, kind: sheet}, {**type_marks, kind: marks})


def pictures(page):
    """A picture for each item in many colours that needs no OpenGL."""
    ramp = (np.arange(2400) % 251).astype(np.uint8).reshape(20, 40, 3)
    return [ramp for item in page.items if isinstance(item, Polygons) and item.pictured]


def test_paths_are_read_by_their_commands():
    path = path_of(b"MLLZMQML", [0, 0, 3, 0, 3, 3, 9, 9, 12, 9, 12, 12, 5, 5, 5, 5])
    assert path.closed.tolist() == [True, False, False]
    assert path.run.tolist() == [0, 0, 0, 1, 2]
    assert path.pieces[2].tolist() == [[3, 3], [2, 2], [1, 1], [0, 0]]
    assert path.pieces[3].tolist() == [[9, 9], [11, 9], [12, 10], [12, 12]]
    assert path.pieces[4].tolist() == [[5, 5]] * 4


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('stroke-width="1.5"', 'stroke-miterlimit="3"'),
        ("<path ", "<circle "),
        ("c0 ", "C0 "),
        ('id="coast"', 'id="border"'),
        ('id="fan"', 'id="a fan"'),
        ('d="M15 ', 'd="M15.0001 '),
        ('id="ball-light"', 'id="no-light"'),
        (' aria-labelledby="title desc"', ""),
        ("font-weight:normal", "font-weight:light"),
        ("data:font/woff", "data:font/none"),
        ('class="type-1"', 'class="type-3"'),
    ],
)
def test_the_reader_of_svg_refuses_what_it_does_not_know(old, new, tmp_path):
    file = save_vector(everything(), tmp_path / "page.svg", pictures=pictures(everything()))
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises((AssertionError, NotImplementedError, KeyError)):
        read_svg(file)
