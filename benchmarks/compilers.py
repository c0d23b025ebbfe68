"""The kernel of a wheel, compiled by zig, beside the one that the machine's own compiler made: times and answers.

    python -m benchmarks.compilers WHEEL

WHEEL is one for this Python: `make wheels` makes it. Both are measured in processes of their own, in turn, on one
thread; what is compared are the least times of the processor, which a busy machine disturbs least. Writes
benchmarks/compilers.json; 1 if the wheel's kernel answers otherwise or takes more than `LIMIT` as long.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from benchmarks import pages
from stereodel._files import replacing

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "compilers.json"
POINTS = 300_000
ROUNDS = 12
LIMIT = 1.1
WORKER = """
import hashlib, json, sys, time
import numpy as np
import stereodel
from stereodel import PlanarDelaunay, SphericalDelaunay, SphericalVoronoi

rng = np.random.default_rng(0)
xyz, xy = rng.normal(size=(int(sys.argv[1]), 3)), rng.random((int(sys.argv[1]), 2))
found = {"file": stereodel.__file__}
def timed(name, work):
    begin = time.process_time()
    result = work()
    found[name] = time.process_time() - begin
    return result
sphere = timed("triangulation, sphere", lambda: SphericalDelaunay(xyz, workers=1))
plane = timed("triangulation, plane", lambda: PlanarDelaunay(xy, workers=1))
centers = timed("circumcenters, sphere", lambda: sphere.circumcenters)
areas = timed("regions and areas, sphere", lambda: SphericalVoronoi(sphere, workers=1).areas())
bits = b"".join(np.ascontiguousarray(a).tobytes() for a in (sphere.simplices, plane.simplices, centers, areas))
found["bits"] = hashlib.sha256(bits).hexdigest()
print(json.dumps(found))
"""


def run(folder: Path, points: int) -> dict[str, str | float]:
    """What a process says that imports the package of a folder."""
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    line = [sys.executable, "-P", "-c", WORKER, str(points)]
    said = subprocess.run(line, env=environment, cwd=folder, check=True, capture_output=True, text=True).stdout
    found: dict[str, str | float] = json.loads(said)
    if Path(str(found.pop("file"))).parent.parent != folder:
        raise RuntimeError(f"the package of {folder} is not the one that was imported")
    return found


def measure(folders: dict[str, Path], points: int = POINTS, rounds: int = ROUNDS) -> dict[str, dict[str, float]]:
    """The least seconds of each piece of work, by who compiled.

    Raises
    ------
    RuntimeError
        When they do not answer the same to the last bit.
    """
    least: dict[str, dict[str, float]] = {name: {} for name in folders}
    bits = set()
    for turn in range(rounds):
        for name in sorted(folders, reverse=turn % 2 == 1):
            found = run(folders[name], points)
            bits.add(found.pop("bits"))
            for work, seconds in found.items():
                least[name][work] = min(float(seconds), least[name].get(work, float("inf")))
    if len(bits) != 1:
        raise RuntimeError("the kernels do not answer the same to the last bit")
    return least


def main(wheel: str) -> int:
    """Measure, save, report."""
    with tempfile.TemporaryDirectory() as temporary:
        unpacked = Path(temporary).resolve()
        with zipfile.ZipFile(wheel) as packed:
            packed.extractall(unpacked)
        least = measure({"own": HERE.parent, "zig": unpacked})
    ratios = {work: least["zig"][work] / least["own"][work] for work in least["own"]}
    with replacing(RESULTS) as path:
        content = {"points": POINTS, "rounds": ROUNDS, "seconds": least, "zig : own": ratios}
        path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    rows = [
        [work, *(f"{1e3 * least[name][work]:.0f}" for name in ("own", "zig")), f"{ratios[work]:.2f}"] for work in ratios
    ]
    print(pages.table(["ms, one thread", "machine's compiler", "zig", "ratio"], rows, "lrrr"))
    return 0 if max(ratios.values()) <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
