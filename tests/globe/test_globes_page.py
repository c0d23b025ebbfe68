"""The page on globes says what is so: its code runs in order, prints what stands there, and writes its files."""

import re
from pathlib import Path

PAGE = (Path(__file__).parents[2] / "docs" / "globes.md").read_text(encoding="utf-8")
README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def test_the_code_of_the_page(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for code in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
        exec(compile(code, "globes.md", "exec"), names)
    (printed,) = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
    assert capsys.readouterr().out == printed
    assert {path.name for path in tmp_path.iterdir()} == {"paris.png", "marble.png", "airports.svg", "halves.pdf"}
    assert len(names["page"].views) == 3


def test_the_globe_of_the_readme(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (code,) = (code for code in re.findall(r"```python\n(.*?)```", README, re.DOTALL) if "Globe" in code)
    exec(compile(code.replace('"10m"', '"110m"'), "README.md", "exec"), {})
    assert [path.name for path in tmp_path.iterdir()] == ["new_york.svg"]
