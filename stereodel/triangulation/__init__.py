"""Delaunay triangulations of plane and sphere, their Voronoi diagrams, and the proof of both."""

from stereodel.triangulation.hull_insertion import HullInsertion, InsertionStep
from stereodel.triangulation.planar_delaunay import PlanarDelaunay
from stereodel.triangulation.planar_voronoi import PlanarVoronoi
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay, planar_part
from stereodel.triangulation.spherical_voronoi import SphericalVoronoi
from stereodel.triangulation.validate import DelaunayCertificate, InvalidTriangulation, check_delaunay

__all__ = [
    "DelaunayCertificate",
    "HullInsertion",
    "InsertionStep",
    "InvalidTriangulation",
    "PlanarDelaunay",
    "PlanarVoronoi",
    "SphericalDelaunay",
    "SphericalVoronoi",
    "check_delaunay",
    "planar_part",
]
