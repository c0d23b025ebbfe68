"""All tolerances of the library, each with meaning, unit and reason.

Numbers that decide something are defined here and nowhere else. Error *bounds*, which are derived rather than chosen,
are defined next to the arithmetic that they bound; they are multiples of `UNIT_ROUNDOFF`.
"""

from __future__ import annotations

from typing import Final

UNIT_ROUNDOFF: Final = 2.0**-53
"""Largest relative error of one rounded double operation (round to nearest)."""

STORED_ERROR: Final = 4 * 2.0**-52
"""Largest error of a stored unit vector: of its length, or of a map's result from the exact one (chord, unit sphere).

Rounding three components of a unit vector moves it by at most sqrt(3)/2 · 2⁻⁵² ; the rest allows for callers who
normalised in plain double arithmetic.
"""

UNDERFLOW_FLOOR: Final = 2.0**-1000
"""Added to the error bound of filters whose factors are all at most 4: more than underflow can lose there."""

POINTS_WORTH_THREADS: Final = 20_000
"""Number of points (or queries) from which all processors are used by default; below it, threads do not pay."""

REBUILD_INSERTING: Final = 3
"""Inserting more than one point per this many existing ones takes longer than starting from scratch (measured)."""

REBUILD_REMOVING: Final = 6
"""Removing more than one point per this many remaining ones takes longer than starting from scratch (measured)."""

INSIDE_TOLERANCE: Final = 100 * 2.0**-52
"""How far below zero barycentric coordinates may be inside by default, in `stereodel.spatial`: as in SciPy."""

TRANSFORM_CONDITION: Final = 1000 * 2.0**-52
"""Least reciprocal condition number of a triangle with a `transform` in `stereodel.spatial`, as in SciPy: 3 digits."""

UNDECIDED: Final = 2.0**-100
"""Distance of unit vectors in double-double that is indistinguishable from zero: components are off by up to 2⁻¹⁰²."""

PLAIN_SQUARES: Final = (2.0**-480, 2.0**510)
"""Lengths between which squares are summed unscaled: none overflows, and those that underflow are negligible."""

FILTER_RANGE: Final = 2.0**200
"""Planar filters trust differences d with 1/FILTER_RANGE < |d| < FILTER_RANGE or d = 0 (units of the input).

Products of up to four such factors neither overflow nor underflow; rows outside go to exact integers.
"""

MATRIX_ERROR: Final = 1e-9
"""How far a matrix given to `MoebiusMap.from_matrix` may be from its group, relative to its largest entry squared."""

MATRIX_MAGNIFICATION: Final = 1e6
"""Largest S recovered from a matrix: a double Lorentz matrix of magnification S holds S⁻² ulps of its directions."""

LIMB_DEPTH: Final = 1e-12
"""Radians behind the limb of a sphere, or the rim of a cap, up to which a point counts as visible.

A hundred times the rounding of a rotated unit vector: a curve on the limb itself is drawn entirely.
"""

RIM_FINENESS: Final = 1e-3
"""Largest deviation of a chart's rim from its circle, relative to that of the curves that end on it.

As coarse as they are, it would cross them, and outlines of regions would cross themselves.
"""

CHART_ROUNDING: Final = 2.0**-50
"""Rounding of coordinates on a chart, relative to its size; a loop of less area than that times its length is none."""

THIN_RING: Final = 2.0**-8
"""Area of a region, relative to the square of its border's size, up to which its side is found on the sphere.

A disc has 2⁻⁴ or more. Chords that deviate by more than the width of a strip have its area negative.
"""

NARROW_PASSAGE: Final = 4.0
"""Distance along a border of two crossings, relative to the root of the blur, below which a thin region passes once.

Curves a distance d apart cross a circle of radius 1 that they touch up to √(8d) apart, perhaps in reverse order.
"""

TOUCHING: Final = 2.0**-10
"""Distance of a hole's corner from a shell, relative to the hole's size, above which they do not touch there."""

ON_BALL: Final = 1e-9
"""Distance from a sphere, relative to its radius, within which a drawn arc is taken to lie on it: far below a pixel."""

SPARE_PIECE: Final = 1e-9
"""Excess of an arc over a whole number of longest Bézier arcs, as a fraction of one, that adds no further Bézier."""

STRAIGHT_ARC: Final = 1e-9
"""Height of an arc over its chord, relative to it, below which it is straight: a billionth of a page is not seen."""

ONE_HARMONIC: Final = 2.0**-50
"""Size of the second harmonic of a function of an angle, relative to its largest coefficient, that counts as zero.

It is the leading coefficient of the quartic of its roots: rounding at face value would move two of them arbitrarily.
"""

ROOT_ON_CIRCLE: Final = 1e-4
"""Largest distance from 1 of the modulus of a computed root of the quartic of an angle, for its angle to be a root.

A fourfold root is off by the fourth root of 2⁻⁵³, 1.03e-4. One too many only cuts where nothing is separated.
"""

TOUCHING_SLOPE: Final = 1e-6
"""Slope of a function of an angle, relative to its largest coefficient, below which a root is left as it was found.

There two roots are within 1e-6 rad of each other, and Newton's step is rounding.
"""

