"""Globes as axes of matplotlib.

Data are longitude and latitude in degrees. Vertices of a line or polygon are joined by the shorter great-circle arc,
so nothing needs to be cut at ±180° or at a pole; with ``edges="straight"`` edges are straight on the map of
longitude and latitude, as in GeoJSON and cartopy's PlateCarree. ``transform=ax.transGreatCircle`` and
``transform=ax.transStraight`` select the kind of edges for one artist.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.axis import XAxis, YAxis
from matplotlib.cbook import normalize_kwargs
from matplotlib.collections import PathCollection
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from matplotlib.projections import register_projection
from matplotlib.spines import Spine
from matplotlib.transforms import Bbox, Transform

from stereodel import data
from stereodel._arrays import FloatArray, as_choice, as_edges, as_lonlat
from stereodel.conformal import MoebiusMap, fisheye
from stereodel.constants import PAGE_TOLERANCE
from stereodel.curves.ragged import Ragged
from stereodel.curves.view import MapView, View
from stereodel.drawing.page.style import LINES, LineStyle
from stereodel.mpl.plots import GlobePlots
from stereodel.mpl.transforms import EDGES, Edges, LonLatToPage, compound, paths_of
from stereodel.sphere import SphereArc, graticule, xyz_to_lonlat

__all__ = ["FisheyeAxes"]

LAND = "0.86"
"""Gray of the land, against which coasts, borders and the graticule are visible."""

CIRCLE = Path.unit_circle()
POLYGON = Path.unit_regular_polygon(2000)
"""A polygon within 1.3e-6 of the unit circle, used where the limits cut the circle."""


class _Shown:
    """A patch of the part of the view's disc within the limits, in axes coordinates, computed anew when they change."""

    def __init__(self, globe: Axes, *args: Any) -> None:
        self._globe, self._limits, self._within = globe, (), CIRCLE
        super().__init__(*args)

    def get_path(self) -> Path:
        """The path in axes coordinates."""
        left, bottom, right, top = limits = tuple(np.asarray(self._globe.viewLim.extents).tolist())
        if limits != self._limits:
            corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)])
            if max(left, bottom) <= -1 and min(right, top) >= 1:
                within = CIRCLE
            elif (np.sum(corners**2, axis=1) <= 1).all():
                within = Path(corners, closed=True)
            else:
                within = POLYGON.clip_to_bbox(Bbox.from_extents(*limits), inside=True)
            self._limits, self._within = limits, self._globe.transLimits.transform_path(within)
        return self._within


class _Disc(_Shown, Patch):
    """The background patch, to which artists are clipped."""


class _Limb(_Shown, Spine):
    """The outline of the visible part."""


