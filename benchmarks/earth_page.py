"""The plot and the tables of docs/earth.md, from the numbers of `benchmarks.earth_nearest`.

python -m benchmarks.earth_page     (from benchmarks/earth_nearest.json, without measuring again)
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from benchmarks import pages
from stereodel import earth, lonlat_to_xyz, xyz_to_lonlat
from stereodel.drawing.page.style import BLUE, DARK_GRAY, VERMILION
from stereodel.sphere.latitudes import KINDS

RESULTS = pages.DOCS.parent / "benchmarks" / "earth_nearest.json"
KILOMETRES_PER_MINUTE = np.radians(1 / 60) * earth.MEAN_RADIUS_KM


def write(results: dict[str, Any]) -> None:
    """Everything on the page that depends on the numbers, and the plot."""
    pages.fill("earth.md", {"lengths": lengths_table(results), "nearest": nearest_table(results)})
    latitudes_plot()


def lengths_table(results: dict[str, Any]) -> str:
    """Relative errors of distances."""
    rows = [
        [name, *(f"{100 * found[kind][what]:.2f} %" for kind in KINDS for what in ("rms", "largest"))]
        for name, found in results["lengths"].items()
    ]
    head = ["pairs", *(f"{kind}, {what}" for kind in KINDS for what in ("rms", "largest"))]
    return pages.table(head, rows, "l" + 6 * "r")


def nearest_table(results: dict[str, Any]) -> str:
    """How often the nearest site on the sphere is another one, and by how much it is farther."""
    rows = []
    for name, label in (("airports", "airports"), ("random", "as many random places")):
        found = dict(results["nearest"][name])
        mean = found.pop("mean distance")
        for kinds, numbers in found.items():
            rows.append([f"{label}, {mean / 1000:.0f} km away on average", *_numbers(kinds, numbers)])
    head = ["sites", "latitude", "not the nearest", "farther, median", "farther, at most", "of the distance, at most"]
    return pages.table(head, rows, "ll" + 4 * "r")


def _numbers(kinds: str, numbers: dict[str, float]) -> list[str]:
    sites, queries = kinds.split(", ")
    mixed = sites != queries
    return [
        f"sites {sites}, queries {queries}" if mixed else sites,
        f"{100 * numbers['share']:.2g} %" if numbers["share"] < 0.01 else f"{100 * numbers['share']:.1f} %",
        _metres(numbers["median"]),
        _metres(numbers["largest"]),
        "–" if mixed else f"{100 * numbers['relative']:.2g} %",
    ]


def _metres(value: float) -> str:
    return f"{value / 1000:.1f} km" if value >= 1000 else f"{value:.2g} m" if value < 10 else f"{value:.0f} m"


def latitudes_plot() -> None:
    """By how much the latitude on each sphere is less than the geodetic one."""
    latitude = np.linspace(0.0, 90.0, 181)
    lonlat = np.stack([np.zeros_like(latitude), latitude], axis=-1)
    with pages.plot("earth_latitudes", 170.0, 1, 1) as axes:
        plot: Any = axes[0][0]
        for kind, color in (("geodetic", BLUE), ("authalic", VERMILION)):
            less = 60 * (latitude - xyz_to_lonlat(lonlat_to_xyz(lonlat, latitude=kind))[:, 1])
            plot.plot(latitude, less, color=color, linewidth=1.4)
            name = {"geodetic": "direction from the centre (geocentric)", "authalic": "sphere of equal area"}[kind]
            plot.annotate(name, (45, less.max()), (0, 4), textcoords="offset points", ha="center", color=color, size=8)
        plot.set(xlim=(0, 90), ylim=(0, 14), xticks=range(0, 91, 15), yticks=range(0, 11, 2))
        plot.set_xlabel("geodetic latitude, degrees")
        plot.set_ylabel("less by, minutes of arc")
        right = plot.secondary_yaxis(
            "right", functions=(lambda m: m * KILOMETRES_PER_MINUTE, lambda k: k / KILOMETRES_PER_MINUTE)
        )
        right.set_ylabel("kilometres")
        right.tick_params(color=DARK_GRAY)


if __name__ == "__main__":
    write(json.loads(RESULTS.read_text(encoding="utf-8")))
