"""Check that built pages load nothing from elsewhere, no script, style, font or picture, and that links lead somewhere.

Links inside lead to files and places that are there; those to other hosts are not followed, but the hosts are known.

python tools/offline_pages.py docs/_build/html
"""

from __future__ import annotations

import re
import sys
from html import unescape
from pathlib import Path
from urllib.parse import unquote, urlsplit

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


HOSTS = {"anywidget.dev", "hats.readthedocs.io", "hpgeom.readthedocs.io", "keepachangelog.com", "scientific-python.org"}
HOSTS |= {"semver.org", "ugrid-conventions.github.io"}


def broken_links(texts: dict[Path, str]) -> list[str]:
    """Links of pages to what is not there, or to a host that is not known."""
    places = {path: set(re.findall(r'\s(?:id|name)="([^"]*)"', text)) for path, text in texts.items()}
    found = []
    for path, text in texts.items():
        for link in map(unescape, re.findall(r'\s(?:href|src)="([^"]*)"', text)):
            scheme, host, to, _, place = urlsplit(link)
            target = path.parent.joinpath(unquote(to)).resolve() if to else path
            there = target.is_file() and (not place or unquote(place) in places.get(target, {unquote(place)}))
            if not (host in HOSTS if host else scheme == "data" or there):
                found.append(f"{path} leads to {link}")
    return found


def main(folder: str) -> None:
    """Report; end with 1 where something is wrong."""
    paths = sorted(path for path in Path(folder).resolve().rglob("*") if path.suffix in LOADS)
    texts = {path: path.read_text("utf-8") for path in paths}
    found = [f"{path}: {load}" for path, text in texts.items() for load in LOADS[path.suffix].findall(text)]
    # The interactive page makes its places itself; those of the theme are templates.
    left_out = re.compile(r"/_static/|/interactive\.html$|\.css$")
    found += broken_links({path: text for path, text in texts.items() if not left_out.search(path.as_posix())})
    print(f"{len(texts)} pages and style sheets read")
    sys.exit("\n".join(found) or not texts)


if __name__ == "__main__":
    main(*sys.argv[1:])
