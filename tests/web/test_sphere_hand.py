"""The hand on the Sphere: a site that is dragged is drawn where it was and where it is, and nowhere else."""

import numpy as np
import pytest

from .rooms import link, said

BALL = "#sphere-ball"
PLANE = "#sphere-plane"


def differing(a, b):
    """The share of pixels that differ by more than an eye sees."""
    return float((np.abs(a.astype(int) - b).max(axis=-1) > 24).mean())


@pytest.fixture
def crowd(rng):
    """Values of a link with 300 sites all over the sphere, the first one in the middle of the view."""
    lonlat = np.vstack([[0, 0], rng.uniform((-180, -80), (180, 80), size=(300, 2))])
    return f"v=1&room=sphere&sites={','.join(f'{value:.3f}' for value in lonlat.ravel())}"


def test_a_dragged_site_is_drawn_as_a_fresh_page_draws_it(room, crowd):
    page = room(crowd)
    x, y = page.middle(BALL)
    before = page.picture(BALL)
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 90, y - 50, steps=9)
    page.rest()
    held, sentence = [page.picture(drawing) for drawing in (BALL, PLANE)], said(page, "sphere", "sentence")
    assert differing(before, held[0]) > 0.005
    assert "Other sites inside, counted exactly: 0\u00a0and\u00a00." in sentence
    page.page.mouse.up()
    page.rest()
    # While the hand holds it, only its surroundings are drawn anew; the others' lines may differ where windows end.
    at_rest = [page.picture(drawing) for drawing in (BALL, PLANE)]
    assert max(map(differing, held, at_rest)) < 0.0015
    page.page.mouse.move(1, 1)
    link(page)
    again = room(page.link)
    assert said(again, "sphere", "sentence") == said(page, "sphere", "sentence") == sentence
    assert [again.digest(drawing) for drawing in (BALL, PLANE)] == [page.digest(drawing) for drawing in (BALL, PLANE)]
