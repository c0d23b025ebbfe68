#!/usr/bin/env bash
# Usage: benchmarks/run.sh PYTHON [options of `python -m benchmarks`]
# Install the peers where they are missing, then compare. PYTHON is one where stereodel and matplotlib are installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

benchmarks/install_peers.sh
exec "${1:?which python}" -m benchmarks "${@:2}"
