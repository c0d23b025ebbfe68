"""The module of WebAssembly as it is tracked: what it asks of its host, and when it is out of date."""

import json
import shutil

import pytest

from tools import web_hashes

MODULE = web_hashes.BUILT / "stereodel.wasm"


def test_the_tracked_files_are_made_of_the_sources():
    assert web_hashes.out_of_date() == []


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


CHANGED = "the sources of stereodel.wasm have changed"


@pytest.mark.parametrize(
    ("file", "change", "found"),
    [
        ("stereodel/kernel/engine/sphere.cpp", lambda old: old + b"# ", CHANGED),
        ("CMakeLists.txt", lambda old: old + b"# ", CHANGED),
        ("tools/build_web.sh", lambda old: old + b"# ", CHANGED),
        ("stereodel/kernel/web/more.cpp", lambda old: b"", CHANGED),
        ("stereodel/kernel/python/more.cpp", lambda old: b"", None),
        ("stereodel/web/built/stereodel.wasm", lambda old: old[:-1] + b"\1", "is not the file that was built"),
        ("constraints.txt", lambda old: old.replace(b"ziglang==0.17.1", b"ziglang==0.18.0"), "ziglang==0.18.0"),
    ],
)
def test_a_changed_source_module_or_compiler_is_seen(copied, file, change, found):
    path = copied / file
    path.write_bytes(change(path.read_bytes() if path.exists() else b""))
    said = web_hashes.out_of_date()
    assert len(said) == (found is not None)
    assert all(found in each for each in said)
