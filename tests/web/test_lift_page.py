"""The Lift room in a browser: the slider, P and Q, what is drawn and said of it."""

import itertools

import numpy as np
import pytest

from stereodel import RectangleLift, angular_distance

from .rooms import link, numbers, opened, said, table

pytestmark = pytest.mark.thorough  # what is asked once of each room by day stands in test_page.py

ROOM = "#room-lift"
PLATE = "#lift-plate"


def output(page, name):
    return said(page, "lift", name)


def test_the_numbers_are_those_of_the_library(room):
    page = room("lift")
    places, lift = [], RectangleLift(3, 2)
    for site in (3, 7):
        page.page.click(f"{ROOM} tr[data-site='{site}'] button")
        cells = page.page.locator(f"{ROOM} tr[data-site='{site}'] td").all_inner_texts()
        *place, scale = (float(cell.replace("\u2212", "-")) for cell in cells)
        places.append(np.array(place))
        assert scale == pytest.approx(float(lift.scale_factor(place)), abs=6e-4)
    p, q = places
    distance = np.linalg.norm(p - q)
    angle = float(angular_distance(lift.forward(p), lift.forward(q)))
    t = distance / lift.diagonal
    assert numbers(output(page, "separation")) == pytest.approx([distance, t, angle], abs=6e-2)
    expected = [90 * t, 720 / np.pi * t, np.degrees(2 * np.arcsin(t)), np.degrees(4 * np.arctan(t))]
    assert numbers(output(page, "promise")) == pytest.approx(expected, abs=6e-2)
    state = link(page)
    assert (state["p"], state["q"]) == ("4", "8")


def test_the_picture_is_turned_by_the_hand_and_sites_are_chosen_by_keys_and_fields(room):
    page = room("lift")
    x, y = page.middle(PLATE)
    before = page.digest(PLATE)
    page.drag((x + 200, y - 150), (x + 120, y - 150))
    page.rest()
    assert page.digest(PLATE) != before
    turned = float(page.page.locator(f"{ROOM} [name=view-side]").input_value())
    assert turned == pytest.approx(17 + 0.35 * 80, abs=1)
    page.page.fill(f"{ROOM} [name=view-height]", "60")
    assert link(page)["height"] == "60"
    page.page.press(PLATE, "0")
    page.rest()
    assert page.digest(PLATE) == before

    page.page.fill(f"{ROOM} [name=q]", "5")
    assert link(page)["q"] == "5"
    words = output(page, "separation")
    page.page.press(PLATE, ".")
    assert link(page)["q"] == "6"
    assert output(page, "separation") != words

    ink = page.ink(PLATE)
    page.page.check(f"{ROOM} [name=seeing]")
    page.rest()
    assert page.ink(PLATE) > ink + 0.005  # facets that see the pole are hatched
    assert link(page)["on"] == "triangles,rays,seeing"


def test_tables_of_a_plane_are_opened_and_asked_about(room):
    page = room("lift")
    opened(page, "lift", table("plane.csv", "east,north,height\n0,0,1\n4,0,2\n4,3,3\n0,3,4\n2,1,5\n"))
    message = page.page.locator("#messages")
    message.filter(has_text="Which columns of plane.csv?").wait_for()  # what reads files is compiled at the first
    message.get_by_role("button", name="Open").click()
    page.rest()
    assert output(page, "sum") == "6 facets on the ball = 4 triangles of the sheet + 2 facets that see the pole"
    assert output(page, "separation").startswith("In the sheet 2.236, which is 0.447 of the diagonal.")
    opened(page, "lift", table("plane.csv", "x,y\n1,2\n3,four\n"))
    message.filter(has_text="four").wait_for()
    told = "plane.csv: 1 of 2 rows cannot be placed. Row 2: the y is 'four', not a number without"
    assert message.inner_text().startswith(told)
    assert output(page, "sum").startswith("6 facets")

    opened(page, "lift", table("plane.csv", "x,y\n1,2\n"))
    assert (output(page, "separation"), output(page, "count")) == ("Two sites are needed.", "The site")
    assert [page.page.input_value(f"{ROOM} input[name={letter}]") for letter in "pq"] == ["", ""]
    assert page.page.get_attribute(PLATE, "aria-label") == "Sheet with 1 site, and ball"


MARKS = f"""[...document.querySelectorAll("{ROOM} .bounds .mark-at")]
  .filter((each) => each.textContent && getComputedStyle(each).visibility === "visible")
  .map((each) => each.getBoundingClientRect()).map(({{ left, right }}) => [left, right])"""


@pytest.mark.parametrize("width", [1280, 800, 390])
def test_marks_of_the_ruler_keep_clear_of_each_other(room, width):
    page = room("lift", width=width, height=900)
    for other in range(1, 48):
        page.page.fill(f"{ROOM} input[name=q]", str(other))
        marks = page.page.evaluate(MARKS)
        marks.sort()
        assert len(marks) == 3  # the ends of the ruler, and the bounds between them
        assert all(left[1] < right[0] for left, right in itertools.pairwise(marks)), (other, marks)
