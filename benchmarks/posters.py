"""Time and memory of large pictures, each drawn and written in a process of its own.

    python -m benchmarks.posters [--script figures/earth_airports.py] [--sizes 2048 8192 16384]

Memory is the largest resident set above that of the process which has the page and has drawn a small picture of it.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.processes import peak_memory


def measured(script: Path, size: int) -> str:
    """One line about one picture."""
    from tools.build import load_drawing

    page = load_drawing(script).page()
    with tempfile.TemporaryDirectory() as folder:
        path = page.save(Path(folder, "small.png"), size=64)
        base, begin, work = peak_memory() / 2**20, time.perf_counter(), time.process_time()
        path = page.save(Path(folder, "large.png"), size=size)
        seconds, work = time.perf_counter() - begin, time.process_time() - work
        height = round(size * page.height / page.width)
        memory, file = peak_memory() / 2**20 - base, path.stat().st_size / 1e6
    return (
        f"{size:>6} x {height:<6} {seconds:7.1f} s {work:7.1f} s of processors, "
        f"{memory:6.0f} MB above {base:.0f}, file {file:.1f} MB"
    )


def main() -> None:
    """Measure one picture, or start a process for each."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.posters", description="Time and memory of large pictures."
    )
    parser.add_argument("--script", type=Path, default=Path("figures/earth_airports.py"))
    parser.add_argument("--sizes", type=int, nargs="+", default=[2048, 8192, 16384], help="widths in pixels")
    options = parser.parse_args()
    if len(options.sizes) == 1:
        print(measured(options.script, *options.sizes), flush=True)
        return
    for size in options.sizes:
        command = [sys.executable, "-m", "benchmarks.posters", "--script", str(options.script), "--sizes", str(size)]
        subprocess.run(command, check=True)


if __name__ == "__main__":
    main()
