"""Draw what is out of date: the figure scripts run in parallel, and `manifest.json` says what was drawn with what.

Each script defines `FIGURE`, or `ANIMATION` if its name begins with `anim_`; both have `save(out) -> dict`. Whether a
script must run again is decided by the contents of everything that its picture depends on and of the files that it
wrote, before a script is started: when there is nothing to do, that takes a fraction of a second.

    python -m tools.build --scripts figures --out out [NAME…]
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import json
import multiprocessing
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stereodel._files import replacing
from stereodel.render.cores import usable_cores
from stereodel.render.provenance import library_digest, library_versions

SCRIPTS = ("fig", "globe_", "earth_", "sky_", "anim_")
"""Beginnings of the names of scripts: the paper's figures, globes through lenses, pictures of real data, animations."""

Record = dict[str, Any]


class BuildError(Exception):
    """Something that the user can mend: said in one line, without a traceback."""


@dataclass(frozen=True)
class Outcome:
    """What became of one script: its record, or the text of its error."""

    script: Path
    record: Record
    error: str = ""


def build(
    scripts: Path, out: Path, names: Iterable[str] = (), *, jobs: int | None = None, force: bool = False
) -> list[Outcome]:
    """Run every script in `scripts` that is out of date, and write the manifest.

    Parameters
    ----------
    scripts : Path
        Folder of the scripts.
    out : Path
        Folder to write to; made when it is missing.
    names : iterable of str, optional
        Beginnings of script names; all scripts when empty.
    jobs : int, optional
        Scripts that run at once; the usable cores by default.
    force : bool
        Run scripts that are up to date as well.

    Returns
    -------
    list of Outcome
        Of the scripts that ran, in the order of their ends.

    Raises
    ------
    BuildError
        If the folder cannot be written to, or a name is no script's beginning.
    """
    chosen = find_scripts(scripts, names)
    _require_writable(out)
    manifest = read_manifest(out)
    shared = _shared_digest(scripts)
    digests = {script.stem: _digest_of(shared, script) for script in chosen}
    late = [s for s in chosen if force or not _is_current(manifest.get(s.stem), digests[s.stem], out)]
    if not late:
        return []
    late.sort(key=lambda script: -manifest.get(script.stem, {}).get("seconds", 0.0))
    outcomes = []
    with _progress(len(late)) as report:
        for outcome in _run_all(late, out, jobs or usable_cores()):
            report(outcome)
            outcomes.append(outcome)
            if not outcome.error:
                manifest[outcome.script.stem] = {**outcome.record, "inputs": digests[outcome.script.stem]}
                _write_manifest(out, _of_existing(manifest, scripts))
    return outcomes


def find_scripts(folder: Path, names: Iterable[str] = ()) -> list[Path]:
    """The scripts of a folder in order, those whose name begins with one of `names` when there are any."""
    found = sorted(script for kind in SCRIPTS for script in folder.glob(f"{kind}*.py"))
    if not found:
        raise BuildError(f"no figure scripts in {folder}; give the folder that holds fig*.py with --scripts")
    chosen = set()
    for name in names:
        matching = {script for script in found if script.stem.startswith(name)}
        if not matching:
            raise BuildError(f"no script's name begins with {name!r}; there are {', '.join(s.stem for s in found)}")
        chosen |= matching
    return sorted(chosen) or found


# What a picture depends on


def read_manifest(out: Path) -> dict[str, Record]:
    """The record of each figure by name; empty when there is none or it cannot be read."""
    try:
        records = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return records if isinstance(records, dict) else {}


