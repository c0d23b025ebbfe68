"""The plots of docs/benchmarks.md."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

from benchmarks import pages
from benchmarks.engines import CONTENDERS, Contender
from benchmarks.experiments import SPACES

Results = dict[str, Any]
TITLES = {"plane": "plane", "sphere": "sphere"}


def sizes(results: Results) -> None:
    """docs/images/benchmarks_sizes.svg: time per point over the number of points."""
    with pages.plot("benchmarks_sizes", 300, 1, 2, sharey=True) as axes:
        for axis, space in zip(axes[0], SPACES, strict=True):
            for contender in CONTENDERS[space]:
                _curve(axis, results["sizes"][space], contender)
            axis.set_title(TITLES[space])
            _log_axes(axis)
            axis.set_xlabel("uniform points")
            _legend(axis)
        axes[0][0].set_ylabel("nanoseconds per point")


def _curve(axis: Axes, sized: Results, contender: Contender) -> None:
    done = [
        (int(n), 1e9 * r[contender.key]["seconds"] / int(n))
        for n, r in sized.items()
        if "seconds" in r.get(contender.key, {})
    ]
    if done:
        look = (
            {"linewidth": 2.0, "marker": "o", "markersize": 3.5}
            if contender.ours
            else {"linewidth": 1.0, "marker": "o", "markersize": 2.2}
        )
        axis.plot(
            *zip(*done, strict=True),
            color=contender.color,
            label=contender.label,
            zorder=3 if contender.ours else 2,
            **look,
        )


def _legend(axis: Axes) -> None:
    axis.legend(fontsize=6.8, ncols=2, loc="upper center", bbox_to_anchor=(0.45, -0.17), handletextpad=0.4)


def _log_axes(axis: Axes) -> None:
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.yaxis.set_major_locator(FixedLocator([m * 10.0**k for k in range(1, 7) for m in (1, 2, 5)]))
    axis.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}".replace(",", "\u202f")))
    axis.yaxis.set_minor_formatter(NullFormatter())
    axis.minorticks_off()


def distributions(results: Results) -> None:
    """docs/images/benchmarks_distributions.svg: time per point for every distribution at 1e5 points."""
    with pages.plot("benchmarks_distributions", 250, 1, 2) as axes:
        for axis, space in zip(axes[0], SPACES, strict=True):
            names = list(results["distributions"][space])
            for contender in CONTENDERS[space]:
                _dots(axis, results["distributions"][space], names, contender)
            axis.set_yticks(range(len(names)), names)
            axis.invert_yaxis()
            axis.set_xscale("log")
            axis.set_title(TITLES[space])
            axis.set_xlabel("nanoseconds per point")
            _legend(axis)


def _dots(axis: Axes, named: Results, names: list[str], contender: Contender) -> None:
    places = [
        (1e9 * record[contender.key]["seconds"] / record["n"], place)
        for place, name in enumerate(names)
        if (record := named[name].get("100000")) and "seconds" in record.get(contender.key, {})
    ]
    if places:
        size = 26 if contender.ours else 12
        axis.scatter(*zip(*places, strict=True), s=size, color=contender.color, label=contender.label, zorder=3)
