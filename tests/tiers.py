"""Which cases of a test run by day."""

import pytest


def by_day(cases, *some):
    """Cases as parameters: those of some run by day, all others are thorough."""
    assert set(some) <= set(cases)
    return [case if case in some else pytest.param(case, marks=pytest.mark.thorough) for case in cases]
