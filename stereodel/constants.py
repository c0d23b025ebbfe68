"""Every tolerance of the library, once: meaning, unit, reason.

A number that decides something stands here and nowhere else. Error *bounds*, which are derived and not
chosen, stand beside the arithmetic that they bound; they are multiples of `UNIT_ROUNDOFF`.
"""

from __future__ import annotations

from typing import Final

UNIT_ROUNDOFF: Final = 2.0**-53
"""Largest relative error of one rounded double operation (round to nearest)."""

STORED_ERROR: Final = 4 * 2.0**-52
"""What a stored unit vector may be off: length from 1, or a map's result from the exact one (chord, unit sphere).

Rounding three components of a unit vector moves it by at most sqrt(3)/2 · 2⁻⁵² ; the rest is room for a
caller who normalised in plain double arithmetic.
"""

UNDERFLOW_FLOOR: Final = 2.0**-1000
"""Added to the error bound of filters whose factors are all at most 4: more than underflow can lose there."""

POINTS_WORTH_THREADS: Final = 20_000
"""Points (or queries) from which on all processors are used by default: below, starting threads takes as long."""

REBUILD_INSERTING: Final = 3
"""Inserting more than one point for so many present ones takes longer than starting from scratch (measured)."""

REBUILD_REMOVING: Final = 6
"""Removing more than one point for so many that stay takes longer than starting from scratch (measured)."""

INSIDE_TOLERANCE: Final = 100 * 2.0**-52
"""How far below zero barycentric coordinates may be inside by default, in `stereodel.spatial`: as in SciPy."""

TRANSFORM_CONDITION: Final = 1000 * 2.0**-52
"""Smallest reciprocal condition number of a triangle with barycentric coordinates in `stereodel.spatial`: as in SciPy.

Three digits of the coordinates are right there at least.
"""

UNDECIDED: Final = 2.0**-100
"""Distance of unit vectors in double-double that cannot be told from none: each component is off by up to 2⁻¹⁰²."""

PLAIN_SQUARES: Final = (2.0**-480, 2.0**510)
"""Lengths between which squares are summed as they are: none overflows, and one below the least double is nothing."""

FILTER_RANGE: Final = 2.0**200
"""Planar filters trust differences d with 1/FILTER_RANGE < |d| < FILTER_RANGE or d = 0 (units of the input).

Products of up to four such factors neither overflow nor underflow; rows outside go to exact integers.
"""

MATRIX_ERROR: Final = 1e-9
"""How far a matrix given to `MoebiusMap.from_matrix` may be from its group, relative to its largest entry squared."""

MATRIX_MAGNIFICATION: Final = 1e6
"""Largest S recovered from a matrix: a double Lorentz matrix of magnification S holds S⁻² ulps of its directions."""

LIMB_DEPTH: Final = 1e-12
"""Depth behind the limb, relative to the radius, up to which a point of a sphere counts as seen.

A hundred times the rounding of a turned unit vector, so that a curve on the limb itself is drawn whole; as seen from
the viewer it lies within 1e-24 of the limb.
"""

RIM_FINENESS: Final = 1e-3
"""How far the rim of a chart may stray from its circle, in terms of what the curves that end on it may.

Were it as coarse as they are, it would cross them, and a region's outline itself: ears of such outlines cover a
thousandth of the disc too much. A rim 32 times as fine leaves less than a millionth, and has few points.
"""

CHART_ROUNDING: Final = 2.0**-50
"""How far coordinates on a chart may be off for rounding, in terms of its size: four units in the last place of 1.

A loop whose area is less than that times its length has no side to speak of, and is no region.
"""

ON_BALL: Final = 1e-9
"""Distance from a sphere, relative to its radius, within which a drawn arc is taken to lie on it, and a plane to touch.

Far below a pixel, far above the rounding of arcs that were computed through a conformal map.
"""

SPARE_PIECE: Final = 1e-9
"""Share of a Bézier's longest arc by which an arc may be longer than so many of them, and still be that many.

A whole turn, whose end is a rounded sum, is twelve pieces of 30° and not thirteen; their error grows by 6e-9 of itself.
"""

ONE_HARMONIC: Final = 2.0**-50
"""Size of the second harmonic of a function of an angle, relative to its largest coefficient, that counts as none.

It is the leading coefficient of the quartic of its roots. A few roundings of the coefficients are as large; taken for
true they would send two of the roots anywhere. The function itself changes by as little as its coefficients.
"""

ROOT_ON_CIRCLE: Final = 1e-4
"""How far from 1 the modulus of a computed root of the quartic of an angle may be, for its angle to be a root.

Coefficients are off by 2⁻⁵³: a single root by about as much, a double one (two curves that touch) by the square root,
a fourfold one by the fourth root, 1.03e-4. What is taken without being a root costs a cut that separates nothing.
"""

