#!/usr/bin/env bash
# Usage: tools/long_run.sh VENV
# Three hours of what shows only after long, one after the other: partitions whose processes are killed at random, damaged
# files, random bytes for the kernel, all sets that were made to go wrong with a million points, every mistake of
# tests/mutations, ten thousand pictures in one process, a film of 24 000 frames. It goes on after a failure, and ends with
# what was done in which time, and with 1 if anything failed.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
build=$PWD/build/long
mkdir -p "$build"
said=()
failed=0
part() { # NAME COMMAND…
    local name=$1 begun=$SECONDS how="done"
    shift
    echo "$name" >&2
    "$@" >"$build/$name.log" 2>&1 || { how=FAILED failed=1; tail -n 30 "$build/$name.log" >&2; }
    said+=("$(printf '%-12s %-6s %5d s   %s' "$name" "$how" $((SECONDS - begun)) "$(grep -E '[0-9]+ (passed|failed|mistakes|files)|units|runs$' "$build/$name.log" | tail -n 1)")")
}
export STEREODEL_TEST_SOAKS=${STEREODEL_TEST_SOAKS:-40}
part soak python -m pytest -q -n auto -m thorough -o faulthandler_timeout=3600 tests/partitioned/test_ends.py -k soak
part files python -m tests.fuzz.files 20000
part kernel tools/fuzz.sh "$venv" 2400
part sets python -m pytest -q -m large -o faulthandler_timeout=3600 tests/large/test_million.py
part pictures python -m pytest -q -m large -o faulthandler_timeout=7200 tests/large/test_long.py
part mutations python -m tools.mutate
printf '%s\n' "${said[@]}"
exit "$failed"
