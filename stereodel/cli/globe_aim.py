"""The lens and the view of a globe, from options."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stereodel import MoebiusMap, fisheye, xyz_to_lonlat
from stereodel._arrays import FloatArray
from stereodel.cli.globe_options import Projection
from stereodel.cli.options import pair
from stereodel.constants import NO_MIDDLE
from stereodel.drawing import StereographicView, View
from stereodel.drawing.scene.view import MapView
from stereodel.globe import hemispheres

Place = tuple[float, float]

CLOSE = 5.0  # magnification above which the coastline at 1 : 50 million shows its corners


def place(text: str | None, option: str) -> Place | None:
    """Longitude and latitude from the text of an option."""
    return None if text is None else pair(text, option, "LON,LAT")


@dataclass(frozen=True)
class Aim:
    """Focus, magnification, centre of the view, projection and angular radius, with defaults for missing options."""

    focus: Place | None
    magnification: float
    middle: Place | None
    projection: Projection
    angular_radius: float

    def __post_init__(self) -> None:
        if not 0 < self.magnification < np.inf:
            raise ValueError(f"--magnify is {self.magnification:g}, but a magnification is positive and finite")

    def with_middle_of(self, points: FloatArray) -> Aim:
        """The aim centred on unit vectors (n, 3), unless a centre or focus was given."""
        return self if self.middle or self.focus else replace(self, middle=middle_of(points))

    @property
    def place(self) -> Place:
        """The focus, which is also the default centre of the view."""
        return self.focus or self.middle or (0.0, 0.0)

    @property
    def resolution(self) -> str:
        """Resolution of the maps of the Earth: the finest for strong magnification."""
        return "10m" if self.magnification >= CLOSE else "50m"

    @property
    def lens(self) -> MoebiusMap:
        """The fisheye; the identity for magnification 1, whatever the focus."""
        return (
            MoebiusMap.identity() if self.magnification == 1 else fisheye(self.place, magnification=self.magnification)
        )

    @property
    def views(self) -> tuple[MapView, ...]:
        """One view, or two side by side."""
        lon, lat = self.middle or self.place
        if self.projection == Projection.hemispheres:
            return hemispheres(lon, lat, flat=True)
        if self.projection == Projection.stereographic:
            return (StereographicView(lon, lat, angular_radius=self.angular_radius),)
        return (View(lon, lat),)


def middle_of(points: FloatArray) -> Place:
    """Longitude and latitude of the mean of unit vectors (n, 3); (0, 0) if they have none."""
    mean = points.sum(axis=0)
    if np.sqrt(np.sum(mean**2)) <= NO_MIDDLE * len(points):
        return (0.0, 0.0)
    lon, lat = xyz_to_lonlat(mean)
    return (float(lon), float(lat))
