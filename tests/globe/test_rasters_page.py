"""The page on rasters says what is so: its code runs, on smaller pictures, and writes its file."""

import re
from pathlib import Path

PAGE = (Path(__file__).parents[2] / "docs" / "rasters.md").read_text(encoding="utf-8")


def test_the_code_of_the_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    for code in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
        exec(compile(code.replace("1200", "120").replace("512", "64"), "rasters.md", "exec"), names)
    assert [path.name for path in tmp_path.iterdir()] == ["paris.png"]
    assert names["pixels"].shape == (120, 120, 4)
    assert names["desk"].shape == (1024, 2048, 4)
    assert names["faces"].shape == (6, 64, 64, 4)
    assert names["planet"].shape == (1024, 1024, 4)
