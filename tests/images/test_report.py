"""The sheet of pictures that changed."""

import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from tests.images.report import Failure, difference_picture, in_short, report_failure, report_pass
from tools.baselines import Lettering

NOWHERE = np.full(4, np.nan)


@pytest.fixture
def white():
    return np.full((100, 100, 3), 255, dtype=np.uint8)


@pytest.fixture
def spotted(white):
    other = white.copy()
    other[60:70, 40:50] = 0
    return other


class Elements(HTMLParser):
    """The elements of a page, each with its attributes and the texts within; none is left open."""

    def __init__(self, text):
        super().__init__()
        self.found, self._open = [], []
        self.feed(text)
        assert self._open == []

    def handle_starttag(self, tag, attributes):
        self.found.append((tag, dict(attributes), []))
        if tag not in {"meta", "img", "input"}:
            self._open.append(self.found[-1])

    def handle_startendtag(self, tag, attributes):
        self.found.append((tag, dict(attributes), []))

    def handle_endtag(self, tag):
        assert self._open.pop()[0] == tag

    def handle_data(self, data):
        for _, _, texts in self._open:
            texts.append(data)

    def __call__(self, tag, **attributes):
        """Attributes and text of those of a kind."""
        wanted = {name.rstrip("_"): value for name, value in attributes.items()}
        return [
            (found, "".join(texts))
            for name, found, texts in self.found
            if name == tag and wanted.items() <= found.items()
        ]


def elements(sheet):
    return Elements(sheet.read_text(encoding="utf-8"))


def test_the_difference_is_red_where_it_can_be_seen(white):
    other = white.copy()
    other[0, 0] = 0
    other[1, 1] = 250
    marked = difference_picture(white, other)
    assert marked[0, 0].tolist() == [220, 0, 0]
    assert marked[1, 1].tolist() == [240, 160, 0]
    assert np.ptp(marked[5, 5]) == 0


def test_pictures_of_other_shapes_are_compared_where_both_are(white):
    assert difference_picture(white, white[:50, :70]).shape == (50, 70, 3)


def test_the_report_is_one_file_that_needs_no_other(tmp_path, white, spotted):
    sheet = report_failure(Failure("fig02", ("T2: <half> of it",), white, spotted), tmp_path)
    text = sheet.read_text(encoding="utf-8")
    assert "T2</b>&lt;half&gt; of it" in text
    assert not re.search(r"https?:|url\(|@import|<link|src=\"(?!data:image/png;base64,)", text)
    # Stored, today, difference, and the worst place of each.
    assert len(elements(sheet)("img")) == 6


def test_the_index_counts_and_puts_first_what_differs_most(tmp_path, white, spotted):
    black = 0 * white
    for number in range(5):
        report_pass(f"fig1{number}", tmp_path)
    report_failure(Failure("fig01", ("T0: a", "T0: b"), white, white), tmp_path)
    report_failure(Failure("fig02", ("T2: c", "T0: d"), white, spotted), tmp_path)
    report_failure(Failure("fig03", ("T3: e",), white, white), tmp_path)
    report_failure(Failure("fig04", ("T2: f",), white, black), tmp_path)
    sheet = report_failure(Failure("fig05", ("T1: g",), None, white), tmp_path)
    found = elements(sheet)
    ((_, summary),) = found("p", class_="summary")
    assert summary == "10 pictures checked, 5 failed: missing (T1) 1 · pixels (T2) 2 · type (T3) 1 · numbers (T0) 2"
    order = ["fig05", "fig04", "fig02", "fig03", "fig01"]
    assert [link["href"] for link, _ in found("a")[:5]] == [f"#{name}" for name in order]
    assert [section["id"] for section, _ in found("section")] == order
    rows = [text for _, text in found("tr")[1:]]
    assert rows == [
        *("fig05T1 missing", "fig04T2 pixels100.0000%100.0000%", "fig02T2 pixelsT0 numbers1.0000%1.0000%1"),
        *("fig03T3 type1", "fig01T0 numbers2"),
    ]


def test_what_can_be_seen_comes_first_and_what_is_too_much_is_folded(tmp_path, white, spotted):
    numbers = [f"T0: stroke {number}, style: width is 2, expected 1" for number in range(300)]
    failure = Failure("fig02", (*numbers, 'T3: label 1 ("N") has moved', "T2: 1 % of the pixels"), white, spotted)
    found = elements(report_failure(failure, tmp_path))
    assert [text[:2] for _, text in found("li")] == ["T2", "T3", *["T0"] * 300]
    ((_, folded),) = found("details")
    assert folded.startswith("292 more by T0")
    assert folded.count("T0stroke") == 292
    assert [text for _, text in found("ul")][2].count("T0stroke") == 8


