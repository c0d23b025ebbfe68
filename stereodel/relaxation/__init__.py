"""Lloyd relaxation of points to a centroidal Voronoi diagram, in a convex part of the plane or on the sphere."""

from stereodel.relaxation.lloyd import Progress, Quality, Relaxation, lloyd

__all__ = ["Progress", "Quality", "Relaxation", "lloyd"]
