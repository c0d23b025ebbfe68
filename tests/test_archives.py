"""The check of `make dist`: what must be in the source archive and in the wheel, and what must not."""

import importlib.util
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TRACKED = {
    ".ci/run",
    "README.md",
    "tests/images/baselines/fig01_sphere.png",
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
    whole = TRACKED - {"tests/images/baselines/fig01_sphere.png"} | {"PKG-INFO"}
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


def test_sizes_by_part(tmp_path, capsys):
    members = {
        KERNEL: 7,
        "stereodel/data/a.xz": 5,
        "stereodel/data/b.xz": 6,
        "stereodel/earth.py": 1,
        "s.dist-info/RECORD": 2,
    }
    assert archives.sizes(members) == {"data": 11, "kernel": 7, "metadata": 2, "modules": 1}
    wheel = tmp_path / "s.whl"
    with zipfile.ZipFile(wheel, "w") as packed:
        packed.writestr(KERNEL, bytes(2 * 10**6))
        packed.writestr("stereodel/earth.py", "")
    assert archives.report_sizes([str(wheel)]) == 0
    assert capsys.readouterr().out == "s.whl: 2.00 MB; kernel 2.00\n"
