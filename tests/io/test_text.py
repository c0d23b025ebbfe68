"""Columns of text: nothing is lost that is not asked to be."""

from fractions import Fraction

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.io.formats.columns import LONG, column, doubles, objects, plain_cells, readings, texts

KINDS = {
    "i": "1/-2/+3 9223372036854775807/1",
    "f": "1/2.5 1/ 1/NA / 0/0.5/-0.5 9007199254740992/ 0.30000000000000004/1 0.50000000000000000000/1 5e-324/1",
    "U": "NA/NA 1_2/3 \uff11\uff12/3 007/8 -07/8 9223372036854775808/1 9007199254740993/ 9007199254740993/0.5 1e400/1 "
    "0.1234567890123456789/1 1e-400/1 1.23456789e-320/1 inf/1 1,5/2 1e/2 --1/2 a/1",
}
"""Columns of cells by what becomes of them."""


@pytest.mark.parametrize(("kind", "column"), [(kind, each) for kind in KINDS for each in KINDS[kind].split(" ")])
def test_numbers_are_taken_where_doubles_hold_them(kind, column):
    cells = column.split("/")
    found = readings(np.array(cells)).get("." if "." in "".join(cells) else "", np.array(cells))
    assert found.dtype.kind == kind
    if kind == "U":
        assert found.tolist() == cells
    else:
        known = [(cell, value) for cell, value in zip(cells, found.tolist(), strict=True) if value == value]
        assert all(Fraction(cell) == Fraction(repr(value)) for cell, value in known)


@pytest.mark.parametrize(
    ("cells", "values"),
    [
        (["1,5", "2"], {",": [1.5, 2]}),
        (["1,5", ""], {",": [1.5, None]}),
        (["1.5", "2,5"], {}),
        (["1.234,5", "2"], {",": [1234.5, 2]}),
        (["1.234.567", "128,5"], {",": [1234567, 128.5]}),
        (["1.234", "2,345"], {".": [1.234, 2345], ",": [1234, 2.345]}),
        (["1.234", "0.5"], {".": [1.234, 0.5]}),
        (["1'234.5", "\u22122"], {".": [1234.5, -2]}),
        (["1\n2", "3"], {}),
    ],
)
def test_readings_by_the_decimal_mark(cells, values):
    found = readings(np.array(cells))
    assert {mark: [None if x != x else x for x in each.tolist()] for mark, each in found.items()} == values


@given(st.lists(st.one_of(st.integers(), st.floats(allow_nan=False, allow_infinity=False)), min_size=1, max_size=5))
def test_what_is_written_comes_back(values):
    cells = [repr(value) for value in values]
    numbers = next(iter(readings(np.array(cells)).values()), None)
    if numbers is None:  # the column stays text, as the double of a whole number has other digits
        assert any(Fraction(cell) != Fraction(repr(float(cell))) for cell in cells)
        return
    for cell, found in zip(cells, numbers.tolist(), strict=True):
        assert cell == found or Fraction(cell) == Fraction(repr(found))


def test_one_long_field_costs_its_own_bytes():
    cells = ["a"] * 1000 + ["x" * 50_000]
    found = texts(cells)
    assert found.dtype == object
    assert found.tolist() == cells
    assert texts(["a" * LONG] * 3).dtype.kind == "U"
    assert texts(["a" * 200] * 3).dtype.kind == "U"
    assert texts([]).tolist() == []


@pytest.mark.parametrize(
    ("kind", "values"),
    [
        *(("i", [1, 2]), ("f", [1, 2.5]), ("U", ["a", "b"]), ("b", [True, False])),
        *(("O", [n, other]) for n, other in ((2**53 + 1, None), (2**63, -1), (2**60, 0.5), ("a", None), (True, 1))),
        *(("O", values) for values in ([None, None], [{"a": 1}, [2]], [])),
    ],
)
def test_columns_of_values(kind, values):
    assert column(values).dtype.kind == kind
    assert column(values).tolist() == values
    assert column([1, None]).dtype.kind == "f"


@pytest.mark.parametrize("dtype", [np.str_, object])
def test_doubles_of_what_is_asked_for_as_numbers(dtype):
    cells = np.array([" 1,5 ", "2.25", "-", "0.1234567890123456789", "1_0", "north", "inf"], dtype=dtype)
    values, wrong = doubles(cells)
    assert wrong.tolist() == [False, False, False, False, True, True, False]
    assert values[[0, 1, 3, 6]].tolist() == [1.5, 2.25, 0.12345678901234568, np.inf]
    assert np.isnan(values[2])


def test_durations_of_pandas_are_as_others():
    assert plain_cells(objects([pd.Timedelta("1h"), None])) == ["0 days 01:00:00", None]
