"""The experiment on interpolation: what its page says of the methods."""

import pytest

from benchmarks import interpolation, interpolation_page

pytestmark = pytest.mark.thorough


@pytest.fixture(scope="module")
def rows():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(interpolation, "QUERIES", 500)
        patch.setattr(interpolation, "stripys", lambda *task: iter(()))  # needs an environment of its own
        return [row for size in (500, 4000) for row in interpolation.measure(size)]


def error(rows, space, library, method):
    asked = {"space": space, "library": library, "method": method, "points": 4000}
    (found,) = [row["rms"] for row in rows if asked.items() <= row.items()]
    return found


def test_linear_interpolation_leaves_no_choice(rows):
    ours, scipys = (error(rows, "plane", library, "linear") for library in ("stereodel", "SciPy"))
    assert ours == pytest.approx(scipys, rel=1e-9)


@pytest.mark.parametrize("space", ["plane", "sphere"])
def test_methods_stand_in_the_order_of_the_page(rows, space):
    errors = [error(rows, space, "stereodel", method) for method in ("smooth", "linear", "nearest")]
    assert errors == sorted(errors)
    assert error(rows, "plane", "stereodel", "smooth") < error(rows, "plane", "SciPy", "smooth")


def test_tables_have_a_cell_for_each_measurement(rows):
    table = interpolation_page.error_table(rows, "plane")
    assert "–" not in table.replace(":--", "")
    assert "NaN" in interpolation_page.errors(rows[0] | {"missing": 3})
