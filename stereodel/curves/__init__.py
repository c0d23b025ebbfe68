"""Curves and regions of the sphere through conformal maps: traced, cut at a border, closed along it, filled.

Read the modules in this order: `ragged` (rows of different lengths, the one container), `trace` (edges as circular arcs
and their images), `insides` (rings with their region on the left), `seams` (rings of map files without the cuts of the
map), `view` (the part of the sphere that is seen), `borders` (the edge of a chart, crossings with it and paths along
it), `clip` (lines and rings cut there and closed), `chart` (all of it for a lens and a view) and `fill` (triangles, for
OpenGL only).
"""
