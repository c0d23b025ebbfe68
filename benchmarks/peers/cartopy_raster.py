"""cartopy's reprojection of a raster onto a globe, in an environment where stereodel is not installed.

    python cartopy_raster.py TASK.npz

The task holds `raster` (h, w, 3) uint8, `center` (lon, lat) and `size` in pixels. Prints seconds on the wall and of
processors, version, and the file of the picture, rows from the top.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import cartopy
import cartopy.crs as ccrs
import numpy as np
from cartopy.img_transform import warp_array


def main(file: str) -> None:
    """Warp once: an index of all texels is made in each call."""
    with np.load(file) as task:
        raster, (lon, lat), size = task["raster"], task["center"], int(task["size"])
    target, source = ccrs.Orthographic(lon, lat), ccrs.PlateCarree()
    begin, begin_busy = time.perf_counter(), time.process_time()
    picture, _ = warp_array(raster[::-1], target, source_proj=source, target_res=(size, size))
    seconds, busy = time.perf_counter() - begin, time.process_time() - begin_busy
    found = Path(file).with_suffix(".npy")
    np.save(found, np.ma.filled(picture, 0)[::-1])
    print(json.dumps({"seconds": seconds, "busy": busy, "version": cartopy.__version__, "file": str(found)}))


if __name__ == "__main__":
    main(sys.argv[1])
