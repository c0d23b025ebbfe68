"""The module of WebAssembly as it is tracked: what it asks of its host, and what it offers."""

from .conftest import SCRIPT


def test_it_asks_for_one_function_and_offers_what_is_called(node):
    imports, exports = node(
        'import { readFileSync } from "node:fs";'
        f'const module = await WebAssembly.compile(readFileSync("{SCRIPT.parent}/built/stereodel.wasm"));'
        "export default [WebAssembly.Module.imports(module), WebAssembly.Module.exports(module)];"
    )
    assert imports == [{"module": "page", "name": "fail", "kind": "function"}]
    names = {export["name"] for export in exports}
    assert {"memory", "_initialize", "allocate", "release", "discard"} <= names
    sources = " ".join(path.read_text(encoding="utf-8") for path in (SCRIPT / "kernel").glob("*.ts"))
    for name in names - {"memory", "_initialize"}:
        space, _, rest = name.partition("_")
        # Those of a space are called by the space that a class has.
        shared = f'"{rest}"' in sources or f"_{rest}`" in sources or f'"{rest.rsplit("_", 1)[-1]}"' in sources
        assert f'"{name}"' in sources or (space in ("plane", "sphere") and shared), name
