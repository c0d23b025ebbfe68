#!/usr/bin/env bash
# Usage: tools/dist_again.sh VENV
# Make the archives of dist/ once more, the wheel in another folder: the same sources must give the same bytes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

venv=$(cd "$1" && pwd)
again=$(mktemp -d)
trap 'rm -rf "$again"' EXIT
tools/make_archives.sh "$venv" "$again/archives" "$again/elsewhere/the-same"
for made in "$again/archives"/*; do
    cmp "$made" "dist/${made##*/}" || { echo "tools/dist_again.sh: ${made##*/} is not the same when it is made again" >&2; exit 1; }
done
