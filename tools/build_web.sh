#!/usr/bin/env bash
# Usage: tools/build_web.sh VENV [compare]
# Build the files of stereodel/web/built with the tools of VENV; with `compare` fail if they are not the tracked ones to the
# last byte.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
use_zig
built=stereodel/web/built
build=build/web
mkdir -p "$built"
echo "Building the kernel for the web with zig $("$zig" version)" >&2
# For few bytes, but for what CMakeLists.txt names. Zig takes -Oz for -Os: hence the word for clang itself.
mapfile -t defines < <(zig_cmake wasm32-wasi)
compile "${defines[@]/#/-D}" -DCMAKE_CXX_FLAGS_RELEASE="-Os -Xclang -Oz -DNDEBUG" -DSTEREODEL_DEVELOPMENT=ON \
    -DSTEREODEL_MODULE=OFF -DSTEREODEL_THREADS=OFF -DSTEREODEL_WEB=ON
rm -rf "$build/stage"
quietly cmake --install "$build" --prefix "$build/stage"
chmod 644 "$build/stage/stereodel.wasm"

quietly node tools/bundle_web.mjs "$build/stage"

if [[ -n ${2:-} ]]; then
    diff -rq "$build/stage" "$built" >&2 || die "run make web and commit $built"
else
    # Moved into place whole, and what is built no more goes.
    rm -rf "$built"
    cp -r "$build/stage" "$built"
fi
