"""Whether land is land and sea is sea: asked of the pixels of every globe that paints them, at places that all know.

A stored picture keeps what was stored, right or wrong; these places are known without any picture. Where they lie on
a page follows from the formulas of the fisheye and of the orthographic view, as `tests/globe/truth.py` has them.
"""

import re
import runpy

import numpy as np
import pytest

from stereodel.drawing import Fill, Polygons
from tests.globe import truth
from tests.images.scripts import SCRIPTS, cases
from tests.render.test_pages import brightness
from tools.baselines import SIZE

pytestmark = pytest.mark.images

EARTH_KM = 6371.0
USUAL = 300.0
"""Distance in km from the coast that a place has at least, where it does not say otherwise."""

LAND = """
Kalgoorlie: 121.5 -30.7; Alice Springs: 133.9 -23.7 800; the Gibson Desert: 124.5 -24.5 450; Nairobi: 36.8 -1.3 400;
Kano: 8.5 12.0 700; Fairbanks: -147.7 64.8 400; the Yukon: -157.0 64.7 230; Brasília: -47.9 -15.8 800;
the middle of Greenland: -40.0 72.0; the South Pole: 0.0 -89.9 500; Denver: -105.0 39.7 900;
Winnipeg: -97.1 49.9 600; Manaus: -60.0 -3.1 800; La Paz: -67.5 -16.5; Asunción: -57.6 -25.3 700;
Timbuktu: -3.0 16.8 900; Tamanrasset: 5.5 22.8 1000; Khartoum: 32.5 15.6 500; Kisangani: 25.2 0.5 1200;
Lusaka: 28.3 -15.4 700; Vienna: 16.4 48.2; Madrid: -3.7 40.4; Moscow: 37.6 55.8 550; Tashkent: 69.2 41.3 700;
Delhi: 77.2 28.6 800; Lhasa: 91.1 29.7 600; Ulaanbaatar: 106.9 47.9 900; Novosibirsk: 82.9 55.0 1200;
Yakutsk: 129.7 62.0 500; Chengdu: 104.1 30.7 900; Riyadh: 46.7 24.7; Pittsburgh: -80.0 40.4 150;
Allentown: -75.5 40.6 50; Springfield: -72.6 42.1 80; Concord: -71.5 43.2 50; Binghamton: -75.9 42.1 120;
Morristown: -74.5 40.8 25; Somerville: -74.6 40.6 20; the Ramapo Mountains: -74.3 41.1 25; Danbury: -73.5 41.4 25
"""
SEA = """
mid-Pacific: -140.0 10.0 1000; the North Pacific: -150.0 42.0 1000; the South Pacific: -115.0 -45.0 1500;
the Philippine Sea: 133.0 18.0 700; the Tasman Sea: 160.0 -38.0 700; the Bay of Bengal: 88.0 14.0 500;
the Arabian Sea: 64.0 14.0 600; the Indian Ocean: 82.0 -15.0 900; the sea off Western Australia: 100.0 -28.0 1000;
the Weddell Sea: -38.0 -68.0; the Southern Ocean: 110.0 -55.0 900; the South Atlantic: -20.0 -28.0 800;
the Gulf of Guinea: 0.0 -3.0 600; mid-Atlantic: -38.0 25.0 1000; the Sargasso Sea: -60.0 27.0 500;
the North Atlantic: -35.0 48.0 800; the Labrador Sea: -54.0 58.0; the Norwegian Sea: 0.0 68.0;
the Arctic Ocean: -150.0 80.0 700; Hudson Bay: -86.0 59.5 200; the Gulf of Mexico: -90.5 25.0;
the Bering Sea: -177.0 57.5; the Ionian Sea: 18.5 36.3 200; the sea south of Cyprus: 31.0 33.2 120;
the Black Sea: 34.0 43.2 110; the Bay of Biscay: -5.5 45.7 180; the sea off Long Island: -72.5 39.8 90;
the New York Bight: -73.3 40.1 35; the sea off Rockaway: -73.75 40.4 15; the sea south of Montauk: -71.9 40.3 60;
the edge of the continental shelf: -71.0 39.0 180
"""
"""Longitude and latitude of places, and km from the coast."""
PLACES = [
    (name.strip(), *map(float, numbers.split()), kind)
    for kind, text in (("land", LAND), ("sea", SEA))
    for name, numbers in re.findall(r"([^;:]+): ([-\d. ]+)", text)
]

REACH = (1, 5)
"""Half the width of the window that is asked about a place, at least and at most, pixels."""

COVERED = 2 / 3
"""Share of the window above which lines, dots and tints leave too little to ask."""

NEAR = 0.016
"""How far a channel may be from a colour that is looked for, in [0, 1]: 4 levels of 255."""

LEAST = {"anim_flight": 6, "globe_poster": 9, "globe_new_york": 14, "globe_tissot": 40}
LEAST |= {"earth_cities": 30, "earth_partitions": 30}
"""How many answers the pictures of a script give at least, one from each globe that shows a place."""


def orthographic(lon, lat):
    """Directions (..., 3) to the right, up and toward the viewer of a globe seen from above a place, north up."""
    right, toward = truth.unit(lon + 90, 0.0), truth.unit(lon, lat)
    return lambda points: points @ np.stack([right, np.cross(toward, right), toward]).T


