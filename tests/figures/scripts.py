"""The scripts of the figures, run as a reader runs them, and what they draw."""

import runpy
import sys
from functools import cache, lru_cache
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parents[2] / "figures"
FIGURES = tuple(path.stem for path in sorted(FOLDER.glob("fig*.py")))
ROWS = ("fig10_earth", "fig11_fisheye4", "fig12_fisheye20")


@cache
def script(name):
    """What the script defines, by name."""
    sys.path.insert(0, str(FOLDER))
    try:
        return runpy.run_path(str(FOLDER / f"{name}.py"))
    finally:
        sys.path.remove(str(FOLDER))


@lru_cache(maxsize=3)  # the tests of one figure follow each other, and pages of all would fill gigabytes
def geometry(name):
    return script(name)["FIGURE"].geometry()


@lru_cache(maxsize=3)
def page(name):
    return script(name)["FIGURE"]._page(geometry(name))


def arc_points(rows, steps=33):
    """Points (n, steps, 3) of arcs given as centre, two radii and sweep."""
    t = np.linspace(0, 1, steps)[None, :, None] * rows[:, None, 9:]
    return rows[:, None, 0:3] + np.cos(t) * rows[:, None, 3:6] + np.sin(t) * rows[:, None, 6:9]


def path_points(path, steps=65):
    """Points (k·steps, d) of cubic Béziers (k, 4, d), piece after piece."""
    t = np.linspace(0, 1, steps)
    weights = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=-1)
    return np.einsum("sc,kcx->ksx", weights, path).reshape(-1, path.shape[-1])
