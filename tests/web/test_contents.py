"""What a page carries comes out of it as it went in: land without seams, sets, and the reader's points to the bit."""

import json

import numpy as np
import pytest

from stereodel import data
from stereodel.curves.ragged import Ragged
from stereodel.data import land
from stereodel.web import contents

from .conftest import SCRIPT, asking

read = asking(f"""
import {{ Contents }} from "{SCRIPT}/contents.ts";
const blocks = given;
const contents = new Contents((name) => blocks[name] ?? null);
const rings = (found) => found && {{ lonlat: [...found.lonlat], offsets: [...found.offsets] }};
""")


def read_rings(node, text):
    found = read(node, "rings(await contents.rings('land-50m'))", {"land-50m": text})
    return np.reshape(found["lonlat"], (-1, 2)), found["offsets"]


def test_places_come_back_to_the_bit(node, rng):
    degrees = np.round(rng.uniform((-180, -90), (180, 90), size=(1000, 2)), 6)
    degrees[:4] = [(-180, -90), (180, 90), (0, 0), (-0.000001, 0.000001)]
    lonlat, offsets = read_rings(node, contents.packed_places(Ragged(degrees, np.array([0, 3, 3, 1000])), 6))
    np.testing.assert_array_equal(lonlat, degrees)
    assert offsets == [0, 3, 3, 1000]


def test_doubles_come_back_to_the_bit(node, rng):
    degrees = np.concatenate([rng.uniform(-90, 90, size=(50, 2)), [[-0.0, 5e-324], [1 / 3, -90]]])
    blocks = {
        "given": contents.packed_doubles(degrees),
        "given-name": contents.packed(json.dumps('Orte, "neu" ∂').encode()),
    }
    expression = "contents.given().then(({ name, lonlat }) => [name, [...new Uint8Array(lonlat.buffer)]])"
    found = read(node, expression, blocks)
    assert found[0] == 'Orte, "neu" ∂'
    assert bytes(found[1]) == degrees.astype("<f8").tobytes()


def test_what_a_page_has_not(node):
    nothing = "Promise.all([contents.rings('land-50m'), contents.given()])"
    assert read(node, nothing, {}) == [None, None]
    assert read(node, "contents.kernel().catch((error) => error.message)", {}) == "the page has no kernel"


def area(rings):
    """Of rings on a cylinder of equal area; round the pole, the land beyond it is the rest of the cylinder."""
    a, b = rings.values, rings.values[rings.following]
    step = np.remainder(b[:, 0] - a[:, 0] + 180, 360) - 180
    height = np.sin(np.radians([a[:, 1], b[:, 1]])).mean(axis=0)
    turns = np.bincount(rings.row, step, minlength=len(rings))
    return -np.sum(height * np.radians(step)) + np.sum(np.abs(np.round(turns / 360))) * 2 * np.pi


@pytest.mark.parametrize("resolution", ["110m", pytest.param("50m", marks=pytest.mark.thorough)])
def test_land_is_that_of_the_package_without_seams(node, resolution):
    lonlat, offsets = read_rings(node, contents.land_rings(resolution))
    rings = Ragged(lonlat, np.array(offsets))
    after = lonlat[rings.following]
    assert rings.sizes.min() > 2
    assert (lonlat != after).any(axis=1).all()
    assert lonlat[:, 1].min() > -86  # the coast of Antarctica, and not the pole
    along = (np.abs(lonlat[:, 0]) == 180) & (np.abs(after[:, 0]) == 180)
    # Both sides of Fiji's Taveuni differ by 200 m there.
    assert np.abs(lonlat[along, 1] - after[along, 1]).max(initial=0) < 0.011

    table = land(resolution)
    whole = Ragged(table.lonlat, table.ring_offsets.astype(np.intp))
    sides = whole.values[whole.following]
    heights = np.sin(np.radians([whole.values[:, 1], sides[:, 1]])).mean(axis=0)
    stored = -np.sum(heights * np.radians(sides[:, 0] - whole.values[:, 0]))
    assert area(rings) == pytest.approx(stored, rel=1e-3)
    assert 0.28 < area(rings) / (4 * np.pi) < 0.30


def read_set(node, name):
    found = read(node, f"contents.rings('{name}').then((s) => [...s.lonlat])", {name: contents.sites(name)})
    return np.reshape(found, (-1, 2))


@pytest.mark.parametrize("name", ["cities", "airports", "stars"])
def test_the_sets_are_places_of_the_package(node, name):
    whole = getattr(data, name)().lonlat
    found = read_set(node, name)
    assert 100 < len(found) < 300
    assert {tuple(place) for place in found.tolist()} <= {tuple(place) for place in whole.tolist()}
    assert len(np.unique(found, axis=0)) == len(found)


@pytest.mark.parametrize(("name", "places"), contents.scattered().items())
def test_the_sets_that_rooms_begin_with(node, name, places):
    assert read_set(node, name).tolist() == places.tolist()


def test_too_many_points():
    with pytest.raises(ValueError, match=r"stars\.csv has 1000001 points, but a page takes up to 1000000"):
        contents.Given(np.zeros((contents.MOST_POINTS + 1, 2)), "stars.csv")
