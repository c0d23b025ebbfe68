"""The browser that the other tests look through: it counts frames and ink, turns and swipes, and has no network."""

import numpy as np
import pytest

from tools.browser import ink

BALL = """<!doctype html><meta charset="utf-8"><title>Ball</title>
<style>
  body { margin: 0; height: 4000px; font-family: STIXGeneral; }
  canvas { display: block; width: 200px; height: 200px; border-radius: 50%; touch-action: none; }
  @media (prefers-color-scheme: dark) { body { background: #000; } }
</style>
<canvas width="200" height="200"></canvas>
<script>
  const canvas = document.querySelector("canvas"), pen = canvas.getContext("2d");
  let moves = 0;
  const draw = () => { pen.fillRect(0, 0, 100, 100 + moves); };
  requestAnimationFrame(draw);
  canvas.onpointermove = () => { moves += 1; canvas.dataset.moves = moves; requestAnimationFrame(draw); };
  addEventListener("keydown", () => { location.hash = "v=1"; });
</script>
"""


@pytest.fixture
def ball(tmp_path):
    file = tmp_path / "ball.html"
    file.write_text(BALL)
    return file


def test_ink_and_frames(visit, ball):
    page = visit(ball)
    page.rest()
    assert page.requests == [ball.as_uri()]
    assert page.picture("canvas").shape == (200, 200, 3)
    assert page.ink("canvas") == pytest.approx(np.pi / 16, abs=0.005)  # a square, cut by the round canvas
    assert page.frames(0.2) == 0
    before = page.digest("canvas")
    page.drag((50, 50), (150, 150), steps=5)
    page.rest()
    assert int(page.page.evaluate("framesDrawn")) > 1
    assert page.digest("canvas") != before


def test_a_still_page_is_the_same_twice(visit, ball):
    first, second = (visit(ball, colours="dark", scale=2) for _ in range(2))
    for page in (first, second):
        page.rest()
    assert first.digest() == second.digest()
    assert first.picture().shape == (1600, 2560, 3)
    assert (first.picture()[-1, -1] == 0).all()


def test_the_link(visit, ball):
    page = visit(ball)
    assert page.link == ""
    page.page.keyboard.press("a")
    page.until("location.hash")
    assert page.link == "v=1"


def test_a_swipe_beside_the_disc_scrolls_and_one_on_it_does_not(visit, ball):
    page = visit(ball, touch=True, width=390)
    page.swipe(((100, 150), (100, 60)))
    assert page.page.evaluate("scrollY") == 0
    assert int(page.page.evaluate("canvas.dataset.moves")) > 3
    page.swipe(((300, 150), (300, 60)))
    assert page.page.evaluate("scrollY") > 30


def test_two_fingers(visit, ball):
    page = visit(ball, touch=True)
    page.page.evaluate(
        "void (canvas.onpointermove = (e) => { window.fingers = new Set(window.fingers).add(e.pointerId); })"
    )
    page.swipe(((90, 100), (50, 100)), ((110, 100), (150, 100)))
    assert page.page.evaluate("fingers.size") == 2


def test_the_type_is_that_of_the_figures(visit, ball):
    page = visit(ball)
    width = """(font) => { pen.font = `40px ${font}`; return pen.measureText("Saalfeld").width; }"""
    assert page.page.evaluate(width, "STIXGeneral") != page.page.evaluate(width, "serif")


def test_there_is_no_network(visit, served):
    address, folder = served
    (folder / "away.html").write_text("<!doctype html><title>Away</title><p>Here")
    page = visit(f"{address}/away.html")
    said = page.page.evaluate("fetch('http://stereodel.invalid/').then(() => 'there', () => 'nowhere')")
    assert said == "nowhere"
    assert page.requests.pop() == "http://stereodel.invalid/"
    assert page.complaints.pop().startswith("error: Failed to load resource")


def test_complaints_are_kept(visit, tmp_path):
    file = tmp_path / "wrong.html"
    file.write_text("<!doctype html><title>Wrong</title><script>console.warn('careful'); nothing();</script>")
    page = visit(file, complaints=["careful", "nothing is not defined"])
    assert len(page.complaints) == 2


def test_what_never_comes_is_an_error(visit, ball):
    with pytest.raises(TimeoutError, match=r"not true after 0\.1 s: false"):
        visit(ball).until("false", seconds=0.1)


def test_ink_is_what_differs_from_the_ground():
    pixels = np.full((10, 10, 3), 200, dtype=np.uint8)
    assert ink(pixels) == 0
    pixels[0] = 220
    assert ink(pixels) == 0
    pixels[0, :5] = 100
    assert ink(pixels) == 0.05


def test_a_page_is_busy_while_it_computes(visit, ball):
    page = visit(ball)
    before = page.busy()
    page.page.evaluate("(() => { const end = performance.now() + 200; while (performance.now() < end); })()")
    assert page.busy() - before > 0.15
