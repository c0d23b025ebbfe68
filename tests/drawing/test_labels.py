"""Names beside their places: none covers another, the first matter most, and none is left out that has room."""

import numpy as np
import pytest

from stereodel.drawing.page import Label
from stereodel.drawing.page.labels import SIDES, claimed, in_disc, label_box, meets, on_its_sides, placed_apart
from tests.tiers import by_day

UNIT = 200.0
DISC = ((0.0, 0.0), 1.0, UNIT)


def names(count, seed):
    rng = np.random.default_rng(seed)
    places = rng.uniform(-0.75, 0.75, (count, 2)).tolist()
    return [Label("n" * int(rng.integers(2, 12)), (x, y), size=9.0, halo=1.0) for x, y in places]


def box(label):
    return label_box(label, UNIT)


@pytest.mark.parametrize("seed", by_day(range(4), 0))
def test_no_label_covers_another_and_all_are_in_the_disc(seed):
    before = [Label("title", (0.0, 0.0), size=14.0)]
    placed = placed_apart(names(80, seed), 4.0, DISC, before=before)
    assert 5 < len(placed) < 80
    boxes = np.array([box(label) for label in before + placed])
    for k in range(len(boxes)):
        assert not meets(boxes[k], np.delete(boxes, k, axis=0))
        halo = np.array([[-1.0], [1.0]]) if k else 0.0
        assert not meets(boxes[k] + halo, boxes[:k])  # which would cut the type of those before
    assert all(in_disc(label, DISC) for label in placed)
    for label in placed:
        # Beside its place, as far away as was said or three quarters of that along both axes.
        assert np.hypot(*label.offset) in (pytest.approx(4.0), pytest.approx(3.0 * np.sqrt(2)))
        low, high = box(label) - UNIT * np.array(label.anchor)
        assert (low > 0).any() or (high < 0).any()


@pytest.mark.parametrize("seed", by_day(range(3), 1))
def test_the_first_matter_most(seed):
    """What comes later changes nothing of what stands before it."""
    labels = names(60, seed)
    all_of_them = placed_apart(labels, 4.0, DISC)
    for count in (1, 7, 30):
        some = placed_apart(labels[:count], 4.0, DISC)
        first = {label.anchor for label in labels[:count]}
        expected = [(label.anchor, label.offset) for label in all_of_them if label.anchor in first]
        assert [(label.anchor, label.offset) for label in some] == expected


@pytest.mark.parametrize("seed", by_day(range(3), 1))
def test_none_is_left_out_that_has_room(seed):
    labels = names(60, seed)
    placed = placed_apart(labels, 4.0, DISC)
    kept = {label.anchor for label in placed}
    number = 0
    for label in labels:
        if label.anchor in kept:
            number += 1
            continue
        boxes = np.array([box(each) for each in placed[:number]]).reshape(-1, 2, 2)
        sides = list(on_its_sides(label, 4.0))
        assert len({side.offset for side in sides}) == len(SIDES)
        assert all(meets(claimed(side, UNIT), boxes) or not in_disc(side, DISC) for side in sides)


def test_dots_are_covered_last():
    """To the right there is a dot, to the left none; where all sides have one, the right side comes first."""
    assert placed_apart([Label("far too long for this disc" * 9, (0.0, 0.0))], 4.0, DISC) == []
    label = Label("Ulm", (0.0, 0.0))
    (free,) = placed_apart([label], 4.0, DISC)
    assert (free.offset, free.align) == ((4.0, 0.0), "left")
    dot = np.array([box(free).mean(axis=0) / UNIT])
    (aside,) = placed_apart([label], 4.0, DISC, dots=dot)
    assert (aside.offset, aside.align) == ((-4.0, 0.0), "right")
    every = np.array([box(side).mean(axis=0) / UNIT for side in on_its_sides(label, 4.0)])
    (covering,) = placed_apart([label], 4.0, DISC, dots=every)
    assert covering.offset == (4.0, 0.0)
