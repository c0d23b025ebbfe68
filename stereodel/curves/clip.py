"""Lines and rings clipped at any border; rings closed along it.

Rings have their region on the left. Cut at the border, they fall into chains that run from border to border. Along the
border counterclockwise, with the chart on the left, a region is entered wherever a chain *ends* and left wherever a
chain *starts*, so the depth changes by ±1 even where rings overlap. Closing the chains is therefore a matter of
sorting: **the i-th end is joined to the (i + w)-th start**, both counted along the border, where w is the depth at its
first position. No search is needed, a region may have any number of chains, and all regions are closed at once.

Two questions remain:

* w is such that the depth is never negative: minus the smallest running sum of ends and starts.
* A chart that a region surrounds without touching the border is inside when the loops on it have a negative area
  together (holes without a shell). Where nothing of a region's border is in sight, the same question is asked of the
  hidden rings, on the sphere without the middle of the view, unless the caller knows.

Loops are chords, and a region thinner than their deviation has an area of any sign, and two ends in any order. Whatever
such an area cannot tell, the rings themselves do, as they are on the sphere (`Edges.left`): an area a little above zero
is that of a thin region, a little below zero, or a whole sphere, that of all the rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.constants import CHART_ROUNDING, NARROW_PASSAGE, THIN_RING
from stereodel.curves.borders import UP, Outline, Pieces
from stereodel.curves.ragged import Ragged, cycles, offsets_of, spans
from stereodel.curves.trace import Arcs, fans


@dataclass(frozen=True, eq=False)
class Chains:
    """Runs of pieces between cuts; a reversed piece has the index ~piece."""

    pieces: Ragged
    row: Indices
    """(m,): the line or ring of each chain."""
    whole: BoolArray
    """(m,): whether it is closed and not cut."""
    seen: BoolArray


def chains_of(sides: Ragged, pieces: Pieces) -> Chains:
    """Lines and rings, given by their edges (~edge if reversed), as chains of pieces."""
    arcs = pieces.arcs
    # Pieces are in the order of their edges: those of an edge are contiguous, and in reverse for a reversed edge.
    edge, back = np.maximum(sides.values, ~sides.values), sides.values < 0
    none = len(pieces.of_edge) - 1  # edges after the last that has pieces
    first, last = (pieces.of_edge[np.minimum(edge + k, none)] for k in (0, 1))
    piece = spans(np.where(back, last - 1, first), last - first, np.where(back, -1, 1))
    run = Ragged(np.where(np.repeat(back, last - first), ~piece, piece), offsets_of(last - first)[sides.offsets])
    # A closed line has no start of its own: it starts at its first cut.
    held = run.sizes > 0
    heads, tails = run.values[run.offsets[:-1][held]], run.values[run.offsets[1:][held] - 1]
    closed = np.zeros(len(run), dtype=bool)
    closed[held] = (_begin(arcs, heads) == _begin(arcs, ~tails)).all(axis=1)
    at = np.flatnonzero(_flag(pieces.opens, pieces.shuts, run.values))
    turn = np.zeros(len(run), dtype=np.intp)
    turn[run.row[at[::-1]]] = at[::-1] - run.offsets[run.row[at[::-1]]]
    run = run.rotated(np.where(closed, turn, 0))
    # Chains begin at cuts and at the beginnings of rows.
    cut = _flag(pieces.opens, pieces.shuts, run.values)
    begins = cut.copy()
    begins[run.offsets[:-1][held]] = True
    starts = np.flatnonzero(begins)
    row = run.row[starts]
    head = run.values[starts]
    return Chains(
        Ragged(run.values, np.append(starts, len(run.values))),
        row,
        closed[row] & ~cut[starts],
        pieces.seen[np.maximum(head, ~head)],
    )


def among(rows: Ragged, chosen: BoolArray) -> Ragged:
    """Rows with only the chosen edges, renumbered as by `Edges.take`: hidden ones have no ends of chains."""
    number = np.cumsum(chosen) - 1
    edge = np.maximum(rows.values, ~rows.values)
    return Ragged(np.where(rows.values < 0, ~number[edge], number[edge]), rows.offsets).kept(chosen[edge])


def points_along(chains: Ragged, samples: Ragged) -> Ragged:
    """Points of chains from the samples of their pieces, whose shared endpoints are not repeated."""
    piece, back = np.maximum(chains.values, ~chains.values), chains.values < 0
    counts = samples.sizes[piece] - 1
    counts[chains.offsets[1:][chains.sizes > 0] - 1] += 1  # the last piece of a chain includes its endpoint
    start = np.where(back, samples.offsets[piece + 1] - 1, samples.offsets[piece])
    points = samples.values[spans(start, counts, np.where(back, -1, 1))]
    return without_repeats(Ragged(points, offsets_of(counts)[chains.offsets]))


def lines(sides: Ragged, pieces: Pieces, samples: Ragged, border: Outline) -> tuple[Ragged, Indices]:
    """The visible parts of lines, on the chart, and the line of each part."""
    chains = chains_of(sides, pieces)
    points = points_along(chains.pieces.take(chains.seen), samples)
    long = points.sizes > 1
    return Ragged(border.flat(points), points.offsets).take(long), chains.row[chains.seen][long]


def regions(
    rings: Ragged,
    owner: Indices,
    count: int,
    pieces: Pieces,
    samples: Ragged,
    border: Outline,
    left: FloatArray | None = None,
) -> tuple[Ragged, Indices]:
    """The visible parts of regions, interior left of their rings: closed loops on the chart, and the region of each.

    rings, owner, count: edges of each ring; the region of each, (r,); number of regions.
    pieces, samples: the arcs of the edges, cut at the border, and their points.
    left: what `Edges.left` says of the rings, (r, 3); without it, chords alone decide.
    """
    left = np.full((len(rings), 3), np.nan) if left is None else left
    loops, region, shown = in_sight(rings, owner, count, pieces, samples, border, left)
    hidden = np.zeros(count, dtype=bool)
    hidden[owner[rings.sizes > 0]] = True
    around = surround(rings, owner, hidden & ~shown, pieces, samples, border, left)
    return bordered(loops, region, around, border)


def in_sight(
    rings: Ragged, owner: Indices, count: int, pieces: Pieces, samples: Ragged, border: Outline, left: FloatArray
) -> tuple[Ragged, Indices, BoolArray]:
    """As for `regions`, but for those whose rings are hidden, for `surround`; also which have a ring in sight."""
    chains = chains_of(rings, pieces)
    region = owner[chains.row]
    # Parts along the border are dropped: closing the other chains restores them where needed.
    piece = np.maximum(chains.pieces.values, ~chains.pieces.values)
    off = np.bincount(chains.pieces.row, ~pieces.along[piece], minlength=len(chains.row)) > 0
    drawn = chains.seen & (off | chains.whole)
    points = points_along(chains.pieces.take(drawn), samples)
    flat, whole = Ragged(border.flat(points), points.offsets), chains.whole[drawn]
    shown = region[drawn]
    of_ring, (of_region, narrow) = _known(left), _known(_by_region(left, owner, count))
    unit = border.length / (2 * np.pi)
    # Sides that coincide, as at the 180th meridian, cross the border where rounding has put either of them.
    least = np.where(narrow, NARROW_PASSAGE * unit * np.sqrt(border.blur), 8 * border.slack)[shown[~whole]]
    joined, closed_by = closed_along(border, flat.take(~whole), shown[~whole], least)
    # A part at the border may become clockwise, as if its region surrounded everything else; its overlap with
    # neighbours is equally thin, so it is left out, or turned where it may be all there is of a thin region.
    part, length = signed_areas(joined)
    error = length * border.blur * unit
    kept = (part > length * border.slack) | (part < -length * border.slack - error)
    turned = ~kept & (np.abs(part) > length * border.slack) & ((narrow > 0) & (of_region > 0))[closed_by]
    # A ring that may run clockwise for the same reason is turned to run as it does on the sphere.
    uncut, ring_owner = flat.take(whole), shown[whole]
    side, reach = fans(UP, points.take(whole))
    told = np.copysign(side, _told(side, reach, reach * border.blur, of_ring[:, chains.row[drawn][whole]]))
    area, length = signed_areas(uncut)
    there = np.abs(area) > length * border.slack
    loops = together(uncut.reversed(told * area < 0).take(there), joined.reversed(turned).take(kept | turned))
    loop_owner = np.concatenate([ring_owner[there], closed_by[kept | turned]])

    def total(owner: Indices, values: FloatArray) -> FloatArray:
        return np.bincount(owner, values, minlength=count).astype(np.float64)

    # With parts at the border, their order along it has told what the region surrounds, unless it is thin.
    on_chart = total(closed_by[kept], part[kept]) + total(ring_owner[there], np.copysign(area, told)[there])
    blurred = total(closed_by, error) + total(ring_owner, length * border.blur * unit)
    seen, reach = total(ring_owner, told), total(ring_owner, reach)
    on_sphere = _told(seen, reach, reach * border.blur, np.stack([of_region, narrow]))
    on_chart = np.where((narrow > 0) & (np.abs(on_chart) < blurred), of_region, on_chart)
    around = np.where(total(closed_by, np.ones(len(joined))) > 0, on_chart, on_sphere) < 0
    loops, loop_owner = bordered(loops, loop_owner, around, border)
    return loops, loop_owner, np.bincount(shown, minlength=count) > 0


def _by_region(left: FloatArray, owner: Indices, count: int) -> FloatArray:
    """The sums over the rings of each region."""
    return np.stack([np.bincount(owner, a, minlength=count) for a in left.T], axis=1)


def _known(left: FloatArray) -> FloatArray:
    """Areas of rings or regions less whole spheres, NaN if larger than a quarter of one, and which are thin: (2, n)."""
    area, size, length = left.T
    area = area - 4 * np.pi * np.rint(area / (4 * np.pi))
    area[np.abs(area) > np.pi] = np.nan
    sure = np.where(np.abs(area) <= CHART_ROUNDING * size, 0.0, area)
    return np.stack([sure, np.abs(area) <= THIN_RING * length**2])


def _told(area: FloatArray, length: FloatArray, error: FloatArray, known: FloatArray) -> FloatArray:
    """Areas (n,), where they are in doubt and thin by what is `_known`."""
    # What is not thin keeps its side however large the error: a lens may make a dot of nearly the whole sphere.
    on_sphere, thin = known
    doubt = (np.abs(area) < error) & ((np.abs(area) <= THIN_RING * length**2) | (thin > 0)) & ~np.isnan(on_sphere)
    return np.where(doubt, on_sphere, area)


def bordered(loops: Ragged, owner: Indices, around: BoolArray, border: Outline) -> tuple[Ragged, Indices]:
    """Loops, with the whole border added for each region that surrounds the chart."""
    regions = np.flatnonzero(around)
    if not len(regions):
        return loops, owner
    return together(loops, Ragged.of([border.once()] * len(regions))), np.concatenate([owner, regions])


def surround(
    rings: Ragged, owner: Indices, asked: BoolArray, pieces: Pieces, samples: Ragged, border: Outline, left: FloatArray
) -> BoolArray:
    """Which of some regions (count,) without visible rings contain the whole visible part."""
    # The areas between rings and the place opposite the centre of the view, on their left, add up to that of the
    # region, or, if it contains the centre, to that less a whole sphere.
    chosen = asked[owner]
    if not chosen.any():
        return np.zeros_like(asked)
    chains = chains_of(rings.take(chosen), pieces)
    points = points_along(chains.pieces, samples)
    (area, length), (same, _) = fans(-UP, points), fans(UP, points)
    # To the opposite place, angles cancel about the centre; unless a ring goes round that, the area to it is the same.
    near = (np.abs(same - area) < 2 * np.pi) & (points.values[points.offsets[:-1], 2] > 0)
    area = np.where(near, same, area)
    region = owner[chosen][chains.row]
    total, reach = (np.bincount(region, of, minlength=len(asked)).astype(np.float64) for of in (area, length))
    known = _known(_by_region(left[chosen], owner[chosen], len(asked)))
    return asked & (_told(total, reach, reach * border.blur, known) < 0)


def closed_along(
    border: Outline, chains: Ragged, owner: Indices, least: FloatArray | float = 0.0
) -> tuple[Ragged, Indices]:
    """Loops of chains (k, 2) from border to border, closed along it for each region, and the region of each."""
    if not len(chains):
        return chains, owner
    starts = border.place(chains.values[chains.offsets[:-1]])
    ends = border.place(chains.values[chains.offsets[1:] - 1])
    follower, stop = followers(starts, ends, border.length, owner, least)
    # Loops alternate between chains, in the first half of the rows, and walks along the border, in the second.
    loops = cycles(follower)
    rows = together(chains, border.between(ends, stop)).take((loops.values[:, None] + [0, len(chains)]).ravel())
    closed = without_repeats(with_first_again(Ragged(rows.values, rows.offsets[2 * loops.offsets])))
    return closed, owner[loops.values[loops.offsets[:-1]]]


def followers(
    starts: FloatArray, ends: FloatArray, length: float, owner: Indices, least: FloatArray | float = 0.0
) -> tuple[Indices, FloatArray]:
    """For each chain its successor in the loop, and the position at which that starts, counted onwards from its end.

    starts, ends: positions of the chains' ends along a border of this length; owner: the region of each chain.
    least: distance between neighbouring positions of a region below which their order does not tell its depth.
    """
    # Depth: +1 after an end, −1 after a start; at equal positions the end comes first, so that chains that only touch
    # the border close there. The sums restart at 0 for each region.
    region, place, kind = np.tile(owner, 2), np.concatenate([ends, starts]), np.repeat([0, 1], len(owner))
    order = np.lexsort((kind, place, region))
    depth = np.cumsum(1 - 2 * kind[order])
    first = np.flatnonzero(np.append(True, np.diff(region[order]) > 0))
    ahead = np.diff(place[order], append=0.0)
    ahead[np.append(first[1:], len(order)) - 1] = np.inf
    lasting = ahead >= np.tile(np.broadcast_to(least, owner.shape), 2)[order]
    deep = -np.minimum.reduceat(np.where(lasting, depth, 0), first)
    # The i-th end of a region to its (i + deep)-th start, which may be one or more turns around the border.
    by_end, by_start = np.lexsort((ends, owner)), np.lexsort((starts, owner))
    base, size = first // 2, np.diff(np.append(first, 2 * len(owner))) // 2
    group = np.repeat(np.arange(len(base)), size)
    target = np.arange(len(owner)) - base[group] + deep[group]
    chosen = by_start[base[group] + target % size[group]]
    follower, stop = np.empty_like(by_end), np.empty(len(owner))
    follower[by_end], stop[by_end] = chosen, starts[chosen] + length * (target // size[group])
    return follower, stop


def signed_areas(loops: Ragged) -> tuple[FloatArray, FloatArray]:
    """Areas of closed loops (m,), positive counterclockwise, and their lengths."""
    points = loops.values - np.repeat(loops.values[loops.offsets[:-1]], loops.sizes, axis=0)
    after = loops.following
    step = points[after] - points
    cross = points[:, 0] * step[:, 1] - points[:, 1] * step[:, 0]
    row, count = loops.row, len(loops)
    area: FloatArray = np.bincount(row, cross, minlength=count) / 2
    return area, np.bincount(row, np.hypot(*step.T), minlength=count).astype(np.float64)


def together(a: Ragged, b: Ragged) -> Ragged:
    """The rows of both."""
    return Ragged(np.concatenate([a.values, b.values]), np.concatenate([a.offsets, a.offsets[-1] + b.offsets[1:]]))


def without_repeats(rows: Ragged) -> Ragged:
    """Rows of points without points equal to their predecessors."""
    fresh = np.ones(len(rows.values), dtype=bool)
    fresh[1:] = (rows.values[1:] != rows.values[:-1]).any(axis=1)
    fresh[rows.offsets[:-1][rows.sizes > 0]] = True
    return rows.kept(fresh)


def with_first_again(loops: Ragged) -> Ragged:
    """Loops with the first point repeated at the end."""
    order = np.insert(np.arange(len(loops.values)), loops.offsets[1:], loops.offsets[:-1])
    return Ragged(loops.values[order], loops.offsets + np.arange(len(loops) + 1))


def _flag(opens: BoolArray, shuts: BoolArray, directed: Indices) -> BoolArray:
    """Whether directed pieces begin at a cut."""
    return np.where(directed < 0, shuts[~directed], opens[directed])


def _begin(arcs: Arcs, directed: Indices) -> FloatArray:
    return np.where((directed < 0)[:, None], arcs.end[~directed], arcs.start[directed])
