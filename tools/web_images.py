"""Draw the screenshots of the interactive page in the README and the documentation anew, into docs/images.

    python -m tools.web_images

Each room is shown as it begins, once light or dark, in a window of 1280 × 800 pixels on a screen of twice as many.
"""

from __future__ import annotations

import io
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

COLOURS_OF_IMAGE: Final = 128
"""In the palette of a picture: paper, inks and the shades between them."""


def main() -> None:
    """Draw them all."""
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        page = web(Path(folder, "stereodel.html"))
        for room, colours in COLOURS.items():
            visit = Visit(browser, f"{page.as_uri()}#{room}", scale=1.5, colours=colours)
            visit.until("document.documentElement.dataset.ready")
            visit.rest()
            path = ROOT / "docs" / "images" / f"web_{room}.png"
            with replacing(path) as temporary:
                temporary.write_bytes(_small(Image.fromarray(visit.picture())))
            print(path.relative_to(ROOT))
            visit.close()


def _small(picture: Image.Image) -> bytes:
    """A picture as PNG with a palette."""
    target = io.BytesIO()
    picture.quantize(COLOURS_OF_IMAGE, dither=Image.Dither.NONE).save(target, "PNG", optimize=True)
    return target.getvalue()


if __name__ == "__main__":
    main()
