"""Draw docs/images/graphs.png: four graphs of nearness, and the same sites relaxed.

python tools/graphs_picture.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from stereodel import SphericalDelaunay, SphericalVoronoi
from stereodel.drawing import LineStyle, Page, Scene, View
from stereodel.drawing.page.style import BLUE, LIGHT_GRAY
from stereodel.graphs import (
    gabriel_graph,
    minimum_spanning_tree,
    relative_neighborhood_graph,
    urquhart_graph,
)
from stereodel.relaxation import lloyd

SITES, SEED, STEPS = 450, 11, 40
VIEW = View(20, 25)
WIDTH = 1100  # pixels
ROOT = Path(__file__).resolve().parent.parent
GRAPHS = {
    "gabriel": gabriel_graph,
    "urquhart": urquhart_graph,
    "relative": relative_neighborhood_graph,
    "tree": minimum_spanning_tree,
}


def geometry() -> dict[str, object]:
    """Uniform sites, their graphs, and the diagrams of the sites before and after relaxation."""
    sites = np.random.default_rng(SEED).standard_normal((SITES, 3))
    sites /= np.linalg.norm(sites, axis=1, keepdims=True)
    triangulation = SphericalDelaunay(sites)
    cells, relaxed = SphericalVoronoi(triangulation), SphericalVoronoi(lloyd(sites, steps=STEPS).points)
    return {
        "sites": sites,
        "edges": triangulation.edges,
        **{name: graph(triangulation) for name, graph in GRAPHS.items()},
        "vertices": cells.vertices,
        "ridges": cells.ridge_vertices,
        "relaxed": relaxed.points,
        "relaxed_vertices": relaxed.vertices,
        "relaxed_ridges": relaxed.ridge_vertices,
    }


def graph_globe(g: dict[str, object], name: str) -> Scene:
    """One graph over the triangulation."""
    scene = Scene(weight=0.6)
    scene.add_edges(g["sites"], g["edges"], name="delaunay", style=LineStyle(LIGHT_GRAY, 0.6))
    scene.add_edges(g["sites"], g[name], name="graph", style=LineStyle(BLUE, 1.4))
    scene.add_points(g["sites"], name="sites")
    return scene


def cell_globe(g: dict[str, object], prefix: str, sites: str) -> Scene:
    """Cells and sites."""
    scene = Scene(weight=0.6)
    scene.add_edges(g[f"{prefix}vertices"], g[f"{prefix}ridges"], name="voronoi")
    scene.add_points(g[sites], name="sites")
    return scene


def draw(g: dict[str, object]) -> Page:
    """Each graph is a part of the one before; below them the cells before and after relaxation."""
    scenes = [graph_globe(g, name) for name in GRAPHS]
    scenes += [cell_globe(g, "", "sites"), cell_globe(g, "relaxed_", "relaxed")]
    places = [(-2.12, 1.06), (0.0, 1.06), (2.12, 1.06), (-2.12, -1.06), (0.0, -1.06), (2.12, -1.06)]
    layers = [layer for scene, at in zip(scenes, places, strict=True) for layer in scene.layout(VIEW, at=at)]
    return Page((-3.16, 3.16, -2.1, 2.1), layers, width=720.0, views=(VIEW.matrix,) * len(scenes))


def main() -> None:
    """Draw it."""
    path = draw(geometry()).save(ROOT / "docs" / "images" / "graphs.png", size=WIDTH)
    print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
