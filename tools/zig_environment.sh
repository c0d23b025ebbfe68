# Sourced by the scripts that compile with zig: `$zig` is its program in the environment VENV whose python comes first in
# PATH, `zig_cmake` the options of CMake that build for a target. What zig makes once, its C++ library for a target and
# compiled sources, is kept in a folder of ours.
zig=$(python -c 'import ziglang; print(ziglang.__path__[0])')/zig
export ZIG_GLOBAL_CACHE_DIR=$PWD/build/zig ZIG_LOCAL_CACHE_DIR=$PWD/build/zig
zig_cmake() { # TARGET
    printf '%s\n' "CMAKE_TOOLCHAIN_FILE=$PWD/tools/zig.cmake" "ZIG=$zig" "ZIG_TARGET=$1"
}
