"""The one writer of what was measured: tables between markers of the documentation, and plots, from stored results.

python -m benchmarks.pages [NAME…]     writes them anew without measuring; NAME is that of a file benchmarks/NAME.json
"""

from __future__ import annotations

import json
import re
import statistics
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter

from benchmarks.engines import CONTENDERS, Contender
from benchmarks.rounds import paired
from stereodel._tasks.whole_files import replacing, write_whole
from stereodel.drawing.page.style import DARK_GRAY, PRINT_WIDTH, TYPE

HERE = Path(__file__).resolve().parent
DOCS = HERE.parent / "docs"
Results = dict[str, Any]
Rows = list[dict[str, Any]]
Blocks = dict[str, str]


def record(name: str, found: Any) -> None:
    """Store what was measured as benchmarks/NAME.json, and write its page."""
    save(found, HERE / f"{name}.json")
    write(name)


def save(found: Any, path: Path) -> None:
    """Write results, whole or not at all."""
    write_whole(path, json.dumps(found, indent=1) + "\n")


def write(name: str) -> None:
    """Fill the page that shows the results of a name."""
    page, blocks = PAGES[name]
    filled = blocks(json.loads((HERE / f"{name}.json").read_text(encoding="utf-8")))
    fill(page, filled)
    if "opening" in filled:
        fill("../paper/paper.md", {"opening": filled["opening"]})


