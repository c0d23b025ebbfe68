"""The tables of docs/interpolation.md, from what `benchmarks.interpolation` measured."""

from __future__ import annotations

from typing import Any

from benchmarks import pages

Rows = list[dict[str, Any]]


def errors(row: dict[str, Any]) -> str:
    """Root mean square, largest, and for how many queries there was no answer."""
    missing = f", {row['missing']} NaN" if row["missing"] else ""
    return f"{row['rms']:.1e} ({row['largest']:.0e}{missing})"


def error_table(rows: Rows, space: str) -> str:
    """Root mean square and largest error of each method for each number of points."""
    chosen = [row for row in rows if row["space"] == space]
    sizes = sorted({row["points"] for row in chosen})
    names = list(dict.fromkeys((row["method"], row["library"]) for row in chosen))
    names.sort(key=lambda name: ["nearest", "linear", "natural neighbour", "smooth"].index(name[0]))
    cells = {(row["method"], row["library"], row["points"]): errors(row) for row in chosen}
    head = ["method", "library", *(f"{size:,} points" for size in sizes)]
    body = [[*name, *(cells.get((*name, size), "–") for size in sizes)] for name in names]
    return pages.table(head, body, "ll" + "r" * len(sizes))


def time_table(rows: Rows) -> str:
    """Seconds of preparation and microseconds a query with the most points."""
    largest = max(row["points"] for row in rows)
    chosen = [row for row in rows if row["points"] == largest]
    body = [
        [row["space"], row["method"], row["library"], f"{row['prepare']:.2f}", f"{1e6 * row['ask'] / 20_000:.1f}"]
        for row in chosen
    ]
    return pages.table(["", "method", "library", "preparing, s", "a query, µs"], body, "lllrr")


def write(rows: Rows) -> None:
    """All blocks of the page."""
    blocks = {space: error_table(rows, space) for space in ("plane", "sphere")}
    pages.fill("interpolation.md", blocks | {"times": time_table(rows)})
