"""The check of `make dist`: what must be in the source archive and in the wheel, and what must not."""

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from importlib.metadata import distribution
from pathlib import Path

import nanobind
import pytest
from markdown_it import MarkdownIt

from tools import archives, readme_metadata

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
    "stereodel-1.dist-info/licenses/LICENSE",
    "stereodel-1.dist-info/licenses/NOTICES.md",
    "stereodel-1.dist-info/licenses/stereodel/data/README.md",
}
KERNEL = "stereodel/_kernel.cpython-311-x86_64-linux-gnu.so"
PROBE = "stereodel/_kernel_probe.cpython-311-x86_64-linux-gnu.so"


def test_archive():
    whole = TRACKED - {"tests/images/baselines/fig01_sphere.png"} | {"PKG-INFO"}
    assert archives.archive_problems(whole, TRACKED) == []
    assert archives.archive_problems(whole - {"README.md"}, TRACKED) == ["not in the archive: README.md"]
    assert archives.archive_problems(whole | {KERNEL}, TRACKED) == [f"not tracked: {KERNEL}"]


WHOLE = WHEEL | {KERNEL}


@pytest.mark.parametrize(
    ("names", "problems"),
    [
        (WHOLE, []),
        (WHEEL, ["one compiled kernel wanted, not []"]),
        (WHOLE - {"stereodel/py.typed"}, ["not in the wheel: stereodel/py.typed"]),
        (WHOLE - {"stereodel/web/built/page.js"}, ["not in the wheel: stereodel/web/built/page.js"]),
        (WHOLE - {"stereodel-1.dist-info/licenses/NOTICES.md"}, ["no licence in the wheel: NOTICES.md"]),
        *(
            (WHOLE | {name}, [f"not in the package: {name}"])
            for name in (PROBE, "stereodel/kernel/python/module.cpp", "stereodel/web/script/main.ts")
        ),
    ],
)
def test_wheel(names, problems):
    assert archives.wheel_problems(names, TRACKED) == problems


# Notices


def test_what_is_compiled_in_has_its_notice():
    notices = (ROOT / "NOTICES.md").read_text(encoding="utf-8")
    of_nanobind = distribution("nanobind").read_text("licenses/LICENSE")
    assert of_nanobind.strip() in notices
    headers = list(Path(nanobind.__file__).parent.glob("ext/*/include/**/*.h"))
    rights = {line for path in headers for line in re.findall(r"Copyright.*", path.read_text(encoding="utf-8"))}
    assert rights  # what nanobind brings along
    assert [line for line in rights if line not in notices] == []


def test_scripts_and_styles_of_the_page_bring_nothing_of_others():
    """No package of npm and no font; what is compiled in and what is data is checked above and below."""
    web = ROOT / "stereodel" / "web"
    sources = [path for path in web.glob("script/**/*.[tc]s*") if "node_modules" not in path.parts]
    texts = [path.read_text(encoding="utf-8") for path in [*sources, *web.glob("built/*.css")]]
    named = {name for text in texts for name in re.findall(r'^(?:import|export|\}).* from "([^.][^"]*)";$', text, re.M)}
    assert named <= {"stereodel", "page:shared"}  # our own, by the names that users and the bundler have for them
    assert len(texts) > 50
    assert "@font-face" not in "".join(texts)


def test_a_wheel_whose_data_are_not_those_of_its_bill_is_refused(tmp_path):
    bill = (ROOT / "NOTICES.cdx.json").read_bytes()
    listed = [part["name"] for part in json.loads(bill)["components"] if part.get("type") == "data"]
    assert len(listed) > 10

    def problems(changed=None, named="NOTICES.cdx.json"):
        with zipfile.ZipFile(tmp_path / "made.whl", "w") as wheel:
            wheel.writestr(f"stereodel-1.dist-info/sboms/{named}", bill)
            for name in listed:
                wheel.writestr(name, b"" if name == changed else (ROOT / name).read_bytes())
            return archives.bill_problems(wheel)

    assert problems() == []
    assert set(problems(changed=listed[0])) == {f"not as the bill of materials says: {listed[0]}"}
    assert problems(named="other.json") == ["no bill of materials in the wheel"]


# The README in the metadata

WHERE = "https://example.invalid/stereodel"
ADDRESS = "[project.urls]\n" + "".join(f'{name} = "{WHERE}"\n' for name in readme_metadata.ADDRESSES) + "\n"


def long_description(folder, *, address="", publication=""):
    """What the build backend makes of the README, with these lines in pyproject.toml; or its error."""
    for name in ("LICENSE", "NOTICES.md", "README.md", "stereodel/__init__.py", "stereodel/data/README.md", "tools"):
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, target)
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8").partition("[project.scripts]")
    (folder / "pyproject.toml").write_text(address.join([project[0], project[1] + project[2]]), encoding="utf-8")
    build = "from scikit_build_core.build import prepare_metadata_for_build_wheel as prepare; prepare('made')"
    environment = os.environ | {"STEREODEL_PUBLICATION": publication}
    command = [sys.executable, "-c", build]
    ran = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    made = list(folder.glob("made/*.dist-info/METADATA"))
    return made[0].read_text(encoding="utf-8").partition("\n\n")[2] if ran.returncode == 0 else ran.stderr


def links(text):
    """Addresses of pictures and links, as a page shows them."""
    return re.findall(r'\b(?:src|href)="([^"]*)"', MarkdownIt().render(text))


@pytest.mark.thorough
def test_an_index_shows_pictures_and_links_of_the_readme(tmp_path):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    found = links(long_description(tmp_path, address=ADDRESS, publication="1"))
    assert len(found) == len(links(readme)) > 25
    pattern = rf"{re.escape(WHERE)}/(raw|blob)/v\d+\.\d+\.\d+/(.+)"
    for link, path in zip(found, links(readme), strict=True):
        kind, absolute = re.fullmatch(pattern, link).groups()
        assert absolute == path
        assert (ROOT / path).is_file()
        assert (kind == "raw") == path.endswith((".png", ".webp"))


@pytest.mark.thorough
def test_without_an_address_the_readme_is_that_of_the_repository_and_nothing_is_published(tmp_path):
    assert long_description(tmp_path / "a").strip() == (ROOT / "README.md").read_text(encoding="utf-8").strip()
    without = "project.urls of pyproject.toml lacks Homepage, Documentation, Source, Issues, Changelog:"
    assert without in long_description(tmp_path / "b", publication="1")
    all_but_one = ADDRESS.replace("Issues", "Other")
    assert "lacks Issues:" in long_description(tmp_path / "c", address=all_but_one, publication="1")


@pytest.mark.parametrize("text", ["`[a](b.md)`", "```\n[a](b.md)\n```", "[a](https://b.invalid)", "[a](#b)"])
def test_code_and_whole_addresses_are_left_as_they_are(text):
    assert readme_metadata.absolute(text, WHERE, "v1") == text
