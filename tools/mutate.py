"""Break the library on purpose, one place at a time, and see the tests fail: `python -m tools.mutate`.

`tests/mutations/*.toml` say what is broken and which tests must fail, each by an assertion; all in a copy of the tree.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
import tomllib
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "mutations"
TREE = BUILD / "tree"
KERNEL = "stereodel/kernel/"


@dataclass(frozen=True)
class Mutation:
    """A change of one place in a file, under a row of the ledger or what draws, and the tests that must fail for it."""

    name: str
    where: str
    file: str
    old: str
    new: str
    caught_by: tuple[str, ...]


def mutations() -> Iterator[Mutation]:
    """The mutations of all tables, in order."""
    for table in sorted((ROOT / "tests" / "mutations").glob("*.toml")):
        for entry in tomllib.loads(table.read_text(encoding="utf-8"))["mutation"]:
            where, tests = entry.pop("claim", "") or entry.pop("where"), tuple(entry.pop("caught_by"))
            yield Mutation(where=where, caught_by=tests, **entry)


def copy_tree() -> None:
    """Make the copy: what is in it already keeps its time, so that only what changed is compiled again."""
    listed = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
    names = set(filter(None, listed.split("\0")))
    names.update(path.relative_to(ROOT).as_posix() for path in (ROOT / "stereodel").glob("_kernel*.so"))
    for path in [path for path in TREE.rglob("*") if path.is_file()]:
        if path.suffix != ".pyc" and path.relative_to(TREE).as_posix() not in names:
            path.unlink()
    for name in names:
        source, target = ROOT / name, TREE / name
        if not target.is_file() or source.read_bytes() != target.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)  # with the time of now


def build_kernel() -> None:
    """Compile what changed of the copy's kernel, and put it into the copy."""
    nanobind = subprocess.check_output([sys.executable, "-m", "nanobind", "--cmake_dir"], text=True).strip()
    options = ["-DSTEREODEL_DEVELOPMENT=ON", f"-DPython_EXECUTABLE={sys.executable}", f"-Dnanobind_DIR={nanobind}"]
    kernel, tree = str(BUILD / "kernel"), str(TREE)
    configure = ["cmake", "-S", tree, "-B", kernel, "-G", "Ninja", *options]
    for command in (configure, ["cmake", "--build", kernel], ["cmake", "--install", kernel, "--prefix", tree]):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            raise SystemExit(f"the kernel cannot be built:\n{done.stdout}")


def pytest_configure() -> None:
    """As a plugin of pytest: what fails a property is taken as it is found, for to make it smaller takes minutes."""
    from hypothesis import Phase, settings

    settings.register_profile("as found", settings.default, phases=(Phase.explicit, Phase.generate))
    settings.load_profile("as found")


def outcomes(tests: Sequence[str]) -> dict[str, set[str]]:
    """What becomes of each test of the copy: "passed", "failed", that is for an assertion, or what else there is."""
    report = BUILD / "report.xml"
    report.unlink(missing_ok=True)
    command = [sys.executable, "-m", "pytest", "-p", "tools.mutate", "-qm", "", f"--junitxml={report}"]
    settings = {"PYTHONPATH": str(TREE), "CI": "true", "PYTEST_ADDOPTS": "-p no:cacheprovider --assert=plain"}  # fast
    done = subprocess.run([*command, *tests], cwd=TREE, env=os.environ | settings, capture_output=True, text=True)
    said: dict[str, set[str]] = {test: set() for test in tests}
    for case in ET.parse(report).iter("testcase") if report.is_file() else ():
        kind, message = next(((each.tag, each.get("message", "")) for each in case), ("passed", ""))
        failed = kind == "failure" and message.startswith(("AssertionError", "assert ", "Failed", "ExceptionGroup"))
        name, file = case.get("name", ""), case.get("classname", "").replace(".", "/") + ".py"
        for test in {f"{file}::{name}", f"{file}::{name.partition('[')[0]}"} & said.keys():
            said[test].add("failed" if failed else f"{kind} {message[:150]}".strip())
    return {test: found or {f"did not run: {done.stderr[-200:]}"} for test, found in said.items()}


def why_survived(mutation: Mutation) -> str:
    """What is wrong with a mutation or its tests; nothing where each of them fails, of those with parameters one."""
    target = TREE / mutation.file
    text = target.read_text(encoding="utf-8")
    if text.count(mutation.old) != 1:
        return f"old stands {text.count(mutation.old)} times in {mutation.file}"
    target.write_text(text.replace(mutation.old, mutation.new), encoding="utf-8")
    try:
        if mutation.file.startswith(KERNEL):
            build_kernel()
        found = outcomes(mutation.caught_by)
    finally:
        target.write_text(text, encoding="utf-8")
    return "; ".join(f"{test} {' '.join(said)}" for test, said in found.items() if "failed" not in said)


def main() -> None:
    """Try all mutations, or some; exit with 1 where one of them survives."""
    parser = argparse.ArgumentParser(prog="python -m tools.mutate", description=__doc__.partition("\n")[0])
    parser.add_argument("--only", metavar="PATTERN", default="", help="those whose row or name match")
    parser.add_argument("--changed", metavar="FILE", nargs="+", default=(), help="those of these files or tests")
    given = parser.parse_args()
    os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    chosen = [m for m in mutations() if re.search(given.only, f"{m.where}: {m.name}")]
    changed = set(given.changed)
    chosen = [m for m in chosen if not changed or changed & {m.file, *(t.partition("::")[0] for t in m.caught_by)}]
    # The kernel's last: after them that of the copy is not what it was.
    chosen.sort(key=lambda mutation: mutation.file.startswith(KERNEL))
    copy_tree()
    if any(mutation.file.startswith(KERNEL) for mutation in chosen):
        build_kernel()
    tests = sorted({test for mutation in chosen for test in mutation.caught_by})
    wrong = [f"{test} {' '.join(said)}" for test, said in outcomes(tests).items() if said != {"passed"}]
    if wrong:  # where one is not found, none runs
        print(f"{len(wrong)} tests do not pass as it is:", *wrong[:5], sep="\n", flush=True)
    survived = 0
    for number, mutation in enumerate(chosen, start=1):
        begun = time.perf_counter()
        why = why_survived(mutation)
        survived += bool(why)
        head = f"{number}/{len(chosen)} {'SURVIVED' if why else 'caught'} {time.perf_counter() - begun:.1f} s"
        print(f"{head} | {mutation.where}: {mutation.name} | {why or ' '.join(mutation.caught_by)}", flush=True)
    print(f"{len(chosen) - survived} of {len(chosen)} mutations are caught")
    raise SystemExit(bool(wrong or survived))


if __name__ == "__main__":
    main()
