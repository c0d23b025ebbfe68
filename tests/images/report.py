"""One HTML sheet for what the picture tests found, in a single file: an index, and what is wrong with each picture.

Tests may run in several processes. Each picture has a record of its own in `parts`, a failure its section of the sheet
too, and whoever adds one puts the sheet together again; so the sheet shows what passes and fails now, whoever ran it.
"""

from __future__ import annotations

import base64
import html
import json
import os
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import imageio.v3 as iio
import numpy as np

from stereodel._arrays import FloatArray, Pixels
from stereodel._files import replacing
from tools.baselines import Case, Lettering, Store
from tools.image import PIXEL_LEVELS, PIXEL_TILE, Comparison, compare, levels_apart, read_picture

SHOWN: Final = 8
"""Messages of a net that stand in the open; the others are folded away, in the terminal counted."""

ENLARGED: Final = 8
"""How many times as large the worst place is shown."""

AROUND: Final = 8
"""Pixels that are shown around the worst tile."""

NAME_SIZE: Final = 8
"""Points of the page; of the names of moved labels that do not fit into their boxes."""

NETS: Final = {"T1": "missing", "T2": "pixels", "T3": "type", "T0": "numbers"}
"""What each net finds, those first whose finds can be seen."""

HEADS: Final = ("Visibly other", "Other at all", "Labels", "Arrays")
"""Of the columns of the index that hold numbers."""

PARTS: Final = Path(__file__).parent / "sheet"
"""The style and the script of the sheet."""


@dataclass(frozen=True, eq=False)
class Failure:
    """A picture that is not what was stored.

    Parameters
    ----------
    name : str
        Of the figure, or of a frame of an animation.
    messages : tuple of str
        What is wrong, a line each, which begins with the net that found it.
    expected, actual : (h, w, 3) uint8 arrays, optional
    lettering : tuple of Lettering
        The labels, which the pictures are without.
    width : float
        Of the page in points, in which labels are measured.
    """

    name: str
    messages: tuple[str, ...] = ()
    expected: Pixels | None = None
    actual: Pixels | None = None
    lettering: tuple[Lettering, ...] = ()
    width: float = 1.0

    @classmethod
    def of(cls, store: Store, case: Case, messages: Iterable[str]) -> Failure:
        """The messages about a case, with the stored picture and that of today."""
        path = store.folder / f"{case.name}.png"
        expected = read_picture(path) if path.is_file() else None
        return cls(case.name, tuple(messages), expected, case.picture, tuple(store.lettering(case)), case.page.width)

    @cached_property
    def comparison(self) -> Comparison | None:
        """How the pictures differ, if there are two."""
        return None if self.expected is None or self.actual is None else compare(self.expected, self.actual)

    @property
    def by_net(self) -> dict[str, list[str]]:
        """Net → its messages, in the order of `NETS`."""
        found = {net: [text for text in self.messages if text.startswith(f"{net}:")] for net in NETS}
        return {net: texts for net, texts in found.items() if texts}

    @property
    def record(self) -> dict[str, Any]:
        """What the index says of it."""
        found = self.comparison
        nets = {net: len(texts) for net, texts in self.by_net.items()}
        return {"nets": nets, "visible": found.visible if found else 0.0, "any": found.any if found else 0.0}


def report_failure(failure: Failure, folder: str | os.PathLike[str]) -> Path:
    """Put a failure into the sheet `index.html` of a folder, in place of an older one of that name.

    Returns
    -------
    Path
        The sheet.
    """
    return _report(failure.name, failure.record, _section(failure), Path(folder))


def report_pass(name: str, folder: str | os.PathLike[str]) -> Path:
    """Count a picture as one that is what was stored, and take it out of the sheet if it is there."""
    return _report(name, {"nets": {}}, "", Path(folder))


def in_short(messages: Sequence[str]) -> list[str]:
    """The first of the messages, and how many there are beside.

    Examples
    --------
    >>> in_short([f"T0: stroke {number}, style: width is 2.0, expected 1.0" for number in range(300)])[-2:]
    ['T0: stroke 7, style: width is 2.0, expected 1.0', 'and 292 more, 292 by T0']
    """
    more = Counter(message.partition(":")[0] for message in messages[SHOWN:])
    told = ", ".join(f"{count} by {net}" for net, count in more.items())
    return [*messages[:SHOWN], *([f"and {more.total()} more, {told}"] if more else [])]


