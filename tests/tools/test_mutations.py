"""The tables of mutations fit the tree: what is to be replaced stands once, and the tests that are named exist.

Whether these tests notice is what `python -m tools.mutate` finds out, each week.
"""

import re
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from tools.mutate import ROOT, mutations

MUTATIONS = {f"{mutation.where}: {mutation.name}": mutation for mutation in mutations()}


@cache
def text(file):
    return (ROOT / file).read_text(encoding="utf-8")


@cache
def functions(file):
    return set(re.findall(r"^(?:def )?(test_\w+)(?:\(| = refused\()", text(file), re.MULTILINE))


def test_names_are_unique():
    """In the dictionary the last of equal names would hide the others."""
    names = Counter(f"{mutation.where}: {mutation.name}" for mutation in mutations())
    assert [name for name, count in names.items() if count > 1] == []


@pytest.mark.parametrize("name", MUTATIONS)
def test_it_can_be_made(name):
    mutation = MUTATIONS[name]
    assert text(mutation.file).count(mutation.old) == 1
    assert mutation.new != mutation.old
    assert mutation.caught_by
    for test in mutation.caught_by:
        file, _, function = test.partition("::")
        assert Path(file).parts[0] == "tests"
        assert function.partition("[")[0] in functions(file)
