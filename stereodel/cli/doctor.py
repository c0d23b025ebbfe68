"""`stereodel doctor`: what would draw here, and what is missing."""

from __future__ import annotations

import platform
from typing import TYPE_CHECKING

import typer

import stereodel

if TYPE_CHECKING:
    from stereodel.render import gl

EXAMPLE = "STEREODEL_GL=egl stereodel doctor"


def command() -> None:
    """Say what would draw here, every version that matters, and what is missing; exit code 1 if nothing can draw."""
    from rich.console import Console
    from rich.table import Table

    from stereodel.render import gl, provenance

    console = Console(highlight=False, soft_wrap=True)
    found = gl.describe()
    for title, rows in (("Rendering", _rendering_rows(found)), ("Versions", _version_rows())):
        table = Table(title=title, title_justify="left", show_header=False, box=None, pad_edge=False)
        for row in rows:
            table.add_row(*row)
        console.print(table)
    missing = [name for name, version in provenance.library_versions().items() if version == "not installed"]
    if missing:
        console.print(f"Missing: {', '.join(missing)}. Install with: pip install {' '.join(missing)}")
    if found.problem:
        console.print(f"Globes cannot be drawn as PNG: {found.problem}.")
        console.print("Plane figures, SVG and PDF files and all computations work without OpenGL.")
    else:
        console.print("Ready: globes can be drawn.")
    raise typer.Exit(1 if found.problem or missing else 0)


def _rendering_rows(found: gl.Description) -> list[tuple[str, str]]:
    """What draws and why, and which libraries are there."""
    from stereodel.render import gl

    reasons = {"found": "the first that can be opened"}
    rows = [("would be used", f"{found.platform} ({reasons.get(found.chosen_by, found.chosen_by)})")]
    if not found.platform:
        rows = [("would be used", "nothing")]
    if not found.problem:
        rows += [("OpenGL", found.version), ("renderer", found.renderer)]
    for name in gl.PLATFORMS:
        here = "library found" if gl.can_open(name) else f"library missing; Debian: apt-get install {gl.PACKAGES[name]}"
        rows.append((name, here))
    return rows


def _version_rows() -> list[tuple[str, str]]:
    """The library, the system, and the libraries that pictures and files depend on."""
    from stereodel.render import provenance

    rows = [("stereodel", stereodel.__version__), ("system", platform.platform())]
    return rows + list(provenance.library_versions().items())
