"""The tables of docs/benchmarks.md, from benchmarks/results.json.

python -m benchmarks.benchmark_page     (without measuring again)
"""

from __future__ import annotations

import json
import statistics
from typing import Any

from benchmarks import benchmark_plots, pages
from benchmarks.benchmark_asked import digits, faster, figures, power
from benchmarks.engines import CONTENDERS, PEERS, Contender
from benchmarks.experiments import RESULTS, SPACES

Results = dict[str, Any]
COLUMNS = [f"{space}, {threads}" for space in SPACES for threads in ("one thread", "two threads")]


def time_per_point(record: dict[str, Any] | None, n: int) -> str:
    """Nanoseconds per point, or what stopped the engine."""
    if record is None:
        return "–"
    return record.get("stopped") or digits(1e9 * record["seconds"] / n)


def short_reason(reason: str) -> str:
    """A reason that fits a cell: limits as they are, other words shortened."""
    text = reason.replace("|", "/").replace("<", "").replace(">", "")
    return text if len(text) <= 46 else text[:45] + "…"


def asked(results: Results) -> str:
    """Every figure with what was measured."""
    return pages.table(["figure", "asked", "measured, median (range)", "reached"], [f.row() for f in figures(results)])


def verdict(results: Results) -> str:
    """How many figures are reached, and which are not."""
    measured = [figure for figure in figures(results) if figure.values]
    missed = [figure for figure in measured if not figure.reached]
    text = f"{len(measured) - len(missed)} of {len(measured)} figures are reached."
    return text + (" Not reached: " + "; ".join(figure.what for figure in missed) + "." if missed else "")


def opening(results: Results) -> str:
    """The main numbers at 1e6 points: times of ours, and ratios to CGAL and SciPy on one thread."""
    n = 1_000_000
    records = {f"Delaunay triangulation, {space}": (results["sizes"][space][str(n)], "ours") for space in SPACES}
    if "voronoi" in results:
        records["Voronoi regions and areas, sphere"] = (results["voronoi"][str(n)], "voronoi")
    rows = []
    for what, (record, ours) in records.items():
        times = [time_per_point(record.get(f"{ours} {workers}"), n) for workers in (1, 2)]
        over = [faster(record, peer, f"{ours} 1") for peer in ("cgal", "scipy")]
        rows.append([what, *times, *(f"{digits(statistics.median(values))}×" if values else "–" for values in over)])
    head = [f"{power(n)} uniform points", "ns per point, one thread", "two threads"]
    return pages.table([*head, "times as fast as CGAL, one thread", "as SciPy"], rows, "lrrrr")


def sizes(results: Results, space: str) -> str:
    """Nanoseconds per point for every size, memory at 1e6."""
    sized = results["sizes"][space]
    rows = []
    for contender in CONTENDERS[space]:
        if contender.missing:
            continue
        cells = [short_reason(time_per_point(record.get(contender.key), int(n))) for n, record in sized.items()]
        rows.append([contender.label, *cells, memory(sized, contender)])
    head = ["ns per point", *(power(int(n)) for n in sized), "peak bytes per point at 10⁶"]
    return pages.table(head, rows, "l" + "r" * (len(head) - 1))


def memory(sized: Results, contender: Contender) -> str:
    """Growth of the peak per point at 1e6."""
    record = sized.get("1000000", {}).get(contender.key, {})
    return digits(record["peak"] / 1e6) if "peak" in record else "–"


def distributions(results: Results, space: str, n: str) -> str:
    """Nanoseconds per point and points lost, distribution by distribution."""
    rows = []
    for name, sized in results["distributions"][space].items():
        if record := sized.get(n):
            cells = [cell(record, contender) for contender in present(results, space, n)]
            rows.append([name, f"{record['n']:,}", *cells])
    head = ["ns per point", "points", *(contender.label for contender in present(results, space, n))]
    return pages.table(head, rows, "lr" + "r" * (len(head) - 2))


def present(results: Results, space: str, n: str) -> list[Contender]:
    """Those that were asked at this size."""
    records = [sized[n] for sized in results["distributions"][space].values() if n in sized]
    return [contender for contender in CONTENDERS[space] if any(contender.key in record for record in records)]


def cell(record: dict[str, Any], contender: Contender) -> str:
    """Time per point; how many distinct points are no vertex, where that is so."""
    own = record.get(contender.key)
    text = short_reason(time_per_point(own, record["n"]))
    ours = record["ours 1"].get("points")
    if not own or "stopped" in own or ours is None or contender.ours:
        return text
    if own["triangles"] == 0:
        return f"{text}, no triangles"
    lost = ours - own["points"]
    return f"{text}, loses {lost:,}" if lost > 0 else text


def changes(results: Results) -> str:
    """Insertion, removal and queries in microseconds each."""
    measured, n = results["changes"], results["changes"]["n"]
    words = {
        "insert": ("insert, per point in batches of 1000", 1000),
        "changed": ("the same and read `simplices` and `neighbors` after each batch", 1000),
        "remove": ("remove, per point in batches of 1000", 1000),
        "find": ("`find_simplex`, per query", n),
        "nearest": ("`nearest`, per query", n),
        "run": ("triangulate, per point", n),
        "bare": ("triangulate without `neighbors`, per point", n),
    }
    columns = [f"{space} {workers}" for space in SPACES for workers in (1, 2)]
    rows = []
    for word, (what, each) in words.items():
        records = [measured[column].get(word, {}) for column in columns]
        times = [digits(1e6 * r["seconds"] / each) if "seconds" in r else r.get("stopped", "–") for r in records]
        rows.append([what, *map(short_reason, times)])
    for word, what in (("insert", "the first batch inserted, in all"), ("remove", "the first batch removed, in all")):
        records = [measured[column].get(word, {}) for column in columns]
        rows.append([what, *(digits(1e6 * r["first"]) if "first" in r else "–" for r in records)])
    bare = [measured[column].get("bare", {}) for column in columns]
    rows.append(
        ["peak bytes per point without `neighbors`", *(digits(r["peak"] / n) if "peak" in r else "–" for r in bare)]
    )
    return pages.table([f"µs, {power(n)} points", *COLUMNS], rows, "lrrrr")


