#!/usr/bin/env bash
# Usage: tools/documentation_versions.sh SITE
# Write the first page of a site that has a folder of documentation for each version: it leads to the newest one, or to
# "dev" where there is none, and lists all, each after what was tried before it. "stable" is another name of the newest, and
# versions.json is the list for the pages themselves, with the address of pyproject.toml or of the host.
set -euo pipefail
address=$(sed -nE 's|^Documentation = "(.*[^/])/*"$|\1|p' "$(dirname "${BASH_SOURCE[0]}")/../pyproject.toml")
cd "$1"
rm -f stable

# In the order of `sort -V` a tilde comes before all else: 1.0~rc1 before 1.0, ~dev before every version.
mapfile -t versions < <(for page in */index.html; do echo "${page%/*}"; done | sed 's/[a-z]/~&/' | sort -rV | tr -d '~')
[[ -f ${versions[0]}/index.html ]] || { echo "tools/documentation_versions.sh: no folder of $1 has documentation" >&2; exit 1; }
{
    printf '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n'
    printf '<meta http-equiv="refresh" content="0; url=%s/">\n' "${versions[0]}"
    printf '<title>stereodel: documentation</title>\n<h1>stereodel: documentation</h1>\n<ul>\n'
    for version in "${versions[@]}"; do printf '<li><a href="%s/">%s</a>\n' "$version" "$version"; done
    printf '</ul>\n</html>\n'
} >index.html
ln -s "${versions[0]}" stable
printf '%s\n' "${versions[@]}" | sed -e 's|.*|,{"version": "&", "url": "'"$address"'/&/"}|' -e '1s|,\(.*\)}$|[\1, "preferred": true}|' \
    -e '$s|$|]|' >versions.json
touch .nojekyll
