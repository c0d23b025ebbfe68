#!/usr/bin/env bash
# Usage: tools/find_python.sh [VERSION]
# Print a Python that works and is at least 3.11, python3 first; or the newest one of a VERSION as 3.13, or 3.14t, which
# has no lock of the interpreter: status 1 where there is none. A version manager's shim may exist and not run.
set -euo pipefail

if [[ $# == 0 ]]; then
    for candidate in python3 python3.13 python3.12 python3.11 python "$HOME"/.pyenv/versions/3.1[1-9].*/bin/python; do
        if "$candidate" -c 'import sys, venv; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; then
            command -v "$candidate"
            exit 0
        fi
    done
    echo "stereodel needs Python 3.11 or newer with its venv module; none was found. On Debian: apt-get install python3 python3-venv" >&2
    exit 1
fi

found=
for candidate in "$HOME/.pyenv/versions/${1%t}".*/bin/python "python$1"; do
    if "$candidate" -c "import sys, sysconfig, venv
lock = '' if not sysconfig.get_config_var('Py_GIL_DISABLED') else 't'
sys.exit('%d.%d' % sys.version_info[:2] + lock != '$1')" >/dev/null 2>&1; then
        found=$(command -v "$candidate")
    fi
done
[[ -n $found ]] && printf '%s\n' "$found"
