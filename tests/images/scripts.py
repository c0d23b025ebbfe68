"""The scripts whose pictures are tested, what they draw, and what was stored."""

from functools import cache
from pathlib import Path

import pytest

from tools.baselines import Store, cases_of
from tools.build import find_scripts

ROOT = Path(__file__).parents[2]
SCRIPTS = find_scripts(ROOT / "figures")
STORE = Store(Path(__file__).parent / "baselines")

by_script = pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)


@cache
def cases(script):
    """The cases of a script, drawn once a process."""
    return cases_of(script)


def case(name):
    """A case by its name: that of a script, or of a script and a frame."""
    (script,) = [script for script in SCRIPTS if name.startswith(script.stem)]
    (found,) = [case for case in cases(script) if case.name == name]
    return found
