#!/usr/bin/env bash
# Usage: tools/one_definition.sh VENV
# Check that no two sources of the kernel and its bindings define one name differently: the linker would pick either.
# GCC compares all definitions when it optimises at link time. Then build the kernel without threads, as pages of a
# browser do, and feed it some random bytes. Both only if a source has changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$(cd "$1" && pwd)
PATH=$venv/bin:$PATH # its cmake and ninja come first
wanted=$(find CMakeLists.txt tools/one_definition.sh constraints.txt stereodel/kernel tests/kernel/probe tests/fuzz -type f \
    -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum)
done=build/one_definition
if [[ -f $done && $(<"$done") == "$wanted" ]]; then
    exit 0
fi
quietly() { "$@" >"$build/log" 2>&1 || { cat "$build/log" >&2; exit 1; }; }
compiled() { # BUILD CMAKE-OPTION…
    build=$1
    mkdir -p "$build"
    rm -f "$build/CMakeCache.txt"
    quietly cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 "${@:2}"
    quietly cmake --build "$build"
}
if ${CXX:-c++} --version | grep -qiE 'gcc|g\+\+|free software foundation'; then
    compiled build/link_time -DSTEREODEL_ONE_DEFINITION=ON -DSTEREODEL_DEVELOPMENT=ON \
        -DPython_EXECUTABLE="$venv/bin/python" -Dnanobind_DIR="$(python -m nanobind --cmake_dir)"
    echo "each name has one definition"
else
    echo "one definition a name: not checked, GCC alone compares them" >&2
fi
compiled build/one_thread -DSTEREODEL_THREADS=OFF -DSTEREODEL_MODULE=OFF -DSTEREODEL_FUZZ=ON
# The fuzz target's own main may use files, and these threads.
if ninja -C "$build" -t deps | awk '/^[^ ]/ { kernel = /kernel\.dir/ } kernel' | grep -qE '/(thread|mutex|condition_variable)$'; then
    echo "without threads, no header of threads may be asked for" >&2
    exit 1
fi
quietly env --chdir="$build" ./fuzz_points -max_total_time=2
echo "the kernel runs without threads"
printf '%s\n' "$wanted" >"$done"
