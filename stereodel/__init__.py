"""Exact Delaunay triangulations and Voronoi diagrams of the plane and the sphere."""
