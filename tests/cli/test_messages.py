"""What is wrong is said in one line, in the words of the command line, by every command, with nothing written."""

import inspect
import re
import shlex
import shutil
import struct
import zlib

import geopandas
import imageio.v3 as iio
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel.cli import app
from stereodel.cli.application import ARGUMENTS

TEXTS = {
    "wrong.csv": "name,a,b\nA,1,2\n",
    "both.csv": "lon,lng,lat\n1,2,3\n",
    "gap.csv": "lon,lat\n1,\n2,3\n",
    "infinite.csv": "lon,lat\n1,inf\n2,3\n",
    "gappy.csv": "lon,lat,size\n1,2,\n2,3,4\n",
    "plane.csv": "x1,y1\n0,0\n1,0\n0,1\n",
    "none.csv": "lon,lat\n",
    "two.csv": "lon,lat\n0,0\n9,0\n",
    "broken.geojson": '{"type": "FeatureCollection", "features": [',
    "far.geojson": '{"type": "Point", "coordinates": [0, 100]}',
    "broken.gpkg": "no database",
}
SHORT = {"PEOPLE": "cities.csv --value people", "FILE": "points/0.parquet"}
SHORT["FILES"] = "points/0.parquet points/1.parquet"
ENDINGS = {"contour": "geojson", "globe": "svg", "panorama": "png", "web": "html"}

