"""What tests ask of rooms of the page: their drawings, what is said, the link, files in and out, lines of Python."""

import re

from axe_playwright_python.sync_playwright import Axe

DRAWINGS = {"sphere": "#sphere-ball", "lift": "#lift-plate", "globe": "#globe-plate"}
"""Rooms, and their first drawing."""

DISCS = {name: DRAWINGS[name] for name in ("sphere", "globe")}
"""Those that are turned."""

PIXELS = """(room) => [...document.querySelectorAll(`#room-${room} canvas`)]
  .filter((each) => each.checkVisibility()).map((each) => each.toDataURL())"""

CANNOT_BE_READ = "This link cannot be read, so here is the room as it begins."


def said(page, room, name):
    """Text of an output of a room."""
    text = page.page.locator(f"#room-{room} [data-out={name}]").inner_text()
    return text.replace("\u2009", "").replace("\u2002", " ")


def pixels(page, room):
    """The drawings of a room that are seen, without the ring round what has the focus."""
    return page.page.evaluate(PIXELS, room)


def link(page):
    """The values of the address, once it has followed."""
    page.page.wait_for_timeout(400)
    return dict(part.split("=", 1) for part in page.link.split("&") if "=" in part)


def table(name, text):
    """A file of the reader's that need not lie in a folder."""
    return {"name": name, "mimeType": "text/csv", "buffer": text.encode()}


def opened(page, room, file):
    """Open a file of the reader's in a room."""
    page.page.set_input_files(f"#room-{room} input[type=file]", file)
    page.page.wait_for_timeout(200)
    page.rest()


def downloaded(page, kind):
    """The file that a room gives away: its name and its bytes."""
    with page.page.expect_download() as download:
        page.page.click(f"[data-export={kind}]:visible")
    return download.value.suggested_filename, download.value.path().read_bytes()


def python_lines(page):
    """What a room shows as its lines of Python."""
    page.page.click(".foot summary")
    page.page.wait_for_timeout(500)
    return page.page.locator("#python").inner_text()


EXPERIMENTAL = ["css-orientation-lock", "focus-order-semantics", "label-content-name-mismatch", "p-as-heading"]
EXPERIMENTAL += ["table-fake-caption", "td-has-header"]
"""Rules that axe leaves out unless they are asked for."""


def barriers(page, **options):
    """What axe finds of a page that keeps readers out, by its experimental rules too unless there are other options."""
    options = options or {"rules": {rule: {"enabled": True} for rule in EXPERIMENTAL}}
    found = Axe().run(page.page, options=options).response
    assert len(found["passes"]) > 20
    return [f"{each['id']}: {each['nodes'][0]['html'][:120]}" for each in found["violations"]]


def numbers(text):
    """Numbers with a decimal point in a text."""
    return [float(number) for number in re.findall(r"\d+\.\d+", text)]
