#!/usr/bin/env bash
# Usage: tools/dist.sh VENV
# Source archive and wheel into dist/, the wheel built from the archive, and the archive for npm; then the wheel is tried
# in a new environment, and the npm archive in an empty folder.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pip=(-m pip --disable-pip-version-check -qq)

rm -rf dist
"$venv/bin/python" -c 'from scikit_build_core.build import build_sdist; build_sdist("dist")' >/dev/null
PATH=$(cd "$venv/bin" && pwd):$PATH python "${pip[@]}" wheel --no-deps --no-build-isolation --wheel-dir dist dist/*.tar.gz
"$venv/bin/python" tools/archives.py dist/*.tar.gz dist/*.whl
tools/npm_archive.sh "$venv" dist

# As users get it: NumPy alone, then the command line, then all that README's first commands need.
"$venv/bin/python" -m venv "$work/venv"
pins=$PWD/constraints.txt
wheel=$(echo "$PWD"/dist/*.whl)
archive=$(echo "$PWD"/dist/*.tgz)
bin=$(cd "$venv/bin" && pwd)
install() { "$work/venv/bin/python" "${pip[@]}" install --constraint "$pins" "$1"; }
stereodel() { "$work/venv/bin/stereodel" "$@"; }
refused() { if "$@" >said 2>&1; then echo "tools/dist.sh: $* should fail" >&2; exit 1; fi; }
expect() { # FILE WORDS
    grep -qF -- "$2" "$1" || { echo "tools/dist.sh: no $2 in:" >&2; cat "$1" >&2; exit 1; }
}
cd "$work"
printf 'name,lon,lat\nQuito,-78.5,-0.2\nUlm,10.0,48.4\nKyoto,135.8,35.0\nPerth,115.9,-32.0\n' >cities.csv

install "$wheel"
venv/bin/python - <<'PYTHON'
import numpy as np
import stereodel

points = np.random.default_rng(1).normal(size=(500, 3))
triangles = stereodel.SphericalDelaunay(points).simplices
stereodel.check_delaunay(points, triangles)
assert len(triangles) == 2 * 500 - 4
print(f"stereodel {stereodel.__version__} from the wheel, with NumPy alone: {len(triangles)} triangles")
PYTHON
refused stereodel --help
expect said "pip install 'stereodel[cli]'"

# The extras of what is installed: pip asks no index for stereodel itself.
install 'stereodel[cli]'
stereodel --version
stereodel voronoi cities.csv -o cells.csv
expect cells.csv Kyoto
for picture in svg png; do
    refused stereodel globe cities.csv -o globe.$picture
    expect said "pip install 'stereodel["
done
refused stereodel doctor
expect said "pip install 'stereodel[render]'"

install 'stereodel[all]'
stereodel voronoi cities.csv -o cells.geojson
expect cells.geojson Kyoto
stereodel globe cities.csv --focus=10,48.4 --magnify 2 -o globe.svg
expect globe.svg '</svg>'
stereodel doctor >said || cat said # the machine may have no OpenGL
if grep ' lacks ' said; then exit 1; fi

# What users of JavaScript get; no network is needed, as the package needs no other.
"$bin/npm" install --silent --no-audit --no-fund --offline "$archive"
"$bin/node" --input-type=module --eval '
import { load, SphericalDelaunay } from "stereodel";
await load();
const { simplices } = SphericalDelaunay.fromLonlat([-78.5, -0.2, 10, 48.4, 135.8, 35, 115.9, -32]);
console.log(`stereodel from the npm archive: ${simplices.length / 3} triangles`);'