def table(head: Sequence[str], rows: Sequence[Sequence[str]], align: str = "") -> str:
    """A Markdown table; `align` has one of l, r, c for each column."""
    rules = {"l": ":--", "r": "--:", "c": ":-:"}
    lines = [head, [rules[a] for a in align or "l" * len(head)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def listed(rows: Rows, align: str, *columns: tuple[str, str]) -> str:
    """A row for each measurement; a column is its head and a format with names of what was measured.

    Examples
    --------
    >>> print(listed([{"what": "kernel", "kB": 345.9}], "lr", ("", "{what}"), ("kB", "{kB:.0f}")))
    |  | kB |
    | :-- | --: |
    | kernel | 346 |
    """
    return table([head for head, _ in columns], [[cell.format_map(row) for _, cell in columns] for row in rows], align)


def fill(page: str, blocks: Blocks) -> None:
    """Put each block between its markers `<!-- measured: name -->` and `<!-- end -->` of a page of docs/."""
    path = DOCS / page
    text = path.read_text(encoding="utf-8")
    for name, block in blocks.items():
        marked = re.compile(rf"(<!-- measured: {re.escape(name)} -->\n).*?(<!-- end -->)", re.DOTALL)
        if not marked.search(text):
            raise ValueError(f"{page} has no place for {name!r}")
        text = marked.sub(lambda found, block=block: f"{found[1]}\n{block}\n\n{found[2]}", text)
    write_whole(path, text)


@contextmanager
def plot(name: str, height: float, **options: Any) -> Iterator[Sequence[Axes]]:
    """Two axes, as wide together as a figure and `height` points high, saved as docs/images/<name>.svg at the end."""
    look = {
        "axes.edgecolor": DARK_GRAY,
        "svg.hashsalt": name,  # the same bytes each time
        "axes.linewidth": 0.6,
        "axes.labelsize": 8,
        "axes.titlesize": 9,
        "legend.fontsize": 8,
        "legend.frameon": False,
        "grid.color": "#a6a6a6",
        "grid.linewidth": 0.3,
    }
    ticks = {"labelsize": 7.5, "major.width": 0.5, "minor.width": 0.3}
    look |= {f"{axis}tick.{what}": value for axis in "xy" for what, value in ticks.items()}
    with mpl.rc_context({**TYPE, **look}):
        figure = Figure(figsize=(PRINT_WIDTH / 72, height / 72), layout="constrained")
        axes = figure.subplots(1, 2, **options)
        for axis in axes:
            axis.grid(True)
            axis.spines[["top", "right"]].set_visible(False)
        yield axes
        with replacing(DOCS / "images" / f"{name}.svg") as temporary:
            figure.savefig(temporary, format="svg", metadata={"Date": None, "Creator": None}, facecolor="white")


def digits(value: float) -> str:
    """Three digits, or all of a larger number."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def power(n: int) -> str:
    """10⁵ for 100000."""
    exponent = len(str(n)) - 1
    return f"10{str(exponent).translate(str.maketrans('0123456789', '⁰¹²³⁴⁵⁶⁷⁸⁹'))}" if n == 10**exponent else f"{n:,}"


def spaced(n: int) -> str:
    """1 000 for 1000."""
    return f"{n:,}".replace(",", " ")


# The kernel and its peers: docs/benchmarks.md

COLUMNS = [f"{space}, {threads}" for space in CONTENDERS for threads in ("one thread", "two threads")]


def kernel(results: Results) -> Blocks:
    """The page's blocks and its plots."""
    plot_sizes(results["sizes"])
    plot_distributions(results["distributions"])
    parts = {"changes": changes, "derived": derived, "voronoi": diagrams, "conformal maps": conformal_maps, "gmt": gmt}
    blocks = {name: block(results[name]) for name, block in parts.items()}
    whole = {"machine": machine, "opening": opening, "engines": taking_part, "missing": missing}
    blocks |= {name: block(results) for name, block in whole.items()}
    for space in CONTENDERS:
        blocks[f"sizes {space}"] = sizes(results, space)
        blocks |= {f"{space} {n}": distributions(results, space, n) for n in ("100000", "1000000")}
    return blocks


def faster(record: Results, peer: str, ours: str) -> str:
    """How many times the peer takes as long: the median of the rounds."""
    seconds = [record.get(key, {}).get("rounds", []) for key in (peer, ours)]
    return f"{digits(statistics.median(paired(*seconds)))}×" if all(seconds) else "–"


def time_per_point(record: Results | None, n: int) -> str:
    """Nanoseconds per point, or what stopped the engine."""
    if record is None:
        return "–"
    return short_reason(record.get("stopped") or digits(1e9 * record["seconds"] / n))


def short_reason(reason: str) -> str:
    """A reason that fits a cell: limits as they are, other words shortened."""
    text = reason.replace("|", "/").replace("<", "").replace(">", "")
    return text if len(text) <= 46 else text[:45] + "…"


def opening(results: Results) -> str:
    """The main numbers at 1e6 points: times of ours, and ratios to CGAL and SciPy on one thread."""
    n = 1_000_000
    records = {f"Delaunay triangulation, {space}": (results["sizes"][space][str(n)], "ours") for space in CONTENDERS}
    records["Voronoi regions and areas, sphere"] = (results["voronoi"][str(n)], "voronoi")
    rows = []
    for what, (own, ours) in records.items():
        times = [time_per_point(own.get(f"{ours} {workers}"), n) for workers in (1, 2)]
        rows.append([what, *times, *(faster(own, peer, f"{ours} 1") for peer in ("cgal", "scipy"))])
    head = [f"{power(n)} uniform points", "ns per point, one thread", "two threads"]
    return table([*head, "times as fast as CGAL, one thread", "as SciPy"], rows, "lrrrr")


def taken(results: Results, space: str) -> dict[Contender, list[Results]]:
    """Those that took part, with what is known of each."""
    sized = results["sizes"][space].values()
    found = {one: [record[one.key] for record in sized if one.key in record] for one in CONTENDERS[space]}
    return {one: records for one, records in found.items() if records}


def sizes(results: Results, space: str) -> str:
    """Nanoseconds per point for every size, memory at 1e6."""
    sized = results["sizes"][space]
    rows = []
    for contender in taken(results, space):
        times = [time_per_point(record.get(contender.key), int(n)) for n, record in sized.items()]
        million = sized.get("1000000", {}).get(contender.key, {})
        rows.append([contender.label, *times, digits(million["peak"] / 1e6) if "peak" in million else "–"])
    head = ["ns per point", *(power(int(n)) for n in sized), "peak bytes per point at 10⁶"]
    return table(head, rows, "l" + "r" * (len(head) - 1))


def distributions(results: Results, space: str, n: str) -> str:
    """Nanoseconds per point and points lost, distribution by distribution."""
    named = {name: sized[n] for name, sized in results["distributions"][space].items() if n in sized}
    asked = [one for one in CONTENDERS[space] if any(one.key in record for record in named.values())]
    rows = [[name, f"{r['n']:,}", *(with_losses(r, one) for one in asked)] for name, r in named.items()]
    head = ["ns per point", "points", *(contender.label for contender in asked)]
    return table(head, rows, "lr" + "r" * len(asked))


def with_losses(record: Results, contender: Contender) -> str:
    """Time per point; how many distinct points are no vertex, where that is so."""
    own = record.get(contender.key)
    text = time_per_point(own, record["n"])
    ours = record["ours 1"].get("points")
    if not own or "stopped" in own or ours is None or contender.ours:
        return text
    if own["triangles"] == 0:
        return f"{text}, no triangles"
    lost = ours - own["points"]
    return f"{text}, loses {lost:,}" if lost > 0 else text


def changes(measured: Results) -> str:
    """Insertion, removal and queries in microseconds each."""
    n = measured["n"]
    told = {
        "insert, per point in batches of 1000": ("insert", "seconds", 1e3),
        "the same and read `simplices` and `neighbors` after each batch": ("changed", "seconds", 1e3),
        "remove, per point in batches of 1000": ("remove", "seconds", 1e3),
        "`find_simplex`, per query": ("find", "seconds", 1e6 / n),
        "`nearest`, per query": ("nearest", "seconds", 1e6 / n),
        "triangulate, per point": ("run", "seconds", 1e6 / n),
        "triangulate without `neighbors`, per point": ("bare", "seconds", 1e6 / n),
        "the first batch inserted, in all": ("insert", "first", 1e6),
        "the first batch removed, in all": ("remove", "first", 1e6),
        "peak bytes per point without `neighbors`": ("bare", "peak", 1 / n),
    }
    columns = [measured[f"{space} {workers}"] for space in CONTENDERS for workers in (1, 2)]

    def cell(record: Results, key: str, factor: float) -> str:
        return short_reason(record.get("stopped") or digits(factor * record[key]))

    rows = [[what, *(cell(column[word], key, by) for column in columns)] for what, (word, key, by) in told.items()]
    return table([f"µs, {power(n)} points", *COLUMNS], rows, "lrrrr")


def derived(measured: Results) -> str:
    """Nearest points, graphs, relaxation and contours in microseconds for each query or point."""
    words = {
        "nearest": "`nearest`, per query",
        "tree nearest": "SciPy, `cKDTree.query`",
        "k nearest": "`nearest` with `k=8`, per query",
        "tree k nearest": "SciPy, `cKDTree.query` with `k=8`",
        "gabriel": "`gabriel_graph`, per point",
        "urquhart": "`urquhart_graph`",
        "relative": "`relative_neighborhood_graph`",
        "spanning": "`minimum_spanning_tree`",
        "scipy spanning": "SciPy, `minimum_spanning_tree` of the edges and their lengths",
        "lloyd": "`lloyd`, one step",
        "contours": "`contours`, ten levels",
        "matplotlib contours": "Matplotlib, `tricontour`, the same levels",
    }
    n = measured["n"]
    rows = []
    for word, what in words.items():
        records = [measured[space].get(f"{word} {workers}") for space in CONTENDERS for workers in (1, 2)]
        rows.append([what, *(digits(1e6 * record["seconds"] / n) if record else "–" for record in records)])
    return table([f"µs, {power(n)} points", *COLUMNS], rows, "lrrrr")


def diagrams(measured: Results) -> str:
    """Seconds, ratios and memory of Voronoi diagrams."""
    labels = {
        "voronoi 1": "stereodel, one thread",
        "voronoi 2": "stereodel, two threads",
        "lists 2": "the same with regions as lists",
        "scipy": "SciPy, regions as lists",
    }

    def cells(record: Results, key: str) -> list[str]:
        ours, ratio = record[key], faster(record, "scipy", key) if key != "scipy" else ""
        peak = digits(ours["peak"] / 1e6) if "peak" in ours else ""
        return [ours.get("stopped") or digits(ours["seconds"]), ratio, peak]

    rows = [[label, *(c for record in measured.values() for c in cells(record, key))] for key, label in labels.items()]
    head = [word for n in measured for word in (f"{power(int(n))}: s", "times as fast as SciPy", "peak MB")]
    return table(["", *head], rows, "l" + "r" * len(head))


def conformal_maps(measured: Results) -> str:
    """Seconds of each call, and how they stand to copying or to PROJ."""
    calls = {
        "directions": {
            "copy": "`np.copy` of the vectors",
            "images 1": "`lens(xyz)`, one thread",
            "images 2": "`lens(xyz)`, two threads",
            "scales 1": "`lens.scale_factor(xyz)`, one thread",
            "scales 2": "`lens.scale_factor(xyz)`, two threads",
        },
        "places": {
            "pyproj": "pyproj, `lens.to_proj()`",
            "lonlat 1": "`lens.lonlat(lonlat)`, one thread",
            "lonlat 2": "`lens.lonlat(lonlat)`, two threads",
            "by vectors": "`lonlat_to_xyz`, `lens`, `xyz_to_lonlat`",
        },
    }
    rows = []
    for part, named in calls.items():
        for key, call in named.items():
            own = measured[part][key]
            middle = statistics.median(own["ratios"])
            ratio = f"{digits(middle)} × as long" if part == "directions" else f"{digits(1 / middle)} × as fast"
            rows.append([f"{measured[part]['n']:,}", call, digits(own["seconds"]), "" if middle == 1 else ratio])
    return table(["points", "call", "s", "median of the rounds"], rows, "rlrr")


def gmt(measured: Rows) -> str:
    """Seconds of both, and of interpolation the errors of both, in a table of their own."""
    rows = [{**row, "ratio": row["theirs"] / row["ours"]} for row in measured]
    known = [row for row in rows if "ours rms" in row]
    columns = [("points", "{n:,}"), ("GMT's command", "`{command}`")]
    times = [("GMT, s", "{theirs:.3g}"), ("here, s", "{ours:.3g}"), ("times as fast", "{ratio:.3g}")]
    named = [("GMT", "theirs"), ("here", "ours")]
    errors = [(f"{what} error, {who}", f"{{{whose} {what}:.1e}}") for what in ("rms", "max") for who, whose in named]
    parts = listed(rows, "rlrrr", *columns, *times), listed(known, "rlrrrr", *columns, *errors)
    return "\n\n".join(parts) if rows else "GMT is not installed."


def taking_part(results: Results) -> str:
    """Version, exactness and result of every engine."""
    rows = []
    for space in CONTENDERS:
        for one, records in taken(results, space).items():
            version = next((r["version"] for r in reversed(records) if r.get("version")), "–")
            rows.append([space, one.label, version, one.exact, one.delivers])
    return table(["", "engine", "version", "exact", "finished when its time stops"], rows)


def missing(results: Results) -> str:
    """Engines that could not be installed; benchmarks/.peers/missing.txt says why."""
    absent = {one.label for space in CONTENDERS for one in CONTENDERS[space] if one not in taken(results, space)}
    return f"Not installed: {', '.join(sorted(absent))}." if absent else "Everything could be installed."


def machine(results: Results) -> str:
    """Where and when."""
    rows = [{"name": name, **where} for name, where in results["machine"].items()]
    columns = [("experiment", "{name}"), ("date", "{date}"), ("processor", "{processor}")]
    columns += [("machine", "{cores} cores, {memory}"), ("system", "{system}"), ("Python", "{python}")]
    return listed(rows, "l" * 7, *columns, ("load at its end", "{load}"))


def plot_sizes(measured: Results) -> None:
    """docs/images/benchmarks_sizes.svg: time per point over the number of points."""
    with plot("benchmarks_sizes", 300, sharey=True) as axes:
        for axis, space in zip(axes, CONTENDERS, strict=True):
            for one in CONTENDERS[space]:
                known = {int(n): record[one.key] for n, record in measured[space].items() if one.key in record}
                done = [(n, 1e9 * record["seconds"] / n) for n, record in known.items() if "seconds" in record]
                width, size = (2.0, 3.5) if one.ours else (1.0, 2.2)
                look = {"color": one.color, "label": one.label, "zorder": 3 if one.ours else 2, "marker": "o"}
                if done:
                    axis.plot(*zip(*done, strict=True), **look, linewidth=width, markersize=size)
            axis.set_yscale("log")
            axis.yaxis.set_major_locator(FixedLocator([m * 10.0**k for k in range(1, 7) for m in (1, 2, 5)]))
            axis.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}".replace(",", "\u202f")))
            _finish(axis, space, "uniform points")
            axis.minorticks_off()
        axes[0].set_ylabel("nanoseconds per point")


def plot_distributions(measured: Results) -> None:
    """docs/images/benchmarks_distributions.svg: time per point for every distribution at 1e5 points."""
    with plot("benchmarks_distributions", 250) as axes:
        for axis, space in zip(axes, CONTENDERS, strict=True):
            named = {name: sized.get("100000", {}) for name, sized in measured[space].items()}
            for one in CONTENDERS[space]:
                places = [
                    (1e9 * record[one.key]["seconds"] / record["n"], place)
                    for place, record in enumerate(named.values())
                    if "seconds" in record.get(one.key, {})
                ]
                if places:
                    size = 26 if one.ours else 12
                    axis.scatter(*zip(*places, strict=True), s=size, color=one.color, label=one.label, zorder=3)
            axis.set_yticks(range(len(named)), list(named))
            axis.invert_yaxis()
            _finish(axis, space, "nanoseconds per point")


def _finish(axis: Axes, title: str, across: str) -> None:
    axis.set_title(title)
    axis.set_xscale("log")
    axis.set_xlabel(across)
    axis.legend(fontsize=6.8, ncols=2, loc="upper center", bbox_to_anchor=(0.45, -0.17), handletextpad=0.4)


# Everything else


def rasters(rows: Rows) -> Blocks:
    """Seconds on the wall and of processors, and decibels."""
    columns = [("", "{lens}"), ("", "{library}"), ("seconds", "{seconds:.2f}"), ("processor seconds", "{busy:.2f}")]
    columns += [(f"{channel}, dB", f"{{{channel}:.0f}}") for channel in ("rings", "squares", "clouds")]
    return {"times": listed(rows, "llrrrrr", *columns)}


def map_files(rows: Rows) -> Blocks:
    """A row for each format."""
    names = {"parquet": "GeoParquet", "fgb": "FlatGeobuf", "gpkg": "GeoPackage", "geojson": "GeoJSON"}
    rows = [{"name": names[row["format"]], "GB": row["peak"] / 1e9, **row} for row in rows]
    columns = [("", "{name}"), ("processor seconds", "{busy:.0f}"), ("memory, GB", "{GB:.1f}")]
    return {"cells": listed(rows, "lrr", *columns)}


def partitioned(results: Results) -> Blocks:
    """A row for each set of points."""
    rows = []
    for row in sorted(results["rows"], key=lambda each: (each["size"], each["sky"])):
        share = f"{100 * row['cpu_ratio']:.0f} %" if "cpu_ratio" in row else "–"
        rows.append({**row["partitions"], "points": spaced(row["size"]), "sky": row["sky"], "share": share})
        rows[-1]["beyond"] *= 100
    columns = [("points", "{points}"), ("sky", "{sky}"), ("seconds", "{wall:.0f}")]
    columns += [("processor: µs a point", "{cpu_us_a_point:.1f}"), ("of that in memory", "{share}")]
    columns += [("MB a worker", "{own_mb:.0f}"), ("scratch: bytes a point", "{scratch_a_point:.0f}")]
    return {"partitions": listed(rows, "rlrrrrrr", *columns, ("read beyond the own", "{beyond:.1f} %"))}


def web(results: Results) -> Blocks:
    """What is sent of the page, and how fast it is."""
    scenes = [{**row, "land": row["land"][:-1]} for row in results["scenes"]]
    columns = [("sites", "{sites}"), ("land", "1 : {land} million"), ("ms a frame", "{ms:.0f}")]
    dragged = results["drag"]
    words = [
        f"Ready {1000 * results['ready, seconds']:.0f} ms after it is opened from the disk.",
        f"A site that is dragged among {dragged['sites']} of the Sphere, all of them triangulated anew in every step: "
        f"{dragged['ms']:.0f} ms a frame.",
    ]
    sent = [("", "{what}"), ("kB", "{kB:.0f}"), ("packed by gzip", "{gzip kB:.0f}")]
    return {
        "sizes": listed(results["sizes"], "lrr", *sent),
        "frames": "\n\n".join([listed(scenes, "rlr", *columns), *words]),
    }


def web_kernel(found: Results) -> Blocks:
    """Milliseconds by the number of points, and ratios of the largest set."""
    heads = {
        "sphere: native": "native sphere",
        "web": "sphere",
        "cells: native": "native cells",
        "web ": "cells",
        "`geoDelaunay`: web": "d3, ours",
        "d3-geo-voronoi": "d3, theirs",
        "plane: native": "native plane",
        "web  ": "plane",
        "delaunator": "delaunator",
    }
    rows = [{**row, "size": spaced(row["size"])} for row in found["rows"]]
    columns = [("points", "{size}"), *((head.strip(), f"{{{key}:.3g}}") for head, key in heads.items())]
    ratios = [[name, f"{value:.1f}"] for name, value in found["ratios"].items()]
    return {
        "times": listed(rows, "r" * len(columns), *columns),
        "ratios": table([f"{rows[-1]['size']} points", "ratio"], ratios, "lr"),
    }


PAGES: dict[str, tuple[str, Callable[[Any], Blocks]]] = {
    "results": ("benchmarks.md", kernel),
    "rasters": ("rasters.md", rasters),
    "map_files": ("files.md", map_files),
    "partitioned": ("partitioned.md", partitioned),
    "web": ("web.md", web),
    "web_kernel": ("javascript.md", web_kernel),
}
"""The page that shows the results of a name, and what makes its blocks of them."""


if __name__ == "__main__":
    for name in sys.argv[1:] or PAGES:
        write(name)