class FisheyeAxes(GlobePlots):
    """A globe, or a flat stereographic map, seen through a conformal map.

    Create it with ``plt.subplot(projection=FisheyeAxes, focus=…, magnification=…)``, with `add_subplot` or `add_axes`
    of a figure, or with the ``subplot_kw`` of ``plt.subplots``. The limits of the axes are in units of the radius of
    the disc that the whole view fills: ``set_xlim(-0.5, 0.5)`` zooms, and so do `zoom_to` and the toolbar. Hidden parts
    are not drawn: lines end at the edge of the view, and filled regions follow it.

    Parameters
    ----------
    focus : array_like, shape (2,) or (3,), optional
        Focus of the fisheye, (lon, lat) in degrees or a direction; by default (0, 0).
    magnification : float, optional
        S > 0; by default 1, which magnifies nothing.
    lens : MoebiusMap, optional
        Any conformal map, instead of `focus` and `magnification`.
    view : (lon, lat), View or StereographicView, optional
        Centre of the view, after the lens; by default the image of the focus.
    edges : {"great circle", "straight"}
        How vertices are joined: by the shorter great-circle arc, or straight on the map of longitude and latitude.

    Raises
    ------
    ValueError
        If the focus, magnification, view or kind of edges is invalid, or a lens and a magnification are both given.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> axes = Figure().add_subplot(projection=FisheyeAxes, focus=(2.35, 48.86), magnification=20)
    >>> coast, grid = axes.coastlines(), axes.graticule(10)
    >>> places = [(2.35, 48.86), (-0.13, 51.51), (174.8, -41.3)]
    >>> print(axes.transGlobe.transform(places).round(3) + 0.0)
    [[ 0.     0.   ]
     [-0.418  0.724]
     [   nan    nan]]
    """

    name = "stereodel.fisheye"
    """Name under which `register` registers the projection."""

    transGreatCircle: Transform  # noqa: N815 (matplotlib's way to name transforms)
    """Degrees to pixels, with great circles between vertices."""
    transStraight: Transform  # noqa: N815
    """Degrees to pixels, with edges straight on the map of longitude and latitude between vertices."""

    def __init__(
        self,
        *args: Any,
        focus: npt.ArrayLike | None = None,
        magnification: float | None = None,
        lens: MoebiusMap | None = None,
        view: MapView | Sequence[float] | None = None,
        edges: Edges = "great circle",
        **kwargs: Any,
    ) -> None:
        if lens is not None and not (focus is None and magnification is None):
            raise ValueError("lens was given together with focus or magnification; give one or the other")
        place = (0.0, 0.0) if focus is None else focus
        self._lens = lens or fisheye(place, magnification=1.0 if magnification is None else magnification)
        center = xyz_to_lonlat(self._lens(self._lens.focus)) if view is None else view
        self._view = View(*as_lonlat(center, "view").tolist()) if isinstance(center, Sequence | np.ndarray) else center
        self._edges = as_choice(edges, EDGES, "edges")
        self._graticule: PathPatch | None = None
        super().__init__(*args, **kwargs)

    # Interface of projections in matplotlib.

    @classmethod
    def _as_mpl_axes(cls) -> tuple[type[FisheyeAxes], dict[str, Any]]:
        """Make the class itself usable as a projection."""
        return cls, {}

    def _init_axis(self) -> None:
        self.xaxis = XAxis(self, clear=False)
        self.yaxis = YAxis(self, clear=False)

    def _set_lim_and_transforms(self) -> None:
        super()._set_lim_and_transforms()  # type: ignore[misc]
        kinds = {kind: LonLatToPage(self._lens, self._view, kind) for kind in EDGES}
        self.transPage = self.transLimits + self.transAxes
        self.transGlobe = kinds[self._edges]
        self.transGreatCircle, self.transStraight = (kinds[kind] + self.transPage for kind in EDGES)
        self.transData = self.transGreatCircle if self._edges == "great circle" else self.transStraight
        self._globes = tuple(kinds.values())

    def get_xaxis_transform(self, which: str = "grid") -> Transform:
        """Across by the limits, up by the height of the axes; there are no ticks, but `axvline` uses it."""
        return self._xaxis_transform  # type: ignore[attr-defined]

    def get_yaxis_transform(self, which: str = "grid") -> Transform:
        """Up by the limits, across by the width of the axes."""
        return self._yaxis_transform  # type: ignore[attr-defined]

    def _gen_axes_patch(self) -> Patch:
        return _Disc(self)

    def _gen_axes_spines(self) -> dict[str, Spine]:
        limb = _Limb(self, self, "circle", CIRCLE)
        limb.set(transform=self.transAxes, capstyle="round", joinstyle="round")
        return {"limb": limb}

    def clear(self) -> None:
        """Clear the axes and show the whole view, with a graticule only if matplotlib's setting ``axes.grid`` is on."""
        self._graticule = None
        super().clear()
        self.set_autoscale_on(False)
        for axis in (self.xaxis, self.yaxis):
            axis.set_visible(False)
        Axes.set_aspect(self, 1.0)
        self.set_global()
        self.grid(mpl.rcParams["axes.grid"])

    def autoscale_view(self, *args: Any, **kwargs: Any) -> None:
        """Do nothing: the limits show the whole globe until you change them."""

    def set_aspect(self, *args: Any, **kwargs: Any) -> None:
        """Do nothing: a globe is round. GeoPandas calls this for maps of longitude and latitude."""

    def draw(self, renderer: Any) -> None:
        """Draw, with lines resampled as finely as the zoom requires."""
        width = abs(self.viewLim.width)
        # In powers of two, so that small changes of the limits do not recompute all paths.
        finer = min(1.0, 2.0 ** float(np.floor(np.log2(width / 2))))
        for globe in self._globes:
            globe.tolerance = PAGE_TOLERANCE * finer
        super().draw(renderer)

    def format_coord(self, x: float, y: float) -> str:
        """The position under the pointer, such as "48.8600° N, 2.3500° E"; empty outside the globe."""
        if not np.isfinite([x, y]).all():
            return ""
        return f"{abs(y):.4f}° {'N' if y >= 0 else 'S'}, {abs(x):.4f}° {'E' if x >= 0 else 'W'}"

    @contextmanager
    def _limits_as_data(self) -> Iterator[None]:
        """A context in which matplotlib's zoom and pan treat page coordinates, the units of the limits, as data."""
        data, self.transData = self.transData, self.transPage
        try:
            yield
        finally:
            self.transData = data

    def _set_view_from_bbox(self, *args: Any, **kwargs: Any) -> None:
        with self._limits_as_data():
            super()._set_view_from_bbox(*args, **kwargs)  # type: ignore[misc]

    def start_pan(self, x: float, y: float, button: Any) -> None:
        """Start to pan with the pointer."""
        with self._limits_as_data():
            super().start_pan(x, y, button)

    # Extent and content.

    def set_global(self) -> None:
        """Show the whole disc of the view."""
        self.set_xlim(-1.0, 1.0)
        self.set_ylim(-1.0, 1.0)

    def zoom_to(self, bounds: npt.ArrayLike) -> None:
        """Zoom to the visible part of a box of longitude and latitude.

        Parameters
        ----------
        bounds : (west, south, east, north)
            Degrees, as in ``geometry.bounds`` and ``frame.total_bounds``; across ±180° with an east above 180 or a west
            below −180.

        Raises
        ------
        ValueError
            If the bounds are not a box, or no part of it is visible.

        Examples
        --------
        >>> from matplotlib.figure import Figure
        >>> axes = Figure().add_subplot(projection=FisheyeAxes, focus=(0, 0))
        >>> axes.zoom_to((-30, -30, 30, 30))
        >>> [round(float(x), 3) for x in axes.get_xlim()]
        [-0.5, 0.5]
        """
        west, south, east, north = as_edges(bounds, "bounds")
        # In thirds: an edge across more than half of the map would be taken the other way around.
        lon = np.linspace(west, east, 4)
        south_side, north_side = (np.stack([lon, np.full(4, lat)], axis=1) for lat in (south, north))
        corners = np.concatenate([south_side, north_side[::-1], south_side[:1]])
        border = self._globes[1].transform_path_non_affine(Path(corners, closed=True))
        if not np.size(border.vertices):
            raise ValueError(
                f"bounds {(west, south, east, north)} are not visible; choose a view above them: view=(lon, lat)"
            )
        box = border.get_extents()
        self.set_xlim(box.x0, box.x1)
        self.set_ylim(box.y0, box.y1)

    def grid(self, visible: bool | None = None, which: str = "major", axis: str = "both", **kwargs: Any) -> None:
        """Show or hide the graticule; `kwargs` are those of `graticule`. `which` and `axis` are ignored."""
        if getattr(self, "patch", None) is None:
            return  # matplotlib calls this while it creates the axes; `clear` calls it again
        shown = self._graticule is not None
        if self._graticule is not None:
            self._graticule.remove()
            self._graticule = None
        if visible or kwargs or (visible is None and not shown):
            self.graticule(**kwargs)

    def graticule(self, spacing: float = 15.0, **kwargs: Any) -> PathPatch:
        """Draw meridians from pole to pole and parallels, every `spacing` degrees; 180 must be a multiple of it.

        Returns the artist; `kwargs` are those of `matplotlib.patches.PathPatch`.
        """
        path = compound(Ragged.of([_in_degrees(arc) for arc in graticule(spacing)]), closed=False)
        self._graticule = self._lines(path, LINES["graticule"], {"zorder": 1.5} | kwargs)
        return self._graticule

    def coastlines(self, resolution: str = "50m", **kwargs: Any) -> PathPatch:
        """Draw the coasts of Natural Earth, "10m", "50m" or "110m", from the package itself.

        Returns the artist; `kwargs` are those of `matplotlib.patches.PathPatch`.
        """
        return self._lines(_path(data.coastlines(resolution)), LINES["fine"], kwargs)

    def borders(self, resolution: str = "50m", **kwargs: Any) -> PathPatch:
        """Draw the borders between countries of Natural Earth; the arguments are those of `coastlines`."""
        return self._lines(_path(data.borders(resolution)), LINES["frame"], kwargs)

    def land(self, resolution: str = "50m", **kwargs: Any) -> PathPatch:
        """Fill the land of Natural Earth; the arguments are those of `coastlines`, to be drawn over it."""
        style = {"color": LAND, "edgecolor": "none", "zorder": 0.5} | normalize_kwargs(kwargs, PathPatch)
        return self._added(_path(data.land(resolution)), {"facecolor": style.pop("color")} | style)

    def _lines(self, path: Path, usual: LineStyle, given: dict[str, Any]) -> PathPatch:
        style = {"color": usual.color, "linewidth": usual.width, "joinstyle": "round", "capstyle": "round"}
        style |= normalize_kwargs(given, PathPatch)
        return self._added(path, {"edgecolor": style.pop("color"), "facecolor": "none"} | style)

    def _added(self, path: Path, style: dict[str, Any]) -> PathPatch:
        artist = PathPatch(path, transform=self.transStraight, **style)
        # Not by add_patch, which reads every vertex for data limits, which a globe does not use.
        self.add_artist(artist)
        return artist

    def add_geometries(self, geometries: Any, *, edges: Edges = "straight", **kwargs: Any) -> PathCollection:
        """Draw Shapely geometries: polygons, filled correctly across the limb, ±180° and the poles, lines and points.

        Parameters
        ----------
        geometries : geometry, sequence of geometries, GeoSeries, GeoDataFrame, GeoJSON, or the path of a file
            Longitude and latitude in degrees; what names another coordinate system is transformed. Anything with
            ``__geo_interface__`` is accepted.
        edges : {"straight", "great circle"}
            How vertices are joined; by default straight, as in GeoJSON, shapefiles and cartopy's PlateCarree.
        **kwargs
            Options of `matplotlib.collections.PathCollection` for polygons and lines; an `array` with one value for
            each sets their colours.

        Returns
        -------
        matplotlib.collections.PathCollection
            The polygons and lines, one path each, in the order of their features. Points are drawn by `scatter`.
        """
        paths, points = paths_of(geometries)
        if len(points):
            style = {key: kwargs[key] for key in ("color", "zorder", "alpha") if key in kwargs}
            self.scatter(points[:, 0], points[:, 1], s=9, **style)
        straight = as_choice(edges, EDGES, "edges") == "straight"
        transform = self.transStraight if straight else self.transGreatCircle
        return self._collection(paths, transform, {"edgecolor": "black", "linewidth": 0.5} | kwargs)


def _path(of: data.EarthLines | data.EarthPolygons) -> Path:
    offsets = of.ring_offsets if isinstance(of, data.EarthPolygons) else of.offsets
    return compound(Ragged(of.lonlat, offsets.astype(np.intp)), closed=isinstance(of, data.EarthPolygons))


def _in_degrees(arc: SphereArc) -> FloatArray:
    """Five places of a meridian or parallel (5, 2), which straight edges join; at a pole with their meridian."""
    # To 1e-12°, so that a parallel is level.
    lonlat = np.round(xyz_to_lonlat(arc.sample(5)), 12)
    polar = np.abs(lonlat[:, 1]) == 90.0
    lonlat[polar, 0] = lonlat[2, 0]
    return lonlat


def register() -> None:
    """Make ``projection="stereodel.fisheye"`` known to matplotlib, for code that selects projections by name.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> register()
    >>> Figure().add_subplot(projection="stereodel.fisheye", focus=(2.35, 48.86)).name
    'stereodel.fisheye'
    """
    register_projection(FisheyeAxes)
