"""Draw what is out of date: the figure scripts run in parallel, and `notes` says of each what was drawn with what.

Each script defines `FIGURE`, or `film()` if its name begins with `anim_`, which becomes a GIF. Whether a
script must run again is decided by the contents of everything that its picture depends on, and by whether the files
that it wrote are there, before a script is started: when there is nothing to do, that takes a fraction of a second.
Rules of `make` would look at times, and know nothing of versions.

    python -m tools.build --scripts figures --out out [--style STYLE] [NAME…]
"""

from __future__ import annotations

import argparse
import hashlib
import sys
import time
import traceback
from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

from stereodel._tasks.crew import Crew
from stereodel._tasks.kept import Kept, Note
from stereodel._tasks.threads import thread_count
from stereodel.film import Film
from stereodel.film.frames import library_digest, library_versions
from stereodel.render.figure import STYLE_HELP, style_names, styled_folder
from stereodel.render.gl import OpenGLError, describe

SCRIPTS = ("fig", "claim_", "globe_", "earth_", "sky_", "anim_")
"""Beginnings of the names of scripts: the paper's figures, claims that it does not draw, globes through lenses,
pictures of real data, animations."""

NOTES = "notes"
"""Folder of what there is to say of each figure, in the folder of the figures."""

LARGEST_FILM = 3_000_000
"""Bytes that a film of the gallery may have."""

Record = dict[str, Any]


class BuildError(Exception):
    """Something that the user can mend: said in one line, without a traceback."""


@dataclass(frozen=True)
class Outcome:
    """What became of one script: its record, or the text of its error."""

    script: Path
    record: Record
    error: str = ""


def build(scripts: Path, out: Path, names: Iterable[str] = (), *, styles: tuple[str, ...] = ()) -> list[Outcome]:
    """Run the scripts of a folder that are out of date, one a core at once; say so and note what was drawn.

    `names` are beginnings of script names, none for all; `styles` those of `stereodel.drawing.styled`. A BuildError
    where a name begins no script's, an OSError where the folder cannot be written.
    """
    chosen = find_scripts(scripts, names)
    out.mkdir(parents=True, exist_ok=True)
    kept, shared = Kept(out), shared_digest(scripts, styles)
    inputs = {script.stem: _digest(shared.encode() + script.read_bytes()) for script in chosen}
    notes = {script.stem: kept.note(f"{NOTES}/{script.stem}") or {} for script in chosen}
    late = [script for script in chosen if not _is_current(notes[script.stem], inputs[script.stem], out)]
    # The longest first, so that none of them is waited for at the end.
    late.sort(key=lambda script: -notes[script.stem].get("seconds", 0.0))
    outcomes: list[Outcome] = []
    with Crew(thread_count(-1, len(late))) as crew:
        for number, done in crew.each(partial(run_script, out=out, styles=styles), late):
            # Without a result the process died: most likely inside a graphics library.
            outcome = done.result or Outcome(late[number], {}, f"{done.message}, without a Python error")
            outcomes.append(outcome)
            name, record = outcome.script.stem, outcome.record
            took = "failed" if outcome.error else f"{record['seconds']:.1f} s"
            print(f"{len(outcomes):>3}/{len(late)} {name}  {took}", flush=True)
            if not outcome.error:
                # After each, so that what was finished is kept whatever comes.
                files = sorted(path.name for path in out.glob(f"{name}.*"))
                digests = {file: _digest((out / file).read_bytes()) for file in files}
                kept.keep(f"{NOTES}/{name}", {**record, "inputs": inputs[name], "digests": digests}, files)
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


def shared_digest(scripts: Path, styles: tuple[str, ...] = ()) -> str:
    """Of all that every script depends on: shared modules, style files, library, kernel, versions, the renderer."""
    files = [*sorted(scripts.glob("_*.py")), *(path for path in map(Path, styles) if path.is_file())]
    shared = [path.name.encode() + b"\0" + path.read_bytes() + b"\0" for path in files]
    return _digest(library_digest() + b"".join(shared))


def _is_current(note: Note, inputs: str, out: Path) -> bool:
    """Whether a script ran on these inputs, and its files, of the same sizes, have what it wrote."""
    return note.get("inputs") == inputs and all(
        _digest((out / name).read_bytes()) == digest for name, digest in note["digests"].items()
    )


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


# Running


def run_script(script: Path, out: Path, styles: tuple[str, ...] = ()) -> Outcome:
    """Load one script in this process and save its picture; an error becomes text."""
    begin = time.perf_counter()
    try:
        drawing = load_drawing(script)
        drawing = drawing.styled(*styles) if styles else drawing
        record = save_film(drawing, out / f"{script.stem}.gif") if isinstance(drawing, Film) else drawing.save(out)
    except (BuildError, PermissionError, OpenGLError) as error:
        return Outcome(script, {}, str(error))  # which the user can mend
    except Exception as error:
        return Outcome(script, {}, "".join(traceback.format_exception(error)))
    seconds = time.perf_counter() - begin
    if record.get("renderer") == "gl":
        found = describe()
        record["opengl"] = f"{found.platform}: OpenGL {found.version}, {found.renderer}"
    about = {"figure": script.stem, "seconds": round(seconds, 3), "versions": library_versions()}
    return Outcome(script, record | about)


def save_film(film: Film[Any], path: Path) -> Record:
    """Write a film for a page of the web; a BuildError where it is too large for one."""
    film.save(path, jobs=1, progress=False)  # scripts run at the same time
    if path.stat().st_size > LARGEST_FILM:
        raise BuildError(f"{path.name} has {path.stat().st_size} bytes; give fewer frames or a smaller size")
    return {"renderer": "gl", "size": film.size, "frames": len(film)}


def load_drawing(script: Path) -> Any:
    """The `FIGURE` of a script, or what its `film()` gives."""
    folder = str(script.resolve().parent)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    sys.modules[script.stem] = module = ModuleType(script.stem)
    module.__file__ = str(script)
    exec(compile(script.read_bytes(), str(script), "exec", dont_inherit=True), vars(module))
    if hasattr(module, "FIGURE"):
        return module.FIGURE
    if hasattr(module, "film"):
        return module.film()
    raise BuildError(f"{script} defines neither FIGURE nor film()")


def main(arguments: list[str] | None = None) -> int:
    """Build from the command line; exit code 0: all is drawn, 1: a script failed, 2: a mistake in the call."""
    parser = argparse.ArgumentParser(prog="tools.build", description="Draw the figures that are out of date.")
    parser.add_argument("names", nargs="*", help="beginnings of script names, e.g. fig03 or anim; all by default")
    parser.add_argument("--scripts", type=Path, default=Path("figures"), help="folder of the scripts")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder to write to")
    parser.add_argument("--style", type=style_names, default=(), help=f"{STYLE_HELP}; goes into a folder")
    options = parser.parse_args(arguments)
    out = styled_folder(options.out, options.style)
    begin = time.perf_counter()
    try:
        outcomes = build(options.scripts, out, options.names, styles=options.style)
    except (BuildError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    failed = [outcome for outcome in outcomes if outcome.error]
    done = f"{len(outcomes) - len(failed)} drawn, {len(failed)} failed" if outcomes else "everything is up to date"
    print(f"{out}: {done} ({time.perf_counter() - begin:.1f} s)")
    for outcome in failed:
        print(f"\n{outcome.script}:\n{outcome.error.rstrip()}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
