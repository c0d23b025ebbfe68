"""How long `import stereodel` takes beyond NumPy: fresh interpreters in turn, the median of each and the difference.

    python benchmarks/import_time.py [--runs 15] [--limit 0.1]

The exit code is 1 when the difference is above the limit (seconds).
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys

MEASURE = "import time; begin = time.perf_counter(); import {}; print(time.perf_counter() - begin)"


def seconds(module: str) -> float:
    """Time of one import in a new interpreter."""
    ran = subprocess.run([sys.executable, "-c", MEASURE.format(module)], capture_output=True, text=True, check=True)
    return float(ran.stdout)


def main() -> int:
    """Measure, print, and return the exit code."""
    parser = argparse.ArgumentParser(description="Time of `import stereodel` beyond NumPy.")
    parser.add_argument("--runs", type=int, default=15)
    parser.add_argument("--limit", type=float, default=0.1, help="seconds")
    options = parser.parse_args()
    modules = ("numpy", "stereodel")
    for module in modules:
        seconds(module)  # the first import compiles and reads from a cold disk
    # In turn, so that a busy moment of the machine meets both.
    times = [[seconds(module) for module in modules] for _ in range(options.runs)]
    numpy, stereodel = (statistics.median(column) for column in zip(*times, strict=True))
    print(f"numpy {numpy:.3f} s, stereodel {stereodel:.3f} s, difference {stereodel - numpy:.3f} s")
    return int(stereodel - numpy > options.limit)


if __name__ == "__main__":
    sys.exit(main())