TOUCHING_SLOPE: Final = 1e-6
"""Slope of a function of an angle, relative to its largest coefficient, below which a root is left as it was found.

There two roots are within 1e-6 rad of each other, and Newton's step, value over slope, is rounding: more than 1e-10.
"""

KIND_TOLERANCE: Final = 2.0**-40
"""How far a `MoebiusMap` may be from one of its `kind`: radians in the points and images, relatively in S.

A product of some thousand maps with rounded parameters is that near to the exact one.
"""

LARGEST_MAGNIFICATION: Final = 1e100
"""Largest S (and largest 1/S) of a `MoebiusMap`: S·|t|² of any point stays in the range of double-double arithmetic."""

SMALL_ANGLE: Final = 1e-9
"""Sine |s| of half a map's angle below which its powers come from series: θ/s is 1 + s²/6 to a double there.

The angle tθ of a power is then below 1e-3 (`LARGEST_EXPONENT`), so that the first term left out, z³/720, is below 2⁻⁶⁹.
"""

LARGEST_EXPONENT: Final = 1e6
"""Largest exponent (and its negative) of `MoebiusMap.power`: the angle of a rotation's power is known to 1e-9 rad."""

FLATNESS: Final = 0.05
"""How far a chord may stray from its curve in a picture made of triangles, pixels: a fifth of a sample's distance."""

PIXEL_ROUNDING: Final = 1e-6
"""Pixels by which rounding may put a border off its place in a vector file or on its canvas: far below what shows."""

FRAME_ROUNDING: Final = 1e-6
"""By how much a frame may be shown for less than a format allows, relatively: 1/50 as a double is not quite 1/50."""

DIRECTION_STEP: Final = 1e-4
"""Degrees over which the direction of an arrow is measured on the page: a difference of points keeps 9 digits."""

NO_MIDDLE: Final = 1e-9
"""Length of the mean of unit vectors below which it has no direction: rounding leaves n/2 roundoffs of n of them."""

THIN_TRIANGLE: Final = 2.0**-12
"""Twice the area of a triangle, relative to the square of its size, below which weights are computed in double-double.

A doubled area is off by about 2⁻⁵¹ in these units, so that weights keep 39 bits above it.
"""

LEAST_WEIGHT: Final = 2.0**-200
"""Least barycentric coordinate in smooth interpolation: at a corner the sum of the two others must not be zero."""

NEEDLE: Final = 2.0**-4
"""Length of a side, relative to the longest (a power of two near it), below which slopes start from another corner.

The two long sides are then nearly the same, and their difference has lost four bits.
"""

UNDETERMINED: Final = 1e-12
"""Part of a column's square that must be left after the columns before it, for neighbours to determine its unknown.

In fits of gradients: neighbours within 1e-6 rad of a line tell nothing of the slope across it. Rounding leaves 1e-15.
"""

QUADRATURE_CHORD: Final = 0.2
"""Longest side of a spherical triangle over which a rule of degree five is used, as a chord: 11.5°.

The whole sphere, cut into such triangles, has its area within 1e-8 of itself.
"""

SEEN_FACE_ON: Final = 2.0**-240
"""Sine of the angle between a circle's axis and the view's, below which an orthographic image is a circle to a double.

Smaller ones have squares beyond the range of double-double arithmetic.
"""

CLOSE_SITES: Final = 1e-4
"""Distance of two unit vectors below which their difference is formed in twice the precision.

Lengths differ from one by 2⁻⁵², so above it a bisecting plane is turned by less than 1e-11 rad.
"""

BALANCED: Final = 1e-6
"""Length of the mean of unit vectors over a cell below which it has no direction to move its site to.

Quadrature leaves less than 1e-7 for the whole sphere. In a hemisphere the mean is 1/2, in a smaller cell more.
"""

AT_POLE: Final = 2.0**-50
"""Components of a point of a map's border, a unit vector, that count as zero; distance from the axis at a pole.

A few roundings of a computed point, 6 nanometres on Earth. Without it the rounding noise of an arc along the 180th
meridian would cut its cells into hundreds of pieces without width.
"""

THIN_CELL: Final = 1e-13
"""Width of a cell, radians, below which its chords are not halved to keep its sides apart on a map: 0.6 micrometres.

Points on a map are rounded to 2e-16 rad, and the two sides of such a cell are arcs between rounded points.
"""

BORDER_STEPS: Final = 2**14
"""Most chords of one cell's border that are halved at once where straight lines on a map cross each other.

A cell 90° long and 0.1 m wide takes 2¹² of them. A cell that takes more is hardly there for more than rounding.
"""

