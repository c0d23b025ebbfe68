"""One HTML file for what the picture tests found: the stored picture, that of today and the difference side by side.

Tests may run in several processes. Each picture that fails has a section of its own in `parts`, and whoever adds one or
takes one out puts the sheet together again; so it shows what fails now, whoever found it.
"""

import base64
import html
from pathlib import Path

import imageio.v3 as iio
import numpy as np

from stereodel._files import replacing
from stereodel.render.pixel_rows import LabelLayer
from tools.baselines import PIXEL_LEVELS, SIZE, compare, levels_apart, read_picture

SHOWN = 8
"""Messages that stand in the open; the others are folded away, in the terminal counted."""

HEAD = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>Pictures that changed</title>
<style>
  body { margin: 2rem; background: #fff; color: #222; font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
  section { margin-top: 2rem; border-top: 1px solid #ccc; }
  ul { padding-left: 1.2rem; font: 13px/1.5 "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
  div { display: flex; flex-wrap: wrap; gap: 1rem; }
  figure { margin: 0; flex: 1 1 20rem; max-width: 60rem; }
  img { width: 100%; border: 1px solid #ccc; }
</style>
<h1>Pictures that changed</h1>
"""


def report_failure(store, case, messages, folder):
    """Put a picture into the sheet `index.html` of a folder, which is returned.

    Parameters
    ----------
    store : Store
    case : Case
        What was drawn today.
    messages : list of str
        What is wrong, a line each.
    folder : Path
    """
    path = store.folder / f"{case.name}.png"
    pictures = {"stored": read_picture(path)} if path.is_file() else {}
    pictures["today"] = case.picture
    rank = 1.0
    if "stored" in pictures:
        rank = compare(pictures["stored"], case.picture).any
        red = f"difference, red above {PIXEL_LEVELS} levels"
        pictures[red] = difference_picture(pictures["stored"], case.picture)
    if case.page.labels:
        pictures["today, with its labels"] = LabelLayer(case.page, SIZE).over(case.picture)
    figures = "".join(f"<figure><figcaption>{what}</figcaption>{_image(p)}</figure>" for what, p in pictures.items())
    name = html.escape(case.name)
    section = f'<section id="{name}"><h2>{name}</h2>{_messages(messages)}<div>{figures}</div></section>\n'
    (folder / "parts").mkdir(parents=True, exist_ok=True)
    _write(folder / "parts" / f"{case.name}.html", f"<!-- {rank:.6f} -->{section}")
    return _assemble(folder)


def report_pass(name, folder):
    """Take a picture that is what was stored out of the sheet, if it is there."""
    part = folder / "parts" / f"{name}.html"
    if part.exists():
        part.unlink()
        _assemble(folder)


def in_short(messages):
    """The first of the messages, and how many there are beside."""
    more = len(messages) - SHOWN
    return [*messages[:SHOWN], *([f"and {more} more"] if more > 0 else [])]


def difference_picture(expected, actual):
    """Where two pictures differ: red if more than `PIXEL_LEVELS`, orange below, over the expected one in pale gray.

    Pictures of different shapes are compared in their common upper left corner.
    """
    height, width = np.minimum(expected.shape[:2], actual.shape[:2])
    levels = levels_apart(expected[:height, :width], actual[:height, :width])
    gray = (191 + expected[:height, :width].mean(axis=-1) / 4).astype(np.uint8)
    picture = np.stack([gray, gray, gray], axis=-1)
    picture[levels > 0] = (240, 160, 0)
    picture[levels > PIXEL_LEVELS] = (220, 0, 0)
    return picture


def _assemble(folder: Path):
    """Write the sheet from its parts, what differs most first; again until no other process has changed them."""
    sheet, seen = folder / "index.html", None
    while seen != (found := sorted((folder / "parts").glob("*.html"))):
        seen = found
        parts = [part.read_text(encoding="utf-8") for part in found if part.exists()]
        # The head of a part is its rank, in digits that sort as text.
        _write(sheet, HEAD + ("".join(sorted(parts, reverse=True)) or "<p>None any more.</p>\n"))
    return sheet


def _write(target, text):
    with replacing(target) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _messages(messages):
    lines = [f"<li>{html.escape(message)}</li>" for message in messages]
    more = "".join(lines[SHOWN:])
    folded = f"<details><summary>{len(lines) - SHOWN} more</summary><ul>{more}</ul></details>" if more else ""
    return f"<ul>{''.join(lines[:SHOWN])}</ul>{folded}"


def _image(pixels):
    data = base64.b64encode(iio.imwrite("<bytes>", pixels, extension=".png", plugin="pillow")).decode()
    return f'<img alt="" src="data:image/png;base64,{data}">'