def _shared_digest(scripts: Path) -> str:
    """Of all that every script depends on: shared modules, library, kernel, versions, the renderer asked for."""
    digest = hashlib.sha256(library_digest())
    for path in sorted(scripts.glob("_*.py")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _digest_of(shared: str, script: Path) -> str:
    return hashlib.sha256(shared.encode() + script.read_bytes()).hexdigest()


def _is_current(record: Record | None, inputs: str, out: Path) -> bool:
    """Whether a script ran on these inputs, and its files are still as it wrote them."""
    if record is None or record.get("inputs") != inputs or not record.get("files"):
        return False
    files: dict[str, str] = record["files"]
    return all((out / name).is_file() and _file_digest(out / name) == digest for name, digest in files.items())


def _file_digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _of_existing(manifest: dict[str, Record], scripts: Path) -> dict[str, Record]:
    return {name: manifest[name] for name in sorted(manifest) if (scripts / f"{name}.py").is_file()}


def _write_manifest(out: Path, manifest: dict[str, Record]) -> None:
    with replacing(out / "manifest.json") as temporary:
        temporary.write_text(json.dumps(manifest, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _require_writable(out: Path) -> None:
    """Fail before the work, not after it."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=out):
            pass
    except OSError as error:
        raise BuildError(f"cannot write to {out}: {error.strerror}; choose another folder with --out") from error


# Running


def _run_all(scripts: list[Path], out: Path, jobs: int) -> Iterator[Outcome]:
    """Outcomes as they come. Scripts that were cut off because another one's process died run again, each alone."""
    cut_off = []
    for script, future in _submit(scripts, out, jobs):
        try:
            yield future.result()
        except BrokenProcessPool:
            cut_off.append(script)
    for script in cut_off:
        for _, future in _submit([script], out, 1):
            try:
                yield future.result()
            except BrokenProcessPool:
                yield Outcome(
                    script, {}, "its process died without a Python error, most likely inside a graphics library"
                )


def _submit(scripts: list[Path], out: Path, jobs: int) -> Iterator[tuple[Path, Future[Outcome]]]:
    # Spawned, not forked: OpenGL contexts and threads do not survive a fork.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(jobs, len(scripts)), mp_context=context) as pool:
        futures = {pool.submit(run_script, script, out): script for script in scripts}
        try:
            for future in as_completed(futures):
                yield futures[future], future
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def run_script(script: Path, out: Path) -> Outcome:
    """Load one script in this process and save its picture; an error becomes text."""
    begin = time.perf_counter()
    try:
        drawing = load_drawing(script)
        record = drawing.save(out)
    except Exception as error:
        return Outcome(script, {}, _error_text(error))
    seconds = time.perf_counter() - begin
    if record.get("renderer") == "gl":
        record["opengl"] = _opengl()
    files = {path.name: _file_digest(path) for path in sorted(out.glob(f"{script.stem}.*"))}
    record = {
        **record,
        "figure": script.stem,
        "script": script.name,
        "seconds": round(seconds, 3),
        "versions": library_versions(),
        "files": files,
    }
    return Outcome(script, record)


def load_drawing(script: Path) -> Any:
    """The `FIGURE` or `ANIMATION` of a script."""
    folder = str(script.resolve().parent)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    spec = importlib.util.spec_from_file_location(script.stem, script)
    if spec is None or spec.loader is None:
        raise BuildError(f"{script} cannot be loaded")
    module = importlib.util.module_from_spec(spec)
    sys.modules[script.stem] = module
    spec.loader.exec_module(module)
    for name in ("FIGURE", "ANIMATION"):
        if hasattr(module, name):
            return getattr(module, name)
    raise BuildError(f"{script} defines neither FIGURE nor ANIMATION")


def _opengl() -> str:
    """What this process drew with."""
    from stereodel.render.gl import describe

    found = describe()
    return f"{found.platform}: OpenGL {found.version}, {found.renderer}"


def _error_text(error: Exception) -> str:
    """The message alone where the user can mend it (script, folder, no OpenGL), else the whole traceback."""
    from stereodel.render.gl import OpenGLError

    if isinstance(error, (BuildError, PermissionError, OpenGLError)):
        return str(error)
    return "".join(traceback.format_exception(error))


# Progress


@contextmanager
def _progress(total: int) -> Iterator[Callable[[Outcome], None]]:
    """A function that shows each outcome: above a bar on a terminal, as plain lines elsewhere."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console()
    done = 0

    def line(outcome: Outcome) -> str:
        took = "failed" if outcome.error else f"{outcome.record['seconds']:.1f} s"
        return f"{done:>3}/{total} {outcome.script.stem}  {took}"

    columns = (TextColumn("drawing"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as progress:
        task = progress.add_task("drawing", total=total)

        def report(outcome: Outcome) -> None:
            nonlocal done
            done += 1
            progress.console.print(line(outcome), style="red" if outcome.error else None, highlight=False)
            progress.advance(task)

        yield report


def main(arguments: list[str] | None = None) -> int:
    """Build from the command line; exit code 0: all is drawn, 1: a script failed, 2: a mistake in the call."""
    parser = argparse.ArgumentParser(prog="tools.build", description="Draw the figures that are out of date.")
    parser.add_argument("names", nargs="*", help="beginnings of script names, e.g. fig03 or anim; all by default")
    parser.add_argument("--scripts", type=Path, default=Path("figures"), help="folder of the scripts")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder to write to")
    parser.add_argument("--jobs", type=int, default=None, help="scripts that run at once; the cores by default")
    parser.add_argument("--force", action="store_true", help="draw also what is up to date")
    options = parser.parse_args(arguments)
    return run(options.scripts, options.out, options.names, jobs=options.jobs, force=options.force)


def run(scripts: Path, out: Path, names: Iterable[str] = (), *, jobs: int | None = None, force: bool = False) -> int:
    """`build`, told in words: prints what happened and returns the exit code."""
    begin = time.perf_counter()
    try:
        outcomes = build(scripts, out, names, jobs=jobs, force=force)
    except BuildError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted; what was finished is kept", file=sys.stderr)
        return 130
    return summarise(outcomes, out, time.perf_counter() - begin)


def summarise(outcomes: list[Outcome], out: Path, seconds: float) -> int:
    """Print what happened, the errors last, and return the exit code."""
    failed = [outcome for outcome in outcomes if outcome.error]
    if not outcomes:
        print(f"{out}: everything is up to date ({seconds:.1f} s)")
    else:
        print(f"{out}: {len(outcomes) - len(failed)} drawn, {len(failed)} failed ({seconds:.1f} s)")
    for outcome in failed:
        print(f"\n{outcome.script}:\n{outcome.error.rstrip()}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
