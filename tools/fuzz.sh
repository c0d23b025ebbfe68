#!/usr/bin/env bash
# Usage: tools/fuzz.sh VENV SECONDS
# Feed bytes to the kernel, built with address and undefined-behaviour sanitizers and assertions: through libFuzzer where
# clang has it, else random ones. What went wrong is left in build/fuzz.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
seconds=$2
build=$PWD/build/fuzz
mkdir -p "$build/corpus"
compiler=${CXX:-c++}
if echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
    clang++ -fsanitize=fuzzer,address,undefined -x c++ -o "$build/probe" - >/dev/null 2>&1; then
    compiler=clang++
fi
compile -DCMAKE_CXX_COMPILER="$compiler" -DSTEREODEL_SANITIZE=ON -DSTEREODEL_FUZZ=ON -DSTEREODEL_MODULE=OFF \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO='-O1 -g'
cd "$build"
options=(-max_total_time="$seconds" -max_len=3000 -timeout=60 -rss_limit_mb=4096 -print_final_stats=1)
./fuzz_points "${options[@]}" corpus >log 2>&1 || { tail -n 60 log >&2; exit 1; }
grep -E 'number_of_executed_units|runs$' log
