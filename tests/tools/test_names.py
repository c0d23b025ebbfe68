"""docs/names.md says what the packages are: every public name, its signature, its first line, its members."""

import importlib
import pkgutil
import re

import pytest

import stereodel
from tools import names

PAGE = names.PAGE.read_text(encoding="utf-8")
NOT_PUBLIC = {"stereodel.cli", "stereodel.constants", "stereodel.curves"}


def test_the_page_is_up_to_date():
    assert names.filled(PAGE) == PAGE, "run make names"


def test_every_package_has_its_table():
    assert re.findall(r"<!-- names: (\S+) -->", PAGE) == list(names.PACKAGES)
    found = {f"stereodel.{module.name}" for module in pkgutil.iter_modules(stereodel.__path__) if module.name[0] != "_"}
    assert found - NOT_PUBLIC == set(names.PACKAGES)


@pytest.mark.parametrize("package", names.PACKAGES)
def test_every_name_has_a_row(package):
    rows = names.table(package).split("\n")[2:]
    assert [re.match(r"\| \**`(\w+)", row)[1] for row in rows] == names.public_names(importlib.import_module(package))
    assert all(re.fullmatch(r"\| \**`.*`\** \| .{9,} \|", row) for row in rows)


def test_members_are_those_of_our_classes():
    members = names.members(stereodel.SphericalDelaunay)
    assert {"closing", "points", "find_simplex", "from_lonlat", "inconclusive", "lonlat"} <= set(members)
    assert not [name for name in members if name.startswith("_")]
    assert names.members(stereodel.HullInsertion) == sorted(names.members(stereodel.HullInsertion))
    assert "start" in names.members(stereodel.HullInsertion)  # described, made by the constructor
    assert names.members(len) == []
