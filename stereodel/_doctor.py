"""What works on NumPy alone: the list of commands, and `stereodel doctor`, which says what is missing here."""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Final

import stereodel
from stereodel._extras import EXTRAS, installed_version, installing, lacking
from stereodel._tasks.interrupts import stop_if_interrupted

if TYPE_CHECKING:
    from stereodel.render import gl

EXAMPLE = "STEREODEL_GL=egl stereodel doctor"

PURPOSE: Final = "Delaunay triangulations and Voronoi diagrams of points on the Earth and in the plane."

COMMANDS: Final[Mapping[str, str]] = {
    "inspect": "what is understood of a table, and which options would say the same",
    "triangulate": "the Delaunay triangles or edges of points",
    "voronoi": "the Voronoi cell of each point, the part of the Earth nearest to it, and its area",
    "partition": "areas and neighbours of the cells of more points than memory holds, in a folder",
    "interpolate": "values at other points, or on a grid",
    "contour": "isolines of values known at points",
    "nearest": "the sites nearest to points, or the line or polygon, and how far away they are",
    "globe": "a picture or a film of the Earth with points and files on it, magnified around a focus if wanted",
    "panorama": "a 360° picture through a fisheye: a panorama again, the faces of a cube, or a little planet",
    "web": "an interactive page with the sphere, the lift and the globe, with your points if you like",
    "doctor": "which renderer would be used on this machine, tested with a small picture, and what is missing",
}
"""What each command writes, in the order of the help."""

EXIT_CODES: Final = (
    "Exit codes: 0 done, 1 nothing to do or a library is missing, 2 wrong usage or input, 130 interrupted."
)

TRIAL: Final = """
import dataclasses, json
from stereodel.render.gl import describe
print(json.dumps(dataclasses.asdict(describe())))
"""
"""A process can use only one OpenGL platform, and a driver may crash it, so each is tried in a process of its own."""

SECONDS: Final = 120
"""Time limit for a platform to draw a few pixels."""


def command() -> None:
    """Draw a small picture on each platform; report the renderer, which extras work, and how to install the rest.

    Exit code 1 if no globe can be drawn.
    """
    from stereodel.render import gl

    found = tried()
    try:
        chosen, reason = gl.choose()
        problem = found[chosen].problem if chosen in found else f"no library of {chosen} can be opened"
    except gl.OpenGLError as error:
        chosen, reason, problem = "", "", str(error)
    rendering = _rendering(found, chosen, reason)
    stop_if_interrupted()
    versions = [("stereodel", stereodel.__version__), ("python", platform.python_version())]
    versions += [("numpy", installed_version("numpy")), ("system", platform.platform())]
    for title, rows in (("Versions", versions), ("Extras", _extras()), ("Rendering", rendering)):
        print(f"{title}\n{_table(rows)}\n")
    if problem:
        print(f"Globes cannot be drawn as PNG: {problem}.")
        if draws := [name for name, what in found.items() if not what.problem]:
            print(f"But {draws[0]} draws: set STEREODEL_GL={draws[0]}.")
        elif not lacking("draw"):
            print("Plane figures, SVG and PDF files and all computations work without OpenGL.")
        raise SystemExit(1)
    print("Ready: globes can be drawn.")


def usage() -> str:
    """The help of the command where the libraries of its other commands are missing."""
    others = f"--version and doctor work as they are; the other commands need: {installing('cli')}"
    return "\n\n".join(["Usage: stereodel COMMAND [OPTIONS]", PURPOSE, _table([*COMMANDS.items()]), others, EXIT_CODES])


def tried() -> dict[str, gl.Description]:
    """Each platform whose library is installed, with the result of drawing on it."""
    from stereodel.render import gl

    here = [name for name in gl.PLATFORMS if gl.can_open(name)]
    with ThreadPoolExecutor() as pool:
        return dict(zip(here, pool.map(_tried, here), strict=True))


def _tried(name: str) -> gl.Description:
    from stereodel.render import gl

    try:
        given = {**os.environ, gl.VARIABLE: name}
        ran = subprocess.run(
            [sys.executable, "-c", TRIAL], env=given, capture_output=True, text=True, timeout=SECONDS, check=False
        )
    except subprocess.TimeoutExpired:
        return gl.Description(name, gl.VARIABLE, problem=f"{name} has drawn nothing in {SECONDS} seconds")
    if ran.returncode:
        last = (ran.stderr.splitlines() or ["no output"])[-1]
        problem = f"the process that drew on {name} ended with code {ran.returncode}: {last}"
        return gl.Description(name, gl.VARIABLE, problem=problem)
    return gl.Description(**json.loads(ran.stdout.splitlines()[-1]))


def _extras() -> list[tuple[str, str, str]]:
    """Each extra with the versions of its packages, or those it lacks, its purpose, and how to install them."""
    rows = []
    for name, extra in EXTRAS.items():
        if missing := ", ".join(each.name for each in lacking(name)):
            rows.append((name, "lacks", f"{missing}, for {extra.purpose}: {installing(name)}"))
        else:
            rows.append(
                (name, "works", ", ".join(f"{each.name} {installed_version(each.name)}" for each in extra.brings))
            )
    return rows


def _rendering(found: Mapping[str, gl.Description], chosen: str, reason: str) -> list[tuple[str, str]]:
    """The platform in use and why, and the result of drawing on each."""
    from stereodel.render import gl

    reasons = {"found": "the first that can be opened"}
    rows = [("would be used", f"{chosen} ({reasons.get(reason, reason)})" if chosen else "nothing")]
    if chosen in found and found[chosen].version:
        rows += [("OpenGL", found[chosen].version), ("renderer", found[chosen].renderer)]
    for name in gl.PLATFORMS:
        if name not in found:
            said = f"library missing; Debian: apt-get install {gl.PACKAGES[name]}"
        elif problem := found[name].problem:
            said = "does not draw" if name == chosen else f"does not draw: {problem}"
        else:
            said = "draws"
        rows.append((name, said))
    return rows


def _table(rows: Sequence[tuple[str, ...]]) -> str:
    """Rows as aligned lines."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ("  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(f"  {line.rstrip()}" for line in lines)
