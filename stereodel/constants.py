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
"""Smallest reciprocal condition number of a triangle with barycentric coordinates in `stereodel.spatial`: as in SciPy.

At least three digits of the coordinates are then correct.
"""

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

A hundred times the rounding error of a rotated unit vector, so that a curve on the limb itself is drawn entirely; on
the page it is within 1e-24 of the limb, and of the rim of a cap of a millionth of a degree within 6e-5 radii.
"""

RIM_FINENESS: Final = 1e-3
"""Largest deviation of a chart's rim from its circle, relative to that of the curves that end on it.

If it were as coarse as they are, it would cross them, and outlines of regions would cross themselves: their ears would
cover a thousandth of the disc too much. With a rim 32 times as fine, which still has few points, the excess is below a
millionth.
"""

CHART_ROUNDING: Final = 2.0**-50
"""Rounding error of coordinates on a chart, relative to its size: four units in the last place of 1.

A loop whose area is less than that times its length has no well-defined interior and is not a region.
"""

THIN_RING: Final = 2.0**-8
"""Area of a region, relative to the square of its border's size, up to which its side is found on the sphere.

A disc has 2⁻⁴ or more. Of a strip, it is half its width over its length, and chords and arcs that deviate by more than
the width of a strip have its area negative: those of `LONGEST_EDGE`, by 2° at most.
"""

NARROW_PASSAGE: Final = 4.0
"""Distance along a border of two crossings, relative to the root of the blur, below which a thin region passes once.

Curves a distance d apart cross a circle of radius 1 that they touch at places up to √(8d) apart: computed crossings of
two sides that are closer than the blur may be in reverse order.
"""

TOUCHING: Final = 2.0**-10
"""Distance of a hole's corner from a shell, relative to the hole's size, above which they do not touch there.

Rims that are sampled differently are less than a pixel apart, a ten-thousandth of the disc.
"""

ON_BALL: Final = 1e-9
"""Distance from a sphere, relative to its radius, within which a drawn arc is taken to lie on it, and a plane to touch.

Far below a pixel, and far above the rounding errors of arcs computed through a conformal map.
"""

SPARE_PIECE: Final = 1e-9
"""Excess of an arc over a whole number of longest Bézier arcs, as a fraction of one, that adds no further Bézier.

A whole turn, whose end is a rounded sum, has twelve pieces of 30° and not thirteen; their relative error grows by 6e-9.
"""

ONE_HARMONIC: Final = 2.0**-50
"""Size of the second harmonic of a function of an angle, relative to its largest coefficient, that counts as zero.

It is the leading coefficient of the quartic of its roots. A few rounding errors of the coefficients are as large; taken
at face value they would move two of the roots arbitrarily. The function itself changes as little as its coefficients.
"""

ROOT_ON_CIRCLE: Final = 1e-4
"""Largest distance from 1 of the modulus of a computed root of the quartic of an angle, for its angle to be a root.

Coefficients are off by 2⁻⁵³: a single root by about as much, a double one (two curves that touch) by the square root, a
fourfold one by the fourth root, 1.03e-4. An angle accepted without being a root only causes a cut that separates
nothing.
"""

TOUCHING_SLOPE: Final = 1e-6
"""Slope of a function of an angle, relative to its largest coefficient, below which a root is left as it was found.

There two roots are within 1e-6 rad of each other, and Newton's step, value over slope, is rounding: more than 1e-10.
"""

KIND_TOLERANCE: Final = 2.0**-40
"""Largest distance of a `MoebiusMap` from one of its `kind`: in radians for points and images, relative for S.

A product of about a thousand maps with rounded parameters is that close to the exact one.
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
"""Fraction of a column's square that must remain after the preceding columns for its unknown to be determined.

In fits of gradients, neighbours within 1e-6 rad of a line do not determine the slope across it. Rounding leaves 1e-15.
"""

QUADRATURE_CHORD: Final = 0.2
"""Longest side of a spherical triangle over which a rule of degree five is used, as a chord: 11.5°.

The area of the whole sphere, cut into such triangles, then has a relative error of 1e-8.
"""

SEEN_FACE_ON: Final = 2.0**-240
"""Sine of the angle between a circle's axis and the view's, below which an orthographic image is a circle to a double.

Smaller sines have squares beyond the range of double-double arithmetic.
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

A few rounding errors of a computed point, 6 nanometres on Earth. Without it, rounding noise of an arc along the 180th
meridian would cut its cells into hundreds of pieces of zero width.
"""

THIN_CELL: Final = 1e-13
"""Width of a cell, radians, below which its chords are not halved to keep its sides apart on a map: 0.6 micrometres.

Points on a map are rounded to 2e-16 rad, and the two sides of such a cell are arcs between rounded points.
"""

BORDER_STEPS: Final = 2**14
"""Most chords of one cell's border that are halved at once where straight lines on a map cross each other.

A cell 90° long and 0.1 m wide takes 2¹² of them. A cell that takes more exists mainly because of rounding.
"""

FINER_WARPS: Final = (2.0**-4, 2.0**-8, 2.0**-12)
"""Fractions of the tolerance, one of which is used if the chords of a warped polygon cross: 1/16 of its width or less.

Polygons narrower than 2⁻⁸ of the tolerance, 4 m on Earth, and parts that touch at a corner may cross however fine the
chords are. What a crossing adds or takes away is within the tolerance.
"""

DEGREE_ROUNDING: Final = 2.0**-43
"""Deviation of a chord from its arc, in degrees, that may be due to rounding: four units in the last place of 180°.

Three numbers that are rounded to half a unit, and their mean, make less than two.
"""

