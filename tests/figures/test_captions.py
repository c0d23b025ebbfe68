"""The numbers in captions: each is read out of the text and compared with what the library computes."""

import ast
import re
from functools import cache

import numpy as np
import pytest

from stereodel import data, earth, fisheye, lonlat_to_xyz
from stereodel.drawing.scene.graticule import WIDTHS_APART
from stereodel.sphere import SphereCircle, graticule_patch, xyz_to_lonlat
from tests.figures.scripts import FOLDER, ROWS, arc_points, geometry, page, script
from tests.tiers import by_day

WORDS = {"three": 3, "four": 4, "five": 5, "six": 6, "eight": 8, "twelve": 12, "twenty": 20}
NUMBER = re.compile(
    r"(?P<digits>\d+(?: \d{3})*(?:\.\d+)?)(?P<million> million)?(?:/(?P<over>\d+))?"
    rf"|\b(?P<word>{'|'.join(WORDS)})\b(?P<half> and a half)?",
    re.IGNORECASE,
)
MAKEFILE = FOLDER.parent / "Makefile"
REFERENCE = re.compile(r"Figures? \d+(?: to \d+)?|Theorem \d|[Cc]laims? P\d+(?: and P\d+)?")
FORMULAS = {
    "anim_hull": ("2n − 4",),
    "claim_scales": ("cos² (χ/2) / cos² (Ξ/2)",),
    "claim_separation": ("R = D/4", "(d/D) 180°", "2/π", "4/π", "4 arctan(d/D)", "2 arcsin(d/D)"),
    "claim_steps": ("Ax + By + Cz + D = 0",),
    "fig09_scale": ("heights R + R sin φ and 2R", "s = (R + R sin φ)/2R", "∂s/∂φ = cos φ / 2"),
    "fig13_latitudes": (
        "tan((90° + φ)/2) = d/2R",
        "S tan((90° + φ)/2) = tan((90° + Φ)/2)",
        "tan((90° + Φ)/2) = d/2r",
    ),
}
"""What captions write as formulas; P11, P14, P18 have their tests, those of claims stand in `test_claim_figures.py`."""


def caption(name):
    """The text of a script on one line, without references and formulas."""
    text = " ".join(ast.get_docstring(ast.parse((FOLDER / f"{name}.py").read_text(encoding="utf-8"))).split())
    for formula in FORMULAS.get(name, ()):
        assert formula in text
        text = text.replace(formula, "")
    return REFERENCE.sub("", text)


def numbers(text):
    """Each number of a text and how far it may be from the truth: half a unit of its last digit."""
    for found in NUMBER.finditer(text):
        if found["word"]:
            yield WORDS[found["word"].lower()] + 0.5 * bool(found["half"]), 0.0
        elif found["over"]:
            yield int(found["digits"]) / int(found["over"]), 0.0
        else:
            decimals = len(found["digits"].partition(".")[2])
            unit = 1e6 if found["million"] else 1.0
            rounded = decimals or found["million"]
            yield unit * float(found["digits"].replace(" ", "")), unit * 0.5 * 10.0**-decimals if rounded else 0.0


def five_views(name):
    """What is drawn in Figures 10 to 12: magnification, graticule, fine grid, its centre and its half-width."""
    panels, fine = script(name)["PANELS"], geometry(name)["fine_3"]
    bend = fisheye((0, 40), magnification=panels.magnification)
    lat = xyz_to_lonlat(bend.inverse()(arc_points(fine)))[..., 1]
    magnification = float(bend.scale_factor(lonlat_to_xyz((0, 40))))
    known = {"magnification": magnification, "coarse": panels.coarse, "fine": panels.fine}
    return known | {"focus": (lat.min() + lat.max()) / 2, "half_width": np.ptp(lat) / 2}


@cache
def hidden_up_to(magnification):
    """The largest half-width, in degrees, of a region about 40° N that the south pole does not see through the lens."""
    bend = fisheye((0, 40), magnification=magnification)

    def is_hidden(half_width):
        arcs = graticule_patch((0, 40), half_width, half_width)
        return bend(np.concatenate([arc.sample(17) for arc in arcs]))[:, 2].min() > 0

    low, high = 0.1, 30.0
    assert is_hidden(low)
    assert not is_hidden(high)
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if is_hidden(middle) else (low, middle)
    return low


