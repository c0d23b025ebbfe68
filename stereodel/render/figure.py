"""Figures: named pictures, from their geometry to their files; the command line shared by all scripts."""

from __future__ import annotations

import argparse
import ast
import inspect
import os
import re
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, Final, Literal

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel.drawing.page import Page, picture_extra
from stereodel.drawing.page.sheets import Style, StyledDraw, as_styles
from stereodel.drawing.scene.solid import Solid

STYLE_HELP: Final = "dark, a .toml file of styles, or several with commas"
"""Help of the option --style of scripts."""


def script_of(function: Callable[..., Any], name: str) -> Path | None:
    """The script that draws a picture, the file of its name in the folder of its drawing function; None without one."""
    try:
        script = source_of(function).with_name(f"{name}.py")
    except (TypeError, OSError):
        return None
    return script if script.is_file() else None


def caption_of(script: Path) -> tuple[str, str]:
    """Title and description of a script: the first line of its docstring, and the paragraphs below its underline."""
    return parted(ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or "")


def parted(docstring: str) -> tuple[str, str]:
    """Title and description of a docstring, as plain text."""
    title, _, rest = re.sub("``(.+?)``", "“\\1”", docstring).partition("\n")
    rest = re.sub(r"\A\s*([=\-~^])\1+\s*$", "", rest, count=1, flags=re.MULTILINE)
    paragraphs = [" ".join(part.split()) for part in re.split(r"\n\s*\n", rest)]
    return title.strip(), "\n\n".join(filter(None, paragraphs))


Geometry = Mapping[str, Any]


@dataclass(frozen=True)
class Figure:
    """A figure: its geometry, its layout on a page, and its files.

    Parameters
    ----------
    name : str
        Stem of the files and of the script that defines it, whose docstring provides the page's title and description.
    geometry : callable
        Function without arguments that returns named arrays: the geometry of the picture, computed by the library.
    draw : callable
        Function of the geometry that returns a `Page`.
    renderer : {"gl", "agg"}
        Renderer of the PNG: OpenGL for globes, matplotlib for the plane.
    in_space : callable, optional
        Function of the geometry that returns a `Solid`, the picture in space.

    Examples
    --------
    >>> figure = Figure("empty", dict, lambda geometry: Page((0.0, 2.0, 0.0, 1.0), width=144.0), renderer="agg")
    >>> figure.pixels(size=40).shape
    (20, 40, 3)
    """

    name: str
    geometry: Callable[[], Geometry]
    draw: Callable[[Any], Page]
    renderer: Literal["gl", "agg"] = "gl"
    in_space: Callable[[Any], Solid] | None = None

    def page(self) -> Page:
        """The picture before rendering, with the script's title if it has none, and description."""
        return self._page(self.geometry())

    def _page(self, geometry: Geometry) -> Page:
        page = self.draw(geometry)
        script = script_of(self.draw, self.name)
        title, description = caption_of(script) if script else ("", "")
        told = "\n\n".join(filter(None, [description, page.description]))
        return replace(page, title=page.title or title, description=told)

    def styled(self, *styles: Style) -> Figure:
        """The same figure in other styles, see `stereodel.drawing.styled`."""
        return replace(self, draw=StyledDraw(self.draw, styles))

    def solid(self) -> Solid:
        """The picture in space; ValueError if the figure has no `in_space`."""
        if self.in_space is None:
            raise ValueError(f"figure {self.name!r} shows nothing in space; give it in_space=")
        return self.in_space(self.geometry())

    def pixels(self, *, size: int | None = None, text: bool = True) -> Pixels:
        """The picture, (height, width, 3), rows from the top; `size` and `text` as for `Page.pixels`."""
        with of_extra(picture_extra(".png", self.renderer)):
            return self.page().pixels(size=size, text=text, renderer=self.renderer)

    def save(self, out: str | os.PathLike[str], *, size: int | None = None, text: bool = True) -> dict[str, Any]:
        """Write NAME.png, NAME.svg and NAME.pdf into a folder, and NAME.glb of the picture in space.

        Parameters
        ----------
        out : path-like
            The folder; created if it does not exist.
        size, text
            As for `Page.save`.

        Returns
        -------
        dict
            figure, files, renderer, size, pixel_hash (of the picture without text) and seconds.

        Raises
        ------
        OSError
            If the folder cannot be created or written to.
        """
        begun = time.perf_counter()
        folder = Path(out)
        folder.mkdir(parents=True, exist_ok=True)
        files = [folder / f"{self.name}.{kind}" for kind in ("png", "svg", "pdf")]
        geometry = self.geometry()
        with of_extra("render" if self.in_space else picture_extra(".png", self.renderer)):
            from stereodel.render.save import save_page

            page = self._page(geometry)
            width, digest = save_page(page, *files, size=size, text=text, renderer=self.renderer)
            if self.in_space:
                files.append(self.in_space(geometry).save(folder / f"{self.name}.glb"))
        return {
            "figure": self.name,
            "files": [file.name for file in files],
            "renderer": self.renderer,
            "size": width,
            "pixel_hash": digest,
            "seconds": round(time.perf_counter() - begun, 3),
        }

    def main(self, argv: Sequence[str] | None = None) -> None:
        """Run as a script: write the files and report where; errors become a message and exit code 1."""
        run_script(self, argv, self.name, "17 cm at 300 dpi")

    def _files(self, folder: Path, *, size: int | None, text: bool) -> list[str]:
        return self.save(folder, size=size, text=text)["files"]


def run_script(drawing: Any, argv: Sequence[str] | None, name: str, usual_size: str) -> None:
    """Write the files of a figure or film, `_files`, by default into `out` next to the script's folder."""
    parser = argparse.ArgumentParser(description=f"Draw {name}.")
    out = default_folder(drawing.draw)
    parser.add_argument("--out", type=Path, help=f"folder to write to ({out}, and in it one for each style)")
    parser.add_argument("--size", type=int, help=f"width in pixels ({usual_size})")
    parser.add_argument("--text", action=argparse.BooleanOptionalAction, default=True, help="draw the labels")
    parser.add_argument("--style", type=style_names, default=(), help=STYLE_HELP)
    options = parser.parse_args(sys.argv[1:] if argv is None else argv)
    folder = styled_folder(out, options.style) if options.out is None else options.out
    begun = time.perf_counter()
    try:
        shown = drawing.styled(*options.style) if options.style else drawing
        files = shown._files(folder, size=options.size, text=options.text)
    except (OSError, RuntimeError, ValueError) as error:
        raise SystemExit(f"{name}: {error}") from None
    print(f"{name}: {', '.join(files)} in {folder} ({time.perf_counter() - begun:.1f} s)")


def style_names(text: str) -> tuple[str, ...]:
    """Names of styles from the command line."""
    return as_styles(tuple(text.split(",")))


def styled_folder(out: Path, styles: tuple[str, ...]) -> Path:
    """The folder for pictures in other styles, within that of the pictures."""
    return out / "-".join(Path(style).stem for style in styles)


def default_folder(source: Callable[..., Any]) -> Path:
    """`out` next to the folder of the script that defines a function, whatever the current folder."""
    return source_of(source).resolve().parent.parent / "out"


def source_of(function: Callable[..., Any]) -> Path:
    """The file that defines a function, also of one in styles or with some arguments given."""
    while isinstance(function, partial | StyledDraw):
        function = function.func if isinstance(function, partial) else function.draw
    return Path(inspect.getfile(function))
