"""Glyphs of the fonts that vector files bring along, as paths."""

import numpy as np
from fontTools.pens.basePen import BasePen

from tests.images.marks import path_of, transformed


def glyph_path(font, name):
    """The outline of a glyph at size 1."""
    glyphs = font.getGlyphSet()
    pen = _Pen(glyphs)
    glyphs[name].draw(pen)
    scale = 1 / font["head"].unitsPerEm
    return transformed(path_of(pen.commands, pen.numbers), np.diag([scale, scale, 1.0]))


class _Pen(BasePen):
    def __init__(self, glyphs):
        super().__init__(glyphs)
        self.commands, self.numbers = b"", []

    def _add(self, command, *points):
        self.commands += command
        self.numbers += [number for point in points for number in point]

    def _moveTo(self, point):
        self._add(b"M", point)

    def _lineTo(self, point):
        self._add(b"L", point)

    def _curveToOne(self, *points):
        self._add(b"C", *points)

    def _closePath(self):
        self._add(b"Z")
