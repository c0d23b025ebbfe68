#!/usr/bin/env bash
# Usage: tools/emulated.sh WHEEL
# Try a wheel for another machine under emulation, with a root of Debian's packages of its C library, Python and what NumPy
# is linked with (by mmdebstrap, once), and NumPy for it from the package index. Says what is missing, if it cannot.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
wheel=$1
machine=$(sed -E 's/.*_([a-z]+[0-9]+(_64)?)\.whl$/\1/' <<<"$wheel")
emulator=$(command -v "qemu-$machine-static" || command -v "qemu-$machine" || true)
if [[ -z $emulator ]] || ! command -v mmdebstrap >/dev/null; then
    echo "not run: qemu-$machine or mmdebstrap is not here"
    exit
fi
build=$PWD/build/emulated/$machine
root=$build/root
site=$build/site
if [[ ! -e $root/usr/bin/python3 ]]; then
    rm -rf "$root"
    mkdir -p "$build"
    # A mirror may be older than the dates in it allow.
    quietly mmdebstrap --variant=extract --architectures="${machine/aarch64/arm64}" \
        --aptopt='Acquire::Check-Valid-Until "false"' --include=python3-minimal,libpython3-stdlib,libstdc++6 stable "$root"
fi
# Where the loader is looked for; distributions have this link in a package of their own.
[[ -e $root/lib ]] || ln -s usr/lib "$root/lib"
interpreter=$(compgen -G "$root/usr/bin/python3.[0-9][0-9]" | sort | tail -1)
version=${interpreter##*python}
rm -rf "$site"
quietly python -m pip --disable-pip-version-check -q install --target "$site" --only-binary :all: --no-compile \
    --platform "manylinux_2_28_$machine" --platform "manylinux_2_27_$machine" --platform "manylinux2014_$machine" \
    --python-version "$version" --implementation cp --abi "cp${version/./}" --abi abi3 --constraint constraints.txt numpy
quietly python -m zipfile -e "$wheel" "$site"
PYTHONHOME=$root/usr PYTHONPATH=$site PYTHONDONTWRITEBYTECODE=1 \
    "$emulator" -L "$root" "$interpreter" -W error tools/try_kernel.py
