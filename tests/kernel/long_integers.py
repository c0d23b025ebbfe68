"""Integers of many digits for the kernel, which takes them to the base 2^30."""

from hypothesis import strategies as st

BASE = 2**30


def digits(number):
    """The highest first, all with the sign of the number."""
    size, sign, out = abs(number), -1 if number < 0 else 1, []
    while size:
        out.insert(0, sign * (size % BASE))
        size //= BASE
    return out


def integers(bits, least=0):
    """Of any length, and where carries run through whole limbs."""
    power = st.builds(lambda e, d: 2**e + d, st.integers(0, bits), st.integers(-2, 2))
    return st.integers(least, 2**bits) | power.filter(lambda n: n >= least)
