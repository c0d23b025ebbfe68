"""Curves and regions of the sphere through conformal maps: traced, cut at a border, closed along it, filled.

Read the modules in this order: `ragged` (rows of different lengths, the one container), `trace` (edges as circular arcs
and their images), `insides` (rings with their region on the left), `seams` (rings of map files without the cuts of the
map), `borders` (the edge of a chart, crossings with it and paths along it), `clip` (lines and rings cut there and
closed) and `fill` (triangles, for OpenGL only).
"""
