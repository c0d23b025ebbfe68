"""The numbers in the words of pictures: computed by the scripts, and here once more in another way.

Those in captions, which are docstrings, have their tests in `test_captions.py`.
"""

import ast
import re
from functools import cache

import numpy as np
import pytest
from scipy.spatial import ConvexHull, Delaunay, SphericalVoronoi, cKDTree

from stereodel import data, earth, fisheye
from stereodel.drawing.style import HALO_OPACITY, MAP_FILLS
from stereodel.sphere import lonlat_to_xyz
from tests.figures.scripts import FOLDER, arc_points, geometry, page, script

SCRIPTS = sorted(FOLDER.glob("*.py"))
NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")
WORDS = {word: number for number, word in enumerate(NUMBERS, start=1)}
NUMERAL = re.compile(
    rf"[\d½¼¾]|\b({'|'.join(WORDS)}|sixteen|twenty|half|twice|hundred|thousand|million)\b", re.IGNORECASE
)

SAID = {
    "_poster": {*WORDS, " and a half", " million"},
    "anim_fisheye": {"½"},
    "anim_hull": {"$,  $2n - 4 = "},
    "claim_separation": {
        r"$2/\pi$",
        r"$4/\pi$",
        r"$c$ = angle / $(d/D)\,180°$",
        r"$4\,\arctan(d/D)$",
        r"$2\,\arcsin(d/D)$",
    },
    "earth_airports": {" million km², is that of "},
    "earth_partitions": {"one point of a box", "first round of one"},
    "fig06_sphere_size": {"½"},
    "fig07_rectangle": {"sphere of radius $R = D/4$"},
    "fig09_scale": {r"$s = (1 + \sin\varphi)/2$", r"$\partial s/\partial\varphi = (\cos\varphi)/2$", "$2R$"},
    "fig13_latitudes": {
        r"$(90°\!+\!\varphi)/2$",
        r"$(90°\!+\!\Phi)/2$",
        r"$\tan((90°\!+\!\varphi)/2) = d/2R$",
        r"$\tan((90°\!+\!\Phi)/2) = d/2r$",
        r"$S\,\tan((90°\!+\!\varphi)/2) = \tan((90°\!+\!\Phi)/2)$",
    },
    "globe_new_york": {
        "Half of it lies within ",
        " km of Manhattan, the other half is the rest of the world; every angle is true.",
        " million and here, in the middle of New York, enlarged ",
        "Land, rivers, lakes: Natural Earth, made for 1 : ",
    },
    "globe_poster": {"° E. Natural Earth, 1 : ", " million."},
    "globe_tissot": {"Orange: all that lies within that distance of a place, one about every "},
}
"""What scripts write with a numeral in it: formulas of the paper, units, and "one" where it is no count."""

NAMES = re.compile(r"(?:accent|covered)\d|#[0-9a-f]{6}|(?:fig\d|10m)\w*")
"""Of styles, colours and files, which nobody reads."""

REFERENCES = ("WGS84", "CC BY 4.0", "F. van Leeuwen, 2007")


