"""The text checks of `make check`: what they see."""

import pytest

from tools import tracked_text as tracked


@pytest.mark.parametrize("line", ["x" * 121, "\tx", "x "])
def test_lines_of_cpp_are_seen(line):
    (found,) = tracked.problems("k.cpp", "x" * 120 + "\n" + line)
    assert found.startswith("k.cpp:2: ")
    assert tracked.problems("k.md", line) == []


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
