"""The numbers in the words of pictures: computed by the scripts, and here once more in another way.

Those in captions, which are docstrings, have their tests in `test_captions.py`.
"""

import re

import numpy as np
import pytest
from scipy.spatial import SphericalVoronoi, cKDTree

from stereodel import data, earth, fisheye
from stereodel.sphere import lonlat_to_xyz
from tests.figures.scripts import geometry, page, script
from tests.tiers import by_day

NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")
WORDS = {word: number for number, word in enumerate(NUMBERS, start=1)}


# Data of the Earth and of the sky.


EARTH_KM2 = 4 * np.pi * earth.AUTHALIC_RADIUS_KM**2


def authalic_xyz(lonlat):
    return lonlat_to_xyz(lonlat, latitude="authalic")


def words_of(name):
    """All that a picture says, by what it begins with."""
    return [label.text.replace("\N{NO-BREAK SPACE}", " ") for label in page(name).labels]


def said(name, pattern):
    """What a pattern finds in the one text of a picture that it fits."""
    (found,) = [match.groups() for text in words_of(name) if (match := re.fullmatch(pattern, text))]
    return found


def as_number(text):
    """What digits or words say."""
    text = text.removeprefix("≤ ").removeprefix("≥ ")
    whole, half, _ = text.partition(" and a half")
    unit = 1e6 if whole.endswith(" million") else 1.0
    digits = whole.removesuffix(" million").replace(" ", "")
    return unit * (WORDS[digits] if digits in WORDS else float(digits)) + 0.5 * bool(half)


def test_the_largest_cell_of_an_airport_in_sight():
    """Asked of points all over the hemisphere that is seen: whose airport is the nearest, and how many those have."""
    count, million, name = said(
        "earth_airports", r"([\d ]+) airports .* in sight, ([\d.]+) million km², is that of (.*)"
    )
    table = data.airports()
    assert as_number(count) == len(table.icao)
    sites, toward = authalic_xyz(table.lonlat), script("earth_airports")["VIEW"].matrix[2]
    k = np.arange(400_000) + 0.5  # a spiral of directions that stand for equal parts of the sphere
    z, turn = 1 - 2 * k / len(k), k * np.pi * (1 + np.sqrt(5))
    places = np.column_stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z])
    nearest = cKDTree(sites).query(places)[1]
    cells = np.bincount(nearest, minlength=len(sites))
    seen = np.unique(nearest[places @ toward > 0])
    largest = seen[np.argmax(cells[seen])]
    assert float(million) == pytest.approx(cells[largest] / len(places) * EARTH_KM2 / 1e6, abs=0.06)
    assert (table.icao[largest], name) == ("SCIP", "Easter Island")
    assert said("earth_airports", r"Airports: .* (.*) itself lies beyond the (.*) limb\.")[1] == "left"
    assert sites[largest] @ toward < 0 > sites[largest] @ script("earth_airports")["VIEW"].matrix[0]


@pytest.mark.parametrize(
    "name", by_day(["earth_airports", "earth_cities", "globe_europe", "sky_stars"], "earth_airports")
)
def test_numbers_beside_a_scale_stand_where_they_belong(name):
    """Where the logarithm puts them, between the ends of the bar; and the ends say what lies beyond them."""
    small, number = [label for label in page(name).labels if label.size == 8.0], r"[≤≥]? ?[\d. ]+( million)?"
    ticks = {label.anchor[0]: label.text for label in small if re.fullmatch(number, label.text)}
    places, values = np.array(sorted(ticks)), np.log([as_number(ticks[x]) for x in sorted(ticks)])
    slope, start = np.polyfit(places, values, 1)
    assert len(ticks) >= 4
    assert np.abs(slope * places + start - values).max() < 1e-9
    if name == "earth_airports":  # nothing lies beyond
        areas = geometry(name)["areas"]
        assert np.exp(values[0]) <= areas[areas > 0].min()
        assert np.exp(values[-1]) >= areas.max()
    if name == "globe_europe":
        assert [ticks[places[0]][0], ticks[places[-1]][0]] == ["≤", "≥"]


