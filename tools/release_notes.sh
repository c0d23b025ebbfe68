#!/usr/bin/env bash
# Usage: tools/release_notes.sh VERSION
# What the changelog says of a version, for its release page; fails if it says nothing.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
notes=$(awk -v head="## [$1]" 'index($0, "## [") == 1 { inside = index($0, head) == 1; next } inside' CHANGELOG.md)
[[ $notes == *[![:space:]]* ]] || die "CHANGELOG.md has nothing under the heading [$1]"
printf '%s\n' "$notes" | sed -e '/./,$!d'
