"""
Figure 12: Five views of a fisheye global-gram, magnification 20
================================================================

The graticule at 5° (gray) and a fine grid at 1/2° (black) under the conformal map that magnifies the surroundings of
40° N twenty times, seen as in Figure 10. The fine grid, 3° across, fills 12.5 % of the hemisphere about the focus; a
cap of angular radius 5.72° fills it entirely, and the rest of the world is compressed into the other half, around the
antipode.

Chosen by us: the fine grid reaches 1.5° from its centre; up to 1.966° it cannot be seen from the south pole. On the
side of the focus fainter lines at 1° are between those of the graticule.
"""

from _five_views import FiveViews

from stereodel.render import Figure

PANELS = FiveViews(magnification=20, coarse=5, fine=0.5, half_width=1.5, between=1)  # degrees

FIGURE = Figure("fig12_fisheye20", PANELS.geometry, PANELS.draw, in_space=PANELS.solid)

if __name__ == "__main__":
    FIGURE.main()
