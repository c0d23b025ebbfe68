"""The module of WebAssembly as it is tracked: its size, what it asks of its host, and when it is out of date."""

import gzip
import json
import shutil

import pytest

from tools import web_hashes

MODULE = web_hashes.BUILT / "stereodel.wasm"
LARGEST = 140_000
"""Bytes of the module packed, as servers send it."""


def test_the_tracked_files_are_made_of_the_sources():
    assert web_hashes.out_of_date() == []


def test_size():
    assert len(gzip.compress(MODULE.read_bytes(), 9, mtime=0)) <= LARGEST


def test_it_asks_for_one_function_and_offers_what_is_called(node):
    imports, exports = node(
        'import { readFileSync } from "node:fs";'
        f"const module = await WebAssembly.compile(readFileSync({json.dumps(str(MODULE))}));"
        "export default [WebAssembly.Module.imports(module), WebAssembly.Module.exports(module)];"
    )
    assert imports == [{"module": "page", "name": "fail", "kind": "function"}]
    names = {export["name"] for export in exports}
    assert {"memory", "_initialize", "allocate", "release", "discard"} <= names
    sources = " ".join(path.read_text(encoding="utf-8") for path in (web_hashes.SCRIPT / "kernel").glob("*.ts"))
    for name in names - {"memory", "_initialize"}:
        space, _, rest = name.partition("_")
        # Those of a space are called by the space that a class has.
        shared = f"_{rest}`" in sources or f'"{rest.rsplit("_", 1)[-1]}"' in sources
        assert f'"{name}"' in sources or (space in ("plane", "sphere") and shared), name


@pytest.fixture
def copied(monkeypatch, tmp_path):
    """A copy of what the module is made of, in place of the sources."""
    for name in ("stereodel/kernel", "stereodel/web/built", "tools"):
        shutil.copytree(web_hashes.ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("CMakeLists.txt", "constraints.txt"):
        shutil.copy(web_hashes.ROOT / name, tmp_path / name)
    for name, folder in {"ROOT": "", "BUILT": "stereodel/web/built", "SCRIPT": "stereodel/web/script"}.items():
        monkeypatch.setattr(web_hashes, name, tmp_path / folder)
    record = tmp_path / "stereodel" / "web" / "built" / "built.json"
    monkeypatch.setattr(web_hashes, "RECORD", record)
    (tmp_path / "stereodel" / "web" / "script").mkdir()
    module = tmp_path / "only" / "stereodel.wasm"
    module.parent.mkdir()
    shutil.copy(MODULE, module)
    for file in record.parent.iterdir():
        if file.name != module.name:
            file.unlink()
    web_hashes.main([str(module.parent)])
    shutil.copy(module.parent / "built.json", record)
    assert web_hashes.out_of_date() == []
    return tmp_path


@pytest.mark.parametrize("file", ["stereodel/kernel/engine/sphere.cpp", "CMakeLists.txt", "tools/build_web.sh"])
def test_a_changed_source_is_seen(copied, file):
    with (copied / file).open("a", encoding="utf-8") as source:
        source.write("# \n")
    assert web_hashes.out_of_date() == ["the sources of stereodel.wasm have changed"]


def test_a_new_source_is_seen_but_not_one_of_python(copied):
    (copied / "stereodel/kernel/python/more.cpp").write_text("", encoding="utf-8")
    assert web_hashes.out_of_date() == []
    (copied / "stereodel/kernel/web/more.cpp").write_text("", encoding="utf-8")
    assert web_hashes.out_of_date() == ["the sources of stereodel.wasm have changed"]


def test_foreign_bytes_are_seen(copied):
    module = copied / "stereodel/web/built/stereodel.wasm"
    module.write_bytes(module.read_bytes()[:-1] + b"\1")
    assert web_hashes.out_of_date() == ["stereodel.wasm is not the file that was built"]


def test_another_compiler_is_seen(copied):
    pins = copied / "constraints.txt"
    pins.write_text(pins.read_text(encoding="utf-8").replace("ziglang==0.17.1", "ziglang==0.18.0"), encoding="utf-8")
    (found,) = web_hashes.out_of_date()
    assert "ziglang==0.17.1" in found
    assert "ziglang==0.18.0" in found
