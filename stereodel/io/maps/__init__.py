"""Cells, triangles and lines on the map of longitude and latitude, or in a plane."""
