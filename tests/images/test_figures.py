"""The three nets over every figure and animation: what is drawn is what was stored.

T0 compares the arrays, T1 the hash of the pixels, T2 the pixels where T1 differs (`stereodel.render.baselines`). What
fails is shown in out/report/index.html. `make baselines` alone changes what is stored.
"""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from stereodel.render.baselines import SIZE, Store, case_names, cases_of
from stereodel.render.build import find_scripts
from stereodel.render.labels import label_layer
from stereodel.render.report import report_failure, withdraw_failure

pytestmark = pytest.mark.images

ROOT = Path(__file__).parents[2]
SCRIPTS = find_scripts(ROOT / "figures")
STORE = Store(Path(__file__).parent / "baselines")
REPORT = ROOT / "out" / "report"

by_script = pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)


@cache
def cases(script):
    return cases_of(script)


@by_script
def test_a_script_draws_what_was_stored(script):
    found = {}
    for case in cases(script):
        messages = [*STORE.drawn_otherwise(case), *STORE.looks_otherwise(case)]
        if messages:
            report_failure(STORE.failure(case, messages), REPORT)
            found[case.name] = messages[:8]
        else:
            withdraw_failure(case.name, REPORT)
    assert found == {}, f"see {REPORT / 'index.html'}"


@by_script
def test_a_drawing_is_named_after_its_script(script):
    assert [case.name for case in cases(script)] == case_names(script)


@by_script
def test_no_text_is_cut_off(script):
    for case in cases(script):
        if case.page.labels:
            ink = label_layer(case.page, SIZE)[..., 3]
            assert ink.any()
            border = np.concatenate([ink[0], ink[-1], ink[:, 0], ink[:, -1]])
            assert not border.any(), case.name


def test_nothing_is_stored_that_no_script_draws():
    names = sorted(name for script in SCRIPTS for name in case_names(script))
    assert sorted(STORE.hashes) == names
    assert sorted(path.name for path in STORE.folder.iterdir()) == sorted(
        [*(f"{name}.{kind}" for name in names for kind in ("npz", "png")), "pixels.json"]
    )
