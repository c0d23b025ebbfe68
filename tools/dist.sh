#!/usr/bin/env bash
# Usage: tools/dist.sh VENV
# Source archive and wheel into dist/, the wheel built from the archive; then the wheel is installed into a new environment
# and triangulates there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pip=(-m pip --disable-pip-version-check -qq)

rm -rf dist
"$venv/bin/python" -c 'from scikit_build_core.build import build_sdist; build_sdist("dist")' >/dev/null
PATH=$(cd "$venv/bin" && pwd):$PATH python "${pip[@]}" wheel --no-deps --no-build-isolation --wheel-dir dist dist/*.tar.gz
"$venv/bin/python" tools/archives.py dist/*.tar.gz dist/*.whl

"$venv/bin/python" -m venv "$work/venv"
"$work/venv/bin/python" "${pip[@]}" install --constraint constraints.txt dist/*.whl
cd "$work"
venv/bin/python - <<'PYTHON'
import numpy as np
import stereodel

points = np.random.default_rng(1).normal(size=(500, 3))
triangles = stereodel.SphericalDelaunay(points).simplices
stereodel.check_delaunay(points, triangles)
assert len(triangles) == 2 * 500 - 4
print(f"stereodel {stereodel.__version__} from the wheel: {len(triangles)} triangles")
PYTHON
venv/bin/stereodel --version
