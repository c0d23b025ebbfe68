"""Settings of all tests: how many examples a property gets, what runs in one process, and where the time goes."""

import ctypes
import os
import re
import sys
from collections import Counter
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

ROOT = Path(__file__).resolve().parent.parent

# `benchmarks` and `tools` are folders of the repository and not installed.
sys.path.insert(0, str(ROOT))

# No deadline: the first call of a test may load a library or meet a busy machine. In CI the same examples every time.
for profile, examples in {"quick": 25, "thorough": 500}.items():
    settings.register_profile(profile, deadline=None, max_examples=examples, derandomize=bool(os.environ.get("CI")))
settings.load_profile("quick")  # `make test-thorough` takes the other by --hypothesis-profile


@pytest.fixture
def rng():
    """Random numbers, in every test from the beginning."""
    return np.random.default_rng(7)


@pytest.fixture
def patience():
    """By what limits on seconds are multiplied: the kernel with sanitizers is several times as slow."""
    return float(os.environ.get("STEREODEL_TEST_PATIENCE", "1"))


@pytest.fixture
def no_other_fonts(monkeypatch):
    """As if the machine had no fonts but those that matplotlib ships."""
    from stereodel.drawing.page import fonts

    monkeypatch.setattr(fonts, "_others", list)
    fonts._families.cache_clear()
    yield
    fonts._families.cache_clear()


SCRIPT = re.compile(r"[\[-]((?:fig\d\d|claim|globe|earth|sky|anim)_\w+)")
"""The name of a figure's script among the parameters of a test."""

ALONE = re.compile("test_soak|test_ten_thousand")
"""Tests of which each case takes a minute and shares nothing: whichever process is free takes the next."""

QUICK_SECONDS = 6.0
"""A quick test that takes longer is named: three times the two seconds of the rule, as machines are busy."""

THOROUGH_SECONDS = 90.0
"""A test with the marker `thorough`, or a property on 500 examples, that takes longer is named, too."""


def scope(nodeid):
    """The name of those tests that run in one process with a test."""
    file, _, test = nodeid.partition("::")
    if ALONE.match(test):
        return nodeid
    script = SCRIPT.search(test)
    return script[1] if script else "browser" if file.startswith("tests/web/") else file


@pytest.hookimpl(optionalhook=True)  # there may be no pytest-xdist
def pytest_xdist_make_scheduler(config, log):
    """The tests of a file run in one process, which makes once what they share; so do all tests of a figure, and all of
    the page.
    """
    from xdist.scheduler import LoadScopeScheduling

    class Together(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return scope(nodeid)

    return Together(config, log)


def pytest_runtest_teardown(item, nextitem):
    """After the last test of a file or figure, give back what the library keeps of the Earth's coasts in 1:10 million,
    and what C's allocator keeps: half a gigabyte.
    """
    if nextitem is None or scope(item.nodeid) != scope(nextitem.nodeid):
        if outlines := sys.modules.get("stereodel.globe.outlines_on_sphere"):
            for kept in vars(outlines).values():
                getattr(kept, "cache_clear", list)()
        with suppress(AttributeError, OSError, TypeError):  # where it is not glibc's
            ctypes.CDLL(None).malloc_trim(0)


times = Counter()
"""Seconds of each test that ran, what prepared and ended it included."""

thorough = set()
"""Which of them have the marker."""


def pytest_runtest_logreport(report):
    times[report.nodeid] += report.duration
    if "thorough" in report.keywords:
        thorough.add(report.nodeid)


def keep_times(terminalreporter):
    """Write what each test took when it last ran, the slowest first, and name those that have outgrown their tier."""
    kept = ROOT / "build" / "test-times.tsv"
    kept.parent.mkdir(exist_ok=True)
    before = [line.split("\t", 1) for line in kept.read_text().splitlines()] if kept.is_file() else []
    known = Counter({test: float(seconds) for seconds, test in before} | times)
    kept.write_text("".join(f"{seconds:.2f}\t{test}\n" for test, seconds in known.most_common()))
    many = terminalreporter.config.getoption("hypothesis_profile") == "thorough"
    outgrown = [
        f"{seconds:5.1f} s  {test}"
        for test, seconds in times.most_common()
        if seconds > (THOROUGH_SECONDS if many or test in thorough else QUICK_SECONDS)
    ]
    if outgrown:
        terminalreporter.section("too slow for their tier: mark them thorough, or make them quicker (CONTRIBUTING.md)")
        for line in outgrown:
            terminalreporter.line(line)


STORED = Path(__file__).resolve().parent / "images" / "baselines"
"""Pictures of the image tests; the source archive has none."""

collect_ignore = [] if STORED.is_dir() else ["images/test_figures.py"]

WEB_SWITCH = "STEREODEL_TEST_WEB"
"""Where this variable of the environment is "off", tests that need a browser or Node are left out."""

NEED_THE_SWITCH = {"browser", "visit", "node", "fresh_node"}
"""The fixtures that start one."""


def pytest_collection_modifyitems(config, items):
    if os.environ.get(WEB_SWITCH) != "off":
        return
    off = [item for item in items if NEED_THE_SWITCH & set(getattr(item, "fixturenames", ()))]
    config.hook.pytest_deselected(items=off)
    items[:] = [item for item in items if item not in off]


def pytest_terminal_summary(terminalreporter):
    """Say what was switched off, so that nobody takes a run without it for a whole one, and where the time went."""
    keep_times(terminalreporter)
    if os.environ.get(WEB_SWITCH) == "off":
        terminalreporter.section("switched off")
        terminalreporter.line(f"Tests that need a browser or Node were left out, because {WEB_SWITCH}=off.")
    if not STORED.is_dir():
        terminalreporter.section("no stored pictures")
        terminalreporter.line(
            "Pictures were not compared: the source archive has none to compare with, the repository has them."
        )
