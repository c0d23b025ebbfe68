"""The README as it stands in the metadata of archives, where an index shows it: with absolute links.

The build backend calls `dynamic_metadata` (``tool.dynamic-metadata`` in pyproject.toml). The address of the sources is
``Source`` of ``project.urls``. Without it links stay as they are in the repository, but a build for publication, with
``STEREODEL_PUBLICATION=1`` in the environment, fails where it or another address is missing: what an index has been
given stays as it is.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

README = Path(__file__).resolve().parent.parent / "README.md"
PUBLICATION = "STEREODEL_PUBLICATION"
ADDRESSES = ("Homepage", "Documentation", "Source", "Issues", "Changelog")
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
LINK = re.compile(r'(!?\[[^\[\]]*\]\(|\b(?:src|href)=")(?![a-z]+:|#)([^)"\s]+)')
"""Paths within the repository, in Markdown and in HTML."""


def dynamic_metadata(settings: Mapping[str, Any], project: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of ``project`` that this provider adds; `project` has the version already."""
    urls = project.get("urls", {})
    source = urls.get("Source", "")
    missing = [name for name in ADDRESSES if not urls.get(name)]
    if os.environ.get(PUBLICATION) and missing:
        raise RuntimeError(
            f"{PUBLICATION} is set, but project.urls of pyproject.toml lacks {', '.join(missing)}: an index would show "
            "the README without its pictures, and lead nowhere; docs/publishing.md says what else is missing"
        )
    text = README.read_text(encoding="utf-8")
    if source:
        text = absolute(text, source.rstrip("/"), f"v{project['version']}")
    return {"readme": {"content-type": "text/markdown", "text": text}}


def absolute(text: str, source: str, tag: str) -> str:
    """Markdown with pictures and links that lead to the files of a tag; code is left as it is."""

    def link(found: re.Match[str]) -> str:
        kind = "raw" if found[1].startswith(("!", "src")) else "blob"
        return f"{found[1]}{source}/{kind}/{tag}/{found[2]}"

    pieces, end = [], 0
    for code in CODE.finditer(text):
        pieces += [text[end : code.start()], code[0]]
        end = code.end()
    pieces.append(text[end:])
    return "".join(piece if number % 2 else LINK.sub(link, piece) for number, piece in enumerate(pieces))
