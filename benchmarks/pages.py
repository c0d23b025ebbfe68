"""Writing measured numbers into the documentation: tables between markers of a page, plots in the figures' style."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from stereodel._files import replacing
from stereodel.drawing.page.style import DARK_GRAY, LIGHT_GRAY, PRINT_WIDTH, TYPE

DOCS = Path(__file__).resolve().parent.parent / "docs"


def table(head: Sequence[str], rows: Sequence[Sequence[str]], align: str = "") -> str:
    """A Markdown table; `align` has one of l, r, c for each column."""
    rules = {"l": ":--", "r": "--:", "c": ":-:"}
    lines = [head, [rules[a] for a in align or "l" * len(head)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def fill(page: str, blocks: dict[str, str]) -> None:
    """Put each block between its markers `<!-- measured: name -->` and `<!-- end -->` of a page of docs/.

    Raises
    ------
    ValueError
        When the page lacks the markers.
    """
    path = DOCS / page
    text = path.read_text(encoding="utf-8")
    for name, block in blocks.items():
        marked = re.compile(rf"(<!-- measured: {re.escape(name)} -->\n).*?(<!-- end -->)", re.DOTALL)
        if not marked.search(text):
            raise ValueError(f"{page} has no place for {name!r}")
        text = marked.sub(lambda found, block=block: f"{found[1]}\n{block}\n\n{found[2]}", text)
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


@contextmanager
def plot(name: str, height: float, rows: int, columns: int, **options: object) -> Iterator[Sequence[Sequence[object]]]:
    """Axes of a plot as wide as a figure and `height` points high, saved as docs/images/<name>.svg at the end."""
    look = {
        "axes.edgecolor": DARK_GRAY,
        "axes.linewidth": 0.6,
        "axes.labelsize": 8,
        "axes.titlesize": 9,
        "xtick.labelsize": 7.5,
        "ytick.labelsize": 7.5,
        "legend.fontsize": 8,
        "legend.frameon": False,
        "grid.color": LIGHT_GRAY,
        "grid.linewidth": 0.3,
        "xtick.major.width": 0.5,
        "ytick.major.width": 0.5,
        "xtick.minor.width": 0.3,
        "ytick.minor.width": 0.3,
    }
    with mpl.rc_context({**TYPE, **look}):
        figure = Figure(figsize=(PRINT_WIDTH / 72, height / 72), layout="constrained")
        axes = figure.subplots(rows, columns, squeeze=False, **options)
        for axis in axes.flat:
            axis.grid(True)
            axis.spines[["top", "right"]].set_visible(False)
        yield axes
        with replacing(DOCS / "images" / f"{name}.svg") as temporary:
            figure.savefig(temporary, format="svg", metadata={"Date": None, "Creator": None}, facecolor="white")
