"""Kinds of sources, and what a caller's source is of: plain files of Parquet, or catalogues that say what they hold."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Any, Final

from stereodel._arrays import as_choice
from stereodel.io.formats.names import listed, spelled
from stereodel.partitioned.hats import hats_source, is_catalogue
from stereodel.partitioned.places import Surface
from stereodel.partitioned.sources import Given, PointFile, Source, opened, parquet_source
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

    Raises ValueError for columns to keep that are not there, have names that results have, or other types in other
    files; for a file that is there under two names.
    """
    chosen = as_choice(kind, ("auto", *KINDS), "kind")
    if chosen == "auto":
        chosen = "hats" if is_catalogue(given) else "parquet"
    found = KINDS[chosen](given, names_of(columns), surface, latitude)
    nodes: dict[tuple[int, int], PointFile] = {}
    for file in found.files:
        state = os.stat(file.path)
        other = nodes.setdefault((state.st_dev, state.st_ino), file)
        if other is not file:
            twice = f"a file twice, as {other.path} and {file.path}"
            raise ValueError(f"source names {twice}; its points would be duplicates of themselves")
    carried = tuple(dict.fromkeys(names_of(keep) or ()))
    first: Any = None
    for file in found.files if carried else ():
        schema = opened(file.path).schema_arrow
        first = first or schema
        for name in carried:
            if name not in schema.names:
                where = f"columns {listed(schema.names)} of {file.path}"
                raise ValueError(f"{spelled('keep')} has {name!r}, which is not one of the {where}")
            if schema.field(name).type != first.field(name).type:
                types = (
                    f"{first.field(name).type} in {found.files[0].path}, but {schema.field(name).type} in {file.path}"
                )
                raise ValueError(f"{spelled('keep')} has {name!r}, which is {types}; give it one type")
    for name in carried:
        if name in results:
            raise ValueError(f"column {name!r} cannot be kept: results have that name; rename it in the files")
    return replace(found, carried=carried)


def names_of(given: str | Sequence[str] | None) -> Sequence[str] | None:
    """Names of columns; one may be given by itself."""
    return (given,) if isinstance(given, str) else given