def fisheye(lon, lat, size):
    """Directions (n, 3) moved away from the focus to Ξ = 2 arctan(S tan(χ/2)), row P18: from where 1/S takes them."""
    return lambda points: truth.before((lon, lat), 1 / size, points)


def looks(script, frame):
    """For each globe of a picture a lens and a view, by the numbers in its script; those of a film are its shots."""
    module = runpy.run_path(str(script))
    match script.stem:
        case "anim_flight":
            shots = module["film"]().shots
            lens, view = shots[(0, len(shots) // 2, len(shots) - 1)[frame]]
            return [(lens, lambda points: points @ view.matrix.T)]
        case "earth_cities" | "earth_partitions":
            one = (lambda points: points, orthographic(module["VIEW"].lon, module["VIEW"].lat))
            return [one] * (1 if script.stem == "earth_cities" else 3)
        case "globe_new_york":
            (lon, lat), far = module["NEW_YORK"], (module["NEW_YORK"][0] + 180, -module["NEW_YORK"][1])
            globes = [("RADIUS_KM", (lon, lat)), ("RADIUS_KM", far), ("FAR_KM", far)]
            sizes = (1 / np.tan(module[bubble] / EARTH_KM / 2) for bubble, _ in globes)
            return [(fisheye(lon, lat, size), orthographic(*to)) for size, (_, to) in zip(sizes, globes, strict=True)]
        case "globe_poster":
            return [(fisheye(*module["FOCUS"], module["MAGNIFICATION"]), orthographic(*module["FOCUS"]))]
        case "globe_tissot":
            sizes = (1.0, module["MAGNIFICATION"])
            return [(fisheye(*module["FOCUS"], size), orthographic(*module["FOCUS"])) for size in sizes]
    raise AssertionError(f"{script.stem} paints land or sea, and nobody says how it is seen")


def around(lon, lat, km):
    """A place, and eight more as far from it as there is nothing but more of the same."""
    place, north = truth.unit(lon, lat), truth.unit(lon, lat + 90)
    turn = np.arange(8)[:, None] * np.pi / 4
    ring = np.cos(turn) * north + np.sin(turn) * np.cross(north, place)
    return np.vstack([place, np.cos(km / EARTH_KM) * place + np.sin(km / EARTH_KM) * ring])


def asked(case, look, middle, radius, insets):
    """What the pixels of a globe say at each place that it shows large enough: 1 land, -1 sea, 0 that it is covered."""
    (lens, view), (left, right, _, top), found = look, case.page.extent, {}
    ground, scale = colors(case.page), SIZE / (right - left)
    for name, lon, lat, *km, kind in PLACES:
        for part in (1.0, 0.5, 0.25):
            axes = view(lens(around(lon, lat, part * (km[0] if km else USUAL))))
            pixels = scale * (middle + radius * axes[:, :2] - [left, top]) * [1, -1]
            reach = min(REACH[1], int(np.linalg.norm(pixels[1:] - pixels[0], axis=1).min() / 1.5))
            if axes[:, 2].min() > 0 and reach >= REACH[0]:
                column, row = np.floor(pixels[0]).astype(int)
                window = case.picture[row - reach : row + reach + 1, column - reach : column + reach + 1]
                light = 255 * brightness(*axes[0, :2])
                votes = [ground(color / light) for color in window.reshape(-1, 3)]
                if any(np.hypot(*(middle + radius * axes[0, :2] - at)) < 1.1 * size for at, size in insets):
                    votes = [0]
                found[name, kind] = np.sign(sum(votes)) if np.count_nonzero(votes) > (1 - COVERED) * len(votes) else 0
                break
    return found


def colors(page):
    """A function that says what an unlit colour is: 1 land, -1 sea, 0 neither."""
    fills = {}
    for item in page.items:
        if isinstance(item, Fill | Polygons) and item.name in ("ball", "land", "ocean"):
            fills[item.name] = np.array(item.color if isinstance(item, Fill) else item.colors[0])[:3]
    sea, land = fills.get("ocean", fills["ball"]), fills.get("land")

    def told(color):
        if np.abs(color - sea).max() < NEAR:
            return -1
        return 1 if land is None or np.abs(color - land).max() < NEAR else 0

    return told


def globes(case):
    """Middles and radii of the globes of a page, as their limbs have them."""
    for item in case.page.items:
        if item.name == "limb":
            points = item.path.reshape(-1, 2)
            yield (points.min(axis=0) + points.max(axis=0)) / 2, np.ptp(points[:, 0]) / 2


PAINTING = [path for path in SCRIPTS if re.search(r"add_(land|ocean)\(", path.read_text(encoding="utf-8"))]


@pytest.mark.parametrize("script", PAINTING, ids=lambda path: path.stem)
def test_known_places_are_land_or_sea(script):
    wrong, answers = [], 0
    for frame, case in enumerate(cases(script)):
        for look, (middle, radius) in zip(looks(script, frame), globes(case), strict=True):
            said = asked(case, look, middle, radius, [other for other in globes(case) if other[1] < radius / 2])
            wrong += [f"{case.name}: {name}" for (name, kind), sign in said.items() if sign == -1 and kind == "land"]
            wrong += [f"{case.name}: {name}" for (name, kind), sign in said.items() if sign == 1 and kind == "sea"]
            answers += np.count_nonzero(list(said.values()))
    assert not wrong
    assert answers >= LEAST[script.stem], answers
