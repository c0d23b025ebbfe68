#!/usr/bin/env bash
# Usage: tools/build_web.sh VENV [compare]
# Build the files of stereodel/web/built with the tools of VENV; with `compare` fail if they are not the tracked ones to the
# last byte.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$(cd "$1" && pwd)
compare=${2:-}
PATH=$venv/bin:$PATH # its cmake, ninja, node and npm come first
script=stereodel/web/script
built=stereodel/web/built
work=build/web
mkdir -p "$work" "$built"
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }; }

source tools/zig_environment.sh
echo "Building the kernel for the web with zig $("$zig" version)" >&2
rm -f "$work/cmake/CMakeCache.txt"
# For few bytes, but for what CMakeLists.txt names. Zig takes -Oz for -Os: hence the word for clang itself.
mapfile -t defines < <(zig_cmake wasm32-wasi)
quietly cmake -S . -B "$work/cmake" -G Ninja "${defines[@]/#/-D}" \
    -DCMAKE_CXX_FLAGS_RELEASE="-Os -Xclang -Oz -DNDEBUG" -DSTEREODEL_DEVELOPMENT=ON -DSTEREODEL_MODULE=OFF \
    -DSTEREODEL_THREADS=OFF -DSTEREODEL_WEB=ON
quietly cmake --build "$work/cmake"
rm -rf "$work/stage"
quietly cmake --install "$work/cmake" --prefix "$work/stage"
chmod 644 "$work/stage/stereodel.wasm"

tools/node_modules.sh "$venv"
quietly node tools/bundle_web.mjs "$work/stage"

if [[ -n $compare ]]; then
    diff -rq "$work/stage" "$built" >&2 || { echo "tools/build_web.sh: run make web and commit $built" >&2; exit 1; }
else
    # Moved into place whole, and what is built no more goes.
    rm -rf "$built"
    cp -r "$work/stage" "$built"
fi
