"""The browser that the other tests look through counts frames and ink, hears complaints and has no network.

Without a browser the tests of the page fail, unless they are switched off by name, which the summary says.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest


def test_there_is_no_network_and_complaints_are_kept(visit, tmp_path):
    (tmp_path / "away.html").write_text("<!doctype html><title>Away</title><script>console.warn('careful')</script>")
    page = visit(tmp_path / "away.html", complaints=["careful"], offline=False)
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
        ("off", 0, ["passed", "Tests that need a browser or Node were left out, because STEREODEL_TEST_WEB=off."]),
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
