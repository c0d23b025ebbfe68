"""An HTML file for each picture that changed: the stored picture, that of today and the difference side by side."""

import base64
import html

import imageio.v3 as iio
import numpy as np

from stereodel.render.pixel_rows import LabelLayer
from tools.baselines import PIXEL_LEVELS, SIZE, levels_apart, read_picture

SHOWN = 8
"""Messages in the terminal; the others are counted there."""

HEAD = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>A picture that changed</title>
<style>
  body { margin: 2rem; background: #fff; color: #222; font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
  ul { padding-left: 1.2rem; font: 13px/1.5 "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
  div { display: flex; flex-wrap: wrap; gap: 1rem; }
  figure { margin: 0; flex: 1 1 20rem; max-width: 60rem; }
  img { width: 100%; border: 1px solid #ccc; }
</style>
"""


def report_failure(store, case, messages, folder):
    """Write the file of a picture into a folder, with what is wrong, a line each; its path."""
    path = store.folder / f"{case.name}.png"
    pictures = {"stored": read_picture(path)} if path.is_file() else {}
    pictures["today"] = case.picture
    if "stored" in pictures:
        red = f"difference, red above {PIXEL_LEVELS} levels"
        pictures[red] = difference_picture(pictures["stored"], case.picture)
    if case.page.labels:
        pictures["today, with its labels"] = LabelLayer(case.page, SIZE).over(case.picture)
    figures = ""
    for what, pixels in pictures.items():
        data = base64.b64encode(iio.imwrite("<bytes>", pixels, extension=".png", plugin="pillow")).decode()
        image = f'<img alt="" src="data:image/png;base64,{data}">'
        figures += f"<figure><figcaption>{what}</figcaption>{image}</figure>"
    lines = "".join(f"<li>{html.escape(message)}</li>" for message in messages)
    folder.mkdir(parents=True, exist_ok=True)
    sheet = folder / f"{case.name}.html"
    head = f"{HEAD}<h1>{html.escape(case.name)}</h1>\n"
    sheet.write_text(f"{head}<div>{figures}</div>\n<ul>{lines}</ul>\n", encoding="utf-8")
    return sheet


def report_pass(name, folder):
    """Remove the file of a picture that is what was stored."""
    (folder / f"{name}.html").unlink(missing_ok=True)


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
