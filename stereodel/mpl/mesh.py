"""Cells of a grid of longitude and latitude as paths on the page."""

from __future__ import annotations

import numpy as np
from matplotlib.path import Path

from stereodel._arrays import FloatArray
from stereodel.curves.ragged import Ragged
from stereodel.mpl.transforms import NOTHING, LonLatToPage, compounds


def mesh_paths(corners: FloatArray, globe: LonLatToPage) -> list[Path]:
    """A path for each cell of a grid with corners (rows + 1, columns + 1, 2) in degrees, row by row; empty if hidden.

    Cells beyond a pole, as around values on the pole itself, end there.
    """
    kept = np.clip(corners, [-np.inf, -90.0], [np.inf, 90.0])
    a, b, c, d = kept[:-1, :-1], kept[:-1, 1:], kept[1:, 1:], kept[1:, :-1]
    cells = np.stack([a, b, c, d, a], axis=2).reshape(-1, 5, 2)
    page = globe.transform_non_affine(cells.reshape(-1, 2)).reshape(-1, 5, 2)
    # In space and on the page a side of length L deviates from its chord by about L²/8, for circles of radius up to 1.
    sides = np.sqrt(np.sum(np.diff(page, axis=1) ** 2, axis=2)).max(axis=1)
    small = sides < np.sqrt(8 * globe.tolerance / globe.view.stretch)
    paths = [Path(outline, closed=True) if whole else NOTHING for outline, whole in zip(page, small, strict=True)]
    large = np.flatnonzero(~small)
    rings = Ragged(cells[large].reshape(-1, 2), 5 * np.arange(len(large) + 1))
    loops, cell = globe.regions(rings, np.arange(len(large)), len(large))
    order = np.argsort(cell, kind="stable")
    for number, path in zip(
        large.tolist(), compounds(loops.take(order), cell[order], len(large), closed=True), strict=True
    ):
        paths[number] = path
    return paths
