#!/usr/bin/env bash
# Usage: tools/one_definition.sh VENV
# Check that no two sources of the kernel and its bindings define one name differently: the linker would pick either.
# GCC compares all definitions when it optimises at link time. Only if a source has changed.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
if ! ${CXX:-c++} --version | grep -qiE 'gcc|g\+\+|free software foundation'; then
    echo "one definition a name: not checked, GCC alone compares them" >&2
    exit 0
fi
wanted=$(find CMakeLists.txt tools/{one_definition,shell}.sh constraints.txt stereodel/kernel tests/kernel/probe -type f -print0 |
    LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum)
build=build/link_time
done=$build/one_definition
if [[ -f $done && $(<"$done") == "$wanted" ]]; then
    exit 0
fi
mkdir -p "$build"
rm -f "$build/CMakeCache.txt"
quietly cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 \
    -DSTEREODEL_ONE_DEFINITION=ON -DSTEREODEL_DEVELOPMENT=ON \
    -DPython_EXECUTABLE="$venv/bin/python" -Dnanobind_DIR="$(python -m nanobind --cmake_dir)"
quietly cmake --build "$build"
echo "each name has one definition"
printf '%s\n' "$wanted" >"$done"
