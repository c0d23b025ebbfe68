#!/usr/bin/env bash
# Usage: tools/make_archives.sh VENV FOLDER SOURCES
# Source archive, wheel and npm archive into FOLDER; the wheel is built from the source archive, unpacked into SOURCES, by
# the machine's own compiler.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$(cd "$1" && pwd)
folder=$2
sources=$3
source tools/source_date.sh
archive=$(tools/source_archive.sh "$venv" "$folder")
mkdir -p "$sources"
tar -xzf "$archive" -C "$sources" --strip-components=1
PATH=$venv/bin:$PATH python -m pip --disable-pip-version-check -qq wheel --no-deps --no-build-isolation --wheel-dir "$folder" "$sources"
tools/npm_archive.sh "$venv" "$folder"
