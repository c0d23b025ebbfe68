"""The type of vector files: whether labels have their words, colours and halos, and their ink where the PNG has it."""

import re
from itertools import groupby

import numpy as np

from tests.images.marks import PLACE
from tests.images.page_marks import WIDTH, levels_of, same_color

APART = 0.3
"""Points by which the ink of a label may differ between PNG and files: a quarter of a pixel on a screen."""

STEPS = 5e-3
"""Points by which a glyph may lie elsewhere in PDF than in SVG: steps of a ten-thousandth of its size, rounded."""


def type_differences(page, ink, sheets, marks):
    """What is wrong with the type of the files, a line each.

    Parameters
    ----------
    page : Page
    ink : (n, 4) array
        Boxes of the ink of the labels in the PNG; NaN where there is none.
    sheets, marks : dict
        "svg" and "pdf" → what the file shows, and the marks of its type in order.
    """
    labels = [(label, box) for label, box in zip(page.labels, ink, strict=True) if not np.isnan(box).any()]
    groups = [list(group) for _, group in groupby(marks["svg"], key=lambda mark: mark.group)]
    if len(groups) != len(labels):
        return [f"svg: {len(groups)} labels, expected {len(labels)}"]
    # PDF has no groups, but the same glyphs in the same order.
    sizes = [len(group) for group in groups]
    if len(marks["pdf"]) != sum(sizes):
        return [f"pdf: {len(marks['pdf'])} glyphs, expected {sum(sizes)}"]
    ends = np.cumsum(sizes).tolist()
    in_pdf = [marks["pdf"][end - size : end] for end, size in zip(ends, sizes, strict=True)]
    wrong = []
    for kind, sheet in sheets.items():
        wrong += [f"{kind}: {what}" for what in _text_differences([label for label, _ in labels], sheet.texts)]
    if sheets["svg"].texts != sheets["pdf"].texts:
        wrong.append(f"pdf: texts {sheets['pdf'].texts}, in SVG {sheets['svg'].texts}")
    for (label, box), svg, pdf in zip(labels, groups, in_pdf, strict=True):
        wrong += [f"svg: {what}" for what in _label_differences(label, svg, box, APART)]
        wrong += [f"pdf: {what}" for what in _label_differences(label, pdf, _box(svg), STEPS)]
    return wrong


def _text_differences(labels, texts):
    """Whether the lines of type are those of the labels; of formulas, whether what stands between them is there."""
    lines = [line for label in labels for line in label.text.split("\n") if line.strip()]
    if len(lines) != len(texts):
        return [f"{len(texts)} lines of type, expected {len(lines)}"]
    patterns = (
        ".*".join(re.escape(part) for part in re.split(r"(?<!\\)\$.*?(?<!\\)\$", line.replace("\\$", "$")))
        if line.count("$") > 1
        else re.escape(line.replace("\\$", "$"))
        for line in lines
    )
    return [
        f"text {text!r}, expected {line!r}"
        for line, pattern, text in zip(lines, patterns, texts, strict=True)
        if not re.fullmatch(pattern, text)
    ]


def _label_differences(label, marks, box, limit):
    """A halo is one path of all outlines, and comes first; then come the glyphs."""
    wrong = []
    halos, glyphs = ([mark for mark in marks if mark.kind == kind] for kind in ("stroke", "fill"))
    for mark in marks:
        color = label.halo_color if mark.kind == "stroke" else label.color
        if not same_color(mark.color, levels_of(color)):
            wrong.append(f"{label.text!r} has a {mark.kind} of colour {mark.color}, expected {levels_of(color)}")
    if len(halos) != bool(label.halo):
        return [*wrong, f"{label.text!r} has {len(halos)} halos, expected {int(bool(label.halo))}"]
    if halos:
        (halo,) = halos
        if marks[0] is not halo:
            wrong.append(f"{label.text!r} lies below its halo")
        if abs(halo.width - 2 * label.halo) > WIDTH or halo.join != "round":
            wrong.append(f"{label.text!r} has a halo of {halo.width / 2:.4g} points, expected {label.halo}")
        inked = sum(len(mark.path.closed) for mark in glyphs)
        apart = np.abs(halo.path.box() - _box(glyphs)).max()
        if len(halo.path.closed) != inked or apart > STEPS + PLACE:
            wrong.append(f"{label.text!r} has a halo of other outlines, {apart:.4f} points off")
    apart = np.abs(_box(marks) - box).max()
    return [*wrong, f"{label.text!r} has its ink {apart:.3f} points elsewhere"] if apart > limit else wrong


def _box(marks):
    """Left, bottom, right and top of what is inked."""
    boxes = np.array([mark.path.box() + np.array([-1, -1, 1, 1]) * mark.width / 2 for mark in marks])
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])
