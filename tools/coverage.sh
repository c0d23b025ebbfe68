#!/usr/bin/env bash
# Usage: tools/coverage.sh VENV [PYTEST ARGUMENT…]
# What the tests of both tiers reach, in every process that they start: lines and branches of Python (coverage.py) and of the
# kernel (gcov), with reports in build/coverage. docs/reliability.md publishes the two sums.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
root=$PWD
source tools/instrumented.sh
instrumented "$1" build/coverage '-O1 -g --coverage -fprofile-abs-path'
shift
find "$root/build/coverage" -name '*.gcda' -delete
ln -s "$root/stereodel/web/script/node_modules" stereodel/web/script/node_modules # which the page's tests load

export STEREODEL_TEST_PATIENCE=10
failed=0
python -m pytest -p no:cacheprovider -o faulthandler_timeout=3000 -m 'not large' --hypothesis-profile=thorough --cov=stereodel --cov-branch --cov-report= "$@" || failed=$?
python -m coverage json --quiet -o "$root/build/coverage/python.json"
python -m coverage report --format=total --precision=1 | sed 's/^/Python, lines and branches, per cent: /'
# Branches that the compiler adds for exceptions are not the kernel's. Counts of threads that come together can be wrong; large ones are right.
python -m gcovr --root "$root" --object-directory "$root/build/coverage" --filter "$root/stereodel/kernel/" \
    --exclude-throw-branches --exclude-unreachable-branches --gcov-ignore-parse-errors negative_hits.warn_once_per_file \
    --gcov-suspicious-hits-threshold 1000000000000000 \
    --json "$root/build/coverage/kernel.json" --print-summary \
    --txt "$root/build/coverage/kernel.txt"
exit "$failed"
