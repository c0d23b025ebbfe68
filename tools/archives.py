"""Check what the source archive and the wheel hold.

The archive: every tracked file but stored pictures, without which its tests do. The wheel: the package with its stub,
its compiled kernel, what was built for the interactive page, the licences and the bill of materials, which names each
file of data by its checksum, and no source of either.

    python tools/archives.py ARCHIVE [WHEEL…]
"""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOT_IN_ARCHIVE = ("tests/images/baselines/",)
NOT_IN_WHEEL = ("stereodel/kernel/", "stereodel/web/script/")
"""Sources, of what is in the wheel as it was built."""


def archive_problems(names: set[str], tracked: set[str]) -> list[str]:
    """What the source archive lacks, and what does not belong there."""
    wanted = {name for name in tracked if not name.startswith(NOT_IN_ARCHIVE)}
    missing = [f"not in the archive: {name}" for name in sorted(wanted - names)]
    return missing + [f"not tracked: {name}" for name in sorted(names - wanted - {"PKG-INFO"})]


def wheel_problems(names: set[str], tracked: set[str]) -> list[str]:
    """What the wheel lacks, and what does not belong there."""
    wanted = {name for name in tracked if name.startswith("stereodel/") and not name.startswith(NOT_IN_WHEEL)}
    kernels = {name for name in names if name.startswith("stereodel/_kernel.") and name not in wanted}
    package = {name for name in names if name.startswith("stereodel/")}
    found = [f"not in the wheel: {name}" for name in sorted(wanted - names)]
    found += [f"not in the package: {name}" for name in sorted(package - wanted - kernels)]
    carried = {name.partition(".dist-info/licenses/")[2] for name in names}
    licences = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["license-files"]
    found += [f"no licence in the wheel: {name}" for name in licences if name not in carried]
    return found if len(kernels) == 1 else [*found, f"one compiled kernel wanted, not {sorted(kernels)}"]


def bill_problems(wheel: zipfile.ZipFile) -> list[str]:
    """Where the wheel's bill of materials is not of what is in it."""
    names = [member.filename for member in wheel.infolist() if not member.is_dir()]
    bills = [name for name in names if name.endswith(".dist-info/sboms/NOTICES.cdx.json")]
    if len(bills) != 1:
        return ["no bill of materials in the wheel"]
    listed = {
        part["name"]: each["content"]
        for part in json.loads(wheel.read(bills[0]))["components"]
        for each in part.get("hashes", [])
    }
    data = [name for name in names if name.startswith("stereodel/data/") and not name.endswith((".py", ".json", ".md"))]
    found = {name: hashlib.sha256(wheel.read(name)).hexdigest() for name in data}
    return [f"not as the bill of materials says: {name}" for name, _ in sorted(listed.items() ^ found.items())]


def main(archive: str, *wheels: str) -> None:
    """Report; end with 1 where something is wrong."""
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    tracked = {name for name in listing.stdout.split("\0") if name}
    with tarfile.open(archive) as source:
        members = {member.name.partition("/")[2] for member in source.getmembers() if member.isfile()}
    print(f"{len(members)} files in {archive}")
    found = [f"{archive}: {problem}" for problem in archive_problems(members, tracked)]
    for wheel in wheels:
        with zipfile.ZipFile(wheel) as built:
            packed = {member.filename for member in built.infolist() if not member.is_dir()}
            found += [f"{wheel}: {problem}" for problem in wheel_problems(packed, tracked) + bill_problems(built)]
        print(f"{len(packed)} files in {wheel}")
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
