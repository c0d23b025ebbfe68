"""Globes that bend: maps of the sphere in layers, through a conformal lens, as balls and flat maps."""

from stereodel.globe.raster import Raster

__all__ = ["Raster"]
