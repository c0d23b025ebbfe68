"""Pages as outlines: SVG, PDF, and matplotlib's Agg."""
