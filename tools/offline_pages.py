"""Check that built pages load nothing from elsewhere: no script, style, font or picture with an address.

python tools/offline_pages.py docs/_build/html
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path

LOADING = {"script": "src", "img": "src", "iframe": "src", "source": "src", "video": "src", "object": "data"}
LOADED_LINKS = {"stylesheet", "preload", "icon", "modulepreload", "prefetch"}
REMOTE = re.compile(r"(?:https?:)?//")
REMOTE_STYLE = re.compile(r"""(?:url\(\s*["']?|@import\s+["'])(?:https?:)?//[^)"']*""")


class Loads(HTMLParser):
    """Collects what a page would fetch from other machines."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Look at one tag."""
        values = {name: value or "" for name, value in attrs}
        address = values.get(LOADING.get(tag, ""), "")
        if tag == "link" and LOADED_LINKS & set(values.get("rel", "").split()):
            address = values.get("href", "")
        if REMOTE.match(address):
            self.found.append(f"<{tag}> {address}")


def remote_loads(path: Path) -> list[str]:
    """What a page or style sheet fetches from elsewhere."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".css":
        return REMOTE_STYLE.findall(text)
    parser = Loads()
    parser.feed(text)
    return parser.found


def main(folder: str) -> int:
    """Report and return the exit code."""
    paths = [path for path in sorted(Path(folder).rglob("*")) if path.suffix in {".html", ".css"}]
    found = [f"{path}: {load}" for path in paths for load in remote_loads(path)]
    print(f"{len(paths)} pages and style sheets read")
    print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
    return 1 if found or not paths else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
