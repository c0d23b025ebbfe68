"""`stereodel doctor`: what works here, what would draw, and how to get what is missing."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from typing import TYPE_CHECKING

import typer

import stereodel
from stereodel._extras import EXTRAS, distributions, installing

if TYPE_CHECKING:
    from stereodel.render import gl

EXAMPLE = "STEREODEL_GL=egl stereodel doctor"


def command() -> None:
    """Say which extras work here, what would draw, and how to get the rest; exit code 1 where no globe can be drawn."""
    from stereodel.render import gl

    found = gl.describe()
    for title, rows in (("Versions", _versions()), ("Extras", _extras()), ("Rendering", _rendering(found))):
        typer.echo(f"{title}\n{_table(rows)}\n")
    if found.problem:
        typer.echo(f"Globes cannot be drawn as PNG: {found.problem}.")
        if not _missing("draw"):
            typer.echo("Plane figures, SVG and PDF files and all computations work without OpenGL.")
        raise typer.Exit(1)
    typer.echo("Ready: globes can be drawn.")


def _versions() -> list[tuple[str, str]]:
    """The library, what it always needs, and the system."""
    from stereodel.render.provenance import library_version

    return [
        ("stereodel", stereodel.__version__),
        ("python", platform.python_version()),
        ("numpy", library_version("numpy")),
        ("system", platform.platform()),
    ]


def _extras() -> list[tuple[str, str, str]]:
    """Each extra: the versions of what it brings itself, or what it lacks, what for, and how to get it."""
    from stereodel.render.provenance import library_version

    rows = []
    for name, extra in EXTRAS.items():
        if missing := _missing(name):
            rows.append((name, "lacks", f"{', '.join(missing)}, for {extra.purpose}: {installing(name)}"))
        else:
            rows.append((name, "works", ", ".join(f"{brought} {library_version(brought)}" for brought in extra.brings)))
    return rows


def _missing(extra: str) -> list[str]:
    """Distributions of an extra, and of those that come along, which are not installed."""
    from stereodel.render.provenance import NOT_INSTALLED, library_version

    return [name for name in distributions(extra) if library_version(name) == NOT_INSTALLED]


def _rendering(found: gl.Description) -> list[tuple[str, str]]:
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


def _table(rows: Sequence[tuple[str, ...]]) -> str:
    """Rows as lines, each column as wide as it must be."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ("  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(f"  {line.rstrip()}" for line in lines)
