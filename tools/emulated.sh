#!/usr/bin/env bash
# Usage: tools/emulated.sh ROOT WHEEL
# Try a wheel for another machine under emulation. ROOT is a folder with that machine's C library and Python, as the
# packages of a distribution unpack there; NumPy for it comes from the package index. Without ROOT's machine in the
# emulator's list of this system, QEMU names the emulator, by a path.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
root=$(cd "$1" && pwd)
wheel=$2
machine=$(sed -E 's/.*_([a-z]+[0-9]+(_64)?)\.whl$/\1/' <<<"$wheel")
emulator=${QEMU:-$(command -v "qemu-$machine-static" || command -v "qemu-$machine" || true)}
[[ -n $emulator ]] || { echo "$machine: not run; qemu-$machine is not here (Debian: qemu-user-static)"; exit; }
interpreter=$(compgen -G "$root/usr/bin/python3.[0-9][0-9]" | sort | tail -1)
version=${interpreter##*python}
# Where the loader is looked for; distributions have this link in a package of their own.
[[ -e $root/lib ]] || ln -s usr/lib "$root/lib"
build=build/wheels
site=$build/$machine-$version
rm -rf "$site"
quietly python -m pip --disable-pip-version-check -q install --target "$site" --only-binary :all: --no-compile \
    --platform "manylinux_2_28_$machine" --platform "manylinux_2_27_$machine" --platform "manylinux2014_$machine" \
    --python-version "$version" --implementation cp --abi "cp${version/./}" --abi abi3 --constraint constraints.txt numpy
quietly python -m zipfile -e "$wheel" "$site"
PYTHONHOME=$root/usr PYTHONPATH=$PWD/$site PYTHONDONTWRITEBYTECODE=1 \
    "$emulator" -L "$root" "$interpreter" -W error tools/try_kernel.py
