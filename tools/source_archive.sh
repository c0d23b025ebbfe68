#!/usr/bin/env bash
# Usage: tools/source_archive.sh VENV FOLDER
# The source archive into FOLDER; its path is printed.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
mkdir -p "$2"
folder=$(cd "$2" && pwd)
source_date
name=$("$1/bin/python" -c 'import sys; from scikit_build_core.build import build_sdist; print(build_sdist(sys.argv[1]))' "$folder" | tail -1)
printf '%s\n' "$folder/$name"
