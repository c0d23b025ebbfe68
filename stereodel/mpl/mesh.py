"""Cells of a grid of longitude and latitude as paths on the page."""

from __future__ import annotations

import numpy as np
from matplotlib.path import Path

from stereodel._arrays import BoolArray, FloatArray
from stereodel.mpl.great_paths import Indices, Lines, chains_of
from stereodel.mpl.transforms import LonLatToPage
from stereodel.sphere import lonlat_to_xyz

NOTHING = Path(np.zeros((0, 2)))


def mesh_paths(corners: FloatArray, globe: LonLatToPage) -> list[Path]:
    """A path for each cell of a grid with corners (rows + 1, columns + 1, 2) in degrees, row by row; empty if hidden.

    Cells beyond a pole, as around values on the pole itself, end there.
    """
    kept = np.clip(corners, [-np.inf, -90.0], [np.inf, 90.0])
    a, b, c, d = kept[:-1, :-1], kept[:-1, 1:], kept[1:, 1:], kept[1:, :-1]
    cells = np.stack([a, b, c, d, a], axis=2).reshape(-1, 5, 2)
    page = globe.transform_non_affine(cells.reshape(-1, 2)).reshape(-1, 5, 2)
    # In space and on the page a side of length L strays from its chord by about L²/8: circles have radii up to 1.
    sides = np.sqrt(np.sum(np.diff(page, axis=1) ** 2, axis=2)).max(axis=1)
    small = sides < np.sqrt(8 * globe.tolerance / globe.view.stretch)
    paths = [Path(outline, closed=True) if whole else NOTHING for outline, whole in zip(page, small, strict=True)]
    large = np.flatnonzero(~small)
    outlines, others = _whole_outlines(cells[large], globe)
    for number, outline in outlines.items():
        paths[large[number]] = Path(outline, closed=True)
    for number in others.tolist():
        paths[large[number]] = globe.transform_path_non_affine(Path(cells[large[number]], closed=True))
    return paths


def _whole_outlines(cells: FloatArray, globe: LonLatToPage) -> tuple[dict[int, FloatArray], Indices]:
    """The outlines of the cells that are seen whole, and the cells that are seen in part."""
    count = len(cells)
    lines = Lines(lonlat_to_xyz(cells.reshape(-1, 2)), np.arange(0, 5 * count + 1, 5))
    chains = chains_of(lines, globe.lens, globe.view, globe.tolerance)
    outlines = {
        int(ring): piece for ring, piece, whole in zip(chains.ring, chains.split(), chains.whole, strict=True) if whole
    }
    partial = np.unique(chains.ring[~chains.whole])
    middle = globe.inverted().transform((0.0, 0.0))
    # A cell whose border is hidden covers the whole view or nothing of it.
    unseen = np.setdiff1d(np.flatnonzero(_surrounds(cells, middle)), chains.ring)
    return outlines, np.union1d(partial, unseen)


def _surrounds(cells: FloatArray, place: FloatArray) -> BoolArray:
    """Whether a place is within the bounds in longitude and latitude of cells (k, 5, 2)."""
    low, high = cells.min(axis=1), cells.max(axis=1)
    lon = low[:, 0] + np.mod(place[0] - low[:, 0], 360.0)
    within: BoolArray = (lon <= high[:, 0]) & (low[:, 1] <= place[1]) & (place[1] <= high[:, 1])
    return within
