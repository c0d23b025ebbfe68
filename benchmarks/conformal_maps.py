"""Conformal maps of many points, beside copying them and beside PROJ.

Everything in one process and in turns. Ratios are those of a round.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from pyproj import Transformer

from benchmarks.rounds import Calls, in_turns
from stereodel import data, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel._arrays import FloatArray

LENS = fisheye((2.35, 48.86), magnification=20.0)
COASTLINE = 1_000_000


def coastline(size: int) -> FloatArray:
    """So many points of the world's coastlines, (n, 2): again and again, shifted by a thousandth of a degree."""
    lonlat = data.coastlines().lonlat
    copies = -(-size // len(lonlat))
    shifts = 1e-3 * np.arange(copies)[:, None, None] * [1.0, 0.0]
    return np.ascontiguousarray((lonlat + shifts).reshape(-1, 2)[:size])


def directions(size: int) -> dict[str, Any]:
    """Unit vectors through a fisheye, beside copying them."""
    points = lonlat_to_xyz(np.random.default_rng(18).uniform([-180, -90], [180, 90], size=(size, 2)))
    calls: Calls = {"copy": points.copy}
    for workers in (1, 2):
        calls[f"images {workers}"] = lambda workers=workers: LENS(points, workers=workers)
        calls[f"scales {workers}"] = lambda workers=workers: LENS.scale_factor(points, workers=workers)
    return in_turns(calls, "copy") | {"n": size}


def places(size: int) -> dict[str, Any]:
    """Coastline points in degrees through a fisheye, beside the pipeline of PROJ that is the same map."""
    lonlat = coastline(size)
    lon, lat = np.ascontiguousarray(lonlat.T)
    pipeline = Transformer.from_pipeline(LENS.to_proj())
    calls: Calls = {
        "pyproj": lambda: pipeline.transform(lon, lat),
        "lonlat 1": lambda: LENS.lonlat(lonlat, workers=1),
        "lonlat 2": lambda: LENS.lonlat(lonlat, workers=2),
        "by vectors": lambda: xyz_to_lonlat(LENS(lonlat_to_xyz(lonlat))),
    }
    gap = LENS.lonlat(lonlat) - np.stack(pipeline.transform(lon, lat), axis=1)
    worst = float(np.abs((gap + 180.0) % 360.0 - 180.0).max())
    return in_turns(calls, "pyproj") | {"n": size, "largest gap in degrees": worst}


def conformal_maps(largest: int) -> dict[str, Any]:
    """The experiment: ten million directions, a million places."""
    return {"directions": directions(min(largest, 10_000_000)), "places": places(min(largest, COASTLINE))}
