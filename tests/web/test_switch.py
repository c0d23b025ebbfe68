"""Without a browser the page's tests fail, unless they are switched off by name, which the summary says."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def run_tests(*options, **environment):
    line = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *options, "tests/web/test_browser.py"]
    # No browser is found there.
    environment = {**os.environ, "PATH": str(Path(sys.executable).parent), **environment}
    return subprocess.run(line, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)


def test_tests_of_the_page_fail_without_a_browser():
    ran = run_tests("-k", "the_link", STEREODEL_TEST_WEB="on")
    assert ran.returncode == 1
    assert "there is no browser here, none of chromium" in ran.stdout
    assert "get one with: make system" in ran.stdout
    assert "switched off" not in ran.stdout


def test_they_are_left_out_by_name_and_the_summary_says_so():
    """Where other processes run the tests, too."""
    ran = run_tests("-n", "1", STEREODEL_TEST_WEB="off")
    assert ran.returncode == 0
    assert "1 passed" in ran.stdout  # what needs no browser
    assert "The tests of the interactive page were left out, because STEREODEL_TEST_WEB=off." in ran.stdout
