"""Rows of different lengths: every operation on all rows at once against the same on a list of lists."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from stereodel.curves.ragged import Ragged, cycles

ROWS = st.lists(st.lists(st.integers(0, 9), max_size=4), max_size=6)


def ragged(rows):
    return Ragged.of([np.array(row, dtype=int) for row in rows], np.zeros(0, dtype=int))


def lists(rows):
    return [row.tolist() for row in rows]


@given(ROWS)
def test_rows_come_back(rows):
    made = ragged(rows)
    assert lists(made) == rows
    assert len(made) == len(rows)
    assert made.sizes.tolist() == [len(row) for row in rows]
    assert made.row.tolist() == [number for number, row in enumerate(rows) for _ in row]
    assert lists(Ragged.grouped(made.values, made.row, len(rows))) == rows


@given(ROWS, st.data())
def test_some_rows_and_some_values(rows, data):
    made = ragged(rows)
    some = data.draw(st.lists(st.integers(0, len(rows) - 1), max_size=8)) if rows else []
    assert lists(made.take(np.array(some, dtype=np.intp))) == [rows[k] for k in some]
    mask = np.array([len(row) % 2 == 0 for row in rows], dtype=bool)
    assert lists(made.take(mask)) == [row for row in rows if len(row) % 2 == 0]
    assert lists(made.kept(made.values > 4)) == [[value for value in row if value > 4] for row in rows]


@given(ROWS, st.integers(0, 3))
def test_rows_as_rings(rows, turn):
    made = ragged(rows)
    first = np.array([turn % max(1, len(row)) for row in rows], dtype=np.intp)
    assert lists(made.rotated(first)) == [row[k:] + row[:k] for row, k in zip(rows, first, strict=True)]
    after = made.values[made.following] if len(made.values) else made.values
    assert lists(Ragged(after, made.offsets)) == [row[1:] + row[:1] for row in rows]


@given(st.permutations(range(12)))
def test_cycles_of_a_permutation(order):
    successor = np.array(order)
    found = lists(cycles(successor))
    assert sorted(member for cycle in found for member in cycle) == list(range(12))
    assert [cycle[0] for cycle in found] == sorted(min(cycle) for cycle in found)
    for cycle in found:
        assert [order[member] for member in cycle] == cycle[1:] + cycle[:1]
