#!/usr/bin/env bash
# Install what the benchmarks compare with into benchmarks/.peers, once. What cannot be had is written to
# benchmarks/.peers/missing.txt with the reason, and the benchmarks go on without it.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

peers=.peers
wanted=$(cat install_peers.sh peers/*.cpp peers/*.hpp | sha256sum)
if [[ -f $peers/installed && $(<"$peers/installed") == "$wanted" ]]; then exit 0; fi
mkdir -p "$peers/bin" "$peers/node"
: >"$peers/missing.txt"

attempt() { # names (separated by commas), command...
    local names=$1 said name
    shift
    echo "  $names" >&2
    if said=$("$@" 2>&1); then return; fi
    said=$(grep -v '^\s*$' <<<"$said" | tail -n 1)
    for name in ${names//,/ }; do printf '%s\t%s\n' "$name" "${said:0:200}" >>"$peers/missing.txt"; done
}

compiled() { # program, source, options...
    local program=$1 source=$2
    shift 2
    g++ -std=c++17 -O3 -DNDEBUG -frounding-math "$@" "peers/$source" -o "$peers/bin/$program" -lgmp -lmpfr
}

cgal() {
    ../tools/system_packages.sh cgal
    [[ -f /usr/include/CGAL/version.h ]] || return 1
    compiled cgal_plane cgal_plane.cpp &&
        compiled cgal_sphere cgal_sphere.cpp &&
        compiled cgal_sphere_projecting cgal_sphere.cpp -DPROJECTING
}

python_with() { # environment, least minor version of Python 3, greatest, requirements...
    local environment=$peers/$1 least=$2 greatest=$3 minor python
    shift 3
    for ((minor = greatest; minor >= least; minor--)); do
        python=$(../tools/find_python.sh "3.$minor") || continue
        [[ -x $environment/bin/python ]] || "$python" -m venv "$environment" || return 1
        "$environment/bin/python" -m pip --disable-pip-version-check -qq install "$@"
        return
    done
    echo "no Python from 3.$least to 3.$greatest on this machine"
    return 1
}

node_packages() {
    command -v node >/dev/null && command -v npm >/dev/null || { echo "no node with npm on this machine"; return 1; }
    (cd "$peers/node" && npm install --silent --no-audit --no-fund --no-package-lock "$@")
}

echo "Installing the peers into benchmarks/$peers" >&2
attempt cgal cgal
attempt gmt ../tools/system_packages.sh gmt
attempt scipy,triangle python_with python 11 13 scipy==1.17.1 triangle==20250106
attempt triangular python_with python312 12 13 triangular==0.2.2 numpy
attempt cartopy python_with cartopy 11 13 cartopy==0.26.0 scipy==1.17.1
attempt stripy python_with python_numpy1 9 12 stripy==2.3.3 'numpy<2'
attempt delaunator,d3-geo-voronoi node_packages delaunator@5.1.0 d3-geo-voronoi@2.1.0
printf '%s\n' "$wanted" >"$peers/installed"
