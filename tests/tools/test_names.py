"""docs/names.md says what the packages are now, all of them."""

import pkgutil

import stereodel
from tools import names

PAGE = names.PAGE.read_text(encoding="utf-8")


def test_the_page_is_up_to_date():
    assert names.filled(PAGE) == PAGE, "run make names"


def test_every_package_has_its_table():
    found = {f"stereodel.{module.name}" for module in pkgutil.iter_modules(stereodel.__path__) if module.name[0] != "_"}
    assert found - {"stereodel.cli", "stereodel.constants", "stereodel.curves"} == set(names.PACKAGES)
