"""PNG files written row by row: read by Pillow, by the rules of the format, and hardly larger than Pillow's."""

import io
import struct
import zlib

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from PIL import Image

from stereodel.data import blue_marble
from stereodel.drawing import Page, Scene, View
from stereodel.drawing.page import Dots
from stereodel.render.pixel_rows import SIGNATURE, png_chunks
from tests.refused import refused


def written(picture, parts=(), page_width=72.0):
    height, width = picture.shape[:2]
    return b"".join(png_chunks(np.split(picture, parts), width, height, page_width=page_width, texts={}))


def chunks(data):
    """Kind and content of each chunk, its sum checked."""
    assert data[:8] == SIGNATURE
    at, found = 8, []
    while at < len(data):
        (size,) = struct.unpack(">I", data[at : at + 4])
        body = data[at + 4 : at + 8 + size]
        assert data[at + 8 + size : at + 12 + size] == struct.pack(">I", zlib.crc32(body))
        found.append((body[:4], body[4:]))
        at += 12 + size
    return found


def picture(height, width, seed=0):
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3)).astype(np.uint8)


def smooth(height, width):
    y, x = np.mgrid[:height, :width]
    return np.stack([x // 3 % 256, y % 256, (x * y) // 97 % 256], axis=-1).astype(np.uint8)


@example(smooth(40, 12), [1, 5])
@example(smooth(12, 40).transpose(1, 0, 2).copy(), [])
@given(
    arrays.arrays(np.uint8, st.tuples(st.integers(1, 9), st.integers(1, 7), st.just(3))),
    st.lists(st.integers(0, 9), max_size=4),
)
def test_any_picture_in_any_parts_comes_back(pixels, cuts):
    parts = sorted(min(cut, len(pixels)) for cut in cuts)
    with Image.open(io.BytesIO(written(pixels, parts))) as image:
        assert image.mode == "RGB"
        assert np.array_equal(image, pixels)


def test_chunks_are_those_of_the_format():
    data = written(picture(5, 300), [2], page_width=72.0)
    kinds = [kind for kind, _ in chunks(data)]
    assert kinds[:2] == [b"IHDR", b"pHYs"]
    assert set(kinds[2:-1]) == {b"IDAT"}
    assert kinds[-1] == b"IEND"
    assert chunks(data)[0][1] == struct.pack(">IIBBBBB", 300, 5, 8, 2, 0, 0, 0)
    assert chunks(data)[1][1] == struct.pack(">IIB", 11811, 11811, 1)  # 300 pixels an inch in metres


@pytest.mark.parametrize(
    ("text", "kind"), [("Zürich\n\nÉtat", b"tEXt"), ("φ = 5°", b"iTXt"), ("10 000 stars ★", b"iTXt")]
)
def test_texts_are_in_the_file(text, kind):
    texts = {"Title": text, "Description": ""}
    data = b"".join(png_chunks([picture(3, 4)], 4, 3, page_width=72.0, texts=texts))
    assert [name for name, _ in chunks(data)][2:4] == [kind, b"IDAT"]
    with Image.open(io.BytesIO(data)) as image:
        assert image.text == {"Title": text}


def figure():
    """A lit ball with dots."""
    dots = Dots(np.random.default_rng(4).uniform(-1, 1, (300, 2)), 2.0, (0.8, 0.0, 0.0, 1.0), rim_width=0.5)
    return Page((-1.1, 1.1, -1.1, 1.1), (*Scene().layout(View(0, 20)), dots), width=240.0).pixels(size=500)


@pytest.mark.parametrize(
    ("draw", "share"),
    [
        (figure, 0.85),
        (lambda: np.full((256, 256, 3), 200, np.uint8), 1.0),
        (lambda: picture(3, 1)[np.random.default_rng(1).integers(0, 3, (32, 200)), 0], 1.01),  # filtered it is larger
        (lambda: picture(64, 64), 1.01),
        (lambda: blue_marble()[200:456, 800:1056], 1.06),
    ],
)
def test_files_are_no_larger_than_those_of_pillow(draw, share):
    """But for the head of the file, and for photographs and noise hardly."""
    file = io.BytesIO()
    Image.fromarray(draw()).save(file, "png")
    assert len(written(draw())) < share * len(file.getvalue()) + 100


test_rows_that_do_not_fit_or_are_missing_are_refused = refused(
    *(
        (shape, kind, r"rows has shape .*at most \(2, 4, 3\) of uint8 are left")
        for shape, kind in (((1, 5, 3), "u1"), ((1, 4, 4), "u1"), ((3, 4, 3), "u1"), ((1, 4, 3), "f8"))
    ),
    ((1, 4, 3), "u1", "1 rows of the picture are missing"),
    call=lambda shape, kind: list(png_chunks([np.zeros(shape, kind)], 4, 2, page_width=72.0, texts={})),
)
