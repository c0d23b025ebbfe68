"""The scripts whose pictures are tested, what they draw, and what was stored."""

from functools import lru_cache
from pathlib import Path

import pytest

from tests.figures import scripts
from tests.tiers import by_day
from tools.baselines import Case, Store, cases_of
from tools.build import find_scripts

ROOT = Path(__file__).parents[2]
SCRIPTS = find_scripts(ROOT / "figures")
STORE = Store(Path(__file__).parent / "baselines")

by_script = pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)


def thorough_but_for(*names):
    """Each script, of which only those are drawn by day."""
    some = [script for script in SCRIPTS if script.stem in names]
    return pytest.mark.parametrize("script", by_day(SCRIPTS, *some), ids=lambda script: script.stem)


@lru_cache(maxsize=2)
def cases(script):
    """The cases of a script, drawn once, as its tests follow each other; figures are those that `tests.figures` has."""
    name = script.stem
    if "FIGURE" not in scripts.script(name):
        return cases_of(script)
    figure = scripts.script(name)["FIGURE"]
    return [Case(figure.name, scripts.page(name), scripts.geometry(name), figure.renderer)]


def case(name):
    """A case by its name: that of a script, or of a script and a frame."""
    (script,) = [script for script in SCRIPTS if name.startswith(script.stem)]
    (found,) = [case for case in cases(script) if case.name == name]
    return found