FINER_WARPS: Final = (2.0**-4, 2.0**-8, 2.0**-12, 2.0**-16)
"""Shares of the tolerance with which polygons are warped anew whose chords cross on the map.

Chords must stray less than a polygon is wide; with the last share they are 256 times as many. Beyond, what crosses is
cut off.
"""

STAR_ROUNDING: Final = 2.0**-50
"""Rounding of a cross product of two differences of doubles, in terms of the sum of its two products.

Each difference is off by 2⁻⁵³ of itself, so are products and their difference: four times that together, and as much
again to be sure.
"""

DEGREE_ROUNDING: Final = 2.0**-43
"""Straying of a chord from its arc, in degrees, that may be rounding alone: four units in the last place of 180°.

Three numbers that are rounded to half a unit, and their mean, make less than two.
"""

WHOLE_TURNS: Final = 2.0**-43
"""Step of longitudes, degrees, to which whole turns are added without rounding: the last place of 512 to 1024.

Less than 2e-15 rad, or 13 nanometres on Earth.
"""

CHORD_CLEARANCE: Final = 0.125
"""How far a chord of a cell's border may stray, in terms of its distance from the two sites that the border divides.

Well below 1, so that every point lies in its own cell on a map, however close it is to the next one.
"""

LARGEST_CAP: Final = 170.0
"""Angular radius of the largest cap that a stereographic view shows, degrees.

The scale at its edge is 132 times that of the middle; a view of everything would be a point in an empty disc.
"""

PAGE_TOLERANCE: Final = 5e-5
"""How far a chord may stray from its curve on a globe drawn by matplotlib, in terms of the radius of what is shown.

A twentieth of a pixel at a radius of 1000 pixels, as `FLATNESS`; matplotlib draws one path at any resolution.
"""

FINEST_POINTS: Final = 0.02
"""Corners of filled regions in vector files that are closer along an outline, in points, become one.

A dot of a printer at 3600 dots an inch; as far as `Globe.page` lets what it draws stray.
"""

FINEST_PLACE: Final = 1e-3
"""Step of the coordinates in vector files, points: 0.35 micrometres. What is shorter on paper is no line."""

FINEST_OUTLINE: Final = 5e-4
"""How far a letter's quadratic outline may stray from the cubic one that a font brings, in terms of the type's size.

Half a unit of such fonts, which have a thousand: their points are rounded by as much.
"""

MOST_FRAMES: Final = 100_000
"""Of a film: more than an hour at 25 frames a second. Each has a hundred bytes while the film is made."""

MOST_FRAME_PIXELS: Final = 2**26
"""Of a frame of a film: 8K twice over. It takes 0.2 GB in each of the processes that draw, and again to be encoded."""

MOST_TEXELS: Final = 2**27
"""Pixels of the largest picture that is read or warped, 16384 × 8192: with its smaller copies it takes 1.4 GB.

Pillow has the same kind of limit, somewhat above.
"""

MOST_PIXELS_ACROSS: Final = 2**20
"""Largest globe in pixels across: columns and rows of a window of it stay whole in single precision."""

LONGEST_EDGE: Final = 30.0
"""Longest piece of a map's edge that one great-circle arc follows, degrees: far from 180, where none does."""

MOST_PIECES: Final = 64
"""Equal pieces into which an edge is cut for a lens; one that needs more is halved first, and each half asked again.

Where a lens magnifies a billion times, a long edge through its focus is then a few hundred pieces, not ten million.
"""

MOST_PLACES: Final = 2**30
"""Of a grid; one value at each takes 8 GB."""

GRID_ROUNDING: Final = 1e-9
"""Part of a step by which the last line of a grid may miss the border of its box, for rounding: it is reached then."""

OPPOSITE: Final = 1e-9
"""Distance of a point from another's antipode, radii, below which no great circle is taken to join the two.

Above it rounding turns the circle between them by less than 1e-6 rad, which no picture shows.
"""

CHART_TOLERANCE: Final = 1e-4
"""How far what a chart draws may be from what it stands for where nothing is said, page units: radii of its disc.

A tenth of a pixel at a radius of 1000 pixels; pages of globes say it in points instead.
"""

REACH_MARGIN: Final = 1e-6
"""Part of its radius by which a view is taken to be wider where it is asked what cannot come into sight.

Rounding then leaves nothing out that touches the border; an edge too many costs a microsecond.
"""

GRID_SAMPLES: Final = 97
"""Places along a line of a grid, before a lens and as many behind it, between which it may end once.

A line that came and went between two of them would do so within 4° of its circle, on the sphere and in its image.
"""

GROUND_PIXEL: Final = 2.0**-10
"""Side of a pixel of which a picture below type is asked for its colour, page units: radii of the disc.

A point, 1/72 inch, is four times as large on a globe 17 cm across.
"""
