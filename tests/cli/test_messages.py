"""What is wrong is said in the words of the command line: options as they are typed, never arguments of Python."""

import inspect
import re

import pytest

from stereodel.cli import app
from stereodel.cli.failures import OPTIONS, in_options

TABLES = {
    "wrong.csv": "name,a,b\nA,1,2\n",
    "both.csv": "lon,lng,lat\n1,2,3\n",
    "gap.csv": "lon,lat\n1,\n2,3\n",
    "infinite.csv": "lon,lat\n1,inf\n2,3\n",
    "gappy.csv": "lon,lat,size\n1,2,\n2,3,4\n",
    "plane.csv": "x1,y1\n0,0\n1,0\n0,1\n",
}
CITIES = "cities.csv"
OF = ["nearest", CITIES, "--of"]
AT = ["interpolate", CITIES, "--value", "people", "--at"]
GRID = ["interpolate", CITIES, "--value", "people", "--grid"]
LEVELS = ["contour", CITIES, "--value", "people"]

SAID = [
    (["voronoi", "wrong.csv"], "csv", "wrong.csv: no column looks like the longitude; say which with --lon, "),
    (["voronoi", "both.csv"], "csv", "both.csv: 'lon', 'lng' may all be the longitude; say which with --lon"),
    (["voronoi", CITIES, "--lon", "x"], "csv", "cities.csv: --lon is 'x', which is not one of the columns "),
    (["voronoi", CITIES, "--lat", "x"], "csv", "cities.csv: --lat is 'x', which is not one of the columns "),
    (["voronoi", CITIES, "--lon", "lat", "--lat", "lat"], "csv", "cities.csv: --lon and --lat are both the column "),
    (["voronoi", CITIES, "--crs", "EPSG:99"], "csv", "cities.csv: --crs is 'EPSG:99', which PROJ does not know; "),
    (["voronoi", "plane.csv", "--plane", "x1", "z"], "csv", "plane.csv: there is no column 'z'; the columns are "),
    (["voronoi", "gap.csv"], "csv", "gap.csv: row 1: the latitude is missing; leave such rows out with --skip-missing"),
    (["voronoi", "infinite.csv"], "csv", "infinite.csv: row 1: the latitude is inf, but must be finite; correct or"),
    (["voronoi", CITIES, "--max-segment=0"], "geojson", "--max-segment is 0.0, outside (0, 90]"),
    (["triangulate", "wrong.csv"], "csv", "wrong.csv: no column looks like the longitude; say which with --lon, "),
    (["triangulate", CITIES, "--max-segment=-1"], "geojson", "--max-segment is -1.0, outside (0, 90]"),
    ([*OF, "wrong.csv"], "csv", "wrong.csv: no column looks like the longitude; say which with --of-lon, "),
    ([*OF, CITIES, "--of-lon", "x"], "csv", "cities.csv: --of-lon is 'x', which is not one of the columns "),
    ([*OF, CITIES, "--of-lat", "x"], "csv", "cities.csv: --of-lat is 'x', which is not one of the columns "),
    ([*OF, CITIES, "--of-crs", "x"], "csv", "cities.csv: --of-crs is 'x', which PROJ does not know; "),
    ([*OF, CITIES, "--lon", "x"], "csv", "cities.csv: --lon is 'x', which is not one of the columns "),
    ([*AT, "wrong.csv"], "csv", "wrong.csv: no column looks like the longitude; say which with --at-lon, "),
    ([*AT, "both.csv"], "csv", "both.csv: 'lon', 'lng' may all be the longitude; say which with --at-lon"),
    ([*AT, CITIES, "--at-lat", "x"], "csv", "cities.csv: --at-lat is 'x', which is not one of the columns "),
    ([*AT, CITIES, "--at-crs", "x"], "csv", "cities.csv: --at-crs is 'x', which PROJ does not know; "),
    ([*AT, CITIES, "--lat", "x"], "csv", "cities.csv: --lat is 'x', which is not one of the columns "),
    (["interpolate", CITIES, "--value", "x", "--grid", 5], "csv", "cities.csv: there is no column 'x'; the columns "),
    (
        ["interpolate", "gappy.csv", "--value", "size", "--grid", 5],
        "csv",
        "gappy.csv: row 1: size is missing; leave such rows out with --skip-missing",
    ),
    ([*AT, CITIES, "--box=0,0,9,9", "--centers"], "csv", "--box and --centers are for a --grid, and there is none"),
    ([*GRID, 5, "--at-lon", "x"], "csv", "--at-lon is for the table --at, and there is none"),
    ([*GRID, 0], "csv", "--grid is 0.0, outside (0, 180]"),
    ([*GRID, 7], "csv", "--grid is 7, but 180 must be a whole multiple of it"),
    ([*GRID, 0.00001], "csv", "--grid is 1e-05, which makes a grid of 36000000 × 18000001 places; 1073741824 are the"),
    ([*GRID, 1e-7, "--box=0,0,9,9"], "csv", "--grid is 1e-07, which makes a grid of 90000001 × 90000001 places; "),
    ([*GRID, "nan"], "csv", "--grid is nan; every value must be a finite number"),
    ([*GRID, 5, "--box=0,0,7"], "csv", "--box is '0,0,7', but must be W,S,E,N in degrees, e.g. --box=-25,34,45,72"),
    ([*GRID, 5, "--box=0,9,7,5"], "csv", "--box is '0,9,7,5', but its south border must be below its north border"),
    ([*GRID, 5, "--box=0,9,7,95"], "csv", "--box is '0,9,7,95', but its south border must be below its north border"),
    ([*GRID, 5, "--box=nan,5,7,9"], "csv", "--box is 'nan,5,7,9', but its west and east borders must be finite"),
    ([*LEVELS, "--levels=1,nan"], "geojson", "--levels is nan; every value must be a finite number"),
    ([*LEVELS, "--levels=1,x"], "geojson", "--levels is '1,x', but must be numbers, e.g. --levels=-10,0,10"),
    ([*LEVELS, "--interval=0"], "geojson", "--interval is 0.0, outside (0, inf]"),
    ([*LEVELS, "--levels=1e6", "--max-segment=0"], "geojson", "--max-segment is 0.0, outside (0, 90]"),
    (["globe", CITIES, "--lon", "x"], "svg", "cities.csv: --lon is 'x', which is not one of the columns "),
    (["globe", "--focus=1"], "svg", "--focus is '1', but must be LON,LAT, e.g. --focus=10.5,48"),
    (["globe", "--focus=1,95"], "svg", "--focus is '1,95', but its latitude is outside [-90, 90]; the longitude comes"),
    (["globe", "--view=inf,9"], "svg", "--view is 'inf,9', but its longitude must be finite"),
    (["globe", "--view=1,nan"], "svg", "--view is '1,nan', but its latitude is outside [-90, 90]; the longitude comes"),
    (["globe", "--magnify=-1"], "svg", "--magnify is -1, but a magnification is positive and finite"),
    (["globe", "--graticule=7"], "svg", "--graticule is 7, but 180 must be a whole multiple of it"),
    (["globe", "--graticule=nan"], "svg", "--graticule is nan; every value must be a finite number"),
    (
        ["globe", "--projection", "stereographic", "--angular-radius=190"],
        "svg",
        "--angular-radius is 190.0, outside (0, 170]",
    ),
    (["globe", "--texture", "x.png", "--texture-box=1,2"], "svg", "--texture-box is '1,2', but must be W,S,E,N in"),
    (["globe", "--fly=1,95"], "gif", "--fly is '1,95', but its latitude is outside [-90, 90]; the longitude comes"),
    (["globe", "--seconds=0"], "gif", "--seconds is 0.0, outside (0, inf]"),
    (["globe", "--fps=0"], "gif", "--fps is 0.0, outside (0, inf]"),
]


