"""The frame of a globe in matplotlib: the disc of the view, where it lies within the limits of the axes."""

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
"""Off the unit circle by 1.3e-6; it stands in for the circle where the limits cut it."""


class _Shown:
    """The disc within the limits, in axes coordinates; the same path as long as the limits are the same."""

    def __init__(self, axes: Axes) -> None:
        self._axes = axes
        self._limits: tuple[float, ...] = ()
        self._path = CIRCLE

    def path(self) -> Path:
        """For `get_path` of an artist that is drawn in axes coordinates."""
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
    """What is behind all artists, and bounds them."""

    def __init__(self, axes: Axes) -> None:
        super().__init__()
        self._shown = _Shown(axes)

    def get_path(self) -> Path:
        """In axes coordinates."""
        return self._shown.path()


class Limb(Spine):
    """The line around what is shown."""

    def __init__(self, axes: Axes, **kwargs: Any) -> None:
        super().__init__(axes, "circle", CIRCLE, **kwargs)
        self._shown = _Shown(axes)
        self.set_transform(axes.transAxes)
        self.set_capstyle("round")
        self.set_joinstyle("round")

    def get_path(self) -> Path:
        """In axes coordinates."""
        return self._shown.path()
