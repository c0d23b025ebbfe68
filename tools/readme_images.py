"""Draw the small pictures of the README, the start page and the page on drawing into docs/images.

python -m tools.readme_images [FOLDER]
"""

from __future__ import annotations

import contextlib
import re
import sys
from pathlib import Path

from tools.build import load_drawing

ROOT = Path(__file__).resolve().parent.parent
WIDTHS = {
    "fig11_fisheye4": 1200,
    "fig01_sphere": 480,
    "fig08_hemisphere": 480,
    "fig02_plane": 480,
    "globe_new_york": 1200,
    "earth_partitions": 1200,
}
"""Pixels across by figure."""

SOLID = {"fig05_projections": 1200}
"""The same of those that are shown in space."""
DARK = {"fig09_scale": 800}
"""The same of those that are shown on a dark background."""


def globe_of_the_readme() -> str:
    """The code of the README that writes the picture beside it, new_york.png."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (code,) = (code for code in re.findall(r"```python\n(.*?)```", text, re.DOTALL) if "Globe()" in code)
    return code


def main(folder: Path) -> None:
    """Draw them all into a folder."""
    folder.mkdir(exist_ok=True)
    with contextlib.chdir(folder):
        exec(compile(globe_of_the_readme(), "README.md", "exec"), {})
    for name, width in WIDTHS.items():
        figure = load_drawing(ROOT / "figures" / f"{name}.py")
        path = figure.page().save(folder / f"{name}.png", size=width, renderer=figure.renderer)
        print(path)
    for name, width in SOLID.items():
        figure = load_drawing(ROOT / "figures" / f"{name}.py")
        print(figure.solid().save(folder / f"{name}_solid.png", size=width))
    for name, width in DARK.items():
        figure = load_drawing(ROOT / "figures" / f"{name}.py").styled("dark")
        print(figure.page().save(folder / f"{name}_dark.png", size=width, renderer=figure.renderer))


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve() if sys.argv[1:] else ROOT / "docs" / "images")
