#!/usr/bin/env bash
# Usage: tools/dist.sh VENV
# Source archive and wheel into dist/, the wheel built from the archive by the machine's own compiler, and the archive for
# npm. Each is made twice, the wheel in two folders: the same sources must give the same bytes. Then the wheel is tried in
# a new environment (tools/try_wheel.sh), and the npm archive in an empty folder.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source tools/source_date.sh

rm -rf dist
archive=$(tools/source_archive.sh "$venv" dist)
wheel() { # FOLDER SOURCES; unpacked into a folder of that name
    mkdir -p "$work/$2"
    tar -xzf "$archive" -C "$work/$2" --strip-components=1
    PATH=$venv/bin:$PATH python -m pip --disable-pip-version-check -qq wheel --no-deps --no-build-isolation --wheel-dir "$1" "$work/$2"
}
same() { cmp "$1" "$2" || { echo "tools/dist.sh: ${1##*/} is not the same when it is made again" >&2; exit 1; }; }
wheel dist sources
wheel "$work/again" elsewhere/the-same
tools/npm_archive.sh "$venv" dist
tools/npm_archive.sh "$venv" "$work/again"
for made in "$work"/again/*; do same "dist/${made##*/}" "$made"; done
"$venv/bin/python" tools/archives.py "$archive" dist/*.whl
"$venv/bin/python" tools/archives.py --sizes dist/*.whl
tools/try_wheel.sh "$venv/bin/python" dist/*.whl

# What users of JavaScript get; no network is needed, as the package needs no other.
packed=$(echo "$PWD"/dist/*.tgz)
cd "$work"
"$venv/bin/npm" install --silent --no-audit --no-fund --offline "$packed"
"$venv/bin/node" --input-type=module --eval '
import { load, SphericalDelaunay } from "stereodel";
await load();
const { simplices } = SphericalDelaunay.fromLonlat([-78.5, -0.2, 10, 48.4, 135.8, 35, 115.9, -32]);
console.log(`stereodel from the npm archive: ${simplices.length / 3} triangles`);'
