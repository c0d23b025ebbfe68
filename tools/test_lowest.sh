#!/usr/bin/env bash
# Usage: tools/test_lowest.sh [PYTEST ARGUMENT…]
# Run the tests of the doors, the command, files and the interface of SciPy, with the least versions of all libraries that
# pyproject.toml allows, at once, on the oldest Python, in an environment of its own. What those need in turn is the newest
# that they allow, as pip would choose it today; warnings of old libraries about new ones are no errors.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
venv=.venvs/lowest
stamp=$venv/installed-lowest
wanted=$(cat pyproject.toml constraints.txt tools/test_lowest.sh tools/lowest.py | sha256sum)
if [[ ! -f $stamp || $(<"$stamp") != "$wanted" ]]; then
    python=$(tools/find_python.sh 3.11) || die "Python 3.11 is needed; it was not found"
    "$python" -m venv --clear "$venv"
    pip=("$venv/bin/python" -m pip --disable-pip-version-check -qq install)
    "${pip[@]}" --constraint constraints.txt scikit-build-core nanobind cmake ninja
    mapfile -t lowest < <("$venv/bin/python" tools/lowest.py)
    "${pip[@]}" --only-binary :all: "${lowest[@]}" pytest pytest-xdist hypothesis mpmath uxarray antimeridian pyyaml
    pwd >"$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/stereodel.pth"
    printf '%s\n' "$wanted" >"$stamp"
fi
tools/build_kernel.sh "$venv"
"$venv/bin/python" -m pytest -o filterwarnings=default "$@" tests/{cli,io,spatial}
