"""What people look for in a project, and the files of services that are not here: they agree with each other."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tomllib
import venv
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

import stereodel
from stereodel._extras import EXTRAS

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
CLASSIFIERS = PROJECT["project"]["classifiers"]
PYTHONS = [found[1] for line in CLASSIFIERS if (found := re.fullmatch(r".* :: (3\.\d+)", line))]
PINS = dict(line.split("==") for line in (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines())
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


def workflow(name):
    return yaml.safe_load(read(f".github/workflows/{name}.yml"))


def wanted(job):
    """The jobs that it waits for."""
    needs = job.get("needs", [])
    return [needs] if isinstance(needs, str) else needs


# Versions


def test_the_recipe_needs_what_the_project_needs():
    text = read("conda/recipe.yaml")
    assert yaml.safe_load(text)["context"]["version"] == stereodel.__version__
    build, run = PROJECT["build-system"]["requires"], PROJECT["project"]["dependencies"]
    for line in [*build, *run]:
        needed = Requirement(line)
        assert f"- {needed.name} {needed.specifier}" in text
    assert f"- python {PROJECT['project']['requires-python']}" in text
    for path in re.findall(r"- ((?:tools|tests|stereodel)/[\w./]+|[A-Z]+(?:\.md)?)$", text, re.MULTILINE):
        assert (ROOT / path).is_file()


def test_the_citation_has_what_its_form_asks_for():
    cited = yaml.safe_load(read("CITATION.cff"))
    assert {"cff-version", "message", "title", "authors", "version", "type"} <= set(cited)
    assert cited["authors"] == PROJECT["project"]["authors"]
    assert cited["license"] == PROJECT["project"]["license"].split(" AND ")
    assert str(cited["version"]) == stereodel.__version__


def test_the_npm_package_has_the_version_too():
    assert json.loads(read("stereodel/web/script/package.json"))["version"] == stereodel.__version__


def test_the_release_page_says_what_the_changelog_says():
    def notes(version):
        line = [ROOT / "tools" / "release_notes.sh", version]
        return subprocess.run(line, capture_output=True, text=True, check=False)

    said = notes("Unreleased").stdout
    assert said.startswith("### ")
    assert "\n## [" not in said
    assert said.strip() in read("CHANGELOG.md")
    nothing = notes("99.0.0")
    assert (nothing.returncode, nothing.stdout) == (1, "")
    assert "nothing under the heading [99.0.0]" in nothing.stderr


def test_classifiers_are_the_pythons_that_are_allowed():
    allowed = SpecifierSet(PROJECT["project"]["requires-python"])
    assert len(PYTHONS) >= 4
    assert [version for version in PYTHONS if version not in allowed] == []
    oldest, newest = (int(PYTHONS[k].split(".")[1]) for k in (0, -1))
    assert [f"3.{minor}" for minor in range(oldest, newest + 1)] == PYTHONS
    assert f"3.{oldest - 1}" not in allowed
    assert any("Free Threading" in line for line in CLASSIFIERS)
    assert "Programming Language :: C++" in CLASSIFIERS
    assert re.findall(r"^\| Python (3\.\d+) \|", read("docs/support.md"), re.MULTILINE) == PYTHONS


# Nothing is invented


@pytest.mark.parametrize(
    "path",
    ["CITATION.cff", "SECURITY.md", "CODE_OF_CONDUCT.md", "paper/paper.md", "paper/paper.bib", "conda/recipe.yaml"],
)
def test_no_address_and_no_identifier(path):
    """They are known at publication; docs/publishing.md lists them."""
    text = read(path)
    assert not re.search(r"[\w.]+@[\w-]+\.\w+", text)
    assert not re.search(r"(?i)\b(?:doi|orcid|swhid)\b", text)
    assert not re.search(r"https?://", text)


# The paper


def test_the_paper_has_what_the_journal_asks_for():
    text, listed = read("paper/paper.md"), read("paper/paper.bib")
    _, head, body = text.split("---", 2)
    assert {"title", "tags", "authors", "bibliography"} <= set(yaml.safe_load(head))
    assert yaml.safe_load(head)["bibliography"] == "paper.bib"
    assert 250 <= len(body.split()) <= 1000
    assert set(re.findall(r"@(\w+)", text)) == set(re.findall(r"^@\w+\{(\w+),", listed, re.MULTILINE))


# Workflows


EACH_WORKFLOW = pytest.mark.parametrize("name", [path.stem for path in WORKFLOWS])


@EACH_WORKFLOW
def test_a_workflow_is_one_and_what_it_calls_is_there(name):
    content = workflow(name)
    assert {"name", True, "permissions", "jobs"} <= set(content)  # YAML takes the word "on" for true
    assert content["name"] == name
    assert content["permissions"] == {"contents": "read"}
    for job in content["jobs"].values():
        assert set(wanted(job)) <= set(content["jobs"])
        if "uses" in job:
            assert (ROOT / job["uses"].removeprefix("$/")).is_file()
            continue
        assert job["timeout-minutes"] <= (300 if job["steps"][-1].get("run") == "make long-run" else 120)
        for step in job["steps"]:
            assert len({"uses", "run"} & set(step)) == 1
    text, targets = read(f".github/workflows/{name}.yml"), re.findall(r"^([a-z-]+):", read("Makefile"), re.MULTILINE)
    assert set(re.findall(r"\bmake ([a-z-]+)", text)) <= set(targets)
    for script in re.findall(r"(?:python|bash|source)(?: -W error)? ((?:tools|\.ci)/[\w./]+)", text):
        assert (ROOT / script).is_file()
    installed = re.findall(r"pip install (?!-)(\w+) --constraint constraints.txt", text)
    assert [library for library in installed if library not in PINS] == []


def test_actions_are_pinned_by_commits_and_the_same_everywhere():
    """By the hash of a commit, as names of versions can be moved to others, with the version that it is."""
    texts = [path.read_text(encoding="utf-8") for path in WORKFLOWS]
    pins = {pin for text in texts for pin in re.findall(r"uses: ([\w.-]+/.*)", text)}
    assert [pin for pin in pins if not re.fullmatch(r"[\w./-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+", pin)] == []
    assert len({pin.partition("@")[0] for pin in pins}) == len(pins) > 5


NEWEST = workflow("tests")["jobs"]["newest"]["strategy"]["matrix"]["python"]
"""Those whose kernel is tried, as they are without a lock or younger than libraries of files and pictures."""


def test_workflows_run_every_python():
    matrix = workflow("tests")["jobs"]["python"]["strategy"]["matrix"]["python"]
    first = workflow("tests")["jobs"]["change"]["steps"][1]["with"]["python-version"]
    assert [first, *matrix] == PYTHONS
    assert NEWEST[0] == f"{PYTHONS[-1]}t"


def test_wheels_are_built_for_every_system_and_python():
    settings = PROJECT["tool"]["cibuildwheel"]
    assert settings["build"].split() == [f"cp{version.replace('.', '')}-*" for version in [*PYTHONS, *NEWEST]]
    systems = [entry["system"] for entry in workflow("wheels")["jobs"]["wheels"]["strategy"]["matrix"]["include"]]
    assert {system.partition("-")[0] for system in systems} == {"linux", "macos", "windows", "pyodide"}
    assert "musllinux" in str(settings["linux"])
    assert (ROOT / re.search(r"\{project\}/(\S+)", settings["test-command"])[1]).is_file()


LEVELS = ("none", "read", "write")


def called_jobs(name):
    """Each job of a workflow, and of those that it calls, with what the host lets it do at most and what it asks."""
    content = workflow(name)
    for job_name, job in content["jobs"].items():
        asked = job.get("permissions", content["permissions"])
        yield f"{name}.{job_name}", asked, job
        if "uses" in job:
            for nested_name, nested, nested_job in called_jobs(Path(job["uses"]).stem):
                yield f"{name}.{job_name} → {nested_name}", nested, nested_job
                beyond = [
                    key for key, level in nested.items() if LEVELS.index(level) > LEVELS.index(asked.get(key, "none"))
                ]
                assert beyond == [], f"{nested_name} asks for {beyond}, which {name}.{job_name} does not have"


@EACH_WORKFLOW
def test_a_called_job_asks_for_no_more_than_its_caller_has(name):
    """The host compares them when it reads the file, whatever `if:` says, and starts no job where they do not fit."""
    assert len(list(called_jobs(name))) >= len(workflow(name)["jobs"])
    called = {Path(job["uses"]).stem for job in workflow(name)["jobs"].values() if "uses" in job}
    assert all("workflow_call" in workflow(other)[True] for other in called)


def test_only_the_job_that_publishes_may_prove_who_it_is():
    asking = {name for path in WORKFLOWS for name, asked, _ in called_jobs(path.stem) if "id-token" in asked}
    assert asking == {"documentation.deploy", "release.publish", "release.npm"}
    jobs = workflow("release")["jobs"]
    assert workflow("release")[True] == {"push": {"tags": ["v*"]}}
    for name in ("publish", "npm"):
        assert jobs[name]["if"] == "startsWith(github.ref, 'refs/tags/v')"
        assert jobs[name]["environment"] == "publication"
    assert jobs["publish"]["steps"][-1]["with"] == {"attestations": True}
    assert not re.search(r"secrets\.|password|token:", read(".github/workflows/release.yml").replace("id-token:", ""))


def test_publication_waits_for_the_tests_and_asks_for_texts_fit_for_it():
    jobs = workflow("release")["jobs"]
    before = {"version", "archives", "tests", "wheels"}
    assert set(wanted(jobs["publish"])) == set(jobs) - {"publish", "npm", "page"} == before
    assert wanted(jobs["npm"]) == wanted(jobs["page"]) == ["publish"]
    assert jobs["wheels"]["with"] == {"publication": True}
    assert workflow("wheels")["env"] == {"STEREODEL_PUBLICATION": "${{ inputs.publication && '1' || '' }}"}
    # Of Linux the wheels are built in a container, which gets what is named.
    assert "STEREODEL_PUBLICATION" in PROJECT["tool"]["cibuildwheel"]["linux"]["environment-pass"]
    assert wanted(workflow("wheels")["jobs"]["check"]) == ["source", "wheels"]


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("tag", "code"), [(f"v{stereodel.__version__}", 0), ("v0.0.9", 1), (stereodel.__version__, 1), ("", 1)]
)
def test_a_tag_that_is_not_the_version_stops_the_publication(tag, code):
    line = workflow("release")["jobs"]["version"]["steps"][-1]["run"]
    environment = os.environ | {"GITHUB_REF_NAME": tag}
    ran = subprocess.run(["bash", "-ec", line], cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert ran.returncode == code, ran.stderr
    assert (stereodel.__version__ in ran.stderr) == bool(code)


def test_the_least_versions_are_those_of_the_table():
    printed = subprocess.run([sys.executable, ROOT / "tools" / "lowest.py"], capture_output=True, text=True, check=True)
    lowest = dict(line.split("==") for line in printed.stdout.splitlines())
    assert lowest.pop("numpy") == "2.0"
    assert lowest == {each.name: each.least for extra in EXTRAS.values() for each in extra.brings}
    assert "make test-lowest" in read(".github/workflows/weekly.yml")


# Documentation with versions


def test_versions_of_the_documentation_are_listed_newest_first(tmp_path):
    write = [ROOT / "tools" / "documentation_versions.sh", tmp_path]
    ran = subprocess.run(write, capture_output=True, text=True, check=False)
    assert ran.returncode == 1
    assert "has documentation" in ran.stderr
    for name in ("dev", "0.9", "0.10", "0.10rc1", "1.0", "other"):
        (tmp_path / name).mkdir()
        if name != "other":
            (tmp_path / name / "index.html").touch()
    for _ in range(2):  # upon what is there
        subprocess.run(write, check=True)
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert re.findall(r'href="([\w.]+)/"', page) == ["1.0", "0.10", "0.10rc1", "0.9", "dev"]
    assert "url=1.0/" in page
    assert (tmp_path / "stable").resolve() == tmp_path / "1.0"
    newest, *others = json.loads((tmp_path / "versions.json").read_text(encoding="utf-8"))
    assert newest == {"version": "1.0", "url": "/1.0/", "preferred": True}
    assert [each["version"] for each in others if "preferred" not in each] == ["0.10", "0.10rc1", "0.9", "dev"]


# Pythons


@pytest.mark.thorough
def test_a_python_is_found_by_its_version_and_lock(tmp_path):
    """A folder of programs that say which Python they are."""
    for name, version, lock in (("3.13", (3, 13), "0"), ("3.14t", (3, 14), "1"), ("3.15t", (3, 15), "0")):
        program = tmp_path / f"python{name}"
        setting = "import sys, sysconfig; sys.version_info = {}; sysconfig.get_config_var = lambda _: {}"
        program.write_text(
            f"#!/bin/sh\nexec {os.path.realpath(sys.executable)} -c '{setting.format((*version, 0), lock)}\n'\"$2\"\n"
        )
        program.chmod(0o755)
    found = {version: find(tmp_path, version) for version in ("3.13", "3.13t", "3.14", "3.14t", "3.15t", "3.16")}
    assert {version for version, path in found.items() if path} == {"3.13", "3.14t"}
    assert found["3.14t"] == str(tmp_path / "python3.14t")


def find(folder, version):
    environment = {"PATH": f"{folder}:/usr/bin:/bin", "HOME": str(folder)}
    ran = subprocess.run(
        [ROOT / "tools" / "find_python.sh", version], env=environment, capture_output=True, text=True, check=False
    )
    assert ran.returncode == (0 if ran.stdout else 1)
    return ran.stdout.strip()


def test_every_extra_can_be_installed_by_a_target():
    """The extras of those who work on the library have a target of their own."""
    of_the_library = {*EXTRAS, "all"}
    script = read("tools/install.sh")
    others = set(PROJECT["project"]["optional-dependencies"]) - of_the_library
    assert [name for name in others if name not in script] == []


# What the page about installing shows


def test_the_page_cites_as_the_file_does():
    cited, page = yaml.safe_load(read("CITATION.cff")), read("docs/installing.md")
    software, paper = re.findall(r"^@\w+\{.*?^\}", page, re.MULTILINE | re.DOTALL)
    for text, work in ((software, cited), (paper, cited["references"][0])):
        assert f"{{{work['title']}}}" in text
        (author,) = work["authors"]
        named = f"{{{author['name']}}}" if "name" in author else f"{author['family-names']}, {author['given-names']}"
        assert f"author  = {{{named}}}" in text
    assert f"version = {{{cited['version']}}}" in software


DOCKERFILE = read("Dockerfile")


def test_the_container_takes_what_the_wheel_is_made_of():
    """Files that are there, official images, and no address of a registry or index."""
    assert re.findall(r"^FROM (\S+)", DOCKERFILE, re.MULTILINE) == ["python:3.13", "python:3.13-slim"]
    assert "://" not in DOCKERFILE
    for sources in re.findall(r"^COPY (?!--)(.*) \S+$", DOCKERFILE, re.MULTILINE):
        assert [path for path in sources.split() if not (ROOT / path).exists()] == []
    assert f"EXTRAS={re.search(r'ARG EXTRAS=(.*)', DOCKERFILE)[1]}" in read("docs/installing.md")


@pytest.mark.thorough
def test_the_lines_of_the_container_make_the_command(tmp_path):
    """Without Docker: an empty folder stands for its root, and a new environment for each image.

    These see the libraries that are installed here, as no test asks a network, but not the package. The kernel is that
    of the checkout, which lies in the folder that is copied: to compile it anew would take minutes.
    """
    environment = {"HOME": str(tmp_path), "LANG": "C.UTF-8", "PIP_NO_INDEX": "1", "PIP_NO_BUILD_ISOLATION": "0"}
    environment |= {"SKBUILD_CMAKE_DEFINE": "STEREODEL_MODULE=OFF", "SKBUILD_BUILD_TARGETS": "clean"}
    entry, images = [], iter(("builder", "runner"))
    for line in DOCKERFILE.splitlines():
        instruction, _, rest = line.partition(" ")
        inside = re.sub(r'(?<=[\s"(\[])/(?=\w)', f"{tmp_path}/", f" {rest}").strip()
        if instruction == "FROM":
            made = tmp_path / next(images)
            venv.create(made, symlinks=True, with_pip=True)
            (site,) = made.glob("lib/python*/site-packages")
            (site / "here.pth").write_text(sysconfig.get_path("purelib"))
            environment["PATH"] = f"{made}/bin:{Path(sys.executable).parent}:/usr/bin:/bin"
        elif instruction == "ARG":
            environment |= dict([rest.split("=")])
        elif instruction == "COPY" and not rest.startswith("--from"):
            *sources, into = inside.split()
            for source in sources:
                if (ROOT / source).is_dir():
                    shutil.copytree(ROOT / source, into, ignore=shutil.ignore_patterns("__pycache__", "node_modules"))
                else:
                    Path(into).mkdir(parents=True, exist_ok=True)
                    shutil.copy(ROOT / source, into)
        elif instruction == "WORKDIR":
            Path(inside).mkdir()
        elif instruction == "RUN":
            ran = subprocess.run(["sh", "-c", inside], cwd=tmp_path, env=environment, capture_output=True, text=True)
            assert ran.returncode == 0, ran.stdout + ran.stderr
        elif instruction == "ENTRYPOINT":
            entry = json.loads(rest)
    (tmp_path / "data" / "cities.csv").write_text("lon,lat\n10,48.4\n-78.5,-0.2\n135.8,35\n115.9,-32\n")
    asked = [*entry, "voronoi", "cities.csv", "-o", "cells.geojson"]
    ran = subprocess.run(asked, cwd=tmp_path / "data", env=environment, capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (0, "")
    assert len(json.loads((tmp_path / "data" / "cells.geojson").read_text())["features"]) == 4
