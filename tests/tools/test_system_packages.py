"""The one way to packages of the system: one by one where that is allowed, else one line that names what is missing."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.thorough

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "system_packages.sh"

APT = """#!/bin/sh
echo "$*" >>"{folder}/asked"
case "$*" in
    *install*osmesa*) exit 1 ;;
    *install*chromium*) [ -e "{folder}/updated" ] && cp /bin/true "{folder}/chromium" ;;
    *update*) touch "{folder}/updated" ;;
esac
"""


@pytest.fixture
def system(tmp_path):
    """A system that has next to nothing; `with_apt` gives it a package manager that cannot get everything."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name in ("bash", "env", "sh", "cp", "touch"):
        (folder / name).symlink_to(shutil.which(name))
    write(folder / "ldconfig", "#!/bin/sh\n")
    write(folder / "python", '#!/bin/sh\n[ "$2" = "${2#*base_prefix}" ] || echo python3.11-dev\n')

    def run(*what, with_apt=False):
        if with_apt:
            write(folder / "apt-get", APT.format(folder=folder))
            write(folder / "sudo", '#!/bin/sh\nshift\nexec "$@"\n')
        environment = {"PATH": str(folder), "HOME": str(tmp_path)}
        ran = subprocess.run(
            [folder / "bash", SCRIPT, *what], env=environment, capture_output=True, text=True, check=False
        )
        asked = (folder / "asked").read_text().splitlines() if (folder / "asked").exists() else []
        return ran, asked

    return run


def write(path, text):
    path.write_text(text)
    path.chmod(0o755)


@pytest.mark.parametrize(
    ("what", "code", "said"),
    [
        (("browser", "opengl"), 0, "Missing packages of the system; on Debian: apt-get install chromium libosmesa6"),
        (("compiler",), 1, "Missing packages of the system; on Debian: apt-get install g++ python3.11-dev"),
        (("printer",), 2, "tools/system_packages.sh: there is no printer"),
    ],
)
def test_what_is_missing_is_one_line(system, what, code, said):
    ran, asked = system(*what)
    assert (ran.returncode, asked) == (code, [])
    assert ran.stderr.startswith(said)


def test_packages_are_installed_one_by_one(system):
    """One that cannot be had stops no other; lists are brought up to date once."""
    ran, asked = system("opengl", "browser", with_apt=True)
    assert ran.returncode == 0
    installed = [line.split()[-1] for line in asked if " install " in line]
    assert installed[:3] == ["libosmesa6", "libosmesa6", "libegl1"]
    assert installed[-1] == "chromium"
    assert sum("update" in line for line in asked) == 1
    *steps, last = ran.stderr.splitlines()
    assert steps[-1] == "Installing chromium"
    assert last.startswith("Missing packages of the system; on Debian: apt-get install libosmesa6 ")
    assert "chromium" not in last


def test_figures_ask_for_nothing_of_the_page():
    """`make figures` gets no browser, and no library of the page."""
    line = ["make", "--dry-run", "--always-make", "figures"]
    said = subprocess.check_output(line, cwd=SCRIPT.parents[1], env={**os.environ, "MAKEFLAGS": ""}, text=True)
    assert "tools/system_packages.sh opengl" in said
    assert "browser" not in said
    assert "installed-test" not in said
