#!/usr/bin/env bash
# Usage: tools/wheels.sh VENV [MACHINE…]
# The source archive and wheels for Linux into dist/, compiled by zig for glibc 2.17 (manylinux2014): for each MACHINE,
# x86_64 and aarch64 unless others are named, one for Python 3.12 and all later ones; for x86_64 besides one for 3.11 and
# one for each Python without the interpreter's lock that is found. Their names, interfaces and texts are checked, and
# each Python found tries its wheel (tools/try_kernel.py), one of them with the oldest NumPy allowed
# besides. Says what could not be tried.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
use_zig
source_date
machines=("${@:2}")
if [[ ${#machines[@]} == 0 ]]; then machines=(x86_64 aarch64); fi
with_lock=(3.12 3.13 3.14 3.15)
without_lock=(3.13t 3.14t 3.15t)
oldest_numpy=$(sed -nE 's/^dependencies = \["numpy>=([0-9.]+)"\]$/\1/p' pyproject.toml)
build=$PWD/build/wheels
mkdir -p "$build"
said=()

rm -rf dist "$build/source" "$build/raw"
archive=$(tools/source_archive.sh "$venv" dist)
python tools/archives.py "$archive" # before minutes of compiling
mkdir -p "$build/source"
tar -xzmf "$archive" -C "$build/source" --strip-components=1 # with times of today: what is compiled is never older

environment() { # VERSION NAME: a new environment of that Python, or nothing
    local python
    python=$(tools/find_python.sh "$1") || return 1
    "$python" -m venv --clear "$build/$2"
}
install() { "$1/bin/python" -m pip --disable-pip-version-check -q install --constraint constraints.txt "${@:2}"; }

make_wheel() { # VERSION MACHINE
    echo "Building for Python $1 on $2" >&2
    local tools=$build/build-$1
    if [[ ! -f $tools/done ]]; then
        environment "$1" "build-$1"
        quietly install "$tools" scikit-build-core nanobind
        touch "$tools/done"
    fi
    local defines=()
    while read -r define; do defines+=("-Ccmake.define.$define"); done < <(zig_cmake "$2-linux-gnu.2.17")
    # One folder a machine, so that the kernel proper is compiled once for all Pythons. Paths of the last one must go, and
    # the backend's note of them, for whose sake it would remove what was compiled.
    rm -f "$build/cmake-$2"/{CMakeCache.txt,.skbuild-info.json}
    # The name of the wheel takes the machine from this variable, which stands for the one that CPython sees.
    quietly env PATH="$tools/bin:$PATH" _PYTHON_HOST_PLATFORM="linux-$2" python -m pip --disable-pip-version-check wheel \
        --no-deps --no-build-isolation --wheel-dir "$build/raw/$2" -Cbuild-dir="$build/cmake-$2" "${defines[@]}" "$build/source"
}

for machine in "${machines[@]}"; do
    for version in "${with_lock[@]}" none; do
        if [[ $version == none ]]; then die "no Python of ${with_lock[*]} is here"; fi
        if tools/find_python.sh "$version" >/dev/null; then break; fi
    done
    make_wheel "$version" "$machine"
    if [[ $machine == x86_64 ]]; then
        for version in 3.11 "${without_lock[@]}"; do
            if tools/find_python.sh "$version" >/dev/null; then make_wheel "$version" "$machine"; fi
        done
    fi
    for raw in "$build/raw/$machine"/*.whl; do
        quietly auditwheel repair --plat auto --wheel-dir dist "$raw" # checked below: it knows the names of other machines by itself
    done
done

echo "Checking" >&2
quietly tools/check_archives.sh "$venv"
for wheel in dist/*.whl; do
    [[ $wheel == *-manylinux* ]] || die "$wheel is not for manylinux"
done
python tools/archives.py "$archive" dist/*.whl

if [[ " ${machines[*]} " == *" $(uname -m) "* ]]; then
    tried=0
    for version in 3.11 "${with_lock[@]}" "${without_lock[@]}"; do
        if ! environment "$version" "try-$version" 2>/dev/null; then
            said+=("Python $version: not found here, not tried")
            continue
        fi
        # As an index does: the wheel that fits this Python is chosen by its name.
        quietly install "$build/try-$version" --only-binary :all: numpy
        quietly install "$build/try-$version" --no-index --no-deps --find-links dist stereodel
        "$build/try-$version/bin/python" -W error tools/try_kernel.py
        if [[ $version == 3.12 ]]; then # the last for which there are wheels of that NumPy
            quietly "$build/try-$version/bin/python" -m pip -q install --only-binary :all: "numpy==$oldest_numpy"
            "$build/try-$version/bin/python" -W error tools/try_kernel.py
        fi
        [[ $version == 3.11 ]] || tried=$((tried + 1))
    done
    if ((tried < 2)); then said+=("the wheel of Python 3.12 was tried on fewer than two"); fi
fi
for machine in "${machines[@]}"; do
    [[ $machine == "$(uname -m)" ]] || said+=("$machine: compiled and checked, not run; tools/emulated.sh tries such a wheel")
done
if [[ ${#said[@]} -gt 0 ]]; then printf '%s\n' "${said[@]}"; fi
