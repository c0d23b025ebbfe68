"""The size and text checks of `make check`: that they count right, and what they say about this repository."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


def tool(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


sizes = tool("code_sizes")
tracked = tool("tracked_text")

SOURCE = '''\
"""A module's docstring
does not count."""

def outer(
    x,
):
    """Nor does a function's,
    however long.
    """
    # nor a comment

    text = """a string that
    is code"""

    def inner():
        return x
    return inner
'''


def test_code_lines_are_counted():
    assert list(sizes.function_lengths(SOURCE)) == [("outer", 4, 8), ("inner", 15, 2)]


def body(lines):
    return "def f():\n" + "    x = 1\n" * (lines - 1)


@pytest.mark.parametrize(
    ("sources", "words"),
    [
        ([body(61), *[body(2)] * 30], "m0:1 f: 61 lines of code"),
        ([*[body(31)] * 2, *[body(2)] * 17], "2 of 19 functions are over 30"),
        ([body(11)] * 3, "longer than 11 lines"),
        (["\n" * 400], "m0: 400 lines"),
    ],
)
def test_each_limit_is_seen(sources, words):
    (found,) = sizes.problems({f"m{number}": text for number, text in enumerate(sources)})
    assert words in found


def test_files_of_the_kernel_are_counted():
    assert len(sizes.read([str(ROOT / "stereodel" / "kernel")], ".hpp", ".cpp")) > 2
    assert sizes.kernel_problems({"k.cpp": "\n" * 400, "k.hpp": "\n" * 399}) == ["k.cpp: 400 lines, at most 399"]


@pytest.mark.parametrize("line", ["x" * 121, "\tx", "x "])
def test_lines_of_the_kernel_are_seen(line):
    (found,) = sizes.kernel_problems({"k.cpp": "x" * 120 + "\n" + line})
    assert found.startswith("k.cpp:2: ")


def test_what_keeps_the_limits_passes():
    assert sizes.problems({"a": body(60) + body(10) * 5, "b": "\n" * 399, "c": body(30) + body(10) * 5}) == []


def test_this_repository_keeps_the_limits():
    line = [sys.executable, "tools/code_sizes.py", "stereodel", "figures"]
    ran = subprocess.run(line, cwd=ROOT, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


@pytest.mark.parametrize(
    ("name", "text", "what"),
    [
        ("a.md", "see /ho" + "me/me/file", "absolute path"),
        ("a.toml", "index = 'https://py" + "pi.org/simple'", "package index"),
        ("a.py", "x = 1  # TO" + "DO later", "unfinished"),
        ("constraints.txt", "numpy>=2", "name==version"),
    ],
)
def test_text_checks_see(name, text, what):
    (found,) = tracked.problems(name, text)
    assert what in found


def test_text_checks_let_pass():
    assert tracked.problems("constraints.txt", "numpy==2.4.6\nruff==0.17.5") == []
    assert tracked.problems("a.py", "#!/usr/bin/env bash\nPath('/usr/lib')\n'out/home/x'") == []
