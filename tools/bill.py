"""Write the bill of materials of the wheel, or check that it is the one that notices, data and versions give.

It is CycloneDX 1.6: what others have written and is compiled in (`NOTICES.md`), and each file of data with its source,
licence and checksum (`stereodel/data/sources.json`). CMake puts it beside the wheel's metadata, where PEP 770 wants it.

    python tools/bill.py [--check]
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

from cyclonedx.contrib.license.factories import LicenseFactory
from cyclonedx.model import ExternalReference, ExternalReferenceType, HashAlgorithm, HashType, XsUri
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.output.json import JsonV1Dot6

import stereodel

ROOT = Path(__file__).resolve().parent.parent
BILL = ROOT / "NOTICES.cdx.json"
PINNED = {"nanobind": "nanobind", "the runtime of Zig's compiler": "ziglang"}
"""What is compiled in, by its words in `NOTICES.md`, and the pin that has its version."""


def bill() -> str:
    """The bill as text; no time and no serial number, so that the same sources give the same bytes."""
    licences = LicenseFactory()
    pins = dict(line.split("==") for line in (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines())
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    own = licences.make_from_string(re.search(r'^license = "(.+)"$', project, re.MULTILINE)[1])  # type: ignore[index]
    bom = Bom()
    bom.metadata.timestamp = None  # type: ignore[assignment]
    bom.metadata.component = Component(
        name="stereodel", version=stereodel.__version__, type=ComponentType.LIBRARY, licenses=[own], bom_ref="stereodel"
    )
    rows = re.findall(
        r"^\| (?!what|---)(.+?) \| (.+?) \| (.+?) \|$", (ROOT / "NOTICES.md").read_text("utf-8"), re.MULTILINE
    )
    parts = [
        Component(
            name=what,
            version=pins[PINNED[what]] if what in PINNED else None,
            description=f"compiled into {re.sub('`', '', where)}",
            licenses=[licences.make_from_string(licence)],
            bom_ref=what,
        )
        for what, where, licence in rows
    ]
    sources = json.loads((ROOT / "stereodel" / "data" / "sources.json").read_text(encoding="utf-8"))
    parts += [
        Component(
            name=f"stereodel/data/{each['file']}",
            type=ComponentType.DATA,
            description=f"{each['source']}; through {each['package']}",
            licenses=[licences.make_from_string(each["licence"].replace("CC BY 4.0", "CC-BY-4.0"))],
            hashes=[HashType(alg=HashAlgorithm.SHA_256, content=each["sha256"])],
            external_references=[
                ExternalReference(type=ExternalReferenceType.DISTRIBUTION, url=XsUri(found))
                for found in re.findall(r"https://[^\s,;]+", each["source"])[:1]
            ],
            bom_ref=name,
        )
        for name, each in sources.items()
    ]
    for part in parts:
        bom.components.add(part)
    bom.register_dependency(bom.metadata.component, parts)
    made = json.loads(JsonV1Dot6(bom).output_as_string())
    del made["serialNumber"]
    made["metadata"].pop("timestamp", None)
    return json.dumps(made, indent=1, ensure_ascii=False) + "\n"


def main(*options: str) -> None:
    """Write, or check; end with 1 where they differ."""
    if options != ("--check",):
        BILL.write_text(bill(), encoding="utf-8")
    elif BILL.read_text(encoding="utf-8") != bill():
        sys.exit(f"{BILL.name} is not what notices, data and versions give: run python tools/bill.py")


if __name__ == "__main__":
    main(*sys.argv[1:])