def test_the_terminal_says_what_it_leaves_out():
    assert in_short(["T2: a", "T3: b"]) == ["T2: a", "T3: b"]
    messages = ["T2: a", *(f"T3: {number}" for number in range(9)), *(f"T0: {number}" for number in range(40))]
    assert in_short(messages) == [*messages[:8], "and 42 more, 2 by T3, 40 by T0"]


def test_the_worst_place_is_shown_eight_times_as_large(tmp_path, white, spotted):
    found = elements(report_failure(Failure("fig02", ("T2: c",), white, spotted), tmp_path))
    ((frame, _),) = found("rect", class_="tile")
    assert (frame["x"], frame["y"], frame["width"]) == ("32", "48", "32")
    sizes = [(image["width"], image["height"], image["alt"]) for image, _ in found("img")[3:]]
    place = "rows from 40, columns from 24"
    assert sizes == [("384", "384", f"{what}, {place}") for what in ("stored", "today", "difference")]


def label(text, stored, found, wrong=""):
    return Lettering(text, np.array(stored, dtype=float), np.array(found, dtype=float), wrong)


def test_boxes_of_labels_lie_where_their_ink_lies(tmp_path, white):
    labels = (
        label("north", (10, 40, 40, 46), (10, 40, 40, 46)),
        label("south <1>", (10, 10, 40, 16), (15, 10, 45, 16), "has moved"),
        label("$R$", (1, 2, 5, 8), NOWHERE, "has no ink"),
        label("", NOWHERE, NOWHERE),
    )
    failure = Failure("fig02", ("T3: b",), white, white, labels, width=50.0)
    found = elements(report_failure(failure, tmp_path))
    assert [box["viewbox"] for box, _ in found("svg", class_="boxes")] == ["0 0 50.00 50.00"] * 2
    boxes = [(b["class"], *(float(b[side]) for side in ("x", "y", "width", "height")), t) for b, t in found("rect")]
    before = [
        ("box", 10, 4, 30, 6, "north"),
        ("box moved", 10, 34, 30, 6, "south <1>"),
        ("box moved", 1, 42, 4, 6, "$R$"),
    ]
    after = [
        *(("box", 10, 4, 30, 6, "north"), ("box moved", 15, 34, 30, 6, "south <1>")),
        *(("box moved before", 10, 34, 30, 6, "south <1>"), ("box moved before", 1, 42, 4, 6, "$R$")),
    ]
    assert boxes == [before[0], before[1], before[2], *after]
    assert [text for _, text in found("text")] == ["north", "south <1>", "R", "north", "south <1>"]
    assert "pixel for pixel" in found("p", class_="same")[0][1]


def test_the_slider_and_the_buttons_work_with_keys(tmp_path, white, spotted):
    failure = Failure("fig02", ("T2: c",), white, spotted, (label("N", (1, 1, 5, 5), (1, 1, 5, 5)),), width=50.0)
    found = elements(report_failure(failure, tmp_path))
    ((slider, _),) = found("input", type="range")
    assert slider["aria-label"].startswith("fig02: ")
    assert [(button["type"], text) for button, text in found("button")] == [("button", "Flicker"), ("button", "Labels")]
    # Each name that the script asks for is there.
    (script,) = (text for _, text in found("script"))
    classes = {name for _, attributes, _ in found.found for name in (attributes.get("class") or "").split()}
    asked = {
        name for query in re.findall(r"querySelector(?:All)?\(\"([^\"]*)\"", script) for name in query.split(".")[1:]
    }
    assert asked == {"comparison", "stage", "side", "left", "right"}
    assert asked | {"flicker", "labels"} <= classes


def test_without_a_stored_picture_or_with_another_shape_both_stand_side_by_side(tmp_path, white):
    new = elements(report_failure(Failure("fig01", ("T1: missing",), None, white), tmp_path / "new"))
    assert [image["alt"] for image, _ in new("img")] == ["fig01, today"]
    other = elements(report_failure(Failure("fig01", ("T2: shape",), white, white[:50]), tmp_path / "other"))
    assert [text for _, text in other("figcaption")] == ["stored, 100 × 100 pixels", "today, 100 × 50 pixels"]
    assert not new("input")
    assert not other("input")


def test_what_passes_again_leaves_the_report(tmp_path, white):
    for name in ("fig01", "fig02"):
        sheet = report_failure(Failure(name, ("T1: a",), white, white), tmp_path)
    report_pass("fig01", tmp_path)
    report_pass("fig09", tmp_path)
    text = sheet.read_text(encoding="utf-8")
    assert "fig01" not in text
    assert "fig02" in text
    report_pass("fig02", tmp_path)
    assert "3 pictures checked, none failed" in "".join(elements(sheet)("p")[0][1])
    assert json.loads((tmp_path / "parts" / "fig09.json").read_text()) == {"nets": {}}
