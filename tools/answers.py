"""Answers of the kernel that are the same wherever it was compiled: tests/kernel/answers.json holds them.

    python tools/answers.py            compare with the stored ones; 1 if some differ
    python tools/answers.py --write    store them

Triangles are decided by exact signs: they are equal on all systems. Circumcentres and areas pass through functions of
the C library: on that of GNU they are equal to the last bit, on others within `OTHER_LIBRARIES`. The points are made of
the raw numbers of a generator, which NumPy promises not to change. Needs stereodel and NumPy alone.
"""

from __future__ import annotations

import hashlib
import json
import platform
import sys
from pathlib import Path
from typing import Any

import numpy as np

import stereodel
from stereodel import PlanarDelaunay, SphericalDelaunay, SphericalVoronoi

STORED = Path(__file__).resolve().parent.parent / "tests" / "kernel" / "answers.json"
OTHER_LIBRARIES = 2.0**-40
"""What values may differ by, relative to the largest: functions that other C libraries round otherwise, by a few units
in the last place, are followed by sums in which at most some thousands of such units remain."""
SAMPLES = 16
Floats = np.ndarray[Any, np.dtype[np.float64]]


def uniform(seed: int, size: int, width: int) -> Floats:
    """Numbers from -1/2 to 1/2, multiples of 2⁻⁵³."""
    raw = np.random.PCG64(seed).random_raw(size * width) >> np.uint64(11)
    return (raw.astype(float) * 2.0**-53 - 0.5).reshape(size, width)


def grid(side: int, width: int) -> Floats:
    """Whole numbers about zero, which is left out: most decisions are ties."""
    steps = np.arange(side, dtype=float) - side // 2
    points = np.stack(np.meshgrid(*[steps] * width, indexing="ij"), axis=-1).reshape(-1, width)
    return points[np.any(points != 0, axis=1)]


def sets() -> dict[str, Floats]:
    """Points by name: directions of any length, or points of the plane."""
    near = np.array([0.6, 0.48, 0.64])
    return {
        "directions": uniform(1, 50_000, 3),
        "directions of a thousandth of a radian": near + 1e-3 * uniform(2, 50_000, 3),
        "directions of whole numbers": grid(17, 3),
        "plane": uniform(3, 50_000, 2),
        "plane of whole numbers": grid(101, 2),
    }


def digest(array: Any) -> str:
    """SHA-256 of an array in one order and width of bytes."""
    kept = np.ascontiguousarray(array)
    return hashlib.sha256(kept.astype(kept.dtype.newbyteorder("<")).tobytes()).hexdigest()


def samples(values: Floats) -> list[str]:
    """Some of the values, to the last bit."""
    flat = values.ravel()
    return [float(value).hex() for value in flat[:: max(1, flat.size // SAMPLES)][:SAMPLES]]


def answers() -> dict[str, dict[str, Any]]:
    """By set: the digest of its triangles, and of circumcentres and areas with some of their values."""
    found: dict[str, dict[str, Any]] = {}
    for name, points in sets().items():
        on_sphere = points.shape[1] == 3
        made = SphericalDelaunay(points) if on_sphere else PlanarDelaunay(points)
        values = {"circumcenters": made.circumcenters}
        if on_sphere:
            values["areas"] = SphericalVoronoi(made).areas()
        found[name] = {"triangles": digest(made.simplices.astype(np.int64))} | {
            key: {"digest": digest(value), "samples": samples(value)} for key, value in values.items()
        }
    return found


def close(left: list[str], right: list[str]) -> bool:
    """Whether values are those of another C library."""
    ours, theirs = ([float.fromhex(value) for value in values] for values in (left, right))
    largest = max(map(abs, theirs))
    return all(abs(a - b) <= OTHER_LIBRARIES * largest for a, b in zip(ours, theirs, strict=True))


def differences(found: dict[str, Any], stored: dict[str, Any], to_the_bit: bool) -> list[str]:
    """What is not as it is stored."""
    wrong = list(stored.keys() ^ found.keys())
    for name in stored.keys() & found.keys():
        if found[name]["triangles"] != stored[name]["triangles"]:
            wrong.append(f"{name}: triangles")
        for key in stored[name].keys() - {"triangles"}:
            ours, theirs = found[name][key], stored[name][key]
            same = ours == theirs if to_the_bit else close(ours["samples"], theirs["samples"])
            if not same:
                wrong.append(f"{name}: {key}")
    return sorted(wrong)


def main(arguments: list[str]) -> int:
    """Report and return the exit code."""
    found = answers()
    if arguments == ["--write"]:
        STORED.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        return 0
    library = platform.libc_ver()[0]
    wrong = differences(found, json.loads(STORED.read_text(encoding="utf-8")), to_the_bit=library == "glibc")
    free = getattr(sys, "_is_gil_enabled", lambda: True)() is False
    python = f"Python {platform.python_version()}{' without its lock' if free else ''}, {platform.machine()}"
    where = f"stereodel {stereodel.__version__} on {python}, {library or platform.system()}, NumPy {np.__version__}"
    print(f"{where}: {f'{len(found)} sets answered as stored' if not wrong else 'OTHER ANSWERS'}")
    print(*wrong, sep="\n", end="\n" if wrong else "", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
