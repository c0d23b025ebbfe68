#!/usr/bin/env bash
# Print a Python that works and is at least 3.11, python3 first. A version manager's shim may exist and not run.
set -euo pipefail

for candidate in python3 python3.13 python3.12 python3.11 python "$HOME"/.pyenv/versions/3.1[1-9].*/bin/python; do
    if "$candidate" -c 'import sys, venv; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; then
        command -v "$candidate"
        exit 0
    fi
done
echo "stereodel needs Python 3.11 or newer with its venv module; none was found. On Debian: apt-get install python3 python3-venv" >&2
exit 1