@pytest.mark.thorough
def test_areas_of_cells_in_europe_are_those_of_scipy():
    """Of the cell of an airport among the three hundred next to it."""
    table = data.airports()
    sites = np.unique(authalic_xyz(table.lonlat[table.iata != ""]), axis=0)
    tree, measured = cKDTree(sites), {}
    for text in words_of("globe_europe"):
        if match := re.fullmatch(r"([A-Z]{3}), ([\d ]+) km²", text):
            (row,) = np.flatnonzero(table.iata == match[1])
            near = sites[tree.query(authalic_xyz(table.lonlat[[row]])[0], 300)[1]]
            area = SphericalVoronoi(near).calculate_areas()[0] * EARTH_KM2 / (4 * np.pi)
            measured[match[1]] = (as_number(match[2]), area)
    assert measured.keys() == set(script("globe_europe")["MEASURED"])
    for code, (written, area) in measured.items():
        assert written == pytest.approx(area, abs=0.5 * 10 ** (np.floor(np.log10(area)) - 1)), code


@pytest.mark.thorough
def test_counts_of_cities_and_stars():
    (cities,) = said("earth_cities", r"The surroundings of ([\d ]+) cities and villages.*")
    (stars,) = said("sky_stars", r"([\d ]+) stars of the Hipparcos catalogue.*")
    assert as_number(cities) == sum(people > 0 for people in data.cities().population.tolist())
    assert as_number(stars) == len(set(data.stars().hip.tolist()))
    (letters, _) = said("globe_europe", r".* a code of (\w+) letters; .* is (\w+) times as large\.")
    assert {len(code) for code in data.airports().iata.tolist()} == {0, as_number(letters)}


# Lenses.


def enlarged(lens, lonlat):
    """How much larger a lens draws what is at a place, by the images of two points a metre apart."""
    a, b = lonlat_to_xyz([lonlat, (lonlat[0], lonlat[1] + 1e-5)])
    return np.linalg.norm(lens(b) - lens(a)) / np.linalg.norm(b - a)


@pytest.mark.parametrize(
    ("name", "pattern"),
    [
        pytest.param("globe_europe", r".* Europe is (.*) times as large\.", marks=pytest.mark.thorough),
        pytest.param("globe_poster", r"The Mediterranean .*: (.*) times as large, .*", marks=pytest.mark.thorough),
        pytest.param("globe_poster", r"Magnification ([\d.]+) about .*", marks=pytest.mark.thorough),
        ("globe_tissot", r"magnified (.*) times"),
    ],
)
def test_magnifications(name, pattern):
    module = script(name)
    (written,) = said(name, pattern)
    assert as_number(written) == pytest.approx(enlarged(drawn_lens(name), module["FOCUS"]), rel=1e-4)


def drawn_lens(name):
    """The lens of a picture, by how far from the focus, in the middle of the globe, it puts the name of a place."""
    module = script(name)
    anchors = {label.text: np.array(label.anchor) for label in page(name).labels}
    match name:
        case "globe_europe":
            text, xyz = "AMS", authalic_xyz(data.airports().lonlat[data.airports().iata == "AMS"])[0]
        case "globe_poster":
            text, xyz = "Rome", lonlat_to_xyz(module["CITIES"]["Rome"])
        case "globe_tissot":
            text, xyz = "2", lonlat_to_xyz(module["NUMBERED"][1])
    *_, limb = [item.path.reshape(-1, 2) for item in page(name).items if item.name == "limb"]
    middle, radius = (limb.min(axis=0) + limb.max(axis=0)) / 2, np.ptp(limb[:, 0]) / 2
    image = np.arcsin(np.linalg.norm(anchors[text] - middle) / radius)
    away = np.arccos(xyz @ lonlat_to_xyz(module["FOCUS"]))
    return fisheye(module["FOCUS"], magnification=np.tan(image / 2) / np.tan(away / 2))


@pytest.mark.thorough
def test_the_hemisphere_of_new_york():
    """S = tan 45° / tan(χ/2) makes a hemisphere of the cap of radius χ, and is the scale in its middle."""
    (km,) = said("globe_new_york", r"Half of it lies within (\d+) km of Manhattan, .*")
    million, times = said("globe_new_york", r"Land, rivers, lakes: .* 1 : (\d+) million .* enlarged (\d+) times\. .*")
    factor = 1 / np.tan(float(km) / (2 * earth.MEAN_RADIUS_KM))
    assert float(times) == round(factor)
    lens = fisheye(script("globe_new_york")["NEW_YORK"], magnification=factor)
    own = script("globe_new_york")["lens_of"](geometry("globe_new_york")["radius"])
    assert own.is_close(lens, tolerance=1e-9)
    assert million == "10"
    # The small globe magnifies the circle that says so: its image is as large as where the lines to the inset begin.
    (far,) = said("globe_new_york", r"beyond (\d+) km")
    distance = float(far) / earth.MEAN_RADIUS_KM
    limbs = [item.path.reshape(-1, 2) for item in page("globe_new_york").items if item.name == "limb"]
    middle, own_middle = ((path.min(axis=0) + path.max(axis=0)) / 2 for path in limbs[1:])
    radius = np.ptp(limbs[2][:, 0]) / np.ptp(limbs[1][:, 0])
    for line in (item.path for item in page("globe_new_york").items if item.name == "leader"):
        image = 2 * np.arctan(factor * np.tan(distance / 2))
        assert np.hypot(*(line[0, 0] - middle)) == pytest.approx(np.sin(image), abs=1e-9)
        assert np.hypot(*(line[-1, 3] - own_middle)) == pytest.approx(radius, abs=1e-3)
        way = line[-1, 3] - line[0, 0]
        assert abs(way @ (line[0, 0] - middle)) < 1e-9
        assert abs(way @ (line[-1, 3] - own_middle)) < 1e-3