SAID = """
voronoi wrong.csv → wrong.csv: no column looks like the longitude; say which with --lon,
voronoi both.csv → both.csv: 'lon', 'lng' may all be the longitude; say which with --lon
voronoi cities.csv --lon x → cities.csv: --lon is 'x', which is not one of the columns
voronoi cities.csv --lat x → cities.csv: --lat is 'x', which is not one of the columns
voronoi cities.csv --lon lat --lat lat → cities.csv: column 'lat' is to have both coordinates
voronoi cities.csv --crs EPSG:99 → cities.csv: --crs is 'EPSG:99', which PROJ does not know;
voronoi plane.csv --plane x1 z → plane.csv: there is no column 'z'; the columns are
voronoi gap.csv → gap.csv: row 1: the latitude is missing; leave such rows out with --skip-missing
voronoi infinite.csv → infinite.csv: row 1: the latitude is inf, but must be finite; correct or
voronoi cities.csv --max-segment=0 -o out.geojson → --max-segment is 0.0, outside (0, 90]
voronoi cities.csv --clip none.geojson → none.geojson: No such file or directory
voronoi cities.csv --clip land -o a.svg → --clip is for csv, geojson, geojsonl, parquet, gpkg, fgb, shp, kml, xlsx
voronoi cities.csv --clip land --plane lon lat → --clip is for cells of the sphere
voronoi cities.csv --dissolve x → cities.csv: there is no column 'x'; the columns are name, people
voronoi cities.csv --dissolve name --of two.csv -o a.nc → --dissolve and --of are for csv, geojson
voronoi cities.csv --of two.csv → --of needs --sum, --mean or --rows, which say what to gather of its points
voronoi cities.csv --sum x --rows --of-lon y → --sum, --rows and --of-lon are for the table --of, and there is none
voronoi cities.csv --of gappy.csv --sum size → gappy.csv: row 1: the size is missing; leave such rows out with --skip
voronoi cities.csv --of gappy.csv --sum x → gappy.csv: there is no column 'x'; the columns are size
voronoi - --of - --rows → cannot both be stdin
voronoi cities.csv -o points → points: cannot write a file without extension; choose .csv
partition - -o a/ → - is no file, folder or pattern of Parquet files
partition FILE -o a/ --lon lon → --lon and --lat are given together
partition FILE -o a/ --lon x --lat y → --lon has 'x', which is not one of the columns 'lon'
partition FILE -o a/ --keep x → --keep has 'x', which is not one of the columns 'lon', 'lat', 'id'
partition nowhere.parquet -o a/ → nowhere.parquet is no file, folder or pattern of Parquet files
partition cities.csv -o a/ → cities.csv is not a Parquet file
partition FILES -o points/ → lies in out, the folder of results; take another folder
partition flags.parquet -o a/ → flags.parquet: the column 'lon' holds bool, not numbers
voronoi two.gpkg → two.gpkg: there are several layers, 'first', 'second'; give a file with one, or say which
triangulate cities.csv --max-segment=-1 -o out.geojson → --max-segment is -1.0, outside (0, 90]
triangulate cities.csv --edges -o out.glb → holds faces, not edges
voronoi cut.gml → cut.gml: the file is damaged: unclosed token: line 20
voronoi cities.csv --clip cut.gml → cut.gml: the file is damaged: unclosed token: line 20
globe --layer cut.gml → cut.gml: the file is damaged: unclosed token: line 20
nearest cities.csv --of cut.gml → cut.gml: the file is damaged: unclosed token: line 20
interpolate PEOPLE --at cut.gml → cut.gml: the file is damaged: unclosed token: line 20
nearest cities.csv --of wrong.csv → wrong.csv: no column looks like the longitude; say which with --of-lon,
nearest cities.csv --of cities.csv --of-lon x → cities.csv: --of-lon is 'x', which is not one of the columns
nearest cities.csv --of cities.csv --of-lat x → cities.csv: --of-lat is 'x', which is not one of the columns
nearest cities.csv --of cities.csv --of-crs x → cities.csv: --of-crs is 'x', which PROJ does not know;
nearest not-there.csv --of cities.csv -o out.xyz → out.xyz: cannot write xyz; choose .csv
nearest not-there.csv --of cities.csv -o none/out.csv → there is no folder none
nearest not-there.csv --of cities.csv -o . → cannot write
interpolate PEOPLE --at wrong.csv → wrong.csv: no column looks like the longitude; say which with --at-lon,
interpolate PEOPLE --at cities.csv --at-lat x → cities.csv: --at-lat is 'x', which is not one of the columns
interpolate PEOPLE --at cities.csv --at-crs x → cities.csv: --at-crs is 'x', which PROJ does not know;
interpolate cities.csv --value x --grid 5 → cities.csv: there is no column 'x'; the columns
interpolate gappy.csv --value size --grid 5 → gappy.csv: row 1: the size is missing; leave such rows out
interpolate PEOPLE --at cities.csv --bounds=0,0,9,9 --centers → --bounds and --centers are for a --grid, and
interpolate PEOPLE --grid 5 --at-lon x → --at-lon is for the table --at, and there is none
interpolate PEOPLE --grid 0 → --grid is 0.0, outside (0, 180]
interpolate PEOPLE --grid 7 --bounds world → --grid is 7, but 180 must be a whole multiple of it
interpolate PEOPLE --grid 1e-05 --bounds world → --grid is 1e-05, which makes a grid of 36000000 × 18000001 places
interpolate PEOPLE --grid nan → --grid is nan; every value must be a finite number
interpolate PEOPLE --grid 5 --bounds=0,0,7 → --bounds is '0,0,7', but must be W,S,E,N in degrees, e.g. --bounds=-25,34
interpolate PEOPLE --grid 5 --bounds=0,9,7,5 → --bounds is (0.0, 9.0, 7.0, 5.0), but south must be below north
interpolate PEOPLE --grid 5 --bounds=nan,5,7,9 → --bounds is 'nan,5,7,9', but must be W,S,E,N in degrees
interpolate PEOPLE → either --at
interpolate PEOPLE --grid 1 --plane lon lat --bounds world → --bounds is 'world', which no plane has; give (xmin, ymin
interpolate PEOPLE --grid 1 --plane lon lat --bounds 1,2 → --bounds is '1,2', but must be xmin,ymin,xmax,ymax, e.g.
interpolate PEOPLE --grid 0 --plane lon lat → --grid is 0.0, outside (0, inf]
interpolate cities.csv --value name --grid 90 → cities.csv: row 1: the name 'Quito' is not a number
contour PEOPLE --levels=1,x → --levels is '1,x', but must be numbers, e.g. --levels=-10,0,10
contour PEOPLE --interval=0 → --interval is 0.0, outside (0, inf]
contour PEOPLE → give either --levels
contour PEOPLE --interval 1e-3 → --interval is 0.001, which makes
globe --show=land,moon → --show has 'moon'; the names are land, lakes, graticule, rivers, coastlines, borders,
globe --fly=1,2 -o a.png → --fly is for films, but a.png is none
globe --focus=1 → --focus is '1', but must be LON,LAT, e.g. --focus=10.5,48
globe --focus=1,95 → --focus is '1,95', but its latitude is outside [-90, 90]; the longitude comes
globe --view=inf,9 → --view is 'inf,9', but must be LON,LAT, e.g. --view=10.5,48
globe --magnify=-1 → --magnify is -1.0, outside [
globe --fly=1 -o out.gif → --fly is '1', but must be LON,LAT
globe --focus=0,0 --fly=180,0 -o out.gif → opposite
globe --projection hemispheres -o out.gif → --projection hemispheres cannot move
globe --projection stereographic -o out.gif → --projection stereographic cannot move
globe --show none --magnify 1e200 → --magnify is 1e+200, outside [
globe --texture missing.png → missing.png: No such file or directory
globe --texture broken.gpkg → broken.gpkg is not a picture
globe --texture cut.png → cut.png is damaged or cut off
globe --texture huge.png → huge.png has too many pixels: at most 134217728 are read
globe --texture square.png → square.png: pixels is 9 wide and 9 high
globe --layer broken.geojson → broken.geojson: the file is not JSON
globe --layer far.geojson → far.geojson: row 1: latitude 100.0 is outside [-90, 90]
globe --layer broken.gpkg → broken.gpkg
globe --labels=name → --labels is for POINTS
globe cities.csv --labels=town → there is no column 'town'
globe --style=bright → --style is 'bright'; give dark or a file .toml
globe --layer=a.geojson,colour=red → --layer a.geojson,colour=red: colour is unknown; the keys are color, width
globe --lon=x --skip-missing → --lon and --skip-missing are for POINTS
globe cities.csv --layer-name=x → --layer-name is 'x', but a file of the kind csv has no layers
globe --point-size=2mm → --point-size is for POINTS
globe cities.csv --point-size=town → --point-size is 'town'; give a length with a unit, pt, mm, cm, in
globe cities.csv --point-color=town → --point-color is 'town', which is not a colour; give a name such as
globe cities.csv --show=cells --point-size=2mm → --point-size is for points; name them in --show, too
globe cities.csv --point-color=people --scale=cube → --scale is 'cube'
globe cities.csv --point-color=people --scale=symlog → --scale is 'symlog' and threshold None; 'symlog' alone needs
globe cities.csv --point-color=people --scale=log --classes=equal:5 → --scale is for scales without --classes
globe cities.csv --point-color=people --classes=jenks:5 → --classes is 'jenks'
globe cities.csv --point-color=people --classes=9,1 → --classes is [9.0, 1.0], but limits of classes are two or more
globe cities.csv --point-color=people --classes=equal:x → --classes is 'x', but must be SCHEME:N or limits
globe cities.csv --point-color=people --classes=equal:2.5 → --classes is 2.5, but must be a whole number
globe cities.csv --point-color=people --colors=sunset → --colors is 'sunset', which is not a colour map of matplotlib
globe cities.csv --point-color=people --limits=5,1 → --limits is 1.0, outside
globe cities.csv --point-color=people --limits=5 → --limits is '5', but must be LOW,HIGH, e.g. --limits=0,100
globe cities.csv --legend-text=town=x → --legend-text names 'town', but the entries are
globe cities.csv --center=0 → --center is for colours by value; name a column of numbers in --point-color or --layer
globe --style=dark -o out.gif → --style is for pictures, not for films
panorama room.png -o room.png --overwrite → room.png: is an input, so it cannot be overwritten
panorama room.png -o out.gif → out.gif: cannot write gif
panorama room.png -o out.png --size 33 → size is 33, but
panorama room.png -o out.png --size 40000 → size is 40000, which makes
panorama room.png -o out.png --magnify 0 → --magnify is 0
panorama room.png -o out.png --to planet --angular-radius 170 → angular_radius is 170
panorama room.png -o out.png --faces → --faces requires --to cubemap, but
panorama room.png -o - --to cubemap --faces → six files
panorama cities.csv -o out.png → cities.csv is not a picture
web cities.csv -o cities.pdf → cities.pdf: cannot write pdf; choose .html
web -o - --open → --open needs a file; name one with --out
"""
STILL = {"globe --focus=0,0 --fly=180,0 -o out.gif", "globe --texture square.png"}
"""What names arguments of Python, `stops[1]` and `bounds=`, to whoever typed a line."""

