"""Names beside their places: none covers another, the first matter most, and none is left out that has room."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stereodel import MoebiusMap
from stereodel.curves.chart import Chart
from stereodel.drawing import LineStyle, View
from stereodel.drawing.page import Dots, Label, Polygons, Polylines, Stroke
from stereodel.drawing.page.labels import label_box
from stereodel.drawing.page.placing import BORDER_WEIGHT, SIDES, Placer, Seats, ink, meets
from tests.tiers import by_day

UNIT = 200.0
DISC = Chart(MoebiusMap.identity(), View(0.0, 0.0), unit=UNIT)
RED = (1.0, 0.0, 0.0, 1.0)
LEADER = LineStyle("black", 0.3)


def names(count, seed, spread=0.75):
    rng = np.random.default_rng(seed)
    places = rng.uniform(-spread, spread, (count, 2)).tolist()
    return [Label("n" * int(rng.integers(2, 12)), (x, y), size=9.0, halo=1.0) for x, y in places]


def put(labels, distance=4.0, items=(), leader=None):
    placer = Placer(DISC, items)
    return [
        item
        for label in labels
        for item in placer.place(Seats.of(label, distance, 2.0, led=leader is not None), leader)
    ]


def box(label):
    return label_box(label, UNIT)


def inside(label):
    return np.hypot(*np.abs(box(label)).max(axis=0)) + label.halo <= UNIT


@pytest.mark.parametrize("seed", by_day(range(4), 0))
def test_no_label_covers_another_and_all_are_in_the_disc(seed):
    before = [Label("title", (0.0, 0.0), size=14.0)]
    placed = put(names(80, seed), items=before)
    assert 5 < len(placed) < 80
    boxes = np.array([box(label) for label in before + placed])
    for k in range(len(boxes)):
        assert not meets(boxes[k], np.delete(boxes, k, axis=0))
        halo = np.array([[-1.0], [1.0]]) if k else 0.0
        assert not meets(boxes[k] + halo, boxes[:k])  # which would cut the type of those before
    assert all(map(inside, placed))
    for label in placed:  # beside its place, as far away as was said
        assert np.hypot(*label.offset) == pytest.approx(4.0)
        low, high = box(label) - UNIT * np.array(label.anchor)
        assert (low > 0).any() or (high < 0).any()


@pytest.mark.parametrize("seed", by_day(range(3), 1))
@pytest.mark.parametrize("leader", [None, LEADER])
def test_the_first_matter_most(seed, leader):
    """What comes later changes nothing of what stands before it."""
    labels = names(60, seed)
    all_of_them = put(labels, leader=leader)
    for count in (1, 7, 30):
        some = put(labels[:count], leader=leader)
        for one, other in zip(some, all_of_them, strict=False):
            assert type(one) is type(other)
            drawn = (each.path if isinstance(each, Stroke) else (*each.anchor, *each.offset) for each in (one, other))
            assert_allclose(*drawn)


@pytest.mark.parametrize("seed", by_day(range(3), 1))
def test_none_is_left_out_that_has_room(seed):
    labels = names(60, seed)
    placed = put(labels)
    kept = {label.anchor for label in placed}
    number = 0
    for label in labels:
        if label.anchor in kept:
            number += 1
            continue
        boxes = np.array([box(each) for each in placed[:number]]).reshape(-1, 2, 2)
        seats = Seats.of(label, 4.0)
        assert len({side.offset for side in seats.labels}) == len(SIDES)
        taken = meets(seats.rooms + UNIT * np.array(label.anchor), boxes)
        assert all(full or not inside(side) for full, side in zip(taken, seats.labels, strict=True))


@pytest.mark.parametrize("seed", by_day(range(6), 0))
def test_leaders_meet_nothing(seed):
    """In a cluster too dense for its names: neither one another, nor a name, nor a dot but that they lead from."""
    labels = names(40, seed, spread=0.3)
    dots = Dots(np.array([label.anchor for label in labels]), 2.0, RED)
    items = put(labels, items=[dots], leader=LEADER)
    lines = UNIT * np.array([item.path[[0, -1], [0, 3]] for item in items if isinstance(item, Stroke)])
    shown = [item for item in items if isinstance(item, Label)]
    assert len(lines) >= 3
    assert len(shown) > len(put(labels, items=[dots]))
    samples = np.linspace(lines[:, 0], lines[:, 1], 100, axis=1)
    for line, others in ((k, np.delete(samples, k, axis=0).reshape(-1, 2)) for k in range(len(lines))):
        assert np.hypot(*np.moveaxis(samples[line][:, None] - others, -1, 0)).min() > 1.0
    boxes = np.array([box(label) for label in shown])
    outside = np.maximum(boxes[:, 0] - samples[:, :, None], samples[:, :, None] - boxes[:, 1]).max(axis=-1)
    assert outside.min() > 1.0
    away = np.hypot(*np.moveaxis(samples[:, :, None] - UNIT * dots.centers, -1, 0))
    assert away.min() > 2.0
    ends = iter(lines)
    for item, label in pairwise(items):
        if isinstance(item, Stroke):  # from beside the dot to beside the name
            start, end = next(ends)
            assert np.hypot(*(start - UNIT * np.array(label.anchor))) == pytest.approx(3.0)
            low, high = box(label)
            assert 1.0 < np.hypot(*np.maximum(np.maximum(low - end, end - high), 0.0)) < 2.001


def test_dots_and_lines_are_avoided_and_large_dots_never_hidden():
    """To the right there is a dot, to the left none; lines count less, and a cloud of tiny dots less than one."""
    assert put([Label("far too long for this disc" * 9, (0.0, 0.0))]) == []
    label = Label("Ulm", (0.0, 0.0))
    (free,) = put([label])
    assert (free.offset, free.align) == ((4.0, 0.0), "left")
    (off,) = Placer(DISC, ()).place(Seats.of(replace(label, halo=1.0), 4.0, 12.0))  # the dot that it names
    assert off.offset == (13.0, 0.0)
    middles = np.array([box(side).mean(axis=0) / UNIT for side in Seats.of(label, 4.0).labels])
    (aside,) = put([label], items=[Dots(middles[:1], 1.8, RED)])
    assert (aside.offset, aside.align) == ((-4.0, 0.0), "right")
    assert put([label], items=[Dots(middles, 1.8, RED)]) == []
    (covering,) = put([label], items=[Dots(middles, 0.7, RED)])
    assert covering.offset == (4.0, 0.0)
    right = np.array([middles[0] - (0, 0.1), middles[0] + (0, 0.1)])
    for line in (Polylines(right, np.array([0, 2]), RED, 1.0), Stroke(np.linspace(*right, 4)[None], RED, 1.0)):
        (aside,) = put([label], items=[line, Dots(middles[2:], 1.8, RED)])
        assert aside.offset == (-4.0, 0.0)
        (over,) = put([label], items=[line, Dots(middles[1:], 1.8, RED)])
        assert over.offset == (4.0, 0.0)


@pytest.mark.parametrize("seed", by_day(range(5), 0))
def test_ink_is_what_is_counted_within_boxes(seed):
    rng = np.random.default_rng(seed)
    points = rng.uniform(-0.6, 0.6, (30, 2))
    lines = Polylines(points, np.array([0, 3, 17, 30]), (0.0, 0.0, 0.0, 0.5), 0.8)
    dots = Dots(points, 1.5, RED)
    closed = np.concatenate([points[:5], points[:1]])
    land = Polygons(closed, np.array([0, 6]), np.array([0]), np.array([RED]))
    placer = Placer(DISC, [dots, lines, land, Label("no ink", (0.0, 0.0))])
    corners = np.sort(rng.integers(-360, 360, (40, 2, 2)) / 2, axis=1)  # on borders of cells
    weight, length = np.pi * 1.5**3, 0.0
    everything = placer.under(np.array([[-200.0, -200.0], [200.0, 200.0]]))
    for part, width in ((lines.points[:3], 0.4), (points[3:17], 0.4), (points[17:], 0.4), (closed, BORDER_WEIGHT)):
        length += width * UNIT * np.hypot(*np.diff(part, axis=0).T).sum()
    assert_allclose(everything, [30 * weight, length], rtol=1e-9)
    for found, items in zip(placer.under(corners), ([dots], [lines, land]), strict=True):
        places = np.concatenate([ink(item, UNIT) for item in items], axis=1)
        for (low, high), value in zip(corners, found, strict=True):
            within = ((low <= places[:2].T) & (high > places[:2].T)).all(axis=1)
            assert value == pytest.approx(places[2, within].sum(), abs=1e-6)


def test_a_name_on_its_place_moves_a_little_from_a_coast():
    """The name of a sea, to where it crosses less."""
    sea = Label("sea", (0.0, 0.0), size=8.0)
    (still,) = put([sea], distance=0.0)
    assert still.offset == (0.0, 0.0)
    coast = np.array([[-0.5, 0.0], [0.5, 0.0]])
    (moved,) = put([sea], distance=0.0, items=[Polylines(coast, np.array([0, 2]), RED, 0.5)])
    assert 0 < np.hypot(*moved.offset) < 2 * sea.size
    low, high = box(moved)
    assert low[1] > 0 or high[1] < 0


def test_names_turn_to_where_the_disc_has_room():
    label = Label("a name", (0.9, 0.0), (4.0, 0.0), "left", "center", 9.0, halo=1.0)

    def fixed(place, unit=100.0, items=()):
        (found,) = Placer(replace(DISC, unit=unit), items).place(Seats.of(replace(label, anchor=place), None))
        return found

    turned = fixed((0.9, 0.0))
    assert (turned.align, turned.offset, turned.halo) == ("right", (-4.0, 0.0), 1.0)
    assert np.hypot(*np.abs(label_box(turned, 100.0)).max(axis=0)) < 100.0
    assert fixed((0.0, 0.0)).align == "left"
    # Near the top of the disc there is room below the place alone.
    top = fixed((0.0, 0.94))
    assert (top.align, top.valign, top.offset, top.halo) == ("center", "top", (0.0, -4.0), 1.0)
    # Without room on any side a halo would cut the limb.
    bare = fixed((-0.9, 0.0), 15.5)
    assert (bare.halo, bare.offset) == (0, label.offset)
    # Dots and lines move only what is movable.
    middle = np.array([label_box(fixed((0.0, 0.0)), 1.0).mean(axis=0) / 100.0])
    assert fixed((0.0, 0.0), items=[Dots(middle, 3.0, RED)]).offset == label.offset
