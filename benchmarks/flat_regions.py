"""The paper's claim about flat regions, measured (rows P5, P6 and P10 of the ledger).

    python -m benchmarks.flat_regions

Draws quadruples of directions of every size from 1 to 1e-14 rad, asks four tests on which side of the circle abc the
point p lies, and counts how many each leaves open by its proven bound and how many signs it has wrong when the bound is
not asked. Writes benchmarks/flat_regions.json, docs/images/flat_regions.svg and the table in docs/flat_regions.md.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks import flat_regions_page, flat_tests
from benchmarks.flat_regions_page import RESULTS, WIDE
from benchmarks.flat_tests import Quadruples, Region
from stereodel._arrays import FloatArray
from stereodel._files import replacing

SIZES = [10.0 ** (-k / 2) for k in range(29)]
CLUSTERS, PER_CLUSTER = 10, 5000
SEED = 20

METHODS = ("plain", "lifted", "curvature", "exact")
Sampler = Callable[[np.random.Generator, float], tuple[Quadruples, Region]]


def tangents(center: FloatArray, generator: np.random.Generator) -> FloatArray:
    """Two orthonormal directions at right angles to `center`, as rows."""
    first = np.cross(center, generator.standard_normal(3))
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(center, first)])


def around(center: FloatArray, distance: FloatArray, generator: np.random.Generator) -> FloatArray:
    """Points at given angular distances (radians) from a centre, in random directions, as rounded unit vectors."""
    turn = generator.uniform(0.0, 2.0 * np.pi, distance.shape)
    across = np.stack([np.cos(turn), np.sin(turn)], axis=-1) @ tangents(center, generator)
    vectors = np.cos(distance)[..., None] * center + np.sin(distance)[..., None] * across
    return flat_tests.rounded_units(vectors)


def random_center(generator: np.random.Generator) -> FloatArray:
    """A direction, rounded."""
    return flat_tests.rounded_units(generator.standard_normal((1, 3)))[0]


def in_cap(generator: np.random.Generator, size: float) -> tuple[Quadruples, Region]:
    """Four points at random in a cap of angular radius `size`, which is the region."""
    center = random_center(generator)
    distance = size * np.sqrt(generator.random((4, PER_CLUSTER)))
    return tuple(around(center, distance, generator)), Region.around(center, size)


def on_circle(generator: np.random.Generator, size: float) -> tuple[Quadruples, Region]:
    """Four points of one circle of angular radius `size`, rounded: ties but for the rounding."""
    center = random_center(generator)
    return tuple(around(center, np.full((4, PER_CLUSTER), size), generator)), Region.around(center, size)


def within(generator: np.random.Generator, size: float) -> tuple[Quadruples, Region]:
    """Four points of a cap of angular radius `size` somewhere in a region of WIDE radians."""
    center = random_center(generator)
    place = around(center, (WIDE - size) * np.sqrt(generator.random(1)), generator)[0]
    distance = size * np.sqrt(generator.random((4, PER_CLUSTER)))
    return tuple(around(place, distance, generator)), Region.around(center, WIDE)


FAMILIES: dict[str, Sampler] = {"random": in_cap, "circle": on_circle, "within": within}


def different(quadruples: Quadruples) -> Quadruples:
    """Without the tests in which rounding made two points one."""
    points = np.stack(quadruples)
    same = np.zeros(points.shape[1], dtype=np.bool_)
    for i in range(4):
        for j in range(i):
            same |= (points[i] == points[j]).all(axis=-1)
    return tuple(points[:, ~same])


def count(quadruples: Quadruples, region: Region) -> dict[str, int]:
    """How many tests and exact zeros; how many signs each method leaves open, has wrong, and calls proved wrongly."""
    truth = flat_tests.truth(quadruples)
    counts = {"tests": len(truth), "zeros": int((truth == 0).sum())}
    found = {
        "plain": flat_tests.plain(quadruples),
        "lifted": flat_tests.lifted(quadruples, region),
        "curvature": flat_tests.curvature(quadruples),
    }
    for method, (value, bound) in found.items():
        decided = np.abs(value) > bound
        counts[f"{method} open"] = int((~decided).sum())
        counts[f"{method} wrong"] = int((np.sign(value) != truth).sum())
        counts[f"{method} proved wrong"] = int((decided & (np.sign(value) != truth)).sum())
    counts["hull wrong"] = int((flat_tests.rounded_exactly(quadruples) != truth).sum())
    counts["exact open"] = counts["exact wrong"] = counts["exact proved wrong"] = 0
    return counts


def measure(family: str, size: float) -> dict[str, Any]:
    """One row: the counts of all clusters of a size."""
    generator = np.random.Generator(np.random.PCG64([SEED, list(FAMILIES).index(family), SIZES.index(size)]))
    rows = []
    for _ in range(CLUSTERS):
        quadruples, region = FAMILIES[family](generator, size)
        rows.append(count(different(quadruples), region))
    return {"family": family, "size": size} | {name: sum(row[name] for row in rows) for name in rows[0]}


def main() -> None:
    """Measure, then write the numbers, the plot and the page's tables."""
    begin = time.perf_counter()
    rows = [measure(family, size) for family in FAMILIES for size in SIZES if family != "within" or size <= WIDE]
    with replacing(RESULTS) as temporary:
        lines = ",\n".join("  " + json.dumps(row) for row in rows)
        temporary.write_text(f"[\n{lines}\n]\n", encoding="utf-8")
    flat_regions_page.write(rows)
    print(f"{sum(row['tests'] for row in rows)} tests in {time.perf_counter() - begin:.0f} s")


if __name__ == "__main__":
    main()
