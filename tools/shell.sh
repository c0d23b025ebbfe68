# Sourced first by the scripts that build and try: they stop at errors, and work in the repository's root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

use() { # VENV: its python, cmake, ninja, node and npm come first
    venv=$(cd "$1" && pwd)
    PATH=$venv/bin:$PATH
}

die() { echo "tools/${0##*/}: $*" >&2; exit 1; }

quietly() { local said; said=$("$@" 2>&1) || { printf '%s\n' "$said" >&2; exit 1; }; } # what it says, only if it fails

files_digest() { find "$@" -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum; } # of files and folders

# Configure with these options of CMake and compile, in `$build`. The cache of an earlier time may hold paths of an
# environment that was made anew since.
compile() {
    mkdir -p "$build"
    rm -f "$build/CMakeCache.txt"
    quietly cmake -S . -B "$build" -G Ninja "$@"
    quietly cmake --build "$build"
}
compile_for_python() {
    compile -DSTEREODEL_DEVELOPMENT=ON -DPython_EXECUTABLE="$(command -v python)" \
        -Dnanobind_DIR="$(python -m nanobind --cmake_dir)" "$@"
}

# The time that stands in archives is that of the last commit, so that the same sources give the same bytes whenever they
# are built. In an unpacked source archive it is that of its settings.
source_date() { export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || stat -c %Y pyproject.toml)}; }

# `$zig` is the program of the environment, `zig_cmake TARGET` prints the options of CMake that build for a target. What zig
# makes once, its C++ library for a target and compiled sources, is kept in a folder of ours.
use_zig() {
    zig=$(python -c 'import ziglang; print(ziglang.__path__[0])')/zig
    export ZIG_GLOBAL_CACHE_DIR=$PWD/build/zig ZIG_LOCAL_CACHE_DIR=$PWD/build/zig
}
zig_cmake() { printf '%s\n' "CMAKE_TOOLCHAIN_FILE=$PWD/tools/zig.cmake" "ZIG=$zig" "ZIG_TARGET=$1"; }
