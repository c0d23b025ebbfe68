#!/usr/bin/env bash
# Usage: tools/bare.sh PYTHON FOLDER
# Try the wheel in FOLDER that fits PYTHON in a bare root: that interpreter, the libraries that it and NumPy are linked with,
# and nothing else; no compiler, no shell, no environment, no network. There the package is imported, asked for the stored
# answers, and put to the quick tests of what computes, as it is installed.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
python=$("$1" -c 'import sys; print(sys.executable)')
wheels=$(cd "$2" && pwd)
root=$(mktemp -d)
build=$root.build
mkdir -p "$build" "$root"/{dev,tmp,site,work}
trap 'rm -rf "$root" "$build"' EXIT

# The interpreter and its standard library, then what the loader finds for both.
read -r real library < <("$python" -c 'import os, sys; print(os.path.realpath(sys.executable), os.path.dirname(os.__file__))')
mkdir -p "$root${real%/*}" "$root$library"
cp -L "$real" "$root$real"
tar -C "$library" --exclude=./site-packages --exclude=./dist-packages --exclude=./test --exclude=__pycache__ -c . | tar -C "$root$library" -x
: >"$root/dev/null"

pip=("$python" -m pip --disable-pip-version-check -q install --target "$root/site" --only-binary :all: --no-compile)
quietly "${pip[@]}" --constraint constraints.txt numpy pytest hypothesis mpmath scipy pyproj
mapfile -t linked < <(find "$root" -type f \( -name '*.so*' -o -name 'python3*' \) -exec ldd {} + 2>/dev/null | grep -oE '[[:space:]]/[^ :]+' | tr -d '\t ' | sort -u)
for each in "${linked[@]}"; do mkdir -p "$root${each%/*}" && cp -L "$each" "$root$each"; done
quietly "${pip[@]}" --no-index --no-deps --find-links "$wheels" stereodel
cp -r tests tools figures pyproject.toml CONTRIBUTING.md "$root/work"
tested=(tests/{conformal,graphs,projections,relaxation,sphere,triangulation})
inside() { (cd "$root" && env -i HOME=/tmp PATH=/nowhere PYTHONPATH=/site:/work PYTHONDONTWRITEBYTECODE=1 CI=true \
    "$(command -v unshare)" --map-root-user --net --root="$root" --wd=/work "$real" "$@"); }
inside -W error tools/try_kernel.py
inside -m pytest -q -p no:cacheprovider -o addopts= --import-mode=importlib -m 'not thorough and not large' "${tested[@]}"
