"""Globes in matplotlib: the axes `FisheyeAxes`, which stand wherever matplotlib takes a projection.

``plt.subplot(projection=FisheyeAxes, focus=…, magnification=…)`` needs nothing else, and an import alone changes
nothing. After `register` the name ``projection="stereodel.fisheye"`` does, too.
"""

from stereodel._extras import of_extra

with of_extra("draw"):
    from stereodel.mpl.axes import FisheyeAxes, register

__all__ = ["FisheyeAxes", "register"]
