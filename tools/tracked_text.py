"""Check the text of every tracked file: no absolute path, no address of a package index, no unfinished work.

C++ besides, which no formatter lays out here: at most 120 columns, no tabs, no spaces at the end of a line.

python tools/tracked_text.py
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# The patterns are written so that they do not match themselves.
FORBIDDEN = {
    "absolute path of one machine": re.compile(r"(?<![\w./])/(?:home|Users|root|work|tmp)/[\w.]"),
    "address of a package index": re.compile(
        r"https?://[\w.-]*(?:py[p]i|python[h]osted|registry\.n[p]m|deb\.deb[i]an)[\w./-]*"
    ),
    "unfinished work": re.compile(r"\b(?:TO[D]O|FIX[M]E|XX[X])\b"),
}
LAYOUT = {"more than 120 characters, a tab, or a space at the end": re.compile(r".{121}|\t| $")}
PINNED = re.compile(r"[A-Za-z0-9._-]+==[A-Za-z0-9._+!-]+")


def problems(name: str, text: str) -> list[str]:
    """What is wrong with one file's text."""
    forbidden = FORBIDDEN | (LAYOUT if name.endswith((".cpp", ".hpp")) else {})
    found = [
        f"{name}:{number}: {what}: {line.strip()[:100]}"
        for number, line in enumerate(text.splitlines(), 1)
        for what, pattern in forbidden.items()
        if pattern.search(line)
    ]
    if name == "constraints.txt":
        found += [f"{name}: not name==version: {line}" for line in text.splitlines() if not PINNED.fullmatch(line)]
    return found


def main() -> None:
    """Report; end with 1 where something is wrong."""
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    names = [name for name in listing.stdout.split("\0") if name and (ROOT / name).is_file()]
    found: list[str] = []
    for name in names:
        try:
            found += problems(name, (ROOT / name).read_text(encoding="utf-8"))
        except UnicodeDecodeError:
            continue  # pictures and other binary files
    print(f"{len(names)} tracked files read")
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()
