"""GMT's sphinterpolate, sphdistance and sphtriangulate beside the same here: grids of one degree, one thread each.

Seconds are those of the processor, of GMT less those of its start; it reads and writes binary files, we arrays.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.derived import waves
from benchmarks.distributions import make
from benchmarks.rounds import fastest
from stereodel import SphericalDelaunay, lonlat_to_xyz, xyz_to_lonlat
from stereodel._arrays import FloatArray
from stereodel.interpolation import LinearInterpolator, SmoothInterpolator

ROUNDS = {True: 7, False: 3}
"""Turns of interpolation, where both are nearly alike, and of what is many times as fast."""

GRID = np.stack(np.meshgrid(np.arange(-180.0, 181.0), np.arange(90.0, -91.0, -1.0)), axis=-1).reshape(-1, 2)
KINDS = {"sphinterpolate -Qp": LinearInterpolator, "sphinterpolate -Ql": SmoothInterpolator}
COMMANDS = [*KINDS, "sphdistance -Ed -Ld", "sphtriangulate -Qd"]


def ours(command: str, points: FloatArray) -> FloatArray:
    """What the command computes: values or degrees to the nearest point on the grid, triangles."""
    triangulation = SphericalDelaunay(points, workers=1)
    if command in KINDS:
        return KINDS[command](triangulation, waves(points))(lonlat_to_xyz(GRID), workers=1)
    if command.startswith("sphtriangulate"):
        return np.asarray(triangulation.simplices)
    places = lonlat_to_xyz(GRID)
    chords = places - points[triangulation.nearest(places, workers=1)]
    return np.asarray(np.degrees(2 * np.arcsin(np.linalg.norm(chords, axis=-1) / 2)))


def theirs(command: str, points: FloatArray) -> FloatArray:
    """The same by GMT; a grid of its single precision, behind 892 bytes. `--version` starts it and no more."""
    with tempfile.TemporaryDirectory() as folder:
        np.column_stack([xyz_to_lonlat(points), waves(points)]).tofile(Path(folder, "points"))
        grid = ["-Rd", "-I1", "-Ggrid=bf"] if command.startswith(("sphinterpolate", "sphdistance")) else []
        words = ["gmt", *command.split(), *([] if command == "--version" else ["points", "-bi3d", *grid])]
        environment = os.environ | {"OMP_NUM_THREADS": "1"}
        subprocess.run(words, check=True, capture_output=True, env=environment, cwd=folder)
        return np.fromfile(f"{folder}/grid", np.float32, offset=892) if grid else points


def gmt(largest: int) -> list[dict[str, Any]]:
    """The experiment; no rows where GMT is not installed."""
    sizes = [n for n in (10_000, 100_000) if n <= largest and shutil.which("gmt")]
    return [measured(command, make("sphere", "uniform", n)) for command in COMMANDS for n in sizes]


def measured(command: str, points: FloatArray) -> dict[str, Any]:
    """The least seconds of both, which take turns, and errors of interpolation."""
    calls = {"ours": (ours, command), "theirs": (theirs, command), "start": (theirs, "--version")}
    least, found = dict.fromkeys(calls, float("inf")), {}
    for _ in range(ROUNDS[command in KINDS]):
        for who, (call, word) in calls.items():
            found[who], _, seconds = fastest(lambda call=call, word=word: call(word, points), 1)
            least[who] = min(least[who], seconds)
    row: dict[str, Any] = {"command": command, "n": len(points), "ours": least["ours"]}
    row["theirs"] = least["theirs"] - least["start"]
    for who in ("ours", "theirs") if command in KINDS else ():
        error = np.abs(found[who] - waves(lonlat_to_xyz(GRID)))
        row |= {f"{who} rms": float(np.sqrt((error**2).mean())), f"{who} max": float(error.max())}
    return row
