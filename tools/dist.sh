#!/usr/bin/env bash
# Usage: tools/dist.sh VENV [again]
# Source archive, wheel and the archive for npm into dist/; the wheel is built from the source archive by the machine's own
# compiler. Then the wheel is tried in a new environment (tools/try_wheel.sh), and the npm archive in an empty folder.
# With `again` those of dist/ are made once more, the wheel in another folder: the same sources must give the same bytes.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
again=${2:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source_date
if [[ -n $again ]]; then folder=$work/archives sources=$work/elsewhere/the-same; else folder=dist sources=$work/sources; fi
rm -rf "$folder"
archive=$(tools/source_archive.sh "$venv" "$folder")
mkdir -p "$sources"
tar -xzf "$archive" -C "$sources" --strip-components=1
python -m pip --disable-pip-version-check -qq wheel --no-deps --no-build-isolation --wheel-dir "$folder" "$sources"
tools/npm_archive.sh "$venv" "$folder"
if [[ -n $again ]]; then
    for made in "$folder"/*; do
        cmp "$made" "dist/${made##*/}" || die "${made##*/} is not the same when it is made again"
    done
    exit
fi
python tools/archives.py dist/*.tar.gz dist/*.whl
tools/try_wheel.sh "$venv/bin/python" dist/*.whl

# What users of JavaScript get; no network is needed, as the package needs no other.
packed=$(echo "$PWD"/dist/*.tgz)
cd "$work"
npm install --silent --no-audit --no-fund --offline "$packed"
node --input-type=module --eval '
import { load, SphericalDelaunay } from "stereodel";
await load();
const { simplices } = SphericalDelaunay.fromLonlat([-78.5, -0.2, 10, 48.4, 135.8, 35, 115.9, -32]);
console.log(`stereodel from the npm archive: ${simplices.length / 3} triangles`);'