KIND_TOLERANCE: Final = 2.0**-40
"""Largest distance of a `MoebiusMap` from one of its `kind`: in radians for points and images, relative for S.

A product of about a thousand maps with rounded parameters is that close.
"""

LARGEST_MAGNIFICATION: Final = 1e100
"""Largest S (and largest 1/S) of a `MoebiusMap`: S·|t|² of any point stays in the range of double-double arithmetic."""

SMALL_ANGLE: Final = 1e-9
"""Sine |s| of half a map's angle below which its powers come from series: θ/s is 1 + s²/6 to a double there."""

LARGEST_EXPONENT: Final = 1e6
"""Largest exponent (and its negative) of `MoebiusMap.power`: the angle of a rotation's power is known to 1e-9 rad."""

FLATNESS: Final = 0.05
"""Largest deviation of a chord from its curve in pictures of triangles, in pixels: a fifth of the sample spacing."""

PIXEL_ROUNDING: Final = 1e-6
"""Pixels by which rounding may displace a border in a vector file or on a canvas: far below visibility."""

FRAME_ROUNDING: Final = 1e-6
"""Relative amount by which a frame may be shorter than a format allows: 1/50 as a double is not exactly 1/50."""

DIRECTION_STEP: Final = 1e-4
"""Degrees over which the direction of an arrow is measured on the page: a difference of points keeps 9 digits."""

NO_MIDDLE: Final = 1e-9
"""Length of the mean of unit vectors below which it has no direction: rounding leaves n/2 roundoffs for n vectors."""

THIN_TRIANGLE: Final = 2.0**-12
"""Twice the area of a triangle, relative to the square of its size, below which weights are in double-double.

A doubled area is off by about 2⁻⁵¹ in these units, so that weights keep 39 bits above it.
"""

LEAST_WEIGHT: Final = 2.0**-200
"""Least barycentric coordinate in smooth interpolation: at a corner the sum of the two others must not be zero."""

WEIGHT_ROUNDING: Final = 1e-9
"""Largest distance from one of the sum of a query's weights in a file: rounding leaves 1e-15."""

NEEDLE: Final = 2.0**-4
"""Length of a side, relative to the longest, below which slopes start from another corner: four bits are lost."""

UNDETERMINED: Final = 1e-12
"""Fraction of a column's square that must remain after the preceding columns for its unknown to be determined.

In fits of gradients, neighbours within 1e-6 rad of a line leave the slope across it open. Rounding leaves 1e-15.
"""

QUADRATURE_CHORD: Final = 0.2
"""Longest side (chord, 11.5°) of a spherical triangle for a rule of degree five: a sphere's area is good to 1e-8."""

SEEN_FACE_ON: Final = 2.0**-240
"""Sine of the angle between a circle's axis and the view's below which its orthographic image is a circle."""

BALANCED: Final = 1e-6
"""Length of the mean of unit vectors over a cell below which it has no direction to move its site to.

Quadrature leaves less than 1e-7 for the whole sphere. In a hemisphere the mean is 1/2, in a smaller cell more.
"""

AT_POLE: Final = 2.0**-50
"""Components of a point of a map's border, a unit vector, that count as zero; distance from the axis at a pole.

Without it, rounding of an arc along the 180th meridian would cut its cells into hundreds of pieces without width.
"""

THIN_CELL: Final = 1e-13
"""Width of a cell, radians, below which its chords are not halved to keep its sides apart on a map: 0.6 micrometres."""

BORDER_STEPS: Final = 2**14
"""Most chords of a cell's border halved at once where lines cross on a map: 90° by 0.1 m takes 2¹² of them."""

FINER_WARPS: Final = (2.0**-4, 2.0**-8, 2.0**-12)
"""Fractions of the tolerance, one of which is used if the chords of a warped polygon cross: 1/16 of its width or less.

Polygons narrower than 2⁻⁸ of the tolerance may cross however fine the chords are, within the tolerance.
"""

DEGREE_ROUNDING: Final = 2.0**-43
"""Deviation of a chord from its arc, in degrees, that may be due to rounding: four units in the last place of 180°."""

WHOLE_TURNS: Final = 2.0**-43
"""Step of longitudes, degrees, to which whole turns are added without rounding: the last place of 512 to 1024."""

CHORD_CLEARANCE: Final = 0.125
"""Largest deviation of a chord of a border, in distances from the sites: well below 1, so sites stay in their cells."""

LARGEST_CAP: Final = 170.0
"""Angular radius of the largest cap of a stereographic view, degrees: its edge has 132 times the centre's scale."""

PAGE_TOLERANCE: Final = 5e-5
"""Largest deviation of a chord from its curve on a globe of matplotlib, in radii: 1/20 pixel at 1000 pixels."""

FINEST_POINTS: Final = 0.02
"""Corners of filled regions in vector files that are closer along an outline, in points, become one: a printed dot."""

FINEST_PLACE: Final = 1e-3
"""Step of the coordinates in vector files, points: 0.35 micrometres. A shorter line is not drawn."""

