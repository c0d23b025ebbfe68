#!/usr/bin/env bash
# Usage: tools/one_definition.sh VENV
# Check that no two sources of the kernel and its bindings define one name differently: the linker would pick either.
# GCC compares all definitions when it optimises at link time. Only if a source has changed.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
if ! ${CXX:-c++} --version | grep -qiE 'gcc|g\+\+|free software foundation'; then
    echo "one definition a name: not checked, GCC alone compares them" >&2
    exit 0
fi
wanted=$(files_digest CMakeLists.txt tools/{one_definition,shell}.sh constraints.txt stereodel/kernel tests/kernel/probe)
build=build/link_time
done=$build/one_definition
if [[ -f $done && $(<"$done") == "$wanted" ]]; then exit; fi
compile_for_python -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -DSTEREODEL_ONE_DEFINITION=ON
echo "each name has one definition"
printf '%s\n' "$wanted" >"$done"
