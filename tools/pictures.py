"""Draw the pictures of the README and the documentation that are no figures of the gallery, into docs/images.

python -m tools.pictures readme [FOLDER]     those of the README, the start page and the page on drawing
python -m tools.pictures web                 screenshots of the interactive page, by a browser
"""

from __future__ import annotations

import contextlib
import re
import sys
import tempfile
from pathlib import Path

from PIL import Image

from stereodel._tasks.whole_files import replacing
from tools.build import load_drawing

ROOT = Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"
PICTURES = {
    "fig11_fisheye4": 1200,
    "fig01_sphere": 480,
    "fig08_hemisphere": 480,
    "fig02_plane": 480,
    "globe_new_york": 1200,
    "earth_partitions": 1200,
    "fig05_projections_solid": 1200,
    "fig09_scale_dark": 800,
}
"""Pixels across by figure, of those that are shown in space or on a dark background under that name."""

ROOMS = {"sphere": ("light", 780), "lift": ("light", 776), "globe": ("dark", 814)}
"""Of the interactive page, as they begin: colours of the system, and height of a window, 1280 pixels wide on a screen
of a quarter as many again, whose lower edge cuts no line of text."""

QUALITY = 75
"""Of WebP: lines and letters without a fringe."""


def globe_of_the_readme() -> str:
    """The code of the README that writes the picture beside it, new_york.png."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (code,) = (code for code in re.findall(r"```python\n(.*?)```", text, re.DOTALL) if "Globe()" in code)
    return code


def readme(folder: Path = IMAGES) -> None:
    """Draw those of the README into a folder."""
    folder.mkdir(exist_ok=True)
    with contextlib.chdir(folder):
        exec(compile(globe_of_the_readme(), "README.md", "exec"), {})
    for name, width in PICTURES.items():
        figure = load_drawing(ROOT / "figures" / f"{name.removesuffix('_solid').removesuffix('_dark')}.py")
        if name.endswith("_solid"):
            print(figure.solid().save(folder / f"{name}.png", size=width))
            continue
        shown = figure.styled("dark") if name.endswith("_dark") else figure
        print(shown.page().save(folder / f"{name}.png", size=width, renderer=shown.renderer))


def web() -> None:
    """Draw the screenshots."""
    from stereodel.web import web as write_page
    from tools.browser import Visit, chromium

    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        page = write_page(Path(folder, "stereodel.html"))
        for room, (colours, height) in ROOMS.items():
            visit = Visit(browser, f"{page.as_uri()}#{room}", height=height, scale=1.25, colours=colours)
            visit.until("document.documentElement.dataset.ready")
            visit.rest()
            with replacing(IMAGES / f"web_{room}.webp") as temporary:
                Image.fromarray(visit.picture()).save(temporary, "WEBP", quality=QUALITY, method=6)
            print(IMAGES / f"web_{room}.webp")
            visit.close()


if __name__ == "__main__":
    {"readme": readme, "web": web}[sys.argv[1]](*(Path(folder).resolve() for folder in sys.argv[2:]))
