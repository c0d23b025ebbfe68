"""Projections of the sphere to a plane, and the rectangle lift."""

from stereodel.projections.azimuthal import Gnomonic, Orthographic, Stereographic
from stereodel.projections.plane_curves import Conic, PlaneCircle, PlaneLine
from stereodel.projections.rectangle_lift import RectangleLift

__all__ = ["Conic", "Gnomonic", "Orthographic", "PlaneCircle", "PlaneLine", "RectangleLift", "Stereographic"]
