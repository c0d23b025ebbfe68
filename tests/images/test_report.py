"""The sheet of pictures that changed."""

import numpy as np
import pytest

from tests.images.report import Failure, difference_picture, report_failure, withdraw_failure


@pytest.fixture
def white():
    return np.full((100, 100, 3), 255, dtype=np.uint8)


def test_the_difference_is_red_where_it_can_be_seen(white):
    other = white.copy()
    other[0, 0] = 0
    other[1, 1] = 250
    marked = difference_picture(white, other)
    assert marked[0, 0].tolist() == [220, 0, 0]
    assert marked[1, 1].tolist() == [240, 160, 0]
    assert np.ptp(marked[5, 5]) == 0


def test_pictures_of_other_shapes_are_compared_where_both_are(white):
    assert difference_picture(white, white[:50, :70]).shape == (50, 70, 3)


def test_the_report_holds_all_failures_in_one_file(tmp_path, white):
    other = white.copy()
    other[:50] = 0
    report_failure(Failure("fig02", ("T2: <half> of it",), white, other), tmp_path)
    sheet = report_failure(Failure("fig01", ("T0: missing",), None, white), tmp_path)
    text = sheet.read_text(encoding="utf-8")
    assert text.index("fig01") < text.index("fig02")
    assert text.count("data:image/png;base64,") == 4
    assert "T2: &lt;half&gt; of it" in text
    assert "http" not in text


def test_what_passes_again_leaves_the_report(tmp_path, white):
    for name in ("fig01", "fig02"):
        sheet = report_failure(Failure(name, ("T1",), white, white), tmp_path)
    withdraw_failure("fig01", tmp_path)
    withdraw_failure("fig09", tmp_path)
    text = sheet.read_text(encoding="utf-8")
    assert "fig01" not in text
    assert "fig02" in text
