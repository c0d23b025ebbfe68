"""The globe of the page in a notebook, with sites, lens, view and selection as traits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat, as_scalar
from stereodel._extras import of_extra
from stereodel.web.assemble import module
from stereodel.web.contents import built

with of_extra("jupyter"):
    import anywidget
    import traitlets


class GlobeWidget(anywidget.AnyWidget):
    """An interactive globe through a conformal lens, controlled by mouse, touch and keyboard.

    It works in JupyterLab and any other host of anywidget, without a network. Interactions are reported back: `lens`,
    `view` and `selection` are traits, which can be observed and set.

    Parameters
    ----------
    lonlat : (n, 2) array_like, optional
        Longitude and latitude of sites in degrees; their Voronoi cells are drawn.
    focus : (2,) array_like, optional
        Longitude and latitude of the focus of the lens in degrees; by default the centre of the view.
    magnification : float
        Magnification of the lens at its focus, above 0; 1 is an undistorted globe.
    view : (2,) array_like
        Longitude and latitude of the centre of the view in degrees.

    Attributes
    ----------
    sites : bytes
        Alternating longitudes and latitudes as little-endian doubles; `lonlat` is the array.
    lens : dict
        `focus`, (lon, lat) in degrees, and `magnification`: ``fisheye(**widget.lens)`` is the map.
    view : dict
        `lon` and `lat` of the centre of the view and `roll`, in degrees; ``View(**widget.view)`` is the view for
        drawings.
    selection : list of int
        Indices of the selected sites.

    Raises
    ------
    ValueError
        If a latitude is outside [−90, 90], or the magnification is not positive.

    Examples
    --------
    >>> from stereodel import fisheye
    >>> globe = GlobeWidget(lonlat=[(10.0, 48.4), (-78.5, -0.2)], focus=(10, 48.4), magnification=4)
    >>> globe.lens
    {'focus': (10.0, 48.4), 'magnification': 4.0}
    >>> round(fisheye(**globe.lens).magnification, 9)
    4.0
    """

    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)
    sites = traitlets.Bytes().tag(sync=True)
    lens = traitlets.Dict().tag(sync=True)
    view = traitlets.Dict().tag(sync=True)
    selection = traitlets.List(traitlets.Int()).tag(sync=True)

    def __init__(
        self,
        *,
        lonlat: npt.ArrayLike = (),
        focus: npt.ArrayLike | None = None,
        magnification: float = 1.0,
        view: npt.ArrayLike = (0.0, 20.0),
        **layout: Any,
    ) -> None:
        middle = as_lonlat(view, "view")
        super().__init__(
            sites=_bytes(lonlat),
            lens={"focus": middle if focus is None else focus, "magnification": magnification},
            view={"lon": middle[0], "lat": middle[1], "roll": 0.0},
            **layout,
        )

    @property
    def lonlat(self) -> FloatArray:
        """Longitude and latitude of the sites in degrees, (n, 2); can be set."""
        return np.frombuffer(self.sites, dtype="<f8").reshape(-1, 2)

    @lonlat.setter
    def lonlat(self, lonlat: npt.ArrayLike) -> None:
        self.sites = _bytes(lonlat)

    @traitlets.observe("sites")
    def _without_those_that_are_gone(self, _change: object) -> None:
        count = len(self.lonlat)
        self.selection = [number for number in self.selection if number < count]

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
        return {
            "focus": (lon, lat),
            "magnification": as_scalar(given["magnification"], "magnification", low=0.0, open_low=True),
        }

    @traitlets.validate("view")
    def _checked_view(self, proposal: Mapping[str, Any]) -> dict[str, float]:
        given = _entries(proposal["value"], ("lon", "lat", "roll"), "view")
        lon, lat = as_lonlat((given["lon"], given["lat"]), "view").tolist()
        return {"lon": lon, "lat": lat, "roll": as_scalar(given["roll"], "roll")}

    @traitlets.validate("selection")
    def _checked_selection(self, proposal: Mapping[str, Any]) -> list[int]:
        numbers, count = [int(number) for number in proposal["value"]], len(self.lonlat)
        wrong = [number for number in numbers if not 0 <= number < count]
        if wrong:
            raise ValueError(f"selection has site {wrong[0]}, but the numbers of {count} sites are below {count}")
        return numbers


def _bytes(lonlat: npt.ArrayLike) -> bytes:
    return as_lonlat(np.reshape(np.asarray(lonlat), (-1, 2))).astype("<f8").tobytes()


def _entries(given: Mapping[str, Any], names: tuple[str, ...], what: str) -> Mapping[str, Any]:
    if set(given) != set(names):
        wanted = f"{', '.join(names[:-1])} and {names[-1]}"
        raise ValueError(f"{what} has the entries {', '.join(map(repr, given))}, but must have {wanted}")
    return given
