"""Lines and rings clipped at any border; rings closed along it.

Rings have their region on the left. Cut at the border they fall into chains that run from border to border. Going
counterclockwise along the border, the chart on the left, one enters a region wherever a chain *ends* and leaves one
wherever a chain *starts*: deeper by one or less deep by one, whatever overlaps what. To close the chains is therefore
to sort: **the i-th end is joined to the (i + w)-th start**, both counted along the border, where w is how deep its
first place is. Nothing is searched for, a region may have any number of chains, and all regions are closed at once.

Two things are left to tell, and signed areas tell both, without a point to ask for:

* w is what makes the border nowhere less than outside: minus the smallest sum of ends and starts passed.
* A chart that a region surrounds without touching the border is inside when the loops on it have a negative area
  together (holes without a shell). Where nothing of a region's border is in sight, the same question is asked of the
  hidden rings, on the chart that shows all but the middle of the view, unless the caller knows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.curves.borders import Outline, Pieces
from stereodel.curves.ragged import Ragged, cycles, offsets_of, spans
from stereodel.curves.trace import Arcs


@dataclass(frozen=True, eq=False)
class Chains:
    """Runs of pieces between cuts; a piece that is run backwards has the number ~piece."""

    pieces: Ragged
    row: Indices
    """(m,): the line or ring that each is a part of."""
    whole: BoolArray
    """(m,): closed, and nowhere cut."""
    seen: BoolArray


def chains_of(sides: Ragged, pieces: Pieces) -> Chains:
    """Lines and rings, given by their edges (~edge where backwards), as chains of pieces."""
    arcs = pieces.arcs
    # Pieces are in the order of their edges: those of an edge are a stretch, run from its end where it is backwards.
    edge, back = np.maximum(sides.values, ~sides.values), sides.values < 0
    none = len(pieces.of_edge) - 1  # edges behind the last that has pieces
    first, last = (pieces.of_edge[np.minimum(edge + k, none)] for k in (0, 1))
    piece = spans(np.where(back, last - 1, first), last - first, np.where(back, -1, 1))
    run = Ragged(np.where(np.repeat(back, last - first), ~piece, piece), offsets_of(last - first)[sides.offsets])
    # A closed line has no beginning of its own: it is begun at its first cut.
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
    """Rows of edges without those that are not chosen; the others are numbered anew, as `Edges.take` does.

    Edges out of sight may be left out before lines and rings are clipped: there are no ends of chains among them.
    """
    number = np.cumsum(chosen) - 1
    edge = np.maximum(rows.values, ~rows.values)
    return Ragged(np.where(rows.values < 0, ~number[edge], number[edge]), rows.offsets).kept(chosen[edge])


def points_along(chains: Ragged, samples: Ragged) -> Ragged:
    """Points of chains from the samples of their pieces, of which neighbours share their ends."""
    piece, back = np.maximum(chains.values, ~chains.values), chains.values < 0
    counts = samples.sizes[piece] - 1
    counts[chains.offsets[1:][chains.sizes > 0] - 1] += 1  # the last piece of a chain brings its end
    start = np.where(back, samples.offsets[piece + 1] - 1, samples.offsets[piece])
    points = samples.values[spans(start, counts, np.where(back, -1, 1))]
    return without_repeats(Ragged(points, offsets_of(counts)[chains.offsets]))


def lines(sides: Ragged, pieces: Pieces, samples: Ragged, border: Outline) -> tuple[Ragged, Indices]:
    """What is in sight of lines, on the chart, and the line that each part belongs to."""
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
    middle: BoolArray | None = None,
) -> tuple[Ragged, Indices]:
    """What is in sight of regions with their rings' left inside: closed loops on the chart, and the region of each.

    Parameters
    ----------
    rings : Ragged
        Edges of each ring.
    owner : (r,) array
        The region of each ring.
    count : int
        Of regions.
    pieces, samples
        The edges' arcs, cut by the border, and points of them.
    middle : (count,) array, optional
        Which regions hold the middle of the view. Where this is known, edges that are hidden from end to end may be
        left out of the rings.
    """
    loops, region, shown = in_sight(rings, owner, count, pieces, samples, border)
    if middle is None:
        hidden = np.zeros(count, dtype=bool)
        hidden[owner[rings.sizes > 0]] = True
        middle = surround(rings, owner, hidden & ~shown, pieces, samples)
    return bordered(loops, region, middle & (np.bincount(region, minlength=count) == 0), border)


def in_sight(
    rings: Ragged, owner: Indices, count: int, pieces: Pieces, samples: Ragged, border: Outline
) -> tuple[Ragged, Indices, BoolArray]:
    """As `regions`, but that regions of whose rings nothing is in sight are left out: `surround` may ask for them.

    So edges out of sight may be missing. Also returned is which regions have a part of a ring in sight (count,).
    """
    chains = chains_of(rings, pieces)
    region = owner[chains.row]
    # What runs along the border is the border's business: closing the rest brings it back, where it belongs.
    head = chains.pieces.values[chains.pieces.offsets[:-1]]
    drawn = chains.seen & ~_flag(pieces.along, pieces.along, head)
    points = points_along(chains.pieces.take(drawn), samples)
    flat, whole = Ragged(border.flat(points), points.offsets), chains.whole[drawn]
    shown = region[drawn]
    joined, closed_by = closed_along(border, flat.take(~whole), shown[~whole])
    loops = together(flat.take(whole), joined)
    loop_owner = np.concatenate([shown[whole], closed_by])
    area, length = signed_areas(loops)
    # A region thinner than its chords stray may come out clockwise at the border, as if it went round all the rest;
    # what it then overlaps its neighbours by is as thin. Counterclockwise it stays, or there would be a gap.
    blur = np.where(np.arange(len(loops)) < whole.sum(), 0.0, border.blur)
    there = (area > length * border.slack) | (area < -length * (border.slack + blur))
    loops, loop_owner = loops.take(there), loop_owner[there]
    around = np.bincount(loop_owner, area[there], minlength=count) < 0
    loops, loop_owner = bordered(loops, loop_owner, around, border)
    return loops, loop_owner, np.bincount(region[chains.seen], minlength=count) > 0


def bordered(loops: Ragged, owner: Indices, around: BoolArray, border: Outline) -> tuple[Ragged, Indices]:
    """Loops, and the whole border for each region that goes round all else."""
    regions = np.flatnonzero(around)
    if not len(regions):
        return loops, owner
    return together(loops, Ragged.of([border.once()] * len(regions))), np.concatenate([owner, regions])


def surround(rings: Ragged, owner: Indices, asked: BoolArray, pieces: Pieces, samples: Ragged) -> BoolArray:
    """Which of some regions (count,), no ring of which is in sight, hold all that is in sight.

    Projected from the middle of the view all that is hidden lies about the origin, mirrored, and the middle of the view
    at infinity: inside where the areas have a positive sum.
    """
    chosen = asked[owner]
    if not chosen.any():
        return np.zeros_like(asked)
    chains = chains_of(rings.take(chosen), pieces)
    points = points_along(chains.pieces, samples)
    x, y, z = points.values.T
    area, _ = signed_areas(Ragged(np.stack([x, y], axis=1) / (1 - z)[:, None], points.offsets))
    total = np.bincount(owner[chosen][chains.row], area, minlength=len(asked))
    return asked & (total > 0)


def closed_along(border: Outline, chains: Ragged, owner: Indices) -> tuple[Ragged, Indices]:
    """Loops of chains (k, 2) from border to border, each region's closed along it; and the region of each loop."""
    if not len(chains):
        return chains, owner
    starts = border.place(chains.values[chains.offsets[:-1]])
    ends = border.place(chains.values[chains.offsets[1:] - 1])
    follower, stop = followers(starts, ends, border.length, owner)
    # Loops alternate between chains, in the first half of the rows, and walks along the border, in the second.
    loops = cycles(follower)
    rows = together(chains, border.between(ends, stop)).take((loops.values[:, None] + [0, len(chains)]).ravel())
    closed = without_repeats(with_first_again(Ragged(rows.values, rows.offsets[2 * loops.offsets])))
    return closed, owner[loops.values[loops.offsets[:-1]]]


