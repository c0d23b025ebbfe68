"""`stereodel figures`: the pictures of the paper."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

EXAMPLE = "stereodel figures fig03 fig11 --out pictures"


def command(
    names: Annotated[
        list[str] | None, typer.Argument(help="Beginnings of script names, e.g. fig03; all by default.")
    ] = None,
    scripts: Annotated[Path, typer.Option(help="Folder of the scripts.")] = Path("figures"),
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder to write to.")] = Path("out"),
    jobs: Annotated[int | None, typer.Option(min=1, help="Scripts that run at once; the cores by default.")] = None,
    force: Annotated[bool, typer.Option(help="Draw also what is up to date.")] = False,
) -> None:
    """Draw the figures and animations that are out of date."""
    from stereodel.render import build

    raise typer.Exit(build.run(scripts, out, names or (), jobs=jobs, force=force))
