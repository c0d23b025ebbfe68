"""Which cases of a test run by day."""

import pytest


def by_day(cases, *some):
    """Cases as parameters, tuples as several: those of some run by day, all others are thorough."""
    assert all(case in cases for case in some)
    rows = ((case, case if isinstance(case, tuple) else (case,)) for case in cases)
    return [pytest.param(*row, marks=() if case in some else pytest.mark.thorough) for case, row in rows]
