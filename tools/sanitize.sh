#!/usr/bin/env bash
# Usage: tools/sanitize.sh VENV [PYTEST ARGUMENT…]
# Run the tests on a kernel that stops at every wrong address, every undefined operation and every failed assertion.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
source tools/instrumented.sh
instrumented "$1" build/sanitize '-O1 -g' -DSTEREODEL_SANITIZE=ON
shift

# Python itself is not sanitized, so the library must be loaded before it, and the C++ library with it: its exceptions
# are intercepted. Leaks are not looked for here, since Python frees nothing at its end.
compiler=${CXX:-c++}
export LD_PRELOAD="$("$compiler" -print-file-name=libasan.so) $("$compiler" -print-file-name=libstdc++.so)"
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1
export STEREODEL_TEST_PATIENCE=10 STEREODEL_TEST_WEB=off # a browser does not start with the libraries above
python -P -c 'import os, stereodel._kernel as k; assert os.path.samefile(os.path.dirname(k.__file__), "stereodel"), k.__file__'
exec python -m pytest -p no:cacheprovider -o faulthandler_timeout=3000 "$@"