def difference_picture(expected: Pixels, actual: Pixels) -> Pixels:
    """Where two pictures differ: red beyond `PIXEL_LEVELS`, orange below, over the expected one in pale gray.

    Pictures of different shapes are compared in their common upper left corner.
    """
    height, width = np.minimum(expected.shape[:2], actual.shape[:2])
    expected, actual = expected[:height, :width, :3], actual[:height, :width, :3]
    levels = levels_apart(expected, actual)
    gray = (191 + expected.mean(axis=-1) / 4).astype(np.uint8)
    picture = np.stack([gray, gray, gray], axis=-1)
    picture[levels > 0] = (240, 160, 0)
    picture[levels > PIXEL_LEVELS] = (220, 0, 0)
    return picture


# The sheet as a whole


def _report(name: str, record: Mapping[str, Any], section: str, folder: Path) -> Path:
    parts = folder / "parts"
    parts.mkdir(parents=True, exist_ok=True)
    _write(parts / f"{name}.html", section)
    _write(parts / f"{name}.json", json.dumps(record))
    return _assemble(folder)


def _assemble(folder: Path) -> Path:
    """Write the sheet from its parts, again until no other process has changed them meanwhile."""
    sheet, seen = folder / "index.html", None
    while seen != (found := _found(folder)):
        seen = found
        _write(sheet, _sheet(found))
    return sheet


def _found(folder: Path) -> dict[str, tuple[dict[str, Any], str]]:
    """Name of each picture → its record and its section."""
    found = {}
    for path in sorted((folder / "parts").glob("*.json")):
        record = json.loads(path.read_text(encoding="utf-8"))
        found[path.stem] = record, path.with_suffix(".html").read_text(encoding="utf-8")
    return found


