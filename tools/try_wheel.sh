#!/usr/bin/env bash
# Usage: tools/try_wheel.sh PYTHON WHEEL|INDEX
# Try a wheel, or what an index at an address has, as users get it, in a new environment of PYTHON and with no compiler to
# be found: with NumPy alone, with the command line, then by the README's first line, after which all its commands and
# pictures must come out, and the examples of documentation and docstrings.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
python=$1
if [[ $2 == http* ]]; then
    first=stereodel
    where=(--extra-index-url "$2")
else
    first=$(cd "$(dirname "$2")" && pwd)/${2##*/}
    where=(--find-links "${first%/*}")
fi
root=$PWD
pins=$PWD/constraints.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$python" -m venv "$work/venv"
# What the scripts below call, and nothing that compiles.
mkdir "$work/bin"
for tool in bash env cat tr grep dirname uname sh ldconfig; do
    found=$(PATH=$PATH:/sbin:/usr/sbin command -v "$tool") && ln -s "$found" "$work/bin/$tool"
done
bin=$work/venv/bin
bare() { env -u CC -u CXX PATH="$bin:$work/bin" "$@"; }
for compiler in cc c++ gcc g++ clang clang++ cmake ninja make; do
    if bare bash -c "command -v $compiler" >/dev/null; then die "$compiler is to be found"; fi
done
install() {
    bare python -m pip --disable-pip-version-check -qq install --only-binary :all: --constraint "$pins" \
        "${where[@]}" "$@"
}
refused() { if bare "$@" >said 2>&1; then die "$* should fail"; fi; }
advice() { bare python -c 'import sys; from stereodel._extras import installing; print(installing(sys.argv[1]))' "$1"; } # EXTRA
expect() { grep -qF -- "$2" "$1" || { cat "$1" >&2; die "no $2 in the above"; }; } # FILE WORDS
cd "$work"
printf 'name,lon,lat\nQuito,-78.5,-0.2\nUlm,10.0,48.4\nKyoto,135.8,35.0\nPerth,115.9,-32.0\n' >cities.csv

install "$first"
site=$(bare python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
# Without bytecode, and without pip, which the environment brings of itself.
megabytes=$(find "$site" -type f ! -name '*.pyc' ! -path '*/pip/*' ! -path '*/setuptools/*' -printf '%s\n' |
    awk '{ sum += $1 } END { printf "%.0f", sum / 1e6 }')
((megabytes <= 80)) || die "NumPy and stereodel take $megabytes MB; more than 80"
echo "NumPy and stereodel alone: $megabytes MB"
bare python -W error "$root/tools/try_kernel.py"
cat >modules.py <<'PYTHON'
import importlib
import pkgutil
import sys

import stereodel
from stereodel._extras import EXTRAS, MissingExtraError, installing

advice = []
names = [module.name for module in pkgutil.walk_packages(stereodel.__path__, "stereodel.")]
for name in names:
    try:
        importlib.import_module(name)
    except MissingExtraError as error:
        advice.append(str(error).partition("': ")[2])
    except ModuleNotFoundError as error:
        sys.exit(f"{name} imports {error.name}, which is neither a dependency nor in an extra that the message names")
assert set(advice) <= set(map(installing, sys.argv[1:] or EXTRAS)), advice
print(f"{len(names) - len(advice)} modules work on what is installed, {len(advice)} name an extra")
PYTHON
bare python -W error modules.py
[[ $(advice cli) == 'pip install "typer>='*'" "rich>='*'"' ]] || die "$(advice cli): not for an environment without a checkout"
bare stereodel --version
bare stereodel --help >said
expect said "$(advice cli)"
refused stereodel voronoi cities.csv -o cells.csv
expect said "$(advice cli)"
refused stereodel doctor
expect said "$(advice render)"

# The extras of what is installed: pip asks no index for stereodel itself.
install 'stereodel[cli]'
bare stereodel --version
bare stereodel voronoi cities.csv -o cells.csv
expect cells.csv Kyoto
bare stereodel voronoi cities.csv -o cells.geojson
expect cells.geojson MultiPolygon
refused stereodel globe cities.csv -o globe.svg
expect said "$(advice draw)"
refused stereodel globe cities.csv -o globe.png
expect said "$(advice render)"
refused stereodel doctor
expect said "$(advice render)"

install 'stereodel[all]'
bare python modules.py vtk
bare stereodel doctor >said || cat said # the machine may have no OpenGL
if grep ' lacks ' said | grep -v '^  vtk '; then exit 1; fi
# The scripts without the package beside them: it is the wheel's that they import.
mkdir -p repository/{docs,tests}
cp -r "$root"/{README.md,pyproject.toml,tools,figures} repository
cp "$root"/docs/*.md repository/docs
cp "$root"/tests/{conftest,tiers,test_docs}.py repository/tests
cd repository
bare python -m tools.page_commands README.md "$work/readme"
bare python -m tools.pictures readme "$work/pictures"
install pytest hypothesis duckdb distributed # these two are what pages show beside
examples() { PATH=$bin:$PATH python -m pytest -q -p no:cacheprovider -m "not large" --durations=0 --durations-min=20 "$@"; }
examples tests/test_docs.py -k "page_runs or dialogues or commands_print or readme_example"
examples --pyargs stereodel -k "not to_polydata" # of docstrings, as it has no tests; that one needs the extra vtk, 580 MB