@pytest.mark.thorough
def test_circles_and_bar_have_the_lengths_that_they_say():
    (km,) = said("globe_tissot", r"Circles of (\d+) km stay circles")
    apart, three = said("globe_tissot", r"Orange: .* every (\d+)°\. The numbers mark the same (\w+) circles .*")
    assert float(km) == pytest.approx(np.radians(geometry("globe_tissot")["radius"]) * earth.MEAN_RADIUS_KM)
    numbers = [text for text in words_of("globe_tissot") if text.isdigit()]
    assert sorted(numbers) == sorted(2 * [str(k + 1) for k in range(int(as_number(three)))])
    one, two, _ = lonlat_to_xyz(script("globe_tissot")["NUMBERED"])
    assert np.degrees(np.arccos(one @ two)) == pytest.approx(float(apart), rel=0.03)
    (bar,) = said("globe_poster", r"(\d+) km")
    drawn = max(np.ptp(item.path[..., 0]) for item in page("globe_poster").items if item.name == "scale")
    on_globe = drawn / enlarged(drawn_lens("globe_poster"), script("globe_poster")["FOCUS"])
    assert float(bar) == pytest.approx(on_globe * earth.MEAN_RADIUS_KM, rel=1e-3)


# Claims and figures of the paper.


def test_curves_of_equal_ratio_say_their_ratio():
    """By cos²(χ/2)/cos²(Ξ/2) where the label stands, and 2 where a hemisphere meets a bubble of no size."""
    chart = script("claim_scales")["RIGHT"]
    labels = [label for label in page("claim_scales").labels if label.size == 8.0 or label.text == "$2$"]
    assert [label.text for label in labels].count("$2$") == 2
    assert len(labels) == 9 + 2
    for label in labels:
        x, y = (np.array(label.anchor) - chart.corner) / chart.size * 90
        ratio = (np.cos(np.radians(x / 2)) / np.cos(np.radians(y / 2))) ** 2
        assert float(label.text.strip("$")) == pytest.approx(max(ratio, 1 / ratio), abs=0.01)
    (stops,) = said("claim_scales", r"through (\d+) points")
    assert int(stops) == script("claim_scales")["STOPS"]


def test_partitions_are_as_many_as_the_title_says():
    """Halved boxes: as many as the different boxes that their points fill."""
    (count,) = said("earth_partitions", r"Cut: (\d+) partitions")
    rooms, points = geometry("earth_partitions")["rooms"], geometry("earth_partitions")["points"]
    inside = ((rooms[:, None, 0] <= points) & (points <= rooms[:, None, 1])).all(axis=2).sum(axis=1)
    assert int(count) == np.count_nonzero(inside)
    assert np.ptp(inside) <= 2  # halves, and points on a border counted twice


# Films.


def test_the_film_of_the_lift_says_what_the_diagonal_spans():
    """4 arctan(D/4R), with R as it is written."""
    for curvature in (0.0, 1.0):
        columns = {}
        for label in script("anim_lift")["frame"](curvature).labels:
            columns.setdefault(round(label.anchor[0], 6), []).append(label.text)
        spans = {texts[0]: texts[1] for texts in columns.values() if len(texts) == 2 and "°" in texts[1]}
        assert spans.keys() == {r"$\infty$", "$D$", "$D/2$", "$D/4$"}
        for radius, span in spans.items():
            part = np.inf if "infty" in radius else 1 / float(radius.strip("$").removeprefix("D").strip("/") or 1)
            assert float(span.removesuffix("°")) == pytest.approx(np.degrees(4 * np.arctan(1 / (4 * part))), abs=0.5)
