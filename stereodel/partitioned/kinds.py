"""Kinds of sources, and what a caller's source is of: plain files of Parquet, or catalogues that say what they hold."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Final

from stereodel._arrays import as_choice
from stereodel.io.columns import listed
from stereodel.partitioned.hats import hats_source, is_catalogue
from stereodel.partitioned.places import Surface
from stereodel.partitioned.sources import Given, Source, opened, parquet_source
from stereodel.sphere.latitudes import Latitude

KINDS: Final = {"parquet": parquet_source, "hats": hats_source}
"""What makes a source of what is given, of columns, surface and latitude, by the kind of files."""


def source_of(
    given: Given,
    kind: str,
    columns: Sequence[str] | None,
    surface: Surface,
    latitude: Latitude,
    keep: Sequence[str],
    results: Collection[str],
) -> Source:
    """The source that is given, of a kind or of the one that it looks like, with columns carried along beside results.

    Raises
    ------
    ValueError
        For columns to keep that are not there, or have names that results have.
    """
    chosen = as_choice(kind, ("auto", *KINDS), "kind")
    if chosen == "auto":
        chosen = "hats" if is_catalogue(given) else "parquet"
    found = KINDS[chosen](given, columns, surface, latitude)
    carried = tuple(dict.fromkeys([*found.carried, *keep]))
    there = opened(found.files[0].path).schema_arrow.names if found.files and carried else carried
    for name in carried:
        if name not in there:
            raise ValueError(f"keep has {name!r}, which is not one of the columns {listed(list(there))}")
        if name in results:
            raise ValueError(f"column {name!r} cannot be kept: results have that name; rename it in the files")
    return replace(found, carried=carried)
