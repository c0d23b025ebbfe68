#!/usr/bin/env bash
# Usage: tools/sanitize.sh VENV [PYTEST ARGUMENT…]
# Run the tests on a kernel that stops at every wrong address, every undefined operation and every failed assertion.
# It is built into a copy of the tracked files, and the tests run there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$(cd "$1" && pwd)
shift
PATH=$venv/bin:$PATH
build=$PWD/build/sanitize
tree=$build/tree
rm -rf "$tree"
mkdir -p "$tree"
git ls-files -z | xargs -0 tar c | tar x -C "$tree"
rm -f "$build/CMakeCache.txt"
quietly() { "$@" >"$build/log" 2>&1 || { cat "$build/log" >&2; exit 1; }; }
# No -DNDEBUG: assertions count as well.
quietly cmake -S . -B "$build" -G Ninja -DSTEREODEL_DEVELOPMENT=ON -DSTEREODEL_SANITIZE=ON \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO='-O1 -g' \
    -DPython_EXECUTABLE="$venv/bin/python" -Dnanobind_DIR="$(python -m nanobind --cmake_dir)"
quietly cmake --build "$build"
quietly cmake --install "$build" --prefix "$tree"

# Python itself is not sanitized, so the library must be loaded before it, and the C++ library with it: its exceptions
# are intercepted. Leaks are not looked for here, since Python frees nothing at its end.
compiler=${CXX:-c++}
export LD_PRELOAD="$("$compiler" -print-file-name=libasan.so) $("$compiler" -print-file-name=libstdc++.so)"
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1
export PYTHONPATH=$tree # before the installed package, in every process that the tests start
export STEREODEL_TEST_PATIENCE=10 STEREODEL_TEST_WEB=off # a browser does not start with the libraries above
cd "$tree"
python -P -c 'import os, stereodel._kernel as k; assert os.path.samefile(os.path.dirname(k.__file__), "stereodel"), k.__file__'
exec python -m pytest -p no:cacheprovider -o faulthandler_timeout=3000 "$@"
