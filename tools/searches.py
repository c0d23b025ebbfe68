"""Check that a search in the built documentation finds the page that a reader looks for, by its words.

python tools/searches.py docs/_build/html
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

BEST = 3
"""Of the pages found, the one that is looked for must be among so many with the best score."""
TITLE, TEXT = 15, 5
"""What a word counts in a title and in the text, as in Sphinx's own searchtools.js."""

SEARCHES = {
    "install": "start",
    "griddata": "interpolation",
    "xarray": "interpolation",
    "dask": "interpolation",
    "healpix": "interpolation",
    "kriging": "finding",
    "alpha shape": "graphs",
    "concave hull": "graphs",
    "GeoTIFF": "files",
    "NetCDF": "files",
    "shapefile": "files",
    "geopandas": "files",
    "antimeridian": "files",
    "dateline": "files",
    "date line": "files",
    "WGS84": "earth",
    "Thiessen": "finding",
    "matplotlib": "map_libraries",
    "cartopy": "map_libraries",
    "scipy": "spatial",
}
"""What readers type, and the page that answers."""


def pages_found(index: dict[str, Any], query: str, stem: Callable[[str], str]) -> list[str]:
    """Pages with all words of a query, the best first; what is generated from docstrings and scripts is left out.

    `stem` takes the ending off a word, as the words of the index have none.
    """
    scores = [_scores(index, stem(word)) for word in query.lower().split()]
    shared = set.intersection(*(set(score) for score in scores))
    total = {index["docnames"][page]: max(score[page] for score in scores) for page in shared}
    return sorted((name for name in total if "/" not in name), key=lambda name: (-total[name], name))


def _scores(index: dict[str, Any], word: str) -> Counter[int]:
    """The pages that have a word, by number, with what it counts there."""
    scores: Counter[int] = Counter()
    for kind, worth in (("titleterms", TITLE), ("terms", TEXT)):
        found = index[kind].get(word, [])
        scores.update(dict.fromkeys([found] if isinstance(found, int) else found, worth))
    return scores


def missed(index: dict[str, Any], stem: Callable[[str], str]) -> list[str]:
    """The searches that do not find their page, each as a sentence."""
    found = {query: pages_found(index, query, stem) for query in SEARCHES}
    return [
        f"a search for {query!r} finds {found[query] or 'nothing'}, but should find {page!r}"
        for query, page in SEARCHES.items()
        if page not in found[query][:BEST]
    ]


def main(folder: str) -> int:
    """Report and return the exit code."""
    from sphinx.search.en import SearchEnglish

    text = Path(folder, "searchindex.js").read_text(encoding="utf-8").strip()
    index = json.loads(text.removeprefix("Search.setIndex(").rstrip(";").removesuffix(")"))
    problems = missed(index, SearchEnglish({}).stem)
    print(f"{len(SEARCHES)} searches tried")
    print(*problems, sep="\n", end="\n" if problems else "", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