FINEST_OUTLINE: Final = 5e-4
"""Largest deviation of a letter's quadratic outline from the cubic one, in type sizes: half a unit of such fonts."""

MOST_FRAMES: Final = 100_000
"""Largest number of frames of a film: more than an hour at 25 per second. Each takes a hundred bytes meanwhile."""

MOST_FRAME_PIXELS: Final = 2**26
"""Largest number of pixels of a frame: twice 8K. It takes 0.2 GB in each drawing process, and again for encoding."""

MOST_TEXELS: Final = 2**27
"""Pixels of the largest picture that is read or warped, 16384 × 8192: with its smaller copies it takes 1.4 GB."""

MOST_PIXELS_ACROSS: Final = 2**20
"""Largest globe in pixels across: columns and rows of a window of it stay whole in single precision."""

LONGEST_EDGE: Final = 30.0
"""Longest piece of a map's edge approximated by one great-circle arc, in degrees: far below 180."""

MOST_PIECES: Final = 64
"""Largest number of equal pieces into which an edge is cut for a lens; an edge that needs more is halved first."""

MOST_PLACES: Final = 2**30
"""Largest number of nodes of a grid; one value at each takes 8 GB."""

GRID_ROUNDING: Final = 1e-9
"""Fraction of a step by which the last line of a grid may miss the border of its box because of rounding."""

OPPOSITE: Final = 1e-9
"""Distance of a point from another's antipode, radii, below which no great circle is taken to join the two.

Above it rounding rotates the circle between them by less than 1e-6 rad.
"""

OUTLINE_TOLERANCE: Final = 1e-8
"""Largest deviation, radians, of arcs from outlines to which distances are taken: 6 cm on the Earth.

Two distances that differ by more than twice that are in the right order; rounding, 1e-15, does not matter beside it.
"""

CHART_TOLERANCE: Final = 1e-4
"""Default largest deviation of charts from the exact image, in radii of the disc: 1/10 pixel at 1000 pixels."""

REACH_MARGIN: Final = 1e-6
"""Fraction of its radius by which a view is enlarged to find what cannot become visible, whatever rounding does."""

GRID_SAMPLES: Final = 97
"""Number of samples along a line of a grid, before a lens and again after it, between which it may end once: 4°."""

MOST_GRID_LINES: Final = 2**16
"""Meridians (and parallels) of one stride that a picture may take: all together 1 GB.

Near a pole of a picture there are about 35 for each least distance between lines in its radius.
"""

GROUND_PIXEL: Final = 2.0**-10
"""Side of the pixel with which an image below a label is sampled for its colour, in page units: 1/4 point."""

AREA_SUM_ERROR: Final = 2e-12
"""How far the areas of all cells of a sphere may add up to another area, in terms of it: what each cell may be off."""

UNPACKED_SIZE: Final = 2**20
"""Bytes to which any packed file may unpack, however small it is: that of a million bytes reads in a second."""

UNPACKED_RATIO: Final = 50
"""How many times its size a packed file may unpack to; tables of measurements pack to a half or a thirtieth."""

MOST_MEMBERS: Final = 10_000
"""Members that a zip archive may have; spreadsheets and zipped shapefiles have a dozen."""

FEW_CELLS: Final = 2**20
"""Cells that the columns of a table of features may have, however empty they are: 8 MiB."""

EMPTY_RATIO: Final = 50
"""How many cells columns of properties may have for each property that a feature has.

With keys of their own, as of OpenStreetMap, cells would grow with the square of the file.
"""

MOST_LINE: Final = 2**22
"""Characters that a line of a table of text may have: ten times a country's border as text."""

MOST_COLUMNS: Final = 2**15
"""Columns that a table of text may have: each takes 30 µs, however few its rows are. Databases hold fewer."""

MOST_SHOWN_BYTES: Final = 2**19
"""Bytes of a picture in a notebook, which is loaded whole with all its pictures; a film may have four times as many."""

MOST_SHOWN_NUMBERS: Final = 2**21
"""Coordinates of a picture in a notebook: three seconds. What it is drawn from may have 16 times as many."""

MOST_SHOWN_POINTS: Final = 2000
"""Points of a diagram that a notebook draws: in a second or two, cells ten pixels wide; more would be a grey page."""

MOST_SHOWN_SECONDS: Final = 4.0
"""Seconds that drawing the frames of a film may take in a notebook, which shows the first one otherwise."""

SHOWN_PIXELS: Final = 576
"""Longer side of a picture in a notebook, CSS pixels: six inches, which a notebook is wide where it is printed."""

SHOWN_TABLE: Final = (10, 20, 50)
"""Most rows (half of them the first, half the last), columns, and characters of a cell of a table in a notebook."""

DISSOLVE_LOSS: Final = 1e-9
"""Share of the area by which a union of cells may differ from their sum before they are taken to overlap: rounding of
corners, with room.
"""

SAME_LENGTH: Final = 1e-6
"""Share by which lengths of rows of three columns may differ and still be directions: six decimals."""