@pytest.mark.parametrize(("arguments", "ending", "said"), SAID, ids=[" ".join(map(str, row[0])) for row in SAID])
def test_a_wrong_argument_is_named_as_it_was_typed(run, folder, arguments, ending, said):
    for name, content in TABLES.items():
        (folder / name).write_text(content, encoding="utf-8")
    line = run(*arguments, "-o", f"out.{ending}", code=2)
    assert line.startswith(f"error: {said}")
    assert line.count("\n") == 1
    assert not re.search(r"(?<![-\w])[a-z_]+=|\w\[\d", line), "an argument of Python"
    assert not (folder / f"out.{ending}").exists()


def test_every_option_that_a_message_may_name_exists():
    options = {
        name
        for command in app.registered_commands
        for parameter in inspect.signature(command.callback, eval_str=True).parameters.values()
        for info in getattr(parameter.annotation, "__metadata__", ())
        for name in (getattr(info, "param_decls", None) or ()) or (f"--{parameter.name.replace('_', '-')}",)
    }
    assert set(OPTIONS.values()) <= options


@pytest.mark.parametrize(
    "message",
    [
        "a.csv: row 3: lat is missing",
        "a.csv: row 3: the seconds 'x' is not a number",
        "the layer is empty",
        "size of x.webp is 17000 pixels",
    ],
)
def test_what_is_no_argument_stays(message):
    assert in_options(message) == message
