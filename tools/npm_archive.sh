#!/usr/bin/env bash
# Usage: tools/npm_archive.sh VENV FOLDER
# The npm archive of the kernel for the web, into FOLDER, with the tools of VENV.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
mkdir -p "$2"
folder=$(cd "$2" && pwd)
script=$PWD/stereodel/web/script
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Readable, with the sources for debuggers: whoever publishes a page makes it small.
"$script/node_modules/.bin/esbuild" "$script"/kernel/{index,inline,d3,delaunator,d3_delaunay}.ts --bundle --splitting --format=esm \
    --sourcemap --target=es2022 --charset=utf8 --loader:.wasm=binary --log-level=error --outdir="$work"
"$script/node_modules/.bin/tsc" --project "$script/kernel" --outDir "$work/types"
cp stereodel/web/built/stereodel.wasm LICENSE NOTICES.md "$script/README.md" "$work"
# The package is the project's file without what those who work on it need.
node - "$script/package.json" "$work/package.json" <<'JAVASCRIPT'
const { readFileSync, writeFileSync } = require("node:fs");
const [from, to] = process.argv.slice(2);
const { private: _, scripts, prettier, devDependencies, ...published } = JSON.parse(readFileSync(from, "utf8"));
writeFileSync(to, JSON.stringify(published, null, 2) + "\n");
JAVASCRIPT
(cd "$work" && npm pack --silent --pack-destination "$folder")
