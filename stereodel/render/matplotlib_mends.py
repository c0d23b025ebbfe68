"""What matplotlib rounds without need where it sets mathematics as outlines.

`stereodel.render.vector` writes its files with it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final

from matplotlib.mathtext import MathTextParser, VectorParse

FINER: Final = 64
"""By how much the pixels are smaller to which the size of a formula is rounded up: then it is 1/64 of a point."""


@contextmanager
def exact_mathtext() -> Iterator[None]:
    """Set formulas in their place.

    The size of a formula is rounded up to whole pixels, those of PDF being points, and its letters are moved up by what
    was added: by three quarters of a point beside the same label in SVG and PNG. So it is set with finer pixels.
    """
    parser: Any = MathTextParser
    parse = parser.parse

    def finer(self: Any, text: str, dpi: float = 72, *options: Any, **named: Any) -> Any:
        parsed = parse(self, text, FINER * dpi, *options, **named)
        return _reduced(parsed) if isinstance(parsed, VectorParse) else parse(self, text, dpi, *options, **named)

    parser.parse = finer
    try:
        yield
    finally:
        parser.parse = parse


def _reduced(parsed: Any) -> Any:
    width, height, depth, glyphs, rectangles = parsed
    return VectorParse(
        width / FINER,
        height / FINER,
        depth / FINER,
        [(*what, x / FINER, y / FINER) for *what, x, y in glyphs],
        [tuple(side / FINER for side in rectangle) for rectangle in rectangles],
    )
