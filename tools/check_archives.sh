#!/usr/bin/env bash
# Usage: tools/check_archives.sh VENV
# Check what is in dist/ before an index gets it, with the tools of VENV: the texts of all archives; that each wheel is
# either for Python 3.12 and all later ones or for a Python that needs its own; and that the former use nothing but the
# stable interface. Of WebAssembly the last is not known: abi3audit reads no symbols of it.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
shopt -s nullglob
wheels=(dist/*.whl)
((${#wheels[@]} > 0)) || die "there is no wheel in dist/"
twine check --strict dist/*.tar.gz "${wheels[@]}"
for wheel in "${wheels[@]}"; do
    case $wheel in
        *-cp312-abi3-*wasm32.whl) ;;
        *-cp312-abi3-*) abi3audit --strict --report "$wheel" ;;
        *-cp311-cp311-* | *-cp3??-cp3??t-*) ;;
        *) die "$wheel is neither for Python 3.12 and all later ones nor for one that needs its own" ;;
    esac
done
