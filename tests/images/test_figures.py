"""The nets over every figure and animation: what is drawn is what was stored.

T0 compares the arrays, T1 the hash of the pixels, T2 the pixels where T1 differs, T3 the type, label by label
(`tools.baselines`). What fails is shown in out/report, a file each. `make baselines` alone changes what is
stored.
"""

import numpy as np
import pytest

from stereodel.render.pixel_rows import LabelLayer
from tests.images.report import in_short, report_failure, report_pass
from tests.images.scripts import ROOT, SCRIPTS, STORE, by_script, cases, thorough_but_for
from tools.baselines import ARRAYS, SIZE, case_names

pytestmark = pytest.mark.images

REPORT = ROOT / "out" / "report"


@by_script
def test_a_script_draws_what_was_stored(script):
    wrong = []
    for case in cases(script):
        messages = STORE.otherwise(case)
        if messages:
            report_failure(STORE, case, messages, REPORT)
            wrong += [case.name, *(f"  {message}" for message in in_short(messages))]
        else:
            report_pass(case.name, REPORT)
    if wrong:
        pytest.fail("\n".join([*wrong, f"see {REPORT}"]), pytrace=False)


@by_script
def test_a_drawing_is_named_after_its_script(script):
    assert [case.name for case in cases(script)] == case_names(script)


@by_script
def test_no_text_is_cut_off(script):
    for case in cases(script):
        if case.page.labels:
            ink = LabelLayer(case.page, SIZE).rows()[..., 3]
            assert ink.any()
            border = np.concatenate([ink[0], ink[-1], ink[:, 0], ink[:, -1]])
            assert not border.any(), case.name


@thorough_but_for("fig03_bubbles", "globe_europe")
def test_labels_lie_together_where_each_lies_alone(script):
    for case in cases(script):
        if case.page.labels:
            ink = LabelLayer(case.page, SIZE).rows()[..., 3] > 0
            boxes = case.ink[~np.isnan(case.ink).any(axis=1)] * (SIZE / case.page.width)
            for left, bottom, right, top in boxes:
                # Two pixels more: the boxes hold what is at least half as strong.
                rows = slice(max(0, int(len(ink) - top) - 2), int(len(ink) - bottom) + 3)
                ink[rows, max(0, int(left) - 2) : int(right) + 3] = False
            assert not ink.any(), case.name


def test_nothing_is_stored_that_no_script_draws():
    names = sorted(name for script in SCRIPTS for name in case_names(script))
    assert sorted(STORE.hashes) == sorted(STORE.labels) == names
    assert sorted(path.name for path in STORE.folder.iterdir()) == sorted(
        [*(f"{name}.{kind}" for name in names for kind in (ARRAYS, "png")), "labels.json", "pixels.json"]
    )
