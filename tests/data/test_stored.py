"""What goes into a file comes out of it."""

import io
import lzma

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from stereodel.data import stored
from tests.examples import examples
from tools.data_files import dump


def unpacked(columns):
    return dict(np.load(io.BytesIO(lzma.decompress(dump(columns)))))


@examples(0.4)
@given(st.lists(st.integers(-(2**31), 2**31 - 1), max_size=20))
def test_integers(values):
    found = stored.integers(unpacked({"n": np.array(values, dtype=np.int64)})["n"])
    assert found.dtype == np.int32
    assert found.tolist() == values


@examples(0.4)
@given(
    st.lists(st.text(st.characters(blacklist_characters="\n\0", blacklist_categories=["Cs"])), min_size=1, max_size=9)
)
def test_texts(values):
    assert stored.texts(unpacked({"t": values})["t"]).tolist() == values


@examples(0.4)
@given(st.lists(st.integers(-180 * 10**6, 180 * 10**6), min_size=1, max_size=20))
def test_decimals_are_what_their_text_says(values):
    written = [f"{'-' * (v < 0)}{abs(v) // 10**6}.{abs(v) % 10**6:06d}" for v in values]
    found = stored.decimals(unpacked({"n": np.array(values)})["n"], 6)
    assert found.tolist() == [float(text) for text in written]


def test_the_same_bytes_every_time():
    columns = {"n": np.arange(1000), "t": ["a", "ä"]}
    assert dump(columns) == dump(columns)
