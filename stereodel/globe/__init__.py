"""Globes: layered maps of the sphere through a conformal lens, as balls and flat maps; panoramas."""

from stereodel.globe.globe import Globe
from stereodel.globe.pages import Panel, hemispheres, panels
from stereodel.globe.panoramas import save_panorama
from stereodel.globe.raster import Raster

__all__ = ["Globe", "Panel", "Raster", "hemispheres", "panels", "save_panorama"]
