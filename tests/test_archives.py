"""The check of `make dist`: what must be in the source archive and in the wheel, and what must not."""

import importlib.util
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TRACKED = {
    ".ci/run",
    "README.md",
    "stereodel/__init__.py",
    "stereodel/_kernel/__init__.pyi",
    "stereodel/py.typed",
    "stereodel/kernel/python/module.cpp",
    "stereodel/web/built/page.js",
    "stereodel/web/script/main.ts",
}
WHEEL = {
    "stereodel/__init__.py",
    "stereodel/_kernel/__init__.pyi",
    "stereodel/py.typed",
    "stereodel/web/built/page.js",
    "stereodel-1.dist-info/METADATA",
}
KERNEL = "stereodel/_kernel.cpython-311-x86_64-linux-gnu.so"
PROBE = "stereodel/_kernel_probe.cpython-311-x86_64-linux-gnu.so"

spec = importlib.util.spec_from_file_location("archives", ROOT / "tools" / "archives.py")
archives = importlib.util.module_from_spec(spec)
spec.loader.exec_module(archives)


def test_archive():
    whole = TRACKED - {".ci/run"} | {"PKG-INFO"}
    assert archives.archive_problems(whole, TRACKED) == []
    assert archives.archive_problems(whole - {"README.md"}, TRACKED) == ["not in the archive: README.md"]
    assert archives.archive_problems(whole | {KERNEL}, TRACKED) == [f"not tracked: {KERNEL}"]


def test_wheel():
    whole = WHEEL | {KERNEL}
    assert archives.wheel_problems(whole, TRACKED) == []
    assert archives.wheel_problems(WHEEL, TRACKED) == ["one compiled kernel wanted, not []"]
    assert archives.wheel_problems(whole - {"stereodel/py.typed"}, TRACKED) == ["not in the wheel: stereodel/py.typed"]
    assert archives.wheel_problems(whole | {PROBE}, TRACKED) == [f"not in the package: {PROBE}"]
    source = "stereodel/kernel/python/module.cpp"
    assert archives.wheel_problems(whole | {source}, TRACKED) == [f"not in the package: {source}"]
    script = "stereodel/web/script/main.ts"
    assert archives.wheel_problems(whole | {script}, TRACKED) == [f"not in the package: {script}"]
    page = "stereodel/web/built/page.js"
    assert archives.wheel_problems(whole - {page}, TRACKED) == [f"not in the wheel: {page}"]