def derived(results: Results) -> str:
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
    measured = results["derived"]
    n = measured["n"]
    rows = []
    for word, what in words.items():
        records = [measured[space].get(f"{word} {workers}") for space in SPACES for workers in (1, 2)]
        rows.append([what, *(digits(1e6 * record["seconds"] / n) if record else "–" for record in records)])
    return pages.table([f"µs, {power(n)} points", *COLUMNS], rows, "lrrrr")


def diagrams(results: Results) -> str:
    """Seconds, ratios and memory of Voronoi diagrams."""
    rows = []
    labels = {
        "voronoi 1": "stereodel, one thread",
        "voronoi 2": "stereodel, two threads",
        "lists 2": "the same with regions as lists",
        "scipy": "SciPy, regions as lists",
    }
    for key, label in labels.items():
        cells = []
        for record in results["voronoi"].values():
            ours = record[key]
            over = faster(record, "scipy", key) if key != "scipy" else []
            cells.append(ours.get("stopped") or digits(ours["seconds"]))
            cells.append(f"{digits(statistics.median(over))}×" if over else "")
            cells.append(digits(ours["peak"] / 1e6) if "peak" in ours else "")
        rows.append([label, *cells])
    head = [""]
    for n in results["voronoi"]:
        head += [f"{power(int(n))}: s", "times as fast as SciPy", "peak MB"]
    return pages.table(head, rows, "l" + "r" * (len(head) - 1))


def conformal_maps(results: Results) -> str:
    """Seconds of each call, and how they stand to copying or to PROJ."""
    labels = {
        "directions": ("`np.copy` of the vectors", "copy", "images", "lens(xyz)", "scales", "lens.scale_factor(xyz)"),
        "places": ("pyproj, `lens.to_proj()`", "pyproj", "lonlat", "lens.lonlat(lonlat)"),
    }
    rows = []
    for part, (reference, key, *others) in labels.items():
        measured = results["conformal maps"][part]
        points = f"{measured['n']:,}"
        rows.append([points, reference, digits(measured[key]["seconds"]), ""])
        for word, call in zip(others[::2], others[1::2], strict=True):
            for workers in (1, 2):
                own = measured[f"{word} {workers}"]
                middle = statistics.median(own["ratios"])
                ratio = f"{digits(middle)} × as long" if part == "directions" else f"{digits(1 / middle)} × as fast"
                thread = "two threads" if workers == 2 else "one thread"
                rows.append([points, f"`{call}`, {thread}", digits(own["seconds"]), ratio])
    vectors = results["conformal maps"]["places"]["by vectors"]
    middle = f"{digits(1 / statistics.median(vectors['ratios']))} × as fast"
    rows.append(["", "`lonlat_to_xyz`, `lens`, `xyz_to_lonlat`", digits(vectors["seconds"]), middle])
    return pages.table(["points", "call", "s", "median of the rounds"], rows, "rlrr")


def taking_part(results: Results) -> str:
    """Version, exactness and result of every engine."""
    rows = []
    for space in SPACES:
        seen = {
            key: r["version"]
            for sized in results["sizes"][space].values()
            for key, r in sized.items()
            if r.get("version")
        }
        rows += [
            [space, c.label, seen.get(c.key, "–"), c.exact, c.delivers] for c in CONTENDERS[space] if c.missing is None
        ]
    return pages.table(["", "engine", "version", "exact", "finished when its time stops"], rows)


def missing() -> str:
    """What could not be installed, with the reason."""
    listed = PEERS / "missing.txt"
    lines = listed.read_text(encoding="utf-8").splitlines() if listed.exists() else []
    if not lines:
        return "Everything could be installed."
    return "Not installed: " + "; ".join("{} ({})".format(*line.split("\t", 1)) for line in lines) + "."


def machine(results: Results) -> str:
    """Where and when."""
    rows = [
        [name, m["date"], m["processor"], f"{m['cores']} cores, {m['memory']}", m["system"], m["python"], m["load"]]
        for name, m in results["machine"].items()
    ]
    head = ["experiment", "date", "processor", "machine", "system", "Python", "load at its end"]
    return pages.table(head, rows)


def write(results: Results) -> None:
    """The page's blocks and its plots, from whatever was measured."""
    blocks = {"verdict": verdict(results), "asked": asked(results), "missing": missing(), "machine": machine(results)}
    if "sizes" in results:
        benchmark_plots.sizes(results)
        blocks["opening"] = opening(results)
        pages.fill("../paper/paper.md", {"opening": blocks["opening"]})
        blocks |= {f"sizes {space}": sizes(results, space) for space in SPACES}
        blocks["engines"] = taking_part(results)
    if "distributions" in results:
        benchmark_plots.distributions(results)
        for space in SPACES:
            blocks |= {f"{space} {n}": distributions(results, space, n) for n in ("100000", "1000000")}
    if "changes" in results:
        blocks["changes"] = changes(results)
    if "derived" in results:
        blocks["derived"] = derived(results)
    if "voronoi" in results:
        blocks["voronoi"] = diagrams(results)
    if "conformal maps" in results:
        blocks["conformal maps"] = conformal_maps(results)
    pages.fill("benchmarks.md", blocks)


if __name__ == "__main__":
    write(json.loads(RESULTS.read_text(encoding="utf-8")))
