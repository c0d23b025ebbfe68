#!/usr/bin/env bash
# Usage: tools/cross.sh VENV [TARGET…]
# Compile the kernel for systems that no wheel is made for here, and link the program that feeds it random bytes, by zig.
# The program is run where this machine can; of the others it is known that they compile and link, and no more. The
# bindings of Python are compiled by the workflow files, on those systems.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
use_zig
targets=("${@:2}")
((${#targets[@]})) ||
    targets=(x86_64-linux-musl aarch64-macos.11.0 x86_64-macos.11.0 x86_64-windows-gnu aarch64-windows-gnu)
for target in "${targets[@]}"; do
    build=build/cross/$target
    mapfile -t defines < <(zig_cmake "$target")
    compile "${defines[@]/#/-D}" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DSTEREODEL_MODULE=OFF -DSTEREODEL_FUZZ=ON
    if [[ $target == "$(uname -m)"-linux-musl* ]]; then
        quietly "$build/fuzz_points" -max_total_time=2
        echo "$target: compiled, linked, and run"
    else
        echo "$target: compiled and linked, not run"
    fi
done
