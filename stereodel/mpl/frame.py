"""The frame of a globe in matplotlib: the part of the view's disc within the limits of the axes."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from matplotlib.path import Path
from matplotlib.spines import Spine
from matplotlib.transforms import Bbox

CIRCLE = Path.unit_circle()
POLYGON = Path.unit_regular_polygon(2000)
"""A polygon within 1.3e-6 of the unit circle, used where the limits cut the circle."""


class _Shown:
    """The part of the disc within the limits, in axes coordinates; the path is cached until the limits change."""

    def __init__(self, axes: Axes) -> None:
        self._axes = axes
        self._limits: tuple[float, ...] = ()
        self._path = CIRCLE

    def path(self) -> Path:
        """The path for artists in axes coordinates."""
        box = self._axes.viewLim
        limits = tuple(np.asarray(box.extents).tolist())
        if limits != self._limits:
            self._limits = limits
            self._path = self._axes.transLimits.transform_path(_within(box))
        return self._path


def _within(box: Bbox) -> Path:
    """The part of the unit disc inside a box."""
    left, bottom, right, top = box.extents
    if max(left, bottom) <= -1 and min(right, top) >= 1:
        return CIRCLE
    corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)])
    if (np.sum(corners**2, axis=1) <= 1).all():
        return Path(corners, closed=True)
    return POLYGON.clip_to_bbox(Bbox.from_extents(left, bottom, right, top), inside=True)


class Disc(Patch):
    """The background patch, to which artists are clipped."""

    def __init__(self, axes: Axes) -> None:
        super().__init__()
        self._shown = _Shown(axes)

    def get_path(self) -> Path:
        """The path in axes coordinates."""
        return self._shown.path()


class Limb(Spine):
    """The outline of the visible part."""

    def __init__(self, axes: Axes, **kwargs: Any) -> None:
        super().__init__(axes, "circle", CIRCLE, **kwargs)
        self._shown = _Shown(axes)
        self.set_transform(axes.transAxes)
        self.set_capstyle("round")
        self.set_joinstyle("round")

    def get_path(self) -> Path:
        """The path in axes coordinates."""
        return self._shown.path()