def _write(target: Path, text: str) -> None:
    with replacing(target) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _sheet(found: Mapping[str, tuple[Mapping[str, Any], str]]) -> str:
    """The whole page; what differs most comes first."""
    records = {name: record for name, (record, _) in found.items() if record["nets"]}
    worst_first = sorted(records, key=lambda name: _rank(name, records[name]))
    style, script = ((PARTS / file).read_text(encoding="utf-8") for file in ("sheet.css", "sheet.js"))
    sections = "\n".join(found[name][1] for name in worst_first)
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Pictures that changed</title>
<style>
{style}</style>
</head>
<body>
<h1 id="top">Pictures that changed</h1>
{_summary(len(found), records)}
{_index(worst_first, records)}
{sections}
<script>
{script}</script>
</body>
</html>
"""


def _rank(name: str, record: Mapping[str, Any]) -> tuple[Any, ...]:
    nets = record["nets"]
    return ("T1" not in nets, -record["visible"], -record["any"], -nets.get("T3", 0), -nets.get("T0", 0), name)


def _summary(checked: int, records: Mapping[str, Mapping[str, Any]]) -> str:
    """Counts of pictures, in all and by net."""
    by_net = Counter(net for record in records.values() for net in record["nets"])
    nets = " · ".join(f"{what} ({net}) <strong>{by_net[net]}</strong>" for net, what in NETS.items() if by_net[net])
    failed = f"<strong>{len(records)}</strong> failed: {nets}" if records else "none failed"
    return f'<p class="summary"><strong>{checked}</strong> {_counted(checked, "picture")} checked, {failed}</p>'


def _index(names: Sequence[str], records: Mapping[str, Mapping[str, Any]]) -> str:
    if not names:
        return ""
    rows = "\n".join(_row(name, records[name]) for name in names)
    counts = "".join(f'<th scope="col" class="number">{what}</th>' for what in HEADS)
    heads = f'<th scope="col">Picture</th><th scope="col">Found by</th>{counts}'
    return f"<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}\n</tbody>\n</table>"


def _row(name: str, record: Mapping[str, Any]) -> str:
    counts = (record["nets"].get("T3", ""), record["nets"].get("T0", ""))
    shares = (f"{record[what]:.4%}" if record["any"] else "" for what in ("visible", "any"))
    numbers = "".join(f'<td class="number">{cell}</td>' for cell in (*shares, *counts))
    link = f'<a href="#{html.escape(name)}">{html.escape(name)}</a>'
    return f"<tr><td>{link}</td><td>{_badges(record['nets'])}</td>{numbers}</tr>"


def _badges(nets: Iterable[str]) -> str:
    return "".join(f'<span class="net{_seen(net)}">{net} {NETS[net]}</span>' for net in nets)


def _seen(net: str) -> str:
    """A class for what can be seen in the picture."""
    return "" if net == "T0" else " seen"


def _counted(count: int, what: str) -> str:
    return what if count == 1 else f"{what}s"


# A picture


def _section(failure: Failure) -> str:
    name = html.escape(failure.name)
    head = f'<h2>{name}</h2><span>{_badges(failure.by_net)}</span><a class="up" href="#top">index</a>'
    messages = "\n".join(_messages(net, texts) for net, texts in failure.by_net.items())
    return f'<section id="{name}">\n<div class="head">{head}</div>\n{messages}\n{_pictures(failure)}\n</section>'


def _messages(net: str, texts: Sequence[str]) -> str:
    """A list of the messages of a net, of which only the first are open to sight."""
    lines = [f"<li><b>{net}</b>{html.escape(text.partition(':')[2].strip())}</li>" for text in texts]
    listed = [f'<ul class="messages{_seen(net)}">{"".join(part)}</ul>' for part in (lines[:SHOWN], lines[SHOWN:])]
    if len(lines) <= SHOWN:
        return listed[0]
    return f"{listed[0]}\n<details><summary>{len(lines) - SHOWN} more by {net}</summary>{listed[1]}</details>"


def _pictures(failure: Failure) -> str:
    expected, actual, found = failure.expected, failure.actual, failure.comparison
    if actual is None or expected is None or found is None or expected.shape != actual.shape:
        sides = [("stored", expected, "before"), ("today", actual, "after")]
        shown = [_alone(failure, what, picture, side) for what, picture, side in sides if picture is not None]
        return f'<div class="pictures">{"".join(shown)}</div>'
    if not found.any:
        same = '<p class="same">Without their type the two pictures are the same, pixel for pixel.</p>'
        return f'{same}<div class="pictures">{_comparison(failure)}</div>'
    difference = difference_picture(expected, actual)
    return f'<div class="pictures">{_comparison(failure)}{_difference(difference, found)}</div>{_crops(failure, found)}'


def _alone(failure: Failure, what: str, picture: Pixels, side: str) -> str:
    height, width = picture.shape[:2]
    layer = _layer(failure, picture, what, side)
    return (
        f'<figure><figcaption>{what}, {width} × {height} pixels</figcaption><div class="stage">{layer}</div></figure>'
    )


def _comparison(failure: Failure) -> str:
    """The stored picture left of a line, that of today right of it."""
    assert failure.expected is not None
    assert failure.actual is not None
    name = html.escape(failure.name)
    labels = '<button type="button" class="labels" aria-pressed="true">Labels</button>' if failure.lettering else ""
    buttons = f'<button type="button" class="flicker" aria-pressed="false">Flicker</button>{labels}'
    layers = _layer(failure, failure.expected, "stored", "before") + _layer(failure, failure.actual, "today", "after")
    told = f'aria-label="{name}: how much of the stored picture is shown"'
    slider = f'<input type="range" min="0" max="100" step="0.5" value="50" {told}>'
    sides = '<span class="side left">stored</span><span class="side right">today</span>'
    return (
        f'<figure class="comparison"><figcaption>{buttons}<span>drag, arrow keys; F flickers</span></figcaption>'
        f'<div class="stage slide">{layers}<div class="cut"></div>{sides}{slider}</div></figure>'
    )


def _layer(failure: Failure, picture: Pixels, what: str, side: str) -> str:
    """A picture with the boxes of its labels."""
    return f'<div class="layer">{_image(picture, f"{failure.name}, {what}")}{_boxes(failure, picture, side)}</div>'


def _boxes(failure: Failure, picture: Pixels, side: str) -> str:
    """Where the ink of each label lies, and, where that has changed, where it lay."""
    height = failure.width * picture.shape[0] / picture.shape[1]
    drawn = "".join(_label(label, side, height) for label in failure.lettering)
    return f'<svg class="boxes" viewBox="0 0 {failure.width:.2f} {height:.2f}" preserveAspectRatio="none">{drawn}</svg>'


def _label(label: Lettering, side: str, height: float) -> str:
    look, own = " moved" if label.wrong else "", label.stored if side == "before" else label.found
    drawn = _box(own, f"box{look}", label.text, height)
    if label.wrong and side == "after":
        drawn += _box(label.stored, f"box{look} before", label.text, height)
    return drawn + _text(own, f"text{look}", label.text, height)


def _box(box: FloatArray, look: str, text: str, height: float) -> str:
    if np.isnan(box).any():
        return ""
    left, bottom, right, top = box
    place = f'x="{left:.2f}" y="{height - top:.2f}" width="{right - left:.2f}" height="{top - bottom:.2f}"'
    return f'<rect class="{look}" {place}><title>{html.escape(text)}</title></rect>'


def _text(box: FloatArray, look: str, text: str, height: float) -> str:
    """The words of a label within its box; above it those of formulas and of type that stands on end, if they moved."""
    if np.isnan(box).any():
        return ""
    left, bottom, right, top = box
    x, words, within = (
        f'x="{left:.2f}"',
        html.escape(text.replace("$", "")),
        right - left > min(1, len(text) - 1) * (top - bottom),
    )
    if "$" not in text and within:
        size = f'font-size="{top - bottom:.2f}" textLength="{right - left:.2f}" lengthAdjust="spacingAndGlyphs"'
        return f'<text class="{look}" {x} y="{height - bottom:.2f}" {size}>{words}</text>'
    if "moved" in look:
        return f'<text class="{look}" {x} y="{height - top - 2:.2f}" font-size="{NAME_SIZE}">{words}</text>'
    return ""


def _difference(picture: Pixels, found: Comparison) -> str:
    """Where the pictures differ, the worst tile framed."""
    height, width = picture.shape[:2]
    place = f'x="{found.worst.column}" y="{found.worst.row}" width="{PIXEL_TILE}" height="{PIXEL_TILE}"'
    frame = f'<svg viewBox="0 0 {width} {height}"><rect class="tile" {place}/></svg>'
    keys = (
        '<span class="key" style="--swatch:#dc0000">more than '
        f'{PIXEL_LEVELS} levels</span><span class="key" style="--swatch:#f0a000">less</span>'
        '<span class="key" style="--swatch:#2b62a8">worst place</span>'
    )
    stage = f'<div class="stage"><div class="layer">{_image(picture, "difference")}{frame}</div></div>'
    return f"<figure><figcaption>{keys}</figcaption>{stage}</figure>"


def _crops(failure: Failure, found: Comparison) -> str:
    """The worst tile and what is around it, enlarged."""
    assert failure.expected is not None
    assert failure.actual is not None
    rows, columns = (
        slice(max(0, at - AROUND), at + PIXEL_TILE + AROUND) for at in (found.worst.row, found.worst.column)
    )
    parts = {"stored": failure.expected[rows, columns], "today": failure.actual[rows, columns]}
    parts["difference"] = difference_picture(parts["stored"], parts["today"])
    place = f"rows from {rows.start}, columns from {columns.start}"
    shown = [
        f"<figure><figcaption>{what}, worst place × {ENLARGED}</figcaption>"
        f"{_image(part, f'{what}, {place}', scale=ENLARGED)}</figure>"
        for what, part in parts.items()
    ]
    return f'<div class="crops">{"".join(shown)}</div>'


def _image(pixels: Pixels, alt: str, *, scale: int = 1) -> str:
    data = base64.b64encode(iio.imwrite("<bytes>", pixels, extension=".png", plugin="pillow")).decode()
    height, width = pixels.shape[:2]
    size = f'width="{scale * width}" height="{scale * height}"'
    return f'<img {size} alt="{html.escape(alt)}" src="data:image/png;base64,{data}">'
