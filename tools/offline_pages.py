"""Check that built pages load nothing from elsewhere: no script, style, font or picture with an address.

python tools/offline_pages.py docs/_build/html
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

REMOTE = r"""["']?(?:https?:)?//"""
LOADS = {
    ".html": re.compile(
        rf"<(?:script|img|iframe|source|video)\b[^>]*\ssrc\s*=\s*{REMOTE}[^>]*|<object\b[^>]*\sdata\s*=\s*{REMOTE}[^>]*|"
        r"""<link\b(?=[^>]*\srel\s*=\s*["']?[^"'>]*\b(?:stylesheet|preload|modulepreload|icon|prefetch)\b)"""
        rf"[^>]*\shref\s*=\s*{REMOTE}[^>]*"
    ),
    ".css": re.compile(rf"(?:url\(\s*|@import\s+){REMOTE}[^)\"']*"),
}
"""What fetches from other machines, by the kind of file."""


def main(folder: str) -> None:
    """Report; end with 1 where something is wrong."""
    paths = [path for path in sorted(Path(folder).rglob("*")) if path.suffix in LOADS]
    found = [f"{path}: {load}" for path in paths for load in LOADS[path.suffix].findall(path.read_text("utf-8"))]
    print(f"{len(paths)} pages and style sheets read")
    sys.exit("\n".join(found) or not paths)


if __name__ == "__main__":
    main(*sys.argv[1:])
