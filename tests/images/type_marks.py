"""The type of vector files: whether each label has its colour, and its ink where that of the PNG is."""

from itertools import groupby

import numpy as np

from tests.images.page_marks import WIDTH, levels_of, same_color

APART = 0.3
"""Points by which the ink of a label may differ between PNG, SVG and PDF: a quarter of a pixel on a screen."""

ROUNDED = 1 / 128
"""Points a letter that the end of a line of type may lie elsewhere in PDF: matplotlib sets it in steps of 1/64."""

UNKERNED = 0.06
"""The same for a character beyond Latin-1, in heights of the type: PDF has no kerning on either side of it."""


def type_differences(page, ink, marks):
    """What is wrong with the type of the files, a line each.

    Parameters
    ----------
    page : Page
    ink : (n, 4) array
        Boxes of the ink of the labels in the PNG; NaN where there is none.
    marks : dict
        "svg" and "pdf" → the marks of the type, in order.
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
    for (label, box), svg, pdf in zip(labels, groups, in_pdf, strict=True):
        wrong += [f"svg: {what}" for what in _label_differences(label, svg, box, APART)]
        apart = sum(ord(letter) > 255 for letter in label.text) * UNKERNED * label.size
        limit = max(APART, ROUNDED * len(label.text)) + apart
        wrong += [f"pdf: {what}" for what in _label_differences(label, pdf, _box(svg), limit)]
    return wrong


def _label_differences(label, marks, box, limit):
    """Glyphs are filled, and rimmed where they have a halo, which is drawn first."""
    wrong = []
    for mark in marks:
        stroked = mark.kind == "stroke"
        color = label.halo_color if stroked else label.color
        if not same_color(mark.color, levels_of(color)):
            wrong.append(f"{label.text!r} has a {mark.kind} of colour {mark.color}, expected {levels_of(color)}")
        if stroked and abs(mark.width - 2 * label.halo) > WIDTH:
            wrong.append(f"{label.text!r} has a halo of {mark.width / 2:.4g} points, expected {label.halo}")
    if label.halo and "stroke" not in {mark.kind for mark in marks}:
        wrong.append(f"{label.text!r} has no halo")
    if marks[-1].kind != "fill":
        wrong.append(f"{label.text!r} lies below its halo")
    apart = np.abs(_box(marks) - box).max()
    return [*wrong, f"{label.text!r} has its ink {apart:.2f} points elsewhere"] if apart > limit else wrong


def _box(marks):
    """Left, bottom, right and top of what is inked."""
    boxes = np.array([mark.path.box() + np.array([-1, -1, 1, 1]) * mark.width / 2 for mark in marks])
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])
