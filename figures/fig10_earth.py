"""
Figure 10: Five orthographic views of the earth's graticule
===========================================================

The graticule at 10° (gray) from above the equator, the two poles, latitude 40° N and its antipode, all on the prime
meridian, which is a vertical line in the middle of each view. A finer grid (2°, black) is drawn about 40° N.

Chosen by us: the fine grid reaches 8° from its centre.
"""

from _five_views import FiveViews

from stereodel.render import Figure

PANELS = FiveViews(magnification=1, coarse=10, fine=2, half_width=8)  # degrees

FIGURE = Figure("fig10_earth", PANELS.geometry, PANELS.draw, in_space=PANELS.solid)

if __name__ == "__main__":
    FIGURE.main()
