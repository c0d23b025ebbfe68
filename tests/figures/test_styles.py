"""Every figure in a column and on a slide: type of a size that is read, none over another, none lost."""

import pytest

from stereodel.drawing import styled
from stereodel.drawing.page_styles import COLUMN, SLIDE
from tests.drawing.test_page_styles import overlapping
from tests.figures.scripts import FIGURES, page
from tests.tiers import by_day

MAPS = ("globe_europe", "globe_tissot")
by_name = pytest.mark.parametrize("name", by_day([*FIGURES, *MAPS], "fig03_bubbles", "globe_tissot"))


def words(shown):
    """All that is written, without the breaks of lines."""
    return sorted(" ".join(label.text for label in shown.labels).split())


@by_name
@pytest.mark.parametrize(("style", "medium"), [("column", COLUMN), ("slide", SLIDE)])
def test_type_can_be_read_and_none_is_lost(name, style, medium):
    before = page(name)
    shown = styled(before, style)
    assert shown.width == pytest.approx(medium.width)
    assert medium.height is None or shown.height == pytest.approx(medium.height)
    assert all(label.size >= medium.least_type for label in shown.labels)
    assert overlapping(shown) == []
    # On maps labels that have no room are left out, but not more than a quarter of them.
    if name in MAPS:
        assert len(words(shown)) >= 0.75 * len(words(before))
    else:
        assert words(shown) == words(before)
