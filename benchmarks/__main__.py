"""Compare stereodel with its peers and write benchmarks/results.json, docs/benchmarks.md and its plots.

    benchmarks/install_peers.sh        once; what cannot be installed is named in the page
    python -m benchmarks [--only EXPERIMENT…] [--largest 1e7] [--results FILE]

With --only the other experiments keep what was measured before. The page is written only from the usual file of
results, and with --largest of 1e6 or more.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import time
from pathlib import Path

import psutil

from benchmarks import pages
from benchmarks.experiments import EXPERIMENTS, RESULTS


def machine() -> dict[str, str]:
    """What the numbers depend on."""
    processors = re.findall(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
    return {
        "processor": processors[0] if processors else platform.machine(),
        "cores": str(os.cpu_count()),
        "memory": f"{psutil.virtual_memory().total / 2**30:.0f} GB",
        "system": platform.freedesktop_os_release()["PRETTY_NAME"],
        "python": platform.python_version(),
        "load": f"{os.getloadavg()[0]:.1f}",
        "date": time.strftime("%Y-%m-%d"),
    }


def main() -> None:
    """Measure, save after each experiment, write the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Compare stereodel with its peers.")
    parser.add_argument("--only", nargs="+", choices=list(EXPERIMENTS), default=list(EXPERIMENTS))
    parser.add_argument("--largest", type=float, default=1e7, help="number of points")
    parser.add_argument("--results", type=Path, default=RESULTS)
    options = parser.parse_args()
    results = json.loads(options.results.read_text(encoding="utf-8")) if options.results.exists() else {}
    for name in options.only:
        begin = time.perf_counter()
        results[name] = EXPERIMENTS[name](int(options.largest))
        results.setdefault("machine", {})[name] = machine()
        pages.save(results, options.results)
        print(f"{name}: {time.perf_counter() - begin:.0f} s", flush=True)
    if options.results == RESULTS and options.largest >= 1e6:
        pages.write("results")


if __name__ == "__main__":
    main()
