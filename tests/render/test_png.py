"""PNG files written row by row: read by Pillow, by the rules of the format, and not larger than Pillow's."""

import io
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from PIL import Image

from stereodel.render.png import SIGNATURE, PngWriter, filtered


def written(picture, parts=(), page_width=72.0):
    file = io.BytesIO()
    writer = PngWriter(file, picture.shape[1], picture.shape[0], page_width=page_width)
    for rows in np.split(picture, parts):
        writer.write(rows)
    writer.finish()
    return file.getvalue()


def decoded(data):
    with Image.open(io.BytesIO(data)) as image:
        assert image.mode == "RGB"
        return np.asarray(image)


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


@given(
    arrays.arrays(np.uint8, st.tuples(st.integers(1, 9), st.integers(1, 7), st.just(3))),
    st.lists(st.integers(0, 9), max_size=4),
)
def test_any_picture_in_any_parts_comes_back(pixels, cuts):
    parts = sorted(min(cut, len(pixels)) for cut in cuts)
    assert np.array_equal(decoded(written(pixels, parts)), pixels)


def packed(data):
    return zlib.decompress(b"".join(body for kind, body in chunks(data) if kind == b"IDAT"))


def test_rows_are_filtered_where_that_makes_files_smaller():
    colors = np.array([[200, 30, 90], [10, 180, 0], [255, 255, 255]], dtype=np.uint8)
    flat = colors[np.random.default_rng(1).integers(0, 3, (32, 200))]
    kinds = np.frombuffer(packed(written(np.concatenate([flat, smooth(32, 200)]))), dtype=np.uint8)[:: 200 * 3 + 1]
    assert set(kinds[:32]) == {0}
    assert 0 not in set(kinds[32:])


def test_chunks_are_those_of_the_format():
    data = written(picture(5, 300), [2], page_width=72.0)
    kinds = [kind for kind, _ in chunks(data)]
    assert kinds[:2] == [b"IHDR", b"pHYs"]
    assert set(kinds[2:-1]) == {b"IDAT"}
    assert kinds[-1] == b"IEND"
    assert chunks(data)[0][1] == struct.pack(">IIBBBBB", 300, 5, 8, 2, 0, 0, 0)
    assert chunks(data)[1][1] == struct.pack(">IIB", 11811, 11811, 1)  # 300 pixels an inch in metres


def test_the_print_size_is_in_the_file():
    with Image.open(io.BytesIO(written(picture(3, 600), page_width=144.0))) as image:
        assert image.info["dpi"] == pytest.approx((300, 300), abs=0.02)


def defiltered(lines, width):
    """Rows from filtered ones, byte by byte, as the specification has it."""
    rows = np.zeros((len(lines) + 1, width * 3 + 3), dtype=int)  # a row above and a pixel at the left of zeros
    for y, (kind, *line) in enumerate(lines.tolist(), start=1):
        for x, value in enumerate(line, start=3):
            a, b, c = rows[y, x - 3], rows[y - 1, x], rows[y - 1, x - 3]
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            rows[y, x] = (value + [0, a, b, (a + b) // 2, nearest][kind]) % 256
    return rows[1:, 3:].reshape(len(lines), width, 3)


@pytest.mark.parametrize("pixels", [picture(20, 9), smooth(40, 12), smooth(12, 40).transpose(1, 0, 2).copy()])
def test_filters_are_undone_by_the_rules(pixels):
    lines = filtered(pixels, np.zeros((1, *pixels.shape[1:]), dtype=np.uint8))
    assert np.array_equal(defiltered(lines, pixels.shape[1]), pixels)


def test_each_kind_of_filter_is_chosen_where_it_is_best():
    nothing = np.zeros((1, 64, 3), dtype=np.uint8)
    noise = picture(1, 64)
    assert filtered(np.arange(192, dtype=np.uint8).reshape(1, 64, 3), nothing)[0, 0] == 1
    assert filtered(noise, noise)[0, 0] == 2
    assert filtered(np.zeros_like(noise), noise)[0, 0] == 0
    half = np.zeros_like(noise)
    for x in range(1, 64):
        half[0, x] = (half[0, x - 1].astype(int) + noise[0, x]) // 2
    assert filtered(half, noise)[0, 0] == 3
    # As above at the left, as before at the right.
    above, below = noise.copy(), noise.copy()
    above[:, 32:], below[:, 32:] = 0, 100
    assert filtered(below, above)[0, 0] == 4


@pytest.mark.parametrize("pixels", [smooth(256, 256), np.full((256, 256, 3), 200, dtype=np.uint8), picture(64, 64)])
def test_files_are_not_larger_than_those_of_pillow(pixels):
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "png")
    assert len(written(pixels)) < 1.05 * len(file.getvalue()) + 100


@pytest.mark.parametrize(
    "rows",
    [
        np.zeros((1, 5, 3), dtype=np.uint8),
        np.zeros((1, 4, 4), dtype=np.uint8),
        np.zeros((3, 4, 3), dtype=np.uint8),
        np.zeros((1, 4, 3)),
    ],
)
def test_rows_that_do_not_fit_are_refused(rows):
    writer = PngWriter(io.BytesIO(), 4, 2, page_width=72.0)
    with pytest.raises(ValueError, match=r"rows has shape .*at most \(2, 4, 3\) of uint8 are left"):
        writer.write(rows)


def test_a_file_without_all_its_rows_is_not_finished():
    writer = PngWriter(io.BytesIO(), 4, 2, page_width=72.0)
    writer.write(np.zeros((1, 4, 3), dtype=np.uint8))
    with pytest.raises(ValueError, match="1 rows of the picture are missing"):
        writer.finish()
