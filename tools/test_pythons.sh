#!/usr/bin/env bash
# Usage: tools/test_pythons.sh VERSION…
# Run the tests under each Python version, in an environment of its own, and say plainly which ones are missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

find_version() { # the newest interpreter of version $1 that runs
    local candidate found=""
    for candidate in "$HOME"/.pyenv/versions/"$1".*/bin/python "python$1"; do
        if "$candidate" -c "import sys, venv; sys.exit('%d.%d' % sys.version_info[:2] != '$1')" >/dev/null 2>&1; then
            found=$candidate
        fi
    done
    printf '%s' "$found"
}

summary=()
failed=0
for version in "$@"; do
    python=$(find_version "$version")
    if [[ -z $python ]]; then
        summary+=("Python $version: not found here, not tested")
        continue
    fi
    tools/install.sh ".venvs/$version" test "$python"
    if ".venvs/$version/bin/python" -m pytest -n auto; then
        summary+=("$("$python" --version): tests passed")
    else
        summary+=("$("$python" --version): TESTS FAILED")
        failed=1
    fi
done
printf '%s\n' "${summary[@]}"
exit "$failed"
