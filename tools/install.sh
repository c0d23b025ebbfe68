#!/usr/bin/env bash
# Usage: tools/install.sh VENV [PYTHON]
# Create the environment and install the package with the pinned libraries, unless that was done already.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$1
wanted=$(cat pyproject.toml constraints.txt tools/install.sh | sha256sum)
if [[ -x $venv/bin/python && -f $venv/installed && $(<"$venv/installed") == "$wanted" ]]; then
    touch "$venv/installed"
    exit 0
fi
python=${2:-$(tools/find_python.sh)}
echo "Installing into $venv ($("$python" --version))" >&2
[[ -x $venv/bin/python ]] || "$python" -m venv "$venv"
pip=("$venv/bin/python" -m pip --disable-pip-version-check -qq)
# The build backend is pinned as well: installed first, then used without an isolated build environment.
"${pip[@]}" install --constraint constraints.txt hatchling editables
"${pip[@]}" install --constraint constraints.txt --no-build-isolation --editable '.[test,docs,dev]'
printf '%s\n' "$wanted" >"$venv/installed"
