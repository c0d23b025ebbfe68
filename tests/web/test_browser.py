"""The browser that the other tests look through counts frames and ink, hears complaints and has no network.

Without a browser the tests of the page fail, unless they are switched off by name, which the summary says.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tools.browser import serving

BALL = """<!doctype html><meta charset="utf-8"><title>Ball</title>
<style>canvas { display: block; width: 200px; height: 200px; border-radius: 50%; }</style>
<canvas width="200" height="200"></canvas>
<script>
  const canvas = document.querySelector("canvas"), pen = canvas.getContext("2d");
  let moves = 0;
  const draw = () => { pen.fillRect(0, 0, 100, 100 + moves); };
  requestAnimationFrame(draw);
  canvas.onpointermove = () => { moves += 1; requestAnimationFrame(draw); };
  const wait = () => { const end = performance.now() + 200; while (performance.now() < end); };
</script>
"""


def test_what_is_drawn_is_counted(visit, tmp_path):
    file = tmp_path / "ball.html"
    file.write_text(BALL)
    page = visit(file)
    page.rest()
    assert page.requests == [file.as_uri()]
    assert page.ink("canvas") == pytest.approx(np.pi / 16, abs=0.005)  # a square, cut by the round canvas
    assert page.frames(0.2) == 0
    before, drawn, busy = page.digest("canvas"), page.page.evaluate("framesDrawn"), page.busy()
    page.drag((50, 50), (150, 150), steps=5)
    page.rest()
    assert page.page.evaluate("framesDrawn") > drawn
    assert page.digest("canvas") != before
    page.page.evaluate("wait()")
    assert page.busy() - busy > 0.15
    with pytest.raises(TimeoutError, match=r"not true after 0\.1 s: false"):
        page.until("false", seconds=0.1)


def test_there_is_no_network_and_complaints_are_kept(visit, tmp_path):
    (tmp_path / "away.html").write_text("<!doctype html><title>Away</title><script>console.warn('careful')</script>")
    with serving(tmp_path) as address:
        page = visit(f"{address}/away.html", complaints=["careful"])
        said = page.page.evaluate("fetch('http://stereodel.invalid/').then(() => 'there', () => 'nowhere')")
        assert said == "nowhere"
        assert page.requests.pop() == "http://stereodel.invalid/"
        assert page.complaints.pop().startswith("error: Failed to load resource")
        page.page.add_script_tag(content="nothing()")
        assert [said.split()[-1] for said in page.complaints] == ["careful", "defined"]
        page.complaints.pop()


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("switch", "code", "said"),
    [
        ("on", 1, ["there is no browser here, none of chromium", "get one with: make system"]),
        ("off", 0, ["passed", "The tests of the interactive page were left out, because STEREODEL_TEST_WEB=off."]),
    ],
)
def test_without_a_browser_the_page_is_left_out_by_name_alone(switch, code, said):
    line = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-n", "1", "tests/web/test_assemble.py"]
    # No browser is found there.
    environment = {**os.environ, "PATH": str(Path(sys.executable).parent), "STEREODEL_TEST_WEB": switch}
    root = Path(__file__).resolve().parents[2]
    ran = subprocess.run(line, cwd=root, env=environment, capture_output=True, text=True, check=False)
    assert ran.returncode == code
    assert [words for words in said if words not in ran.stdout] == []
