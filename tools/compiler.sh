#!/usr/bin/env bash
# Usage: tools/compiler.sh PYTHON
# A C++17 compiler and the headers of PYTHON: install Debian's where that is allowed, otherwise say what to install.
set -euo pipefail

python=$1
compiles() { # a program of C++17, with Python's header
    local include
    include=$("$python" -c 'import sysconfig; print(sysconfig.get_path("include"))')
    printf '#include <Python.h>\n#include <optional>\nstd::optional<int> one = 1;\n' |
        "${CXX:-c++}" -std=c++17 -I"$include" -x c++ -fsyntax-only - >/dev/null 2>&1
}
if compiles; then exit 0; fi

packages=(g++)
# A Python that was not installed by Debian has its headers with it.
if [[ $("$python" -c 'import sys; print(sys.base_prefix)') == /usr ]]; then
    packages+=("$("$python" -c 'import sys; print("python%d.%d-dev" % sys.version_info[:2])')")
fi
say="stereodel's kernel needs a C++17 compiler and Python's headers. On Debian: apt-get install ${packages[*]}"
if ! command -v apt-get >/dev/null; then
    echo "$say" >&2
    exit 1
fi
if ((EUID == 0)); then run=(env); elif sudo -n true 2>/dev/null; then run=(sudo -n env); else
    echo "$say" >&2
    exit 1
fi
echo "Installing ${packages[*]}" >&2
install=("${run[@]}" DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o Dpkg::Use-Pty=0 install --no-install-recommends "${packages[@]}")
"${install[@]}" >/dev/null 2>&1 || { "${run[@]}" apt-get -qq update && "${install[@]}" >/dev/null; } || true
compiles || { echo "$say" >&2; exit 1; }