def share_of_hemisphere(magnification, half_width):
    """How much of the hemisphere about the focus the region's image covers: the integral of the scale squared."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    lon, lat = np.meshgrid(half_width * nodes, 40 + half_width * nodes, indexing="ij")
    scale = fisheye((0, 40), magnification=magnification).scale_factor(lonlat_to_xyz(np.stack([lon, lat], axis=-1)))
    area = np.outer(weights, weights) * np.radians(half_width) ** 2 * np.cos(np.radians(lat)) * scale**2
    return area.sum() / (2 * np.pi)


def truth(name):
    """The numbers of a caption, in their order, as what is drawn has them."""
    module, g = script(name), {} if name.startswith("anim_") else geometry(name)
    match name:
        case "fig01_sphere":
            return [len(g["sites"]), len(g["triangle"])]
        case "fig02_plane" | "claim_theorem":
            return [len(g["sites"])]
        case "fig03_bubbles":
            circle = SphereCircle(g["normal"], float(g["offset"]))
            return [circle.angular_radius, *xyz_to_lonlat(circle.center)]
        case "fig04_triangles":
            return [len(g["vertices"])]
        case "fig05_projections":
            return [len(g["normal_points"])]
        case "fig06_sphere_size":
            radii = [(x[0] ** 2 + x[1] ** 2) / (2 * x[1]) for x in g["lifted"][:, 0]]  # circles through the origin
            return [len(g["extents"]), np.ptp(g["ends"][:, 0]), *radii]
        case "fig07_rectangle":
            (outline,) = [item for item in page(name).items if item.name == "outline"]
            return list(np.ptp(outline.path.reshape(-1, 2), axis=0))
        case "fig08_hemisphere":
            return [-module["VIEW"].lat]
        case "anim_lift" | "claim_closing" | "claim_edges" | "claim_inscribed" | "claim_interior":
            return []
        case "fig09_scale":
            x, y = g["point"]
            return [np.degrees(np.arctan2(1 - y, x))]
        case "fig10_earth" | "fig11_fisheye4" | "fig12_fisheye20":
            views, (size, coarse, fine, focus, half) = len(page(name).views), five_views(name).values()
            if name == "fig10_earth":
                return [views, coarse, focus, fine, focus, half]
            hemisphere, back = SphereCircle((0, 40), 0.0), fisheye((0, 40), magnification=size).inverse()
            filled = [2 * half, 100 * share_of_hemisphere(size, half), back.image_of(hemisphere).angular_radius]
            filled = filled if name == "fig12_fisheye20" else []
            between = [step] if (step := module["PANELS"].between) else []
            return [views, size, coarse, fine, focus, size, *filled, half, hidden_up_to(size), *between]
        case "fig10_12_plate":
            sizes, views = [row.magnification for row in module["ROWS"]], len(page(name).views)
            focus = five_views("fig10_earth")["focus"]
            return [*sizes[1:], views / len(sizes), focus, views, len(sizes), WIDTHS_APART]
        case "fig13_latitudes":
            return [np.divide(*g["radii"]), module["DISTANCE"] / g["radii"][0]]
        case "anim_fisheye":
            sizes = sorted(size for (size, _), seconds in module["moments"]() if seconds >= module["READING"])
            ends = [sizes[0], sizes[-1]]
            drawn = [five_views(figure) for figure in ROWS]
            (coarse, finer, _), fine = ([view[key] for view in drawn] for key in ("coarse", "fine"))
            beside = [drawn[1]["half_width"], fine[1]]  # what of the fine grid becomes a part of the graticule
            return [*ends, module["FOCUS"][1], *ends, *sizes, coarse, finer, *beside, *fine]
        case "anim_flight":
            return [max(stop.magnification for leg in module["legs"]() for stop in leg.stops)]
        case "anim_hull":
            return [max(len(np.unique(moment.facets)) for moment, _ in module["moments"]())]
        case "anim_sites":
            return [len(module["changes"]()[0].before.sites)]
        case "claim_angles":
            return [len(module["COLORS"]), np.degrees(np.arccos(np.divide(*module["STRETCH"][::-1])))]
        case "claim_planet":
            exaggeration = module["STEEP"] * module["RADIUS_KM"] / module["KM"]
            return [len(g["points"]), module["RADIUS_KM"], module["STEP"] * module["KM"], exaggeration]
        case "claim_projections":
            return [module["SITES"], module["REACH"], len(module["DRAWN"])]
        case "claim_rigid":
            return [len(g["points"])]
        case "claim_scales":
            bounds = lift_scales()
            kinds = [module["SEGMENTS"], module["SEGMENTS"], module["WANDERINGS"], module["STOPS"]]
            return [*bounds, *bounds[::-1], *kinds, 1 / bounds[1], 0]
        case "claim_separation":
            return [module["DOTS"], 1 / 2, *lift_scales()[::-1], module["WIDTH"], module["HEIGHT"]]
        case "claim_signs":
            return [len(module["THREE"]), module["SIZES"][-1] * 1e5 * earth.MEAN_RADIUS_KM]
        case "claim_steps":
            return [len(module["TITLES"])]
        case "claim_terrain":
            unit, grid = module["METRES"], (module["COLUMNS"], module["ROWS"])
            return [len(g["points"]), *grid, module["STEP"] * unit, module["STEEP"] * 1000 * module["KM"] / unit]
        case "earth_airports":
            areas = g["areas"]
            return [len(areas), np.count_nonzero(areas == 0), areas[areas > 0].min(), areas.max(), module["NAMED"]]
        case "earth_cities":
            return [len(g["density"]), len(data.cities().population)]
        case "earth_partitions":
            return [len(g[key]) for key in ("points", "rooms", "own", "alone", "planes", "shown", "boxes", "last")]
        case "globe_europe" | "globe_new_york":
            (letters,) = {len(code) for code in data.airports().iata.tolist() if code}
            radius = np.radians(g.get("radius", 0)) * earth.MEAN_RADIUS_KM
            return [radius, letters] if radius else [letters]
        case "globe_poster":
            (wide,) = re.findall(r"globe_poster\.py .* --size (\d+)$", MAKEFILE.read_text("utf-8"), re.MULTILINE)
            return [module["MAGNIFICATION"], 1, module["MILLION"] * 1e6, int(wide)]
        case "globe_tissot":
            size = module["MAGNIFICATION"]
            return [module["RADIUS_KM"], size, size, module["SPACING"]]
        case "sky_stars":
            return [len(data.stars().magnitude), module["SMOOTHED"], module["BRIGHT"]]
    raise AssertionError(f"{name} has a caption that nobody checks")


def lift_scales():
    """The scale of the rectangle of Figure 7 at its centre and at a corner."""
    rectangle = script("claim_scales")["lift"]()
    return rectangle.scale_factor([[0.0, 0.0], [rectangle.width / 2, rectangle.height / 2]]).tolist()


SCRIPTS = [path.stem for path in sorted(FOLDER.glob("[!_]*.py"))]
SLOW = ("earth_cities", "globe_europe", "globe_new_york", "globe_poster", "sky_stars", "claim_planet", "claim_terrain")


@pytest.mark.parametrize("name", by_day(SCRIPTS, *(name for name in SCRIPTS if name not in SLOW)))
def test_numbers_of_a_caption_are_those_of_the_picture(name):
    written, true = list(numbers(caption(name))), truth(name)
    assert len(written) == len(true), (written, true)
    for (value, slack), expected in zip(written, true, strict=True):
        assert abs(value - expected) <= slack + 1e-6, (written, true)


def test_row_p20_has_the_numbers_of_the_captions():
    ledger = (FOLDER.parent / "docs" / "paper.md").read_text(encoding="utf-8")
    (row,) = re.findall(r"^\| P20 \|(.*)$", ledger, re.MULTILINE)
    holds = row.split("|")[1]
    written = [float(x) for x in re.findall(r"[\d.]+(?=°)", holds)]
    widths = [five_views(name)["half_width"].round(6) for name in ("fig11_fisheye4", "fig12_fisheye20")]
    assert written == [round(hidden_up_to(4), 2), round(hidden_up_to(20), 3), *widths]
