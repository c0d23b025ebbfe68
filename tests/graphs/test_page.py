"""The examples of docs/graphs.md print what the page says."""

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "graphs.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```python\n(.*?)```\s+```text\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize(("code", "printed"), EXAMPLES)
def test_example(code, printed, capsys):
    exec(compile(code, "docs/graphs.md", "exec"), {})
    assert capsys.readouterr().out.split() == printed.split()


def test_all_examples_are_seen():
    assert len(EXAMPLES) == PAGE.count("```python") == 5
