"""Globes in matplotlib: ``projection="stereodel.fisheye"``, known to matplotlib once this package is imported."""

from stereodel._extras import of_extra

with of_extra("draw"):
    from stereodel.mpl.axes import FisheyeAxes

__all__ = ["FisheyeAxes"]
