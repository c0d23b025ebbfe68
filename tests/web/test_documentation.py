"""The documentation as it would be published, on a phone and searched; `make docs` builds it and follows its links."""

import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from .rooms import barriers

BUILT = Path(__file__).resolve().parents[2] / "docs" / "_build" / "html"
pytestmark = [
    pytest.mark.thorough,
    pytest.mark.skipif(not BUILT.is_dir(), reason="make docs has not built it"),
]
PAGES = ["index", "start", "names", "paper", "benchmarks", "search", "genindex", "gallery/index", "gallery/anim_hull"]
LOOK = """({
  wide: document.documentElement.scrollWidth,
  bytes: performance.getEntries().reduce((sum, each) => sum + (each.encodedBodySize ?? 0), 0),
  unsized: [...document.images].filter((each) => !each.getAttribute("width")).map((each) => each.src),
})"""


@pytest.fixture(scope="module")
def site():
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(SimpleHTTPRequestHandler, directory=BUILT)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.mark.parametrize("page", [*PAGES, "api/generated/stereodel.SphericalDelaunay"])
def test_a_page_on_a_phone(visit, site, page):
    """What Lighthouse asks and a test can keep; `visit` wants one host and no complaint."""
    phone = visit(f"{site}/{page}.html", width=390, height=844, touch=True)
    look = phone.page.evaluate(LOOK)
    assert look["wide"] <= 390
    assert look["unsized"] == []
    assert look["bytes"] < (3e6 if page == "gallery/index" else 1.5e6)
    assert barriers(phone, preload=False) == []  # it would look for styles where they are not


def test_a_word_is_found(visit, site):
    """By the button of any page, then by the first result."""
    page = visit(f"{site}/start.html").page
    page.locator(".search-button__button:visible, .search-button:visible").first.click()
    page.locator("input[name=q]:visible").fill("yanked")
    page.keyboard.press("Enter")
    page.locator("#search-results li a").first.click()
    assert page.locator("h1").inner_text().startswith("Publishing")
