"""Write the first page of a site that has a folder of documentation for each version.

    python tools/documentation_versions.py SITE

The page leads to the newest version, or to "dev" where there is none, and lists all others.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

VERSION = re.compile(r"\d+(\.\d+)*([a-z]+\d+)?")
PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta http-equiv="refresh" content="0; url={newest}/">
<title>stereodel: documentation</title>
<h1>stereodel: documentation</h1>
<ul>
{links}
</ul>
</html>
"""


def order(name: str) -> tuple[bool, list[int], bool]:
    """Versions by their numbers, each after what was tried before it, and all after "dev"."""
    released = VERSION.fullmatch(name) is not None
    numbers = [int(part) for part in re.findall(r"\d+", re.split("[a-z]", name)[0])]
    return released, numbers if released else [], re.search("[a-z]", name) is None


def versions(site: Path) -> list[str]:
    """Folders with documentation, the newest version first."""
    return sorted((path.parent.name for path in site.glob("*/index.html")), key=order, reverse=True)


def main(site: str) -> int:
    """Write index.html into the folder."""
    found = versions(Path(site))
    if not found:
        print(f"tools/documentation_versions.py: no folder of {site} has documentation", file=sys.stderr)
        return 1
    links = "\n".join(f'<li><a href="{name}/">{name}</a>' for name in found)
    Path(site, "index.html").write_text(PAGE.format(newest=found[0], links=links), encoding="utf-8")
    Path(site, ".nojekyll").touch()
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
