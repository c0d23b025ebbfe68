"""The page on files: its examples run one after the other and print what it says."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[2] / "docs" / "files.md"


@pytest.mark.thorough
def test_examples_print_what_the_page_says(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    for kind, code in re.findall(r"```(python|text)\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL):
        if kind == "python":
            exec(compile(code, PAGE.name, "exec"), names)
        else:
            assert capsys.readouterr().out.rstrip() == code.rstrip()
