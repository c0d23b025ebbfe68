"""What each animation shows is what its words say, it can be read in its time, and its end leads to its beginning."""

import re

import numpy as np
import pytest

from stereodel import PlanarDelaunay, RectangleLift, SphericalDelaunay, in_bubble
from stereodel.drawing import Dots, Graticule, Label
from stereodel.sphere import graticule_patch
from stereodel.triangulation import check_delaunay
from tests.figures.scripts import FOLDER, script

SHORTEST = 2.0  # seconds for a line of words


def labels(page):
    return [item for item in page.items if isinstance(item, Label)]


def centers(page, *names):
    """Dots of some names, in any order."""
    found = np.vstack([item.centers for item in page.items if isinstance(item, Dots) and item.name in names])
    return found[np.lexsort(found.T)]


@pytest.mark.parametrize("name", tuple(path.stem for path in sorted(FOLDER.glob("anim_*.py"))))
def test_a_film_stands_still_for_its_words_and_begins_with_a_picture_that_does(name):
    film = script(name)["film"]()
    assert film.times[0] >= SHORTEST
    assert film.times.min() >= 0.02  # what browsers show
    assert 10 < film.duration < 40


# The fisheye


def test_the_fisheye_stops_at_the_numbers_of_figures_10_to_12():
    module = script("anim_fisheye")
    held = {size for (size, _), seconds in module["moments"]() if seconds >= SHORTEST}
    assert held == {1.0, 4.0, 20.0}
    lines = module["grids"]()
    for stage in module["STAGES"]:
        shot = (stage.magnification, (stage.magnification, stage.magnification))
        (text,) = [label.text for label in module["frame"](shot, lines).labels if "Figure" in label.text]
        looks = module["styles"](stage.magnification)
        drawn = {name for name in lines if looks[name].color[3] > 0}
        black = [arc for name in drawn if looks[name].color[:3] == (0.0, 0.0, 0.0) for arc in lines[name]]
        patch = graticule_patch(module["FOCUS"], stage.half_width, stage.fine)
        # The same in any order, by three points of each.
        rows = [np.array([arc.sample(3).ravel() for arc in arcs]).round(9) + 0.0 for arcs in (black, patch)]
        assert np.array_equal(*(array[np.lexsort(array.T)] for array in rows))
        gray = max((lines[name].arcs for name in drawn if "graticule" in name), key=len)
        expected = Graticule.regular(stage.coarse).arcs
        assert np.array_equal(gray.start, expected.start)
        assert np.array_equal(gray.axis, expected.axis)
        assert all(looks[name].color[3] == 1 for name in drawn)
        assert f"Figure { {1: 10, 4: 11, 20: 12}[stage.magnification] }: graticule {stage.coarse}°" in text
        assert text.endswith(f"fine grid {'½' if stage.fine == 0.5 else stage.fine}°")


# The hull


def test_each_step_of_the_hull_has_the_facets_that_it_says():
    module = script("anim_hull")
    sites = module["on_sphere"](module["SITES"], module["SEED"])
    moments = [moment for moment, _ in module["moments"]()]
    for moment in moments:
        (text,) = [label.text for label in labels(module["frame"](moment, sites)) if "facets" in label.text]
        step, n, facets = map(int, re.fullmatch(r"step (\d+):.*n = (\d+).*= (\d+)\$ facets", text).groups())
        later = moment.point is not None and "new" not in moment.kinds
        assert n == len(np.unique(moment.facets))
        assert n == step + 3 - later
        assert facets == len(moment.facets) == 2 * n - 4
    whole = SphericalDelaunay(sites).simplices
    for final in (moments[0], moments[-1]):
        assert {tuple(sorted(row)) for row in final.facets.tolist()} == {tuple(sorted(row)) for row in whole.tolist()}


# The lift


def test_the_lift_begins_with_the_plane_itself_and_ends_with_the_hemisphere():
    module = script("anim_lift")
    curvatures = [shot for shot, _ in module["moments"]()]
    assert (curvatures[0], max(curvatures)) == (0.0, 1.0)
    start, soon, end = (module["frame"](curvature) for curvature in (0.0, 1e-6, 1.0))
    assert np.abs(centers(start, "sites") - centers(soon, "sites")).max() < 1e-3
    lift = RectangleLift(3.0, 2.0)
    raised = lift.forward(script("fig08_hemisphere")["sites"]()) * lift.sphere.radius
    low = raised + [0.0, 0.0, lift.sphere.radius]
    view = module["VIEW"]
    seen = view.project(low)[(view.depth(raised) > 0) | (low[:, 2] < 0)]
    expected = module["UNIT"] * seen + module["MIDDLE"]
    assert np.allclose(centers(end, "sites"), expected[np.lexsort(expected.T)], atol=1e-9)
    assert [round(module["extent"](place)) for place in (0.0, 0.25, 0.5, 1.0)] == [0, 56, 106, 180]


def test_the_triangulation_of_the_lift_never_changes():
    module = script("anim_lift")
    edges = {tuple(edge) for edge in PlanarDelaunay(module["sites"]()).edges.tolist()}
    for curvature in (0.0, 0.1, 0.7):
        drawn = [item for item in module["frame"](curvature).items if item.name == "delaunay"]
        assert len(drawn) >= len(edges)  # some in two pieces, where they pass under the plane's edge


# Sites that come and go


def test_what_goes_are_the_bubbles_that_contain_a_new_site():
    for change in script("anim_sites")["changes"]():
        if change.comes:
            inside = [rows for rows in change.before.triangles.values() if in_bubble(*rows, change.site) > 0]
            assert sorted(map(str, inside)) == sorted(map(str, change.gone))
        else:
            assert all((rows == change.site).all(axis=1).any() for rows in change.gone)
        # Euler: a star of k + 2 triangles fills a cavity of k.
        assert len(change.new) - len(change.gone) == (2 if change.comes else -2)
        numbers = re.findall(r"\d+", " ".join(change.words(phase) for phase in ("open", "fill", "check")))
        assert numbers == [str(len(change.gone)), *[str(len(change.new))] * 2]


def test_the_triangles_are_those_of_a_fresh_start_and_the_film_closes():
    changes = script("anim_sites")["changes"]()
    for change in changes:
        fresh = SphericalDelaunay(change.after.sites)
        check_delaunay(fresh)
        names = {frozenset(map(tuple, rows)) for rows in fresh.points[fresh.simplices].tolist()}
        assert names == set(change.after.triangles)
        assert len(change.after.ridges) == len(change.after.edges) == 3 * len(change.after.sites) - 6
    for change, following in zip(changes, [*changes[1:], changes[0]], strict=True):
        assert set(change.after.triangles) == set(following.before.triangles)


def test_the_last_frame_of_the_sites_is_the_first_but_for_its_words():
    film = script("anim_sites")["film"]()
    first, last = film.draw(film.shots[0]), film.draw(film.shots[-1])
    assert np.array_equal(centers(first, "sites"), centers(first, "sites", "points"))
    assert np.allclose(centers(first, "sites"), centers(last, "sites", "points"))
