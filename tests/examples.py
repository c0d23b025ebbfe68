"""How many examples a property is tried on: a share of what the tier asks for (tests/conftest.py)."""

from hypothesis import settings


def examples(share):
    """For properties whose examples take longer than some 10 milliseconds: that share of the tier's number."""
    return settings(max_examples=max(5, round(share * settings().max_examples)))
