"""The command `stereodel`: what would draw here, and the figures."""

from __future__ import annotations

import platform
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

import stereodel
from stereodel.render import build, gl

app = typer.Typer(help="Delaunay, Voronoi and the figures of the paper.", no_args_is_help=True, add_completion=False)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"stereodel {stereodel.__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Delaunay triangulations and Voronoi diagrams of the plane and the sphere, and the figures of the paper."""


@app.command()
def doctor() -> None:
    """Say what would draw here, every version that matters, and what is missing; exit code 1 if nothing can draw."""
    console = Console(highlight=False, soft_wrap=True)
    found = gl.describe()
    for title, rows in (("Rendering", _rendering_rows(found)), ("Versions", _version_rows())):
        table = Table(title=title, title_justify="left", show_header=False, box=None, pad_edge=False)
        for row in rows:
            table.add_row(*row)
        console.print(table)
    missing = [name for name, version in build.library_versions().items() if version == "not installed"]
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
    rows = [("stereodel", stereodel.__version__), ("system", platform.platform())]
    return rows + list(build.library_versions().items())


@app.command()
def figures(
    names: Annotated[
        list[str] | None, typer.Argument(help="Beginnings of script names, e.g. fig03; all by default.")
    ] = None,
    scripts: Annotated[Path, typer.Option(help="Folder of the scripts.")] = Path("figures"),
    out: Annotated[Path, typer.Option(help="Folder to write to.")] = Path("out"),
    jobs: Annotated[int | None, typer.Option(min=1, help="Scripts that run at once; the cores by default.")] = None,
    force: Annotated[bool, typer.Option(help="Draw also what is up to date.")] = False,
) -> None:
    """Draw the figures and animations that are out of date."""
    raise typer.Exit(build.run(scripts, out, names or (), jobs=jobs, force=force))
