"""Projections of the sphere to a plane, and the rectangle lift."""

from stereodel.projections.azimuthal import Gnomonic, Orthographic
from stereodel.projections.plane_curves import Conic, PlaneCircle, PlaneLine
from stereodel.projections.rectangle_lift import RectangleLift
from stereodel.projections.stereographic import Stereographic

__all__ = ["Conic", "Gnomonic", "Orthographic", "PlaneCircle", "PlaneLine", "RectangleLift", "Stereographic"]
