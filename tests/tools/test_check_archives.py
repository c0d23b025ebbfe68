"""What the check of archives lets through, and which wheels it has audited."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.thorough  # what only a release needs

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "check_archives.sh"
OF_ALL = ["cp312-abi3-manylinux2014_x86_64", "cp312-abi3-win_amd64", "cp312-abi3-macosx_11_0_arm64"]
OF_ONE = ["cp311-cp311-linux_x86_64", "cp314-cp314t-musllinux_1_2_x86_64", "cp312-abi3-pyodide_2026_0_wasm32"]


@pytest.fixture
def check(tmp_path):
    """Run the script on files of these names; what it said, and what it called."""
    (tmp_path / "tools").mkdir()
    for name in (SCRIPT.name, "shell.sh"):
        shutil.copy(SCRIPT.with_name(name), tmp_path / "tools")
    programs = tmp_path / "venv" / "bin"
    programs.mkdir(parents=True)
    for name in ("twine", "abi3audit"):
        program = programs / name
        program.write_text(f'#!/bin/sh\necho {name} "$@" >>"{tmp_path}/called"\ncase "$*" in *wrong*) exit 1 ;; esac\n')
        program.chmod(0o755)

    def run(*names):
        (tmp_path / "dist").mkdir()
        for name in names:
            (tmp_path / "dist" / name).touch()
        line = [tmp_path / "tools" / SCRIPT.name, "venv"]
        ran = subprocess.run(
            line, cwd=tmp_path, env={**os.environ, "HOME": str(tmp_path)}, capture_output=True, text=True, check=False
        )
        called = tmp_path / "called"
        return ran, called.read_text(encoding="utf-8").splitlines() if called.exists() else []

    return run


def test_texts_of_all_and_the_interface_of_those_for_several_pythons(check):
    wheels = sorted(f"stereodel-1-{tag}.whl" for tag in OF_ALL + OF_ONE)
    ran, (texts, *audited) = check("stereodel-1.tar.gz", "stereodel-1.tgz", *wheels)
    assert ran.returncode == 0
    assert texts == " ".join(["twine check --strict dist/stereodel-1.tar.gz", *(f"dist/{name}" for name in wheels)])
    assert audited == sorted(f"abi3audit --strict --report dist/stereodel-1-{tag}.whl" for tag in OF_ALL)


OTHER = "is neither for Python 3.12 and all later ones nor"
REFUSED = {
    # As one without the stable interface, which a build tool may leave out without a word.
    "stereodel-1-cp312-cp312-manylinux2014_x86_64.whl": f"cp312-manylinux2014_x86_64.whl {OTHER}",
    "stereodel-1-py3-none-any.whl": f"dist/stereodel-1-py3-none-any.whl {OTHER}",
    "wrong-1-cp311-cp311-linux_x86_64.whl": "",  # by the programs
    "stereodel-2.tar.gz": "there is no wheel in dist/",
}


@pytest.mark.parametrize("name", REFUSED)
def test_wheels_of_another_kind_and_none_are_refused(check, name):
    ran, called = check("stereodel-1.tar.gz", name)
    assert ran.returncode == 1
    assert REFUSED[name] in ran.stderr
    assert called == [] or name.endswith(".whl")
