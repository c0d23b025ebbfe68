"""The kernel's tests in stages: which of them leave open what, and that none is wrong."""

import numpy as np
import pytest

OPEN = 2
STAGES = ["filter", "double_double", "exact", "all"]


def third_by_day(cases):
    """Parameters of a test, two of three of them left to the thorough tier."""
    cases = [case if isinstance(case, tuple) else (case,) for case in cases]
    return [pytest.param(*case, marks=pytest.mark.thorough if k % 3 else ()) for k, case in enumerate(cases)]


def shares_of(truth, signs_of, stages=STAGES):
    """No stage is ever wrong, the last ones are never open. The share that each leaves open."""
    shares = {}
    for stage in stages:
        signs = signs_of(stage)
        assert ((signs == truth) | (signs == OPEN)).all(), stage
        shares[stage] = (signs == OPEN).mean()
    assert {shares[stage] for stage in stages if stage in ("exact", "all")} == {0}
    return shares


class Predicates(dict):
    """By name: the kernel's function of rows of points and stage, the exact sign of one row, and how many points."""

    def check(self, name, points, **options):
        """`points` (4, k, d), of which the first are taken. The share that each stage leaves open, and the signs."""
        predicate, oracle, count = self[name]
        points = np.ascontiguousarray(points[:count])
        truth = np.array([oracle(*row) for row in points.transpose(1, 0, 2).tolist()])
        return shares_of(truth, lambda stage: predicate(*points, stage=stage, **options)), truth
