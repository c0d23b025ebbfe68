#!/usr/bin/env bash
# Usage: tools/source_archive.sh VENV FOLDER
# The source archive into FOLDER; its path is printed. Made twice: the same sources must give the same bytes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
again=$(mktemp -d)
trap 'rm -rf "$again"' EXIT
source tools/source_date.sh
archive() { "$venv/bin/python" -c 'import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])' "$1" >/dev/null; }
archive "$folder"
archive "$again"
for made in "$again"/*.tar.gz; do
    cmp "$made" "$folder/${made##*/}" >&2
    printf '%s\n' "$folder/${made##*/}"
done
