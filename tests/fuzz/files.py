"""Changed files, given to the readers: each is read, or refused in one line that names it, in little time and memory.

    python -m tests.fuzz.files COUNT [SEED]

A file that is not is kept in build/fuzz/files.
"""

import bz2
import gzip
import io
import random
import shutil
import sys
import time
import warnings
import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory

import geopandas
import numpy as np
import pandas as pd
import pyogrio
from PIL import Image

from stereodel.constants import MOST_TEXELS
from stereodel.globe.raster import read_photo
from stereodel.io import read_points
from stereodel.io.reading import shapes_of

KEPT = Path(__file__).resolve().parent.parent.parent / "build" / "fuzz" / "files"
SECONDS, KILOBYTES = 5.0, 300_000
"""What one file of some kilobytes may take of a processor and of memory."""

PICTURE = MOST_TEXELS * (4 + 4) // 1000
"""What a picture may take of memory, which says how many pixels it has: each as it is decoded, and as it is given."""

DOORS = {"": (read_points, shapes_of)} | dict.fromkeys((".png", ".jpg", ".tif", ".webp", ".gif"), (read_photo,))
"""Who reads a file with an ending."""

REFUSED = (OSError, ValueError, ImportError)
"""What the command reports in one line; any other exception would be a traceback."""

TEXT = "lon,lat,name,n,when\n" + "".join(f"{k}.5,{k - 20},Zoë {k},{k * k},2024-01-{k % 28 + 1:02}\n" for k in range(40))
ODD = b'\0|\xff|\x7f|\x80|<|"|{|,|\xff\xff\xff\x7f|\0\0\0\x80|\xc3|e999|-'.split(b"|")


def seeds(folder):
    """A sound file of each format, by its ending: their bytes."""
    table = pd.read_csv(io.StringIO(TEXT))
    places = geopandas.points_from_xy(table["lon"], table["lat"])
    frame = geopandas.GeoDataFrame(table.drop(columns=["lon", "lat"]), geometry=places, crs="EPSG:4326")
    drivers = {"gpkg": "GPKG", "fgb": "FlatGeobuf", "kml": "LIBKML", "gml": "GML", "geojsonl": "GeoJSONSeq"}
    for end, driver in {**drivers, "geojson": "GeoJSON", "kmz": "LIBKML"}.items():
        frame.to_file(folder / f"a.{end}", driver=driver)
    frame[["name", "geometry"]].to_file(folder / "a.gpx", driver="GPX", layer="waypoints")
    frame.to_crs("EPSG:25832").to_file(folder / "s.shp", encoding="utf-8")
    with zipfile.ZipFile(folder / "a.zip", "w", zipfile.ZIP_DEFLATED) as packed:
        for part in sorted(folder.glob("s.*")):
            packed.write(part, part.name)
            part.unlink()
    frame.to_parquet(folder / "geo.parquet")
    table.to_parquet(folder / "a.parquet")
    for end in ("xlsx", "ods"):
        pyogrio.write_dataframe(table, folder / f"a.{end}", driver=end.upper())
    text = TEXT.encode()
    (folder / "a.csv").write_bytes(text)
    (folder / "a.csv.gz").write_bytes(gzip.compress(text, mtime=0))
    (folder / "a.csv.bz2").write_bytes(bz2.compress(text))
    (folder / "wide.csv").write_bytes(TEXT.encode("utf-16"))
    (folder / "a.geojson.gz").write_bytes(gzip.compress((folder / "a.geojson").read_bytes(), mtime=0))
    picture = Image.fromarray(np.arange(20 * 30 * 3, dtype=np.uint8).reshape(20, 30, 3))
    for end in ("png", "jpg", "tif", "webp", "gif"):
        picture.save(folder / f"a.{end}")
    return {
        path.name: path.read_bytes() for path in sorted(folder.iterdir()) if path.is_file() and path.suffix != ".xsd"
    }


def changed(content, chance):
    """The bytes after one to four changes; in half of all archives, those of a member."""
    if content[:2] == b"PK" and chance.random() < 0.5:
        return _repacked(content, chance)
    content = bytearray(content)
    for _ in range(chance.randint(1, 4)):
        a, b = sorted(chance.randrange(len(content) + 1) for _ in range(2))
        b = min(b, a + chance.choice((1, 4, 30, 1000)))
        kind = chance.randrange(6)
        if kind == 0:
            content[a:b] = chance.choice(ODD) * chance.choice((1, 1, 1, 20))
        elif kind == 1:
            content[a:b] = content[a:b] * chance.choice((2, 3, 50))
        elif kind == 2:
            del content[a:b]
        elif kind == 3 and a < len(content):
            content[a] ^= 1 << chance.randrange(8)
        elif kind == 4:
            content[a:b] = chance.randbytes(b - a)
        elif chance.random() < 0.3:
            del content[a:]
    return bytes(content)


def _repacked(content, chance):
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    name = chance.choice(sorted(members))
    members[name] = changed(members[name], chance)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, member in members.items():
            archive.writestr(name, member)
    return packed.getvalue()


def wrong(path):
    """What is wrong with how a file is read, or None."""
    for door in DOORS.get(path.suffix, DOORS[""]):
        held, began = memory(fresh=True), time.process_time()
        try:
            door(path)
        except REFUSED as error:
            if "\n" in str(error) or str(path) not in str(error):
                return f"{door.__name__}: message {str(error)!r}"
        except Exception as error:
            return f"{door.__name__}: {type(error).__name__}: {error}"
        spent, more = time.process_time() - began, memory() - held
        if spent > SECONDS or more > (PICTURE if door is read_photo else KILOBYTES):
            return f"{door.__name__}: {spent:.1f} s and {more} kB"
    return None


def memory(*, fresh=False):
    """The most memory in kB that was held since it was asked for afresh; 0 where the system does not tell."""
    if sys.platform != "linux":
        return 0
    if fresh:
        Path("/proc/self/clear_refs").write_text("5")
    said = Path("/proc/self/status").read_text()
    return int(said.partition("VmHWM:")[2].split()[0])


def main(count, seed):
    """Read changed files; the exit code is the number of those that were not read or refused as they should."""
    warnings.simplefilter("ignore")
    chance, found = random.Random(seed), 0
    with TemporaryDirectory() as made, TemporaryDirectory() as tried:
        sound = seeds(Path(made))
        for name, content in sound.items():
            path = Path(tried, name)
            path.write_bytes(content)
            said = wrong(path)
            assert said is None, f"{name}, unchanged: {said}"
        names = sorted(sound)
        for number in range(count):
            path = Path(tried, f"{number}-{names[number % len(names)]}")
            path.write_bytes(changed(sound[names[number % len(names)]], chance))
            shutil.copy(path, KEPT / f"last{path.suffix}")  # what a crash was at
            said = wrong(path)
            if said is not None:
                found += 1
                kept = shutil.copy(path, KEPT / f"{seed}-{path.name}")
                print(f"{kept}: {said}")
            path.unlink()
    print(f"{count} changed files of {len(names)} formats, seed {seed}: {found} wrong")
    return min(found, 100)


if __name__ == "__main__":
    KEPT.mkdir(parents=True, exist_ok=True)
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else random.SystemRandom().randrange(10**9)))
