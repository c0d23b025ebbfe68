"""How maps look where nothing else is asked for."""

from __future__ import annotations

from typing import Final

from stereodel.drawing.colors import Color
from stereodel.drawing.style import BLACK, DARK_GRAY, VERMILION, WHITE, DotStyle, LineStyle, with_opacity

OCEAN: Final[Color] = (0.855, 0.910, 0.945, 1.0)
LAND: Final[Color] = (0.957, 0.937, 0.890, 1.0)
AREA: Final[Color] = (0.400, 0.640, 0.780, 1.0)
CIRCLE: Final[Color] = with_opacity(VERMILION, 0.30)

LIMB: Final = LineStyle(DARK_GRAY, 0.9)
COAST: Final = LineStyle((0.25, 0.33, 0.40, 1.0), 0.45)
BORDER: Final = LineStyle((0.55, 0.48, 0.45, 1.0), 0.35)
RIVER: Final = LineStyle((0.36, 0.58, 0.74, 1.0), 0.35)
HALO: Final = 1.6
"""Width of the white line round type, points."""

GRATICULE: Final = LineStyle((0.62, 0.68, 0.72, 1.0), 0.3)
LINE: Final = LineStyle(BLACK, 0.5)
OUTLINE: Final = LineStyle(DARK_GRAY, 0.4)
DOT: Final = DotStyle(VERMILION, 1.8, rim=WHITE, rim_width=0.4)
