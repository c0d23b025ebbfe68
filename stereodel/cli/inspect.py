"""`stereodel inspect`: what is understood of a table, without doing anything with it."""

from __future__ import annotations

import json
import sys
from typing import Annotated

import typer

from stereodel.cli import options

EXAMPLE = "stereodel inspect stations.csv"


@options.grouped
def command(
    *,
    points: options.Points,
    as_json: Annotated[bool, typer.Option("--json", help="Write JSON instead of lines.")] = False,
    columns: options.AnyTable,
) -> None:
    """Say what is understood of a table of points, and which options would say the same.

    Its encoding, separator, decimal mark and header; its columns with their types and ranges; which are the place;
    the coordinate system; rows that would be left out, and why; duplicates; values far outside all others; the extent.
    """
    from stereodel.cli.application import ARGUMENTS
    from stereodel.io import inspect
    from stereodel.io.formats.names import spelling

    source = sys.stdin.buffer if points == "-" else points
    report = inspect(source, plane=columns.plane, **columns.arguments)
    if as_json:
        typer.echo(json.dumps(report.found, ensure_ascii=False, indent=1))
        return
    with spelling({**ARGUMENTS, "lon": "--lon"}):
        typer.echo(str(report))
