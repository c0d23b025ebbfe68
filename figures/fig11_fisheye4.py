"""
Figure 11: Five views of a fisheye global-gram, magnification 4
===============================================================

The graticule at 5° (gray) and a fine grid at 1° (black) under the conformal map that magnifies the surroundings of
40° N four times, seen as in Figure 10. Every line is still a circle, and every crossing still a right angle.

Chosen by us: the fine grid reaches 8° from its centre; up to 9.98° it cannot be seen from the south pole.
"""

from _five_views import FiveViews

from stereodel.render import Figure

PANELS = FiveViews(magnification=4, coarse=5, fine=1, half_width=8)  # degrees

FIGURE = Figure("fig11_fisheye4", PANELS.geometry, PANELS.draw, in_space=PANELS.solid)

if __name__ == "__main__":
    FIGURE.main()