NOTHING = """
contour PEOPLE --levels 1e12 → no lines
globe none.csv → none.csv: there are no points
web none.csv → none.csv: there are no points
triangulate two.csv → two.csv: no triangles
partition no.parquet -o a/ → no.parquet: there are no points
"""


def lines(table):
    return [line.split(" → ") for line in table.strip().splitlines()]


def arguments(line):
    """The words of a line, with a file to write to if it names none."""
    words = shlex.split(" ".join(SHORT.get(word, word) for word in line.split()))
    return words if "-o" in words else [*words, "-o", f"out.{ENDINGS.get(words[0], 'csv')}"]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Tables, layers and pictures of which much is wrong."""
    folder = tmp_path_factory.mktemp("made")
    for name, content in TEXTS.items():
        (folder / name).write_text(content, encoding="utf-8")
    (folder / "points").mkdir()
    numbers = pa.array([1.0, 2.0])
    for name in ("points/0", "points/1"):
        pq.write_table(pa.table({"lon": numbers, "lat": numbers, "id": [1, 2]}), folder / f"{name}.parquet")
    pq.write_table(pa.table({"lon": numbers[:0], "lat": numbers[:0]}), folder / "no.parquet")
    pq.write_table(pa.table({"lon": [True, False], "lat": numbers}), folder / "flags.parquet")
    points = geopandas.GeoDataFrame({"name": ["a"]}, geometry=geopandas.points_from_xy([10], [48]), crs=4326)
    for layer in ("first", "second"):
        points.to_file(folder / "two.gpkg", layer=layer)
    points.iloc[[0] * 9].to_file(folder / "cut.gml", driver="GML")
    (folder / "cut.gml").write_bytes((folder / "cut.gml").read_bytes()[:1500])
    square, noise = (
        iio.imwrite("<bytes>", np.random.default_rng(0).integers(0, 256, shape, dtype=np.uint8), extension=".png")
        for shape in ((9, 9, 3), (40, 80, 3))
    )
    header = struct.pack(">IIBBBBB", 300_000, 150_000, 8, 2, 0, 0, 0)  # of a picture of 135 GB
    chunk = struct.pack(">I", 13) + b"IHDR" + header + struct.pack(">I", zlib.crc32(b"IHDR" + header))
    pictures = {"square": square, "room": noise, "cut": noise[:5000], "huge": square[:8] + chunk + square[33:]}
    for name, content in pictures.items():
        (folder / f"{name}.png").write_bytes(content)
    return folder


@pytest.fixture
def files(folder, made):
    return shutil.copytree(made, folder, dirs_exist_ok=True)


def everything(folder):
    """All files but those by which a folder of results is known, when its points are looked at."""
    ours = {".lock", "plan.json", "layout.json"}
    return sorted(path for path in folder.rglob("*") if path.name not in ours and path.is_file())


@pytest.mark.parametrize(("line", "said"), lines(SAID))
def test_a_wrong_argument_is_named_as_it_was_typed(run, files, line, said):
    before = everything(files)
    told = run(*arguments(line), code=2)
    assert told.startswith("error: ")
    assert said in told
    assert told.count("\n") == 1
    python = re.search(r"(?<![-,\w])[a-z_]+=|\w\[\d", told)
    assert (python is None) == (line not in STILL), "an argument of Python"
    assert everything(files) == before


@pytest.mark.parametrize(("line", "said"), lines(NOTHING))
def test_nothing_to_do_is_no_error(run, files, line, said):
    assert said in run(*arguments(line), code=1)
    assert not list(files.glob("out.*"))


def test_every_option_that_a_message_may_name_exists():
    options = {
        name
        for command in app.registered_commands
        for parameter in inspect.signature(command.callback, eval_str=True).parameters.values()
        for info in getattr(parameter.annotation, "__metadata__", ())
        for name in (getattr(info, "param_decls", None) or ()) or (f"--{parameter.name.replace('_', '-')}",)
    }
    assert set(ARGUMENTS.values()) <= options