def texts_in(tree):
    """The strings of a script but for docstrings and the formats of numbers."""
    apart = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    apart |= {
        id(part)
        for node in ast.walk(tree)
        if isinstance(node, ast.FormattedValue) and node.format_spec is not None
        for part in ast.walk(node.format_spec)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in apart:
            yield node.value


def typed_numerals(source):
    """Strings of a script with a numeral that somebody typed."""
    for text in texts_in(ast.parse(source)):
        rest = text
        for reference in REFERENCES:
            rest = rest.replace(reference, "")
        if NUMERAL.search(rest) and not NAMES.fullmatch(text):
            yield text


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_no_number_in_the_words_of_a_picture_is_typed(path):
    """It is a formula, or comes out of what is drawn."""
    assert set(typed_numerals(path.read_text(encoding="utf-8"))) == SAID.get(path.stem, set())


def test_a_typed_number_is_found():
    found = typed_numerals('"""Of 5."""\nTITLE = f"the {n:.2f} of four"\nTICKS = {1.0: "10 000"}\nINK = "#00805e"\n')
    assert set(found) == {" of four", "10 000"}


# Data of the Earth and of the sky.


def authalic_xyz(lonlat):
    """Directions on the sphere of equal area, by the closed formula (Snyder, equations 3-11 and 3-12)."""
    lon, lat = np.radians(np.asarray(lonlat, dtype=float)).T
    e = np.sqrt(E2)
    s = np.sin(lat)
    beta = np.arcsin(_q(s, e) / _q(1.0, e))
    return np.column_stack([np.cos(beta) * np.cos(lon), np.cos(beta) * np.sin(lon), np.sin(beta)])


def _q(s, e):
    return (1 - E2) * (s / (1 - E2 * s**2) + np.arctanh(e * s) / e)


A, F = 6378.137, 1 / 298.257223563  # WGS84, km
E2 = F * (2 - F)
EARTH_KM2 = 2 * np.pi * A**2 * (1 + (1 - E2) / np.sqrt(E2) * np.arctanh(np.sqrt(E2)))


def spiral(count):
    """Directions (count, 3) that stand for equal parts of the sphere."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, k * np.pi * (1 + np.sqrt(5))
    return np.column_stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z])


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
    sites, places, toward = authalic_xyz(table.lonlat), spiral(400_000), script("earth_airports")["VIEW"].matrix[2]
    nearest = cKDTree(sites).query(places)[1]
    cells = np.bincount(nearest, minlength=len(sites))
    seen = np.unique(nearest[places @ toward > 0])
    largest = seen[np.argmax(cells[seen])]
    assert float(million) == pytest.approx(cells[largest] / len(places) * EARTH_KM2 / 1e6, abs=0.06)
    assert (table.icao[largest], name) == ("SCIP", "Easter Island")
    assert said("earth_airports", r"Airports: .* (.*) itself lies beyond the (.*) limb\.")[1] == "left"
    assert sites[largest] @ toward < 0 > sites[largest] @ script("earth_airports")["VIEW"].matrix[0]


@pytest.mark.parametrize("name", ["earth_airports", "earth_cities", "globe_europe", "sky_stars"])
def test_numbers_beside_a_scale_stand_where_they_belong(name):
    """Where the logarithm puts them, between the ends of the bar; and the ends say what lies beyond them."""
    ticks = {
        label.anchor[0]: label.text
        for label in page(name).labels
        if re.fullmatch(r"[≤≥]? ?[\d. ]+( million)?", label.text) and label.size == 8.0
    }
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
        ("globe_europe", r".* Europe is (.*) times as large\."),
        ("globe_poster", r"The Mediterranean .*: (.*) times as large, .*"),
        ("globe_poster", r"Magnification ([\d.]+) about .*"),
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
            text, xyz = "Rome", lonlat_to_xyz(module["EAST"]["Rome"])
        case "globe_tissot":
            text, xyz = "2", lonlat_to_xyz(module["NUMBERED"][1])
    *_, limb = [item.path.reshape(-1, 2) for item in page(name).items if item.name == "limb"]
    middle, radius = (limb.min(axis=0) + limb.max(axis=0)) / 2, np.ptp(limb[:, 0]) / 2
    image = np.arcsin(np.linalg.norm(anchors[text] - middle) / radius)
    away = np.arccos(xyz @ lonlat_to_xyz(module["FOCUS"]))
    return fisheye(module["FOCUS"], magnification=np.tan(image / 2) / np.tan(away / 2))


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


def test_names_at_leaders_have_the_ground_under_their_words():
    halos = {label.text: label.halo_color for label in page("globe_new_york").labels if label.halo}
    for name in script("globe_new_york")["FAR"]:
        ground = MAP_FILLS["land" if name == "California" else "ocean"]
        assert halos[name] == pytest.approx((*ground[:3], HALO_OPACITY), abs=1e-3), name
    assert len({halos[name][:3] for name in ("Staten Island", "Philadelphia")}) == 1  # across a coast: neither's


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


def test_triangles_that_projections_break_are_those_of_scipy():
    module, g = script("claim_projections"), geometry("claim_projections")
    own = {frozenset(row) for row in ConvexHull(sphere_sites()).simplices.tolist()}
    texts = [text for text in words_of("claim_projections") if "triangles" in text]
    for name, text in zip(module["DRAWN"], texts, strict=True):
        triangles = Delaunay(g[f"{name}_sites"]).simplices.tolist()
        broken = sum(frozenset(row) not in own for row in triangles)
        whole = f"all {len(triangles)} triangles kept"
        assert text == (f"{broken} of {len(triangles)} triangles broken" if broken else whole), name


@cache
def sphere_sites():
    """Where the sites are on the sphere, in their order: back from the orthographic panel, whose height is lost."""
    module, g = script("claim_projections"), geometry("claim_projections")
    axis = lonlat_to_xyz(module["PLACE"])
    rim = module["Orthographic"](module["PLACE"]).forward(module["CIRCLE"].sample(720))
    drawn = g["orthographic_circle"]
    size = np.linalg.norm(drawn[0] - drawn[360]) / np.linalg.norm(rim[0] - rim[360])
    x, y = ((g["orthographic_sites"] - drawn[0]) / size + rim[0]).T
    east = np.cross([0.0, 0.0, 1.0], axis)
    east /= np.linalg.norm(east)
    return np.outer(x, east) + np.outer(y, np.cross(axis, east)) + np.outer(np.sqrt(1 - x**2 - y**2), axis)


def test_figure_6_gives_its_angles():
    """Of the chord of a circle through the foot: twice the angle 2 arctan(d/2R)."""
    texts = [text for text in words_of("fig06_sphere_size") if "°" in text]
    radii = [text for text in words_of("fig06_sphere_size") if "R" in text]
    half = np.ptp(geometry("fig06_sphere_size")["ends"][:, 0]) / 2
    for text, radius in zip(texts, radii, strict=True):
        number = radius.removeprefix("$R = ").removesuffix("$").replace("½", "0.5")
        assert text == f"${np.degrees(4 * np.arctan(half / (2 * float(number)))):.1f}°$"


@pytest.mark.parametrize("name", ["fig10_earth", "fig11_fisheye4", "fig12_fisheye20"])
def test_figures_10_to_12_name_their_magnification_and_their_view(name):
    """S by how far the ends of the fine grid's middle line are from the middle of the fourth globe."""
    (size,), (lat,) = said(name, r"\$S = (\d+)\$"), said(name, r"(\d+)° N")
    points = arc_points(geometry(name)["fine_3"]).reshape(-1, 3)
    line = points[np.abs(points[:, 1]) < 1e-9]
    ends = np.degrees(np.unwrap(np.arctan2(line[:, 2], line[:, 0])))
    half = np.radians(script(name)["PANELS"].half_width)
    reach = np.degrees(2 * np.arctan(float(size) * np.tan(half / 2)))
    assert [ends.min(), ends.max()] == pytest.approx([float(lat) - reach, float(lat) + reach])


def test_curves_of_equal_ratio_say_their_ratio():
    """By cos²(χ/2)/cos²(Ξ/2) where the label stands, and 2 where a hemisphere meets a bubble of no size."""
    chart = script("claim_scales")["RIGHT"]
    found = 0
    for label in page("claim_scales").labels:
        if label.size == 8.0:
            x, y = (np.array(label.anchor) - chart.corner) / chart.size * 90
            ratio = (np.cos(np.radians(x / 2)) / np.cos(np.radians(y / 2))) ** 2
            assert float(label.text) == pytest.approx(max(ratio, 1 / ratio), abs=0.01)
            found += 1
    assert found == 9
    limits = [label for label in page("claim_scales").labels if label.text == "$2$"]
    assert len(limits) == 2
    for label in limits:
        x, y = (np.array(label.anchor) - chart.corner) / chart.size * 90
        ratio = (np.cos(np.radians(x / 2)) / np.cos(np.radians(y / 2))) ** 2
        assert max(ratio, 1 / ratio) == pytest.approx(2)
    (stops,) = said("claim_scales", r"through (\d+) points")
    assert int(stops) == script("claim_scales")["STOPS"]


def test_partitions_are_as_many_as_the_title_says():
    """Halved boxes: as many as the different boxes that their points fill."""
    (count,) = said("earth_partitions", r"(\d+) partitions")
    rooms, points = geometry("earth_partitions")["rooms"], geometry("earth_partitions")["points"]
    inside = ((rooms[:, None, 0] <= points) & (points <= rooms[:, None, 1])).all(axis=2).sum(axis=1)
    assert int(count) == np.count_nonzero(inside)
    assert np.ptp(inside) <= 2  # halves, and points on a border counted twice


# Films.


def test_the_film_of_sites_counts_its_triangles():
    """A new site sees so many facets of the hull; a ring of so many corners is left, and so many triangles fill it."""
    module = script("anim_sites")
    for change in module["changes"]()[:2]:
        more, less = (change.after, change.before) if change.comes else (change.before, change.after)
        hull = ConvexHull(less.sites)
        seen = np.count_nonzero(hull.equations[:, :3] @ change.site + hull.equations[:, 3] > 0)
        star = sum((row == index_of(more.sites, change.site)).any() for row in ConvexHull(more.sites).simplices)
        gone, new = (seen, star) if change.comes else (star, seen)
        said_ = {phase: change.words(phase) for phase in ("open", "fill", "check")}
        assert [int(re.search(r"\d+", said_[phase])[0]) for phase in said_] == [gone, new, new]


def index_of(sites, site):
    return int(np.argmin(np.linalg.norm(sites - site, axis=1)))


def test_the_film_of_the_hull_counts_its_facets():
    module = script("anim_hull")
    sites = module["on_sphere"](module["SITES"], module["SEED"])
    for moment, _ in list(module["moments"]())[:3]:
        words = " ".join(label.text for label in module["frame"](moment, sites).labels)
        n, facets = map(int, re.search(r"\$n = (\d+)\$,  \$2n - 4 = (\d+)\$", words).groups())
        if moment.point is None:
            assert (n, facets) == (len(sites), len(ConvexHull(sites).simplices))
        elif (moment.kinds == "new").any():
            assert facets == 2 * n - 4


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


def test_the_film_of_the_fisheye_names_the_grids_of_the_figures():
    module = script("anim_fisheye")
    grids = module["grids"]()
    found = set()
    for size, ends in ((1.0, (1.0, 20.0)), (4.0, (4.0, 20.0)), (20.0, (4.0, 20.0))):
        found |= {label.text for label in module["frame"]((size, ends), grids).labels if "Figure" in label.text}
    assert found == {
        "Figure 10: graticule 10°, fine grid 2°",
        "Figure 11: graticule 5°, fine grid 1°",
        "Figure 12: graticule 5° and 1°, fine grid ½°",
    }
