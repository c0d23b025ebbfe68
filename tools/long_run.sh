#!/usr/bin/env bash
# Usage: tools/long_run.sh VENV
# What shows only after long, in two rows on two cores: partitions whose processes are killed at random, damaged
# files, all sets that were made to go wrong with a million points, random bytes for the kernel; beside them ten thousand
# pictures of each kind in one process, a film of 24 000 frames, every mistake of tests/mutations. It goes on after a
# failure, and ends with what was done in which time, and with 1 if anything failed.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
build=$PWD/build/long
rm -rf "$build"
mkdir -p "$build"
part() { # NAME COMMAND…
    local name=$1 begun=$SECONDS how="done"
    shift
    echo "$name" >&2
    "$@" >"$build/$name.log" 2>&1 || { how=FAILED && tail -n 30 "$build/$name.log" >&2; }
    printf '%-12s %-6s %5d s   %s\n' "$name" "$how" $((SECONDS - begun)) "$(tail -n 1 "$build/$name.log")" >>"$build/said"
}
tests() { python -m pytest -q -o faulthandler_timeout=7200 "$@"; }
{
    STEREODEL_TEST_SOAKS=${STEREODEL_TEST_SOAKS:-40} part soak tests -n auto -m thorough tests/partitioned/test_ends.py -k soak
    part files python -m tests.fuzz.files 20000
    part sets tests -m large tests/large/test_million.py
    part kernel tools/fuzz.sh "$venv" 2400
} &
{
    part pictures tests -m large tests/large/test_long.py
    part mutations python -m tools.mutate
} &
wait
cat "$build/said"
! grep -q FAILED "$build/said"
