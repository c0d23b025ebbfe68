"""Draw the screenshots of the interactive page in the README and the documentation anew, into docs/images.

    python -m tools.web_images

Each room is shown as it begins, light or dark, in a window 1280 pixels wide on a screen of a quarter as many again.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Final

from PIL import Image

from stereodel._files import replacing
from stereodel.web import web
from tools.browser import Visit, chromium

ROOT = Path(__file__).resolve().parent.parent
COLOURS: Final = {"sphere": "light", "lift": "light", "globe": "dark"}
"""Of the system, by room."""

HEIGHTS: Final = {"sphere": 780, "lift": 776, "globe": 814}
"""Of the window by room, so that its lower edge cuts no line of text."""

QUALITY: Final = 75
"""Of WebP: lines and letters without a fringe."""


def main() -> None:
    """Draw them all."""
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        page = web(Path(folder, "stereodel.html"))
        for room, colours in COLOURS.items():
            visit = Visit(browser, f"{page.as_uri()}#{room}", height=HEIGHTS[room], scale=1.25, colours=colours)
            visit.until("document.documentElement.dataset.ready")
            visit.rest()
            path = ROOT / "docs" / "images" / f"web_{room}.webp"
            with replacing(path) as temporary:
                Image.fromarray(visit.picture()).save(temporary, "WEBP", quality=QUALITY, method=6)
            print(path.relative_to(ROOT))
            visit.close()


if __name__ == "__main__":
    main()
