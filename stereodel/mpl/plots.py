"""Plotting methods that a globe overrides: contours, meshes, hexagons, arrows, images."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.image import AxesImage
from matplotlib.path import Path
from matplotlib.quiver import Barbs, Quiver
from matplotlib.transforms import Transform

from stereodel._arrays import FloatArray
from stereodel.constants import DIRECTION_STEP
from stereodel.curves.ragged import Ragged
from stereodel.mpl.transforms import NOTHING, LonLatToPage, compounds


class GlobePlots(Axes):
    """Axes with data in longitude and latitude, and limits in page coordinates."""

    transGlobe: LonLatToPage  # noqa: N815 (matplotlib's way to name transforms)
    """Degrees to the unit disc."""
    transPage: Transform  # noqa: N815
    """The unit disc to pixels."""

    def contour(self, *args: Any, **kwargs: Any) -> Any:
        """Contour lines, as in matplotlib; closed ones are lines, not regions, and are cut at the edge of the view."""
        return _with_open_lines(super().contour(*args, **kwargs))

    def tricontour(self, *args: Any, **kwargs: Any) -> Any:
        """Contour lines of scattered points, as in matplotlib, cut at the edge of the view."""
        return _with_open_lines(super().tricontour(*args, **kwargs))

    def pcolormesh(self, *args: Any, **kwargs: Any) -> PathCollection:  # type: ignore[override]
        """Cells of a grid of longitude and latitude, as in matplotlib, except that `shading` cannot be "gouraud".

        Returns a PathCollection with the values as its array, cut at the edge of the view.
        """
        mesh = super().pcolormesh(*args, **kwargs)
        paths = _mesh_paths(np.asarray(mesh.get_coordinates()), self.transGlobe)
        return self._instead(mesh, paths, self.transPage, kwargs)

    def hexbin(self, *args: Any, **kwargs: Any) -> PathCollection:  # type: ignore[override]
        """Hexagonal bins on the map of longitude and latitude, as in matplotlib; returns a PathCollection."""
        cells = super().hexbin(*args, **kwargs)
        outline, middles = np.asarray(cells.get_paths()[0].vertices), np.asarray(cells.get_offsets())
        corners = np.clip(middles[:, None] + outline, [-np.inf, -90.0], [np.inf, 90.0])
        return self._instead(cells, [Path(cell, closed=True) for cell in corners], self.transData, kwargs)

    def _instead(self, old: Any, paths: list[Path], transform: Transform, given: dict[str, Any]) -> PathCollection:
        """Replace a collection by paths with its colours."""
        old.remove()
        style = {"norm": old.norm, "cmap": old.cmap, "alpha": old.get_alpha(), "zorder": old.get_zorder()}
        cells = self._collection(paths, transform, style)
        cells.set_array(np.ma.ravel(np.ma.asarray(old.get_array())))
        edges = given.get("edgecolors", given.get("edgecolor"))
        drawn = edges not in (None, "none", "face")
        cells.set(edgecolor=edges if drawn else "face", linewidth=old.get_linewidth() if drawn else 0.0)
        cells.set(antialiased=drawn, rasterized=old.get_rasterized(), label=old.get_label())
        self._sci(cells)
        return cells

    def _collection(self, paths: list[Path], transform: Transform, style: dict[str, Any]) -> PathCollection:
        collection = PathCollection(paths, transform=transform, **style)
        self.add_collection(collection, autolim=False)
        return collection

    def quiver(self, *args: Any, **kwargs: Any) -> Quiver:
        """Arrows at points in degrees, ``quiver(lon, lat, east, north)``, with components to the east and north."""
        return super().quiver(*self._turned(args), **kwargs)

    def barbs(self, *args: Any, **kwargs: Any) -> Barbs:
        """Wind barbs at points in degrees, ``barbs(lon, lat, east, north)``, with components to the east and north."""
        return super().barbs(*self._turned(args), **kwargs)

    def _turned(self, args: tuple[Any, ...]) -> tuple[Any, ...]:
        """Positions and components of vectors, the latter along the axes of the page with unchanged lengths."""
        if len(args) < 4:
            raise TypeError("give the positions of the vectors, in degrees, first: lon, lat, east, north")
        lon, lat, east, north = np.broadcast_arrays(*(np.ma.filled(np.ma.asarray(a, float), np.nan) for a in args[:4]))
        # Images on the page of steps of equal length on the sphere, along the meridian and along the parallel, on which
        # a degree is shorter. Toward the limb, the orthographic view shortens them differently in the two directions.
        toward_north = _page_step(self.transGlobe, lon, lat, np.array([0.0, DIRECTION_STEP]))
        with np.errstate(divide="ignore"):
            along = DIRECTION_STEP / np.cos(np.radians(lat))
        toward_east = _page_step(self.transGlobe, lon, lat, np.stack([along, np.zeros_like(along)], axis=-1))
        vector = east[..., None] * toward_east + north[..., None] * toward_north
        # The direction on the page with the given length; hidden vectors remain NaN.
        size = np.hypot(vector[..., 0], vector[..., 1])
        scale = np.hypot(east, north) / np.where(size > 0, size, 1.0)
        return (lon, lat, scale * vector[..., 0], scale * vector[..., 1], *args[4:])

    def imshow(self, *args: Any, **kwargs: Any) -> AxesImage:
        """Images in page coordinates, with ``transform=axes.transPage``; ValueError without it.

        For an image in degrees use `pcolormesh`, or `stereodel.globe.Raster`, whose `warp` returns such an image.
        """
        if kwargs.get("transform") is not self.transPage:
            raise ValueError(
                "imshow cannot warp an image: use pcolormesh, or show stereodel.globe.Raster(picture).warp(…) "
                "with extent=(-1, 1, -1, 1), transform=axes.transPage"
            )
        return super().imshow(*args, **kwargs)


def _mesh_paths(corners: FloatArray, globe: LonLatToPage) -> list[Path]:
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
    found = compounds(loops.take(order), cell[order], len(large), closed=True)
    for number, path in zip(large.tolist(), found, strict=True):
        paths[number] = path
    return paths


def _page_step(globe: LonLatToPage, lon: FloatArray, lat: FloatArray, step: FloatArray) -> FloatArray:
    """The image on the page of a small step in degrees, (..., 2)."""
    places = np.stack([lon, lat], axis=-1)
    # Away from the pole, as there is nothing beyond it.
    side = np.where(lat > 0, -1.0, 1.0)[..., None]
    there, here = (globe.transform(lonlat.reshape(-1, 2)) for lonlat in (places + side * step, places))
    return side * (there - here).reshape(places.shape)


def _with_open_lines(contours: Any) -> Any:
    contours.set_paths([_opened(path) for path in contours.get_paths()])
    return contours


def _opened(path: Path) -> Path:
    """The path with explicit lines in place of closing commands."""
    if path.codes is None:
        return path
    codes, points = np.array(path.codes), np.array(path.vertices)
    begins = np.flatnonzero(codes == Path.MOVETO)
    closing = np.flatnonzero(codes == Path.CLOSEPOLY)
    points[closing] = points[begins[np.searchsorted(begins, closing) - 1]]
    codes[closing] = Path.LINETO
    return Path(points, codes)
