"""Globes in matplotlib: the axes `FisheyeAxes`, for use wherever matplotlib takes a projection.

``plt.subplot(projection=FisheyeAxes, focus=…, magnification=…)`` needs nothing else; importing this module has no side
effects. After `register`, ``projection="stereodel.fisheye"`` works too.
"""

from stereodel._extras import of_extra

with of_extra("draw"):
    from stereodel.mpl.axes import FisheyeAxes, register

__all__ = ["FisheyeAxes", "register"]
