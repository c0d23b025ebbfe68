#!/usr/bin/env bash
# Usage: tools/build_kernel.sh VENV
# Build stereodel._kernel for the Python of VENV beside the sources of the package, unless that was done already; and
# stereodel._kernel_probe, through which the tests reach what the library itself does not call.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
tag=$(python -c 'import sys; print(sys.implementation.cache_tag)')
build=build/$tag
wanted=$(files_digest CMakeLists.txt tools/{build_kernel,shell}.sh constraints.txt stereodel/kernel tests/kernel/probe)
if [[ -f $build/installed && $(<"$build/installed") == "$wanted" ]] &&
    compgen -G "stereodel/_kernel.$tag*" >/dev/null && compgen -G "stereodel/_kernel_probe.$tag*" >/dev/null; then
    exit 0
fi
tools/system_packages.sh compiler
echo "Building the kernel for $tag" >&2
rm -f "$build/installed"
compile_for_python
# Moved into place whole: a running Python keeps the file that it opened.
quietly cmake --install "$build" --prefix "$build/stage"
mv -f "$build"/stage/stereodel/_kernel.* "$build"/stage/stereodel/_kernel_probe.* stereodel/
printf '%s\n' "$wanted" >"$build/installed"
