"""Curves and regions of the sphere through conformal maps: traced, cut at a border, closed along it, filled.

Read `ragged` (rows of different lengths, the one container), `trace` (edges as arcs of circles and their images),
`seams` (rings of map files without the cuts of the map), `borders` (where a chart ends, and what goes on along its
edge), `clip` (lines and rings cut there and closed) and `fill` (triangles, for OpenGL alone), in this order.
"""
