#!/usr/bin/env bash
# Usage: tools/system_packages.sh WHAT…
# The one way to packages of the system. What is missing is named, Debian's packages are installed one by one where that is
# allowed, and what is missing then is said in one line. WHAT is any of
#   compiler  C++17 with the headers of `python`: nothing works without it, so that its lack is an error
#   opengl    libraries that draw without a display: plane figures and all computations work without them
#   browser   Chromium, for the tests and pictures of the interactive page
#   librsvg   rsvg-convert, for the tests of SVG files
#   inkscape  opens, changes and saves them in tests of the thorough tier (135 MB)
#   emulator  of aarch64, and what unpacks a system for it, for `make rehearse`
#   cgal      CGAL's headers, for the benchmarks; gmt for them, too
set -euo pipefail

# Debian's packages of $1 that are missing here, a line each.
missing() {
    local libraries
    case $1 in
        compiler)
            # A Python that was not installed by Debian has its headers with it.
            compiles || { echo g++; python -c 'import sys
if sys.base_prefix == "/usr": print("python%d.%d-dev" % sys.version_info[:2])'; } ;;
        opengl)
            libraries=$(PATH=$PATH:/sbin:/usr/sbin ldconfig -p 2>/dev/null || true)
            [[ $libraries == *libOSMesa.so.* ]] || echo libosmesa6
            [[ $libraries == *libEGL.so.1* ]] || echo libegl1
            [[ $libraries == *libEGL_mesa.so.0* ]] || echo libegl-mesa0
            [[ $libraries == *libGL.so.1* ]] || echo libgl1
            compgen -G '/usr/lib*/dri/*swrast_dri.so' >/dev/null || compgen -G '/usr/lib/*/dri/*swrast_dri.so' >/dev/null ||
                echo libgl1-mesa-dri ;;
        browser) # by the names that tools/browser.py knows
            command -v chromium chromium-browser google-chrome-stable google-chrome >/dev/null || echo chromium ;;
        librsvg) command -v rsvg-convert >/dev/null || echo librsvg2-bin ;;
        inkscape) command -v inkscape >/dev/null || echo inkscape ;;
        emulator)
            command -v qemu-aarch64-static qemu-aarch64 >/dev/null || echo qemu-user-static
            command -v mmdebstrap >/dev/null || echo mmdebstrap ;;
        gmt) command -v gmt >/dev/null || echo gmt ;;
        cgal) [[ -f /usr/include/CGAL/version.h ]] || echo libcgal-dev ;;
        *) echo "tools/system_packages.sh: there is no $1" >&2; exit 2 ;;
    esac
}

compiles() { # a program of C++17, with Python's header
    local include
    include=$(python -c 'import sysconfig; print(sysconfig.get_path("include"))')
    printf '#include <Python.h>\n#include <optional>\nstd::optional<int> one = 1;\n' |
        "${CXX:-c++}" -std=c++17 -I"$include" -x c++ -fsyntax-only - >/dev/null 2>&1
}

all_missing() { for what in "$@"; do missing "$what" || exit; done; }

if ((EUID == 0)); then root=(env); elif sudo -n true 2>/dev/null; then root=(sudo -n env); else root=(); fi

install() { # one package; a fresh image has no package lists, and an old list may name versions that are gone
    local line=("${root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o Dpkg::Use-Pty=0 install --no-install-recommends "$1")
    echo "Installing $1" >&2
    "${line[@]}" >/dev/null 2>&1 && return
    [[ -n ${updated:-} ]] || "${root[@]}" apt-get -qq update >/dev/null 2>&1 || true
    updated=yes
    "${line[@]}" >/dev/null 2>&1 || true
}

packages=$(all_missing "$@")
if [[ -z $packages ]]; then exit; fi
if [[ ${#root[@]} -gt 0 ]] && command -v apt-get >/dev/null; then
    while read -r package; do install "$package" </dev/null; done <<<"$packages"
    packages=$(all_missing "$@")
fi
if [[ -n $packages ]]; then
    echo "Missing packages of the system; on Debian: apt-get install ${packages//$'\n'/ }" >&2
fi
if [[ " $* " == *" compiler "* && -n $(missing compiler) ]]; then
    echo "stereodel's kernel needs a C++17 compiler and Python's headers" >&2
    exit 1
fi