WHOLE_TURNS: Final = 2.0**-43
"""Step of longitudes, degrees, to which whole turns are added without rounding: the last place of 512 to 1024.

Less than 2e-15 rad, or 13 nanometres on Earth.
"""

CHORD_CLEARANCE: Final = 0.125
"""Largest deviation of a chord of a cell's border, relative to its distance from the two sites on its sides.

Well below 1, so that every point lies in its own cell on a map, however close it is to the next one.
"""

LARGEST_CAP: Final = 170.0
"""Angular radius of the largest cap that a stereographic view shows, degrees.

The scale at its edge is 132 times that at the centre; a view of the whole sphere would be a point in an empty disc.
"""

PAGE_TOLERANCE: Final = 5e-5
"""Largest deviation of a chord from its curve on a globe drawn by matplotlib, relative to the visible radius.

A twentieth of a pixel at a radius of 1000 pixels, like `FLATNESS`; matplotlib draws one path at any resolution.
"""

FINEST_POINTS: Final = 0.02
"""Corners of filled regions in vector files that are closer along an outline, in points, become one.

A dot of a printer at 3600 dots per inch, which is also the tolerance of `Globe.page`.
"""

FINEST_PLACE: Final = 1e-3
"""Step of the coordinates in vector files, points: 0.35 micrometres. A shorter line is not drawn."""

FINEST_OUTLINE: Final = 5e-4
"""Largest deviation of a letter's quadratic outline from the cubic one of the font, relative to the type size.

Half a unit of such fonts, which have a thousand units: their points are rounded by as much.
"""

MOST_FRAMES: Final = 100_000
"""Largest number of frames of a film: more than an hour at 25 per second. Each takes a hundred bytes meanwhile."""

MOST_FRAME_PIXELS: Final = 2**26
"""Largest number of pixels of a frame: twice 8K. It takes 0.2 GB in each drawing process, and again for encoding."""

MOST_TEXELS: Final = 2**27
"""Pixels of the largest picture that is read or warped, 16384 × 8192: with its smaller copies it takes 1.4 GB.

Pillow has a similar limit, slightly higher.
"""

MOST_PIXELS_ACROSS: Final = 2**20
"""Largest globe in pixels across: columns and rows of a window of it stay whole in single precision."""

LONGEST_EDGE: Final = 30.0
"""Longest piece of a map's edge approximated by one great-circle arc, in degrees: far below 180."""

MOST_PIECES: Final = 64
"""Largest number of equal pieces into which an edge is cut for a lens; an edge that needs more is halved first.

Where a lens magnifies a billion times, a long edge through its focus is then a few hundred pieces, not ten million.
"""

MOST_PLACES: Final = 2**30
"""Largest number of nodes of a grid; one value at each takes 8 GB."""

GRID_ROUNDING: Final = 1e-9
"""Fraction of a step by which the last line of a grid may miss the border of its box because of rounding."""

OPPOSITE: Final = 1e-9
"""Distance of a point from another's antipode, radii, below which no great circle is taken to join the two.

Above it rounding rotates the circle between them by less than 1e-6 rad, which is invisible.
"""

CHART_TOLERANCE: Final = 1e-4
"""Default tolerance of charts, the largest deviation from the exact image, in page units: radii of the disc.

A tenth of a pixel at a radius of 1000 pixels; pages of globes give it in points instead.
"""

REACH_MARGIN: Final = 1e-6
"""Fraction of its radius by which a view is enlarged to find what cannot become visible.

Rounding then omits nothing that touches the border; a superfluous edge costs a microsecond.
"""

GRID_SAMPLES: Final = 97
"""Number of samples along a line of a grid, before a lens and again after it, between which it may end once.

A part that begins and ends between two of them is shorter than 4° of its circle, on the sphere and in its image.
"""

MOST_GRID_LINES: Final = 2**16
"""Meridians (and parallels) of one stride that a picture may take: each has 200 samples, all together 1 GB.

Near a pole of a picture there are about 35 for each least distance between lines in its radius: 16 000 for hair lines.
"""

GROUND_PIXEL: Final = 2.0**-10
"""Side of the pixel with which an image below a label is sampled for its colour, in page units: radii of the disc.

A point, 1/72 inch, is four times as large on a globe 17 cm across.
"""

AREA_SUM_ERROR: Final = 2e-12
"""How far the areas of all cells of a sphere may add up to another area, in terms of it: what each cell may be off."""

UNPACKED_SIZE: Final = 2**20
"""Bytes to which any packed file may unpack, however small it is: that of a million bytes reads in a second."""

UNPACKED_RATIO: Final = 50
"""How many times its size a packed file may unpack to; tables of measurements pack to a half or a thirtieth.

Repetition alone packs to a thousandth (gzip) or a millionth (bzip2): a kilobyte would fill the memory.
"""

MOST_MEMBERS: Final = 10_000
"""Members that a zip archive may have; spreadsheets and zipped shapefiles have a dozen."""

FEW_CELLS: Final = 2**20
"""Cells that the columns of a table of features may have, however empty they are: 8 MiB."""

EMPTY_RATIO: Final = 50
"""How many cells columns of properties may have for each property that a feature has.

With keys of their own, as in exports of OpenStreetMap, cells would grow with the square of the file.
"""

MOST_LINE: Final = 2**22
"""Characters that a line of a table of text may have: of longer ones the csv module makes eleven times as many bytes.

A country's border as text has a tenth of them.
"""

MOST_COLUMNS: Final = 2**15
"""Columns that a table of text may have: each takes 30 µs, however few its rows are. Databases hold fewer."""