def followers(starts: FloatArray, ends: FloatArray, length: float, owner: Indices) -> tuple[Indices, FloatArray]:
    """For each chain the one that follows it in its loop, and the place at which that starts, counted on from its end.

    Parameters
    ----------
    starts, ends : (n,) arrays
        Places of the chains' ends along a border.
    length : float
        Once round the border.
    owner : (n,) array
        The region of each chain: it has as many starts as ends.
    """
    # How deep: +1 behind an end, −1 behind a start; at the same place the end comes first, so that what only touches
    # the border closes there. The sums begin at 0 again with each region.
    region, place, kind = np.tile(owner, 2), np.concatenate([ends, starts]), np.repeat([0, 1], len(owner))
    order = np.lexsort((kind, place, region))
    depth = np.cumsum(1 - 2 * kind[order])
    first = np.flatnonzero(np.append(True, np.diff(region[order]) > 0))
    deep = np.maximum(0, -np.minimum.reduceat(depth, first))
    # The i-th end of a region to its (i + deep)-th start, which may be one or more times round the border.
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
    """Rows of points without those that are equal to the one before them."""
    fresh = np.ones(len(rows.values), dtype=bool)
    fresh[1:] = (rows.values[1:] != rows.values[:-1]).any(axis=1)
    fresh[rows.offsets[:-1][rows.sizes > 0]] = True
    return rows.kept(fresh)


def with_first_again(loops: Ragged) -> Ragged:
    """Loops whose first point comes again at their end."""
    order = np.insert(np.arange(len(loops.values)), loops.offsets[1:], loops.offsets[:-1])
    return Ragged(loops.values[order], loops.offsets + np.arange(len(loops) + 1))


def _flag(opens: BoolArray, shuts: BoolArray, directed: Indices) -> BoolArray:
    """Whether pieces begin at a cut, run as they are run."""
    return np.where(directed < 0, shuts[~directed], opens[directed])


def _begin(arcs: Arcs, directed: Indices) -> FloatArray:
    return np.where((directed < 0)[:, None], arcs.end[~directed], arcs.start[directed])
