"""Lloyd relaxation of points to a centroidal Voronoi diagram, in a convex part of the plane or on the sphere."""

from stereodel.relaxation.lloyd import Relaxation, lloyd

__all__ = ["Relaxation", "lloyd"]
