#!/usr/bin/env bash
# Usage: tools/test_pythons.sh VERSION…
# Run the tests under each Python version, in an environment of its own, and say plainly which ones are missing.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
summary=()
failed=0
for version in "$@"; do
    if ! python=$(tools/find_python.sh "$version"); then
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
