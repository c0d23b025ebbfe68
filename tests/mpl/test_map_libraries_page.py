"""The page on map libraries: its examples run one after the other, print what it says and make its pictures."""

import re
from pathlib import Path

import matplotlib.pyplot as plt

DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_examples_print_what_the_page_says(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = (DOCS / "map_libraries.md").read_text(encoding="utf-8")
    names = {}
    for kind, code in re.findall(r"```(python|text)\n(.*?)```", text, re.DOTALL):
        if kind == "python":
            exec(compile(code, "map_libraries.md", "exec"), names)
        else:
            assert capsys.readouterr().out.rstrip() == code.rstrip()
    plt.close("all")
    pictures = re.findall(r"\{image\} images/(\S+)", text)
    assert pictures
    assert all((tmp_path / name).is_file() and (DOCS / "images" / name).is_file() for name in pictures)
