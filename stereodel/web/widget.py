"""The globe of the page in a notebook, with places, lens, view and selection as traits."""

from __future__ import annotations

import difflib
import inspect
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat, as_scalar
from stereodel._extras import of_extra
from stereodel.drawing.page.colors import ColorLike
from stereodel.drawing.page.style import MAP_FILLS, LengthLike
from stereodel.drawing.scene.by_value import ScaleLike
from stereodel.drawing.scene.legend import LegendEntry
from stereodel.io import PointTable, read_points
from stereodel.io.formats.map_rows import is_frame
from stereodel.web.assemble import module
from stereodel.web.contents import built
from stereodel.web.layers import layers_of
from stereodel.web.looks import Looks
from stereodel.web.looks import legend as legend_of

with of_extra("jupyter"):
    import anywidget
    import traitlets


class GlobeWidget(anywidget.AnyWidget):
    """An interactive globe through a conformal lens, controlled by mouse, touch and keyboard.

    It works in JupyterLab and any other host of anywidget, without a network. Interactions are reported back: `lens`,
    `view` and `selection` are traits, which can be observed and set.

    Parameters
    ----------
    places : (n, 2) array_like, table or frame, optional
        Longitude and latitude of places in degrees, or whatever `read_points` reads: a frame of pandas or GeoPandas, a
        `PointTable`, a file. Without colours by value the Voronoi cells are drawn, those of authalic latitudes.
    lonlat : optional
        The same, by its name.
    names : sequence of str, or str, optional
        A name for each place, or the column of a table that has them, by default the one called ``name``. Names stand
        beside their places where there is room, and are told where the pointer is on a place.
    size, color, values, scale, legend, size_legend
        Sizes and colours of the places, all alike or by value, and titles of their scales in the legend below the
        globe, as for `stereodel.globe.Globe.add_points`; of a table also names of columns.
    focus : (2,) array_like, optional
        Longitude and latitude of the focus of the lens in degrees; by default the centre of the view.
    magnification : float
        Magnification of the lens at its focus, above 0; 1 is an undistorted globe. Hands stop at 100.
    view : (2,) array_like
        Longitude and latitude of the centre of the view in degrees.
    layout : dict or ipywidgets.Layout, optional
        As of any widget; without a ``width`` the globe is 640 pixels wide at the most.

    Attributes
    ----------
    sites : bytes
        Alternating longitudes and latitudes as little-endian doubles; `lonlat` is the array.
    names : list of str
        A name for each site, or none.
    lens : dict
        `focus`, (lon, lat) in degrees, and `magnification`: ``fisheye(**widget.lens)`` is the map. It is read-only; set
        it as a whole, or the properties `focus` and `magnification`.
    view : dict
        `lon` and `lat` of the centre of the view and `roll`, in degrees; ``View(**widget.view)`` is the view for
        drawings. It is read-only; set it as a whole. Hands keep north up where `roll` is 0.
    selection : list of int
        Indices of the selected sites; set it as a whole.
    look, layers : dict, list
        Colours, radii and values of the sites, and shapes, as they are sent; `add_layer` adds shapes.

    Raises
    ------
    ValueError
        If a latitude is outside [−90, 90], the magnification is not positive, a column does not exist, or there are not
        as many names or values as places.
    TypeError
        If an argument is unknown, or an entry of `lens` or `view` is set alone.

    Examples
    --------
    >>> from stereodel import fisheye
    >>> globe = GlobeWidget(lonlat=[(10.0, 48.4), (-78.5, -0.2)], focus=(10, 48.4), magnification=4)
    >>> globe.lens
    {'focus': (10.0, 48.4), 'magnification': 4.0}
    >>> globe.magnification = 5
    >>> round(fisheye(**globe.lens).magnification, 9)
    5.0
    """

    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)
    sites = traitlets.Bytes().tag(sync=True)
    names = traitlets.List(traitlets.Unicode()).tag(sync=True)
    look = traitlets.Dict().tag(sync=True)
    layers = traitlets.List(traitlets.Dict()).tag(sync=True)
    lens = traitlets.Dict().tag(sync=True)
    view = traitlets.Dict().tag(sync=True)
    selection = traitlets.List(traitlets.Int()).tag(sync=True)

    def __init__(
        self,
        places: Any = None,
        *,
        lonlat: Any = None,
        names: Sequence[str] | str | None = None,
        size: LengthLike | npt.ArrayLike | None = None,
        color: ColorLike | npt.ArrayLike | None = None,
        values: npt.ArrayLike | None = None,
        scale: ScaleLike | None = None,
        legend: str = "",
        size_legend: str = "",
        focus: npt.ArrayLike | None = None,
        magnification: float = 1.0,
        view: npt.ArrayLike = (0.0, 20.0),
        layout: Any = None,
        **unknown: Any,
    ) -> None:
        if unknown:
            known = list(inspect.signature(GlobeWidget).parameters)[:-1]
            near = difflib.get_close_matches(next(iter(unknown)), known, 1)
            said = f"did you mean {near[0]}?" if near else f"it takes {', '.join(known)}"
            raise TypeError(f"GlobeWidget has no argument {next(iter(unknown))}; {said}")
        if places is not None and lonlat is not None:
            raise TypeError("places and lonlat are the same; give one of them")
        given = lonlat if places is None else places
        table = _table(() if given is None else given)
        if names is None:
            names = next((key for key in table.columns if key.strip().lower() == "name"), None)
        labels: Any = table.column(names) if isinstance(names, str) else () if names is None else names
        valued: Any = values
        sized: Any = size
        if isinstance(values, str):
            valued, legend = table.column(values), legend or values
        if isinstance(size, str) and size in table.columns:
            sized, size_legend = table.numbers(size), size_legend or size
        if isinstance(color, str) and color in table.columns:
            raise ValueError(f"color is the column {color!r}; colours by value are values={color!r}")
        looks = Looks("", "", sized, color, valued, scale, legend, size_legend)
        middle = as_lonlat(view, "view")
        look, entries = looks.dots(len(table))
        self._entries: dict[str, dict[str, LegendEntry]] = {"places": entries, "layers": {}}
        super().__init__(
            sites=_bytes(table.lonlat),
            names=["" if name is None or name != name else str(name) for name in labels],
            look={**look, "legend": self._legend()},
            lens={"focus": middle if focus is None else focus, "magnification": magnification},
            view={"lon": middle[0], "lat": middle[1], "roll": 0.0},
            **({} if layout is None else {"layout": layout}),
        )

    def add_layer(
        self,
        source: Any,
        *,
        color: ColorLike = MAP_FILLS["area"],
        column: str | None = None,
        scale: ScaleLike | None = None,
        legend: str = "",
    ) -> None:
        """Draw the contents of a file or table of shapes on the land: polygons, lines and points.

        Parameters
        ----------
        source, color, column, scale, legend
            As of `stereodel.globe.Globe.add_layer`: a GeoDataFrame, geometries, GeoJSON or a file; the colour of all
            shapes, or the property that colours them by a scale, with an entry in the legend.
        """
        layers, entries = layers_of(source, color, column, scale, legend)
        with self.hold_sync():
            self._entries["layers"] |= entries
            self.look = self.look | {"legend": self._legend()}
            self.layers = [*self.layers, *layers]

    @property
    def focus(self) -> tuple[float, float]:
        """Longitude and latitude of the focus of the lens in degrees; can be set."""
        return self.lens["focus"]

    @focus.setter
    def focus(self, focus: npt.ArrayLike) -> None:
        self.lens = {**self.lens, "focus": focus}

    @property
    def magnification(self) -> float:
        """Magnification of the lens at its focus; can be set."""
        return self.lens["magnification"]

    @magnification.setter
    def magnification(self, magnification: float) -> None:
        self.lens = {**self.lens, "magnification": magnification}

    @property
    def lonlat(self) -> FloatArray:
        """Longitude and latitude of the sites in degrees, (n, 2); can be set. Of another number they have no names."""
        return np.frombuffer(self.sites, dtype="<f8").reshape(-1, 2)

    @lonlat.setter
    def lonlat(self, lonlat: npt.ArrayLike) -> None:
        with self.hold_sync():
            self.sites = _bytes(lonlat)

    @traitlets.observe("sites")
    def _without_those_that_are_gone(self, _change: object) -> None:
        count = len(self.lonlat)
        self.selection = [number for number in self.selection if number < count]
        if self.names and len(self.names) != count:
            self.names = []
        if "ink" in self.look and len(self.look["ink"]) != count:
            self._entries["places"] = {}
            self.look = {"legend": self._legend()}

    def _legend(self) -> str:
        return legend_of(self._entries["places"] | self._entries["layers"])

    @traitlets.default("_esm")
    def _script(self) -> str:
        return module("110m")

    @traitlets.default("_css")
    def _style(self) -> str:
        return built("widget.css").decode("utf-8")

    @traitlets.validate("lens")
    def _checked_lens(self, proposal: Mapping[str, Any]) -> dict[str, Any]:
        given = _entries(proposal["value"], ("focus", "magnification"), "lens")
        lon, lat = as_lonlat(given["focus"], "focus").tolist()
        magnification = as_scalar(given["magnification"], "magnification", low=0.0, open_low=True)
        return ReadOnly(focus=(lon, lat), magnification=magnification)

    @traitlets.validate("view")
    def _checked_view(self, proposal: Mapping[str, Any]) -> dict[str, float]:
        given = _entries(proposal["value"], ("lon", "lat", "roll"), "view")
        lon, lat = as_lonlat((given["lon"], given["lat"]), "view").tolist()
        return ReadOnly(lon=lon, lat=lat, roll=as_scalar(given["roll"], "roll"))

    @traitlets.validate("names")
    def _checked_names(self, proposal: Mapping[str, Any]) -> list[str]:
        if len(proposal["value"]) not in (0, len(self.lonlat)):
            raise ValueError(f"names has {len(proposal['value'])} entries, but there are {len(self.lonlat)} places")
        return [name.encode("utf-8", "replace").decode() for name in proposal["value"]]

    @traitlets.validate("selection")
    def _checked_selection(self, proposal: Mapping[str, Any]) -> list[int]:
        numbers, count = [int(number) for number in proposal["value"]], len(self.lonlat)
        wrong = [number for number in numbers if not 0 <= number < count]
        if wrong:
            raise ValueError(f"selection has site {wrong[0]}, but the numbers of {count} sites are below {count}")
        return numbers


class ReadOnly(dict[str, Any]):
    """A dictionary that is not changed in place: nobody would hear of it."""

    def _refused(self, *_args: Any, **_entries: Any) -> Any:
        raise TypeError("its entries cannot be set alone; set widget.magnification, widget.focus, or the whole dict")

    __setitem__ = __delitem__ = __ior__ = update = setdefault = pop = popitem = clear = _refused


def _table(given: Any) -> PointTable:
    if isinstance(given, PointTable):
        return given
    if is_frame(given) or isinstance(given, str | os.PathLike):
        return read_points(given)
    return PointTable(np.reshape(as_lonlat(np.reshape(np.asarray(given), (-1, 2))), (-1, 2)))


def _bytes(lonlat: npt.ArrayLike) -> bytes:
    return as_lonlat(np.reshape(np.asarray(lonlat), (-1, 2))).astype("<f8").tobytes()


def _entries(given: Mapping[str, Any], names: tuple[str, ...], what: str) -> Mapping[str, Any]:
    if set(given) != set(names):
        wanted = f"{', '.join(names[:-1])} and {names[-1]}"
        raise ValueError(f"{what} has the entries {', '.join(map(repr, given))}, but must have {wanted}")
    return given
