#!/usr/bin/env bash
# Usage: tools/test_source.sh VENV [PYTEST ARGUMENT…]
# Run the tests as distributions do: from the unpacked source archive, which has neither a repository nor stored pictures,
# with the kernel that was built for VENV, and without Node and browsers.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
shift
tree=$PWD/build/source
rm -rf "$tree"
archive=$(tools/source_archive.sh "$venv" "$tree/archive")
tar -xzf "$archive" -C "$tree" --strip-components=1
cp stereodel/_kernel*.so "$tree/stereodel"
export PYTHONPATH=$tree # before the installed package, in every process that the tests start
export STEREODEL_TEST_WEB=off
cd "$tree"
python -P -c 'import os, stereodel; assert os.path.samefile(stereodel.__path__[0], "stereodel"), stereodel.__path__'
exec python -m pytest -p no:cacheprovider "$@"
