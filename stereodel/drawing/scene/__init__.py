"""Scenes in space and drawings in the plane, laid out on pages: views, curves, hidden parts, legends."""
