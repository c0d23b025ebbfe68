"""Cells: the Voronoi cells of a partition's points as polygons, in files of GeoParquet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from stereodel._files import replacing
from stereodel.curves.borders import frame_of
from stereodel.io.formats.map_rows import MapRows
from stereodel.io.formats.parquet import write_parquet
from stereodel.io.rows_of import rows_of
from stereodel.partitioned.index import Index
from stereodel.partitioned.places import Places
from stereodel.partitioned.rounds import Round
from stereodel.partitioned.store import Store
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi


def cells_of(stars: Round, index: Index, places: Places) -> MapRows:
    """The cells of points whose stars are final, with the ``point`` that each is of and its ``area``.

    On the sphere they are cut at ±180° and led around the poles, as by `stereodel.io.to_geodataframe`; in the plane
    they are cut to the rectangle of all points with a tenth of its longer side around it.
    """
    # In the order of numbers the cells of several partitions have bitwise the same corners.
    order = np.argsort(stars.numbers)
    points, numbers = stars.mesh.points[order], stars.numbers[order]
    if points.shape[1] == 2:
        top = slice(index.levels[-2], index.levels[-1])
        frame = frame_of(np.stack([index.lows[top].min(axis=0), index.highs[top].max(axis=0)]))
        diagram = PlanarVoronoi(PlanarDelaunay(points, workers=1))
        whole = rows_of(diagram, bounds=(frame.left, frame.bottom, frame.right, frame.top))
    else:
        whole = rows_of(SphericalVoronoi(SphericalDelaunay(points, workers=1)), latitude=places.latitude)
    own = whole.take(stars.final[order][whole.columns["point"]])
    return replace(own, columns={**own.columns, "point": numbers[own.columns["point"]]})


def write_cells(store: Store, part: int, layers: Sequence[MapRows]) -> tuple[int, Path]:
    """The file of a partition, in the order of the points' numbers; how many cells it has, and where it is."""
    names = ("point", "area")
    columns = {name: np.concatenate([layer.columns[name] for layer in layers]) for name in names}
    binary = np.concatenate([layer.binary for layer in layers])
    whole = MapRows(columns, binary, layers[0].crs).take(np.argsort(columns["point"]))
    path = store.room("cells") / f"{part}.parquet"
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        write_parquet(whole, temporary, metadata=store.plan.metadata)
    return len(whole), path
