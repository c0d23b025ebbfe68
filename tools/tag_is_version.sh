#!/usr/bin/env bash
# Usage: tools/tag_is_version.sh TAG
# Whether a tag is that of the version in stereodel/__init__.py: an index keeps what it was once given for good.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

version=$(sed -nE 's/^__version__ = "(.+)"$/\1/p' stereodel/__init__.py)
[[ -n $version && $1 == "v$version" ]] || {
    echo "tools/tag_is_version.sh: the tag is $1, but stereodel/__init__.py has ${version:-no version}" >&2
    exit 1
}
