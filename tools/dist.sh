#!/usr/bin/env bash
# Usage: tools/dist.sh VENV
# Source archive, wheel and the archive for npm into dist/ (tools/make_archives.sh). Then the wheel is tried in a new
# environment (tools/try_wheel.sh), and the npm archive in an empty folder.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rm -rf dist
tools/make_archives.sh "$venv" dist "$work/sources"
"$venv/bin/python" tools/archives.py dist/*.tar.gz dist/*.whl
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
