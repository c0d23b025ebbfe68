"""A raster on a globe: time and quality beside cartopy's reprojection and SciPy's map_coordinates.

    benchmarks/install_peers.sh        once, for cartopy
    python -m benchmarks.rasters

A raster of 4096 × 2048 becomes a globe of 2048 × 2048 pixels. Quality is the signal-to-noise ratio against 256 samples
a pixel (`tests/globe/supersampling.py`), over windows all over the disc. Writes benchmarks/rasters.json and the table
in docs/rasters.md.
"""

from __future__ import annotations

import itertools
import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from scipy import ndimage

from benchmarks import pages
from benchmarks.rounds import fastest
from stereodel import MoebiusMap, fisheye
from stereodel._arrays import FloatArray, Pixels
from stereodel.drawing import View
from stereodel.globe import Raster
from tests.globe.supersampling import checkerboard, psnr, reference, zone_plate

HERE = Path(__file__).resolve().parent
HEIGHT, SIZE, SIDE = 2048, 2048, 12
CHANNELS = ("rings", "squares", "clouds")
VIEW = View(20.0, 40.0)
LENSES = {"no lens": MoebiusMap.identity(), "S = 4": fisheye((20.0, 40.0), magnification=4.0)}
REPETITIONS = 3
Row = dict[str, Any]


def clouds(height: int) -> Pixels:
    """Noise whose amplitude falls as 1/f, as that of photographs does."""
    rng = np.random.default_rng(7)
    across, down = np.fft.rfftfreq(2 * height), np.fft.fftfreq(height)
    frequency = np.hypot(across, down[:, None])
    frequency[0, 0] = np.inf
    waves = rng.standard_normal((*frequency.shape, 2)).view(np.complex128)[..., 0] / frequency
    values = np.fft.irfft2(waves, s=(height, 2 * height))
    return np.clip(127.5 + 45 * values / values.std(), 0, 255).astype(np.uint8)


def sample_raster() -> Pixels:
    """Rings of every width, squares of 16 texels, clouds: a channel each."""
    return np.dstack([zone_plate(HEIGHT), checkerboard(HEIGHT, HEIGHT // 16), clouds(HEIGHT)])


def windows() -> list[tuple[int, int, int, int]]:
    """Squares of pixels along eight rays from the middle of the disc to just inside the limb."""
    places = [(0.0, 0.0)]
    for angle in np.arange(8) * np.pi / 4 + 0.3:
        places += [(r * np.cos(angle), r * np.sin(angle)) for r in (0.35, 0.7, 0.9, 0.97, 0.988)]
    corners = [(int((1 + x) * SIZE / 2 - SIDE / 2), int((1 - y) * SIZE / 2 - SIDE / 2)) for x, y in places]
    return [(left, top, SIDE, SIDE) for left, top in corners]


def scipys(raster: Pixels, lens: MoebiusMap, order: int, samples: int = 1) -> Pixels:
    """The mean of samples × samples a pixel: coordinates in NumPy, in closed form, then one call for each channel."""
    total = np.zeros((SIZE, SIZE, 3), dtype=np.uint16)
    for x, y in itertools.product((np.arange(samples) + 0.5) / samples, repeat=2):
        right, up = np.meshgrid((np.arange(SIZE) + x) * 2 / SIZE - 1, 1 - (np.arange(SIZE) + y) * 2 / SIZE)
        inside = right * right + up * up < 1
        lon, lat = lonlat_of(right[inside], up[inside], lens)
        places = np.stack([(90 - lat) / 180 * HEIGHT - 0.5, (lon + 180) / 360 * 2 * HEIGHT - 0.5])
        for channel in range(3):
            values = ndimage.map_coordinates(raster[..., channel], places, order=order, mode="grid-wrap")
            total[inside, channel] += values
    return ((total + samples**2 // 2) // samples**2).astype(np.uint8)


def lonlat_of(x: FloatArray, y: FloatArray, lens: MoebiusMap) -> tuple[FloatArray, FloatArray]:
    """Longitude and latitude of what is seen at points of the disc: rotations and the fisheye in plain doubles."""
    back = lens.inverse()
    seen = np.stack([x, y, np.sqrt(1 - x * x - y * y)], axis=-1) @ (VIEW.matrix @ back.right.matrix.T)
    z, size = seen[:, 2], back.magnification
    lower, upper = (1 + z) / size, size * (1 - z)
    image = np.column_stack([2 * seen[:, 0], 2 * seen[:, 1], lower - upper]) / (lower + upper)[:, None]
    px, py, pz = (image @ back.left.matrix.T).T
    return np.degrees(np.arctan2(py, px)), np.degrees(np.arcsin(np.clip(pz, -1, 1)))


def cartopys(raster: Pixels) -> tuple[str, Pixels, float, float] | None:
    """Name, picture and both times, from an environment of its own; nothing if that is not there."""
    python = HERE / ".peers" / "cartopy" / "bin" / "python"
    if not python.exists():
        print("cartopy is not installed: run benchmarks/install_peers.sh", file=sys.stderr)
        return None
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "task.npz"
        np.savez(file, raster=raster, center=(VIEW.lon, VIEW.lat), size=SIZE)
        command = [str(python), str(HERE / "peers" / "cartopy_raster.py"), str(file)]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        told = json.loads(said.splitlines()[-1])
        title = f"cartopy {told['version']}, nearest texel"
        return title, np.load(told["file"]), told["seconds"], told["busy"]


def pictures(raster: Pixels, lens: MoebiusMap, *, plain: bool) -> Iterator[tuple[str, Pixels, float, float]]:
    """Name, picture and times of each way."""
    yield "stereodel, first picture", *fastest(lambda: Raster(raster).warp(lens, VIEW, SIZE), REPETITIONS)
    ready = Raster(raster)
    ready.warp(lens, VIEW, 16)
    yield "stereodel, each further one", *fastest(lambda: ready.warp(lens, VIEW, SIZE), REPETITIONS)
    yield "stereodel, the same on one thread", *fastest(lambda: ready.warp(lens, VIEW, SIZE, workers=1), REPETITIONS)
    library = f"SciPy {scipy.__version__}"
    yield f"{library}, linear", *fastest(lambda: scipys(raster, lens, 1), 2)
    yield f"{library}, cubic spline", *fastest(lambda: scipys(raster, lens, 3), 1)
    yield f"{library}, cubic spline, 9 samples a pixel", *fastest(lambda: scipys(raster, lens, 3, samples=3), 1)
    peer = cartopys(raster) if plain else None
    if peer is not None:
        yield peer


def measure(name: str, raster: Pixels) -> Iterator[Row]:
    """All ways through one lens, with their signal-to-noise ratios in decibels."""
    lens = LENSES[name]
    places = windows()
    exact = [[reference(raster[..., c], lens, VIEW, SIZE, place)[0] for place in places] for c in range(3)]
    for library, picture, seconds, busy in pictures(raster, lens, plain=name == "no lens"):
        found = [[picture[t : t + h, l : l + w, c] for l, t, w, h in places] for c in range(3)]  # noqa: E741
        ratios = [psnr(np.array(e), np.array(f, dtype=np.float64)) for e, f in zip(exact, found, strict=True)]
        times = {"seconds": seconds, "busy": busy}
        yield {"lens": name, "library": library, **times, **dict(zip(CHANNELS, ratios, strict=True))}


if __name__ == "__main__":
    shown = sample_raster()
    pages.record("rasters", [row for name in LENSES for row in measure(name, shown)])
