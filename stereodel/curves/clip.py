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
    """Rows with only the chosen edges, renumbered as by `Edges.take`.

    Hidden edges may be left out before lines and rings are clipped, since they contain no ends of chains.
    """
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
    middle: BoolArray | None = None,
) -> tuple[Ragged, Indices]:
    """The visible parts of regions, interior left of their rings: closed loops on the chart, and the region of each.

    Parameters
    ----------
    rings : Ragged
        Edges of each ring.
    owner : (r,) array
        The region of each ring.
    count : int
        Number of regions.
    pieces, samples : Pieces, Ragged
        The arcs of the edges, cut at the border, and their points.
    middle : (count,) array, optional
        Which regions contain the centre of the view. If this is known, edges that are hidden throughout may be left out
        of the rings.
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
    """As for `regions`, without regions whose rings are entirely hidden, which `surround` handles.

    Hidden edges may therefore be missing. Also returns which regions have a visible part of a ring (count,).
    """
    chains = chains_of(rings, pieces)
    region = owner[chains.row]
    # Parts along the border are dropped: closing the other chains restores them where needed.
    head = chains.pieces.values[chains.pieces.offsets[:-1]]
    drawn = chains.seen & ~_flag(pieces.along, pieces.along, head)
    points = points_along(chains.pieces.take(drawn), samples)
    flat, whole = Ragged(border.flat(points), points.offsets), chains.whole[drawn]
    shown = region[drawn]
    joined, closed_by = closed_along(border, flat.take(~whole), shown[~whole])
    loops = together(flat.take(whole), joined)
    loop_owner = np.concatenate([shown[whole], closed_by])
    area, length = signed_areas(loops)
    # A region thinner than the deviation of its chords may become clockwise at the border, as if it surrounded
    # everything else. Its overlap with neighbours is equally thin, so it is kept counterclockwise to avoid a gap.
    blur = np.where(np.arange(len(loops)) < whole.sum(), 0.0, border.blur)
    there = (area > length * border.slack) | (area < -length * (border.slack + blur))
    loops, loop_owner = loops.take(there), loop_owner[there]
    around = np.bincount(loop_owner, area[there], minlength=count) < 0
    loops, loop_owner = bordered(loops, loop_owner, around, border)
    return loops, loop_owner, np.bincount(region[chains.seen], minlength=count) > 0


def bordered(loops: Ragged, owner: Indices, around: BoolArray, border: Outline) -> tuple[Ragged, Indices]:
    """Loops, with the whole border added for each region that surrounds the chart."""
    regions = np.flatnonzero(around)
    if not len(regions):
        return loops, owner
    return together(loops, Ragged.of([border.once()] * len(regions))), np.concatenate([owner, regions])


def surround(rings: Ragged, owner: Indices, asked: BoolArray, pieces: Pieces, samples: Ragged) -> BoolArray:
    """Which of some regions (count,) without visible rings contain the whole visible part.

    Projected from the centre of the view, the hidden part lies around the origin, mirrored, and the centre of the view
    is at infinity: it is inside if the sum of areas is positive.
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
    """Loops of chains (k, 2) from border to border, closed along it for each region; and the region of each loop."""
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
    """For each chain its successor in the loop, and the position at which that starts, counted onwards from its end.

    Parameters
    ----------
    starts, ends : (n,) arrays
        Positions of the chains' ends along a border.
    length : float
        Length of the border.
    owner : (n,) array
        The region of each chain, which has as many starts as ends.
    """
    # Depth: +1 after an end, −1 after a start; at equal positions the end comes first, so that chains that only touch
    # the border close there. The sums restart at 0 for each region.
    region, place, kind = np.tile(owner, 2), np.concatenate([ends, starts]), np.repeat([0, 1], len(owner))
    order = np.lexsort((kind, place, region))
    depth = np.cumsum(1 - 2 * kind[order])
    first = np.flatnonzero(np.append(True, np.diff(region[order]) > 0))
    deep = np.maximum(0, -np.minimum.reduceat(depth, first))
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
