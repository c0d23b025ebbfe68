#!/usr/bin/env bash
# Usage: tools/install.sh VENV [PYTHON]
# Create the environment, install the package with the pinned libraries and build its kernel, unless that was done already.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$1
wanted=$(cat pyproject.toml constraints.txt tools/install.sh | sha256sum)
if [[ ! -x $venv/bin/python || ! -f $venv/installed || $(<"$venv/installed") != "$wanted" ]]; then
    python=${2:-$(tools/find_python.sh)}
    echo "Installing into $venv ($("$python" --version))" >&2
    [[ -x $venv/bin/python ]] || "$python" -m venv "$venv"
    pip=("$venv/bin/python" -m pip --disable-pip-version-check -qq)
    build=(scikit-build-core nanobind)
    command -v cmake >/dev/null || build+=(cmake)
    command -v ninja >/dev/null || build+=(ninja)
    # The build backend is pinned as well: installed first, then used without an isolated build environment.
    "${pip[@]}" install --constraint constraints.txt "${build[@]}"
    # Requirements, metadata and the command alone. The package stays here, on a plain path, with no import hook that would
    # hide another copy from PYTHONPATH; its kernel is built beside it below, so that changed sources need no network.
    "${pip[@]}" install --constraint constraints.txt --no-build-isolation \
        --config-settings wheel.cmake=false --config-settings wheel.packages='[]' '.[test,docs,dev]'
    pwd >"$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/stereodel.pth"
    printf '%s\n' "$wanted" >"$venv/installed"
fi
tools/build_kernel.sh "$venv"
touch "$venv/installed"
