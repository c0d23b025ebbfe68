"""The plot and the tables of docs/flat_regions.md, from the counts of `benchmarks.flat_regions`.

python -m benchmarks.flat_regions_page     (from benchmarks/flat_regions.json, without measuring again)
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from benchmarks import pages
from stereodel.drawing.page.style import BLUE, DARK_GRAY, LIGHT_GRAY, VERMILION

Rows = list[dict[str, Any]]

RESULTS = pages.DOCS.parent / "benchmarks" / "flat_regions.json"
WIDE = 0.1
"""Radius of the wide region, radians."""

TITLES = {
    "random": "four random points of the region",
    "circle": "four points of one circle, rounded",
    "within": f"four close points of a region of {WIDE:g} rad",
}
LOOKS: dict[str, dict[str, Any]] = {
    "exact": {"color": LIGHT_GRAY, "linewidth": 5.0, "label": "exact arithmetic on the rays", "solid_capstyle": "butt"},
    "plain": {"color": DARK_GRAY, "linewidth": 1.2, "label": "plain test"},
    "curvature": {"color": BLUE, "linewidth": 1.6, "label": "curvature form"},
    "lifted": {"color": VERMILION, "linewidth": 1.2, "dashes": (4, 2), "label": "plain test after the paper’s lift"},
    "hull": {"color": "black", "linewidth": 0.9, "dashes": (1, 1.5), "label": "exact hull of the rounded vectors"},
}
COUNTED = {"open": "left open, % of the tests", "wrong": "wrong sign, % of the tests"}
EARTH = {1e0: "6400 km", 1e-4: "640 m", 1e-8: "6 cm", 1e-12: "6 µm"}
TABLE_SIZES = (1e0, 1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12, 1e-14)


def curve(rows: Rows, family: str, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Sizes and shares in percent."""
    chosen = [row for row in rows if row["family"] == family]
    return np.array([row["size"] for row in chosen]), np.array([100 * row[name] / row["tests"] for row in chosen])


def draw_panel(axis: Axes, rows: Rows, family: str, what: str) -> None:
    """All methods' shares of one kind."""
    for method, look in LOOKS.items():
        if method != "hull" or what == "wrong":
            axis.plot(*curve(rows, family, f"{method} {what}"), **look)
    axis.set_xscale("log")
    axis.set_xlim(2, 5e-15)
    axis.set_xticks([10.0**-k for k in range(0, 15, 4)])
    axis.minorticks_off()
    axis.set_ylim(-3, 103 if what == "open" else 60)


def add_earth(axis: Axes) -> None:
    """The sizes on Earth above a panel."""
    above = axis.secondary_xaxis("top")
    above.set_xticks(list(EARTH), list(EARTH.values()))
    above.minorticks_off()
    above.tick_params(length=2, labelsize=7)
    above.spines["top"].set_visible(False)


def draw(rows: Rows) -> None:
    """docs/images/flat_regions.svg."""
    with pages.plot("flat_regions", 330, 2, 3, sharex=True, sharey="row") as axes:
        for line, what in zip(axes, COUNTED, strict=True):
            for axis, family in zip(line, TITLES, strict=True):
                draw_panel(axis, rows, family, what)
            line[0].set_ylabel(COUNTED[what])
        for axis, title in zip(axes[0], TITLES.values(), strict=True):
            axis.set_title(title, fontsize=8.5)
            add_earth(axis)
        for axis, words in zip(
            axes[1], ("size of the region", "radius of the circle", "size of the four"), strict=True
        ):
            axis.set_xlabel(f"{words}, rad")
        handles, labels = axes[1][0].get_legend_handles_labels()
        axes[0][0].figure.legend(handles, labels, loc="outside lower center", ncols=3)


def share(row: dict[str, Any], name: str) -> str:
    """A share in percent, exact zeros and ones without digits."""
    part = row[name] / row["tests"]
    return "0" if part == 0 else "100" if part == 1 else f"{100 * part:.2g}" if part < 0.1 else f"{100 * part:.0f}"


def family_table(rows: Rows, family: str) -> str:
    """Open and wrong shares of one family."""
    head = ["size, rad", "plain", "lift", "curvature", "exact", "plain", "hull", "lift", "curvature", "exact"]
    columns = [f"{m} open" for m in ("plain", "lifted", "curvature", "exact")]
    columns += [f"{m} wrong" for m in ("plain", "hull", "lifted", "curvature", "exact")]
    head = [name if not k else f"{name}, {'open' if k < 5 else 'wrong'}" for k, name in enumerate(head)]
    chosen = [
        row for row in rows if row["family"] == family and any(np.isclose(row["size"], TABLE_SIZES, rtol=1e-6, atol=0))
    ]
    body = [[f"{row['size']:.0e}", *(share(row, name) for name in columns)] for row in chosen]
    return pages.table(head, body, "r" * len(head))


def summary(rows: Rows) -> str:
    """How many tests there were, and that no bound was broken."""
    tests = sum(row["tests"] for row in rows)
    broken = sum(row[f"{method} proved wrong"] for row in rows for method in ("plain", "lifted", "curvature"))
    zeros = sum(row["zeros"] for row in rows)
    return (
        f"{tests:,} tests, of which {zeros:,} are exact ties. Signs that a bound called proved and exact arithmetic "
        f"called wrong: {broken}."
    )


def span(sizes: np.ndarray, good: np.ndarray) -> str:
    """The sizes at which something holds, where they are an end of the range."""
    if good.all():
        return "all sizes"
    if not good.any():
        return "no size"
    bad = sizes[~good]
    above, below = sizes[sizes > bad.max()], sizes[sizes < bad.min()]
    if len(above):
        return f"{above.min():.0e} and above"
    return f"{below.max():.0e} and below" if len(below) else "some sizes"


def thresholds(rows: Rows) -> str:
    """Where each method decides nearly everything, and where its sign is a coin."""
    body = []
    for family, title in TITLES.items():
        for what, limit, words in (("open", 1, "less than 1 % open"), ("wrong", 45, "more than 45 % wrong")):
            cells = []
            for method in ("plain", "lifted", "curvature", "exact"):
                sizes, shares = curve(rows, family, f"{method} {what}")
                cells.append(span(sizes, shares < limit if what == "open" else shares > limit))
            body.append([title, words, *cells])
    return pages.table(["four points", "share", "plain", "lift", "curvature form", "exact"], body)


def write(rows: Rows) -> None:
    """The plot and the page's blocks."""
    draw(rows)
    blocks = {"summary": summary(rows), "thresholds": thresholds(rows)}
    pages.fill("flat_regions.md", blocks | {family: family_table(rows, family) for family in TITLES})


if __name__ == "__main__":
    write(json.loads(RESULTS.read_text(encoding="utf-8")))
