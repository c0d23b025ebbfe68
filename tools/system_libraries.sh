#!/usr/bin/env bash
# Offscreen OpenGL: install Debian's libraries where that is allowed, otherwise say what to install. Never fails:
# plane figures and all computations work without them.
set -euo pipefail

libraries=$(PATH=$PATH:/sbin:/usr/sbin ldconfig -p 2>/dev/null || true)
missing=()
want() { # package, soname
    [[ $libraries == *"$2"* ]] || missing+=("$1")
}
want libosmesa6 libOSMesa.so.
want libegl1 libEGL.so.1
want libegl-mesa0 libEGL_mesa.so.0
want libgl1 libGL.so.1
compgen -G '/usr/lib/*/dri/*swrast_dri.so' >/dev/null || compgen -G '/usr/lib*/dri/*swrast_dri.so' >/dev/null || missing+=(libgl1-mesa-dri)
if ((${#missing[@]} == 0)); then exit 0; fi

say="For offscreen rendering install: apt-get install ${missing[*]}"
if ! command -v apt-get >/dev/null; then
    echo "$say (or your system's packages of the same libraries)" >&2
    exit 0
fi
if ((EUID == 0)); then run=(env); elif sudo -n true 2>/dev/null; then run=(sudo -n env); else
    echo "$say" >&2
    exit 0
fi
echo "Installing ${missing[*]}" >&2
install=("${run[@]}" DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o Dpkg::Use-Pty=0 install --no-install-recommends "${missing[@]}")
# A fresh image has no package lists, and an old list may name versions that are gone: update and try once more.
"${install[@]}" >/dev/null 2>&1 || { "${run[@]}" apt-get -qq update && "${install[@]}" >/dev/null; } || echo "$say" >&2
