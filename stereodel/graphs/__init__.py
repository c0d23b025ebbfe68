"""Graphs of nearness and hulls, as parts of a Delaunay triangulation, decided exactly.

Each is part of the next: minimum spanning tree, relative neighbourhood graph, Urquhart graph, Gabriel graph, Delaunay
triangulation.
"""

from stereodel.graphs.gabriel import gabriel_graph
from stereodel.graphs.hull import hull
from stereodel.graphs.relative_neighborhood import relative_neighborhood_graph
from stereodel.graphs.spanning_tree import minimum_spanning_tree
from stereodel.graphs.urquhart import urquhart_graph

__all__ = [
    "gabriel_graph",
    "hull",
    "minimum_spanning_tree",
    "relative_neighborhood_graph",
    "urquhart_graph",
]
