#!/usr/bin/env bash
# Usage: tools/rehearse.sh VENV
# A release as if it were published, on this machine: source archive, wheels and npm archive are made and checked; each wheel
# is tried in a bare root; a local index of Python and a local registry of npm take the upload, and what is installed from
# them makes the README's pictures, tables and page; each interpreter builds the source archive. Ends with a table of what
# was tried. Files that exist already are taken as they are with REHEARSE_DIST=folder.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
shopt -s nullglob
build=$PWD/build/rehearsal
rm -rf "$build"
mkdir -p "$build"
servers=()
trap 'kill "${servers[@]}" 2>/dev/null || true' EXIT
table=()
told() { # WHAT HOW
    table+=("$(printf '%-52s %s' "$1" "$2")")
    echo "$1: $2" >&2
}
free_port() { python -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
wait_for() { # ADDRESS: until a server answers
    for _ in {1..120}; do
        if python -c 'import sys, urllib.request; urllib.request.urlopen(sys.argv[1], timeout=5)' "$1" 2>/dev/null; then return; fi
        sleep 0.5
    done
    cat "$build"/*.log >&2
    die "no server answers at $1"
}

if [[ -n ${REHEARSE_DIST:-} ]]; then
    dist=$(cd "$REHEARSE_DIST" && pwd)
else
    dist=$PWD/dist
    tools/wheels.sh "$venv" x86_64 aarch64
    tools/npm_archive.sh "$venv" dist
fi
source_archive=("$dist"/*.tar.gz)
npm_archive=("$dist"/*.tgz)
version=$(sed -nE 's/^__version__ = "(.+)"$/\1/p' stereodel/__init__.py)
for archive in "${source_archive[0]}" "$dist"/*.whl "${npm_archive[0]}"; do
    [[ ${archive##*/} == stereodel-"$version"[-.]* ]] || die "${archive##*/} is not of version $version"
done
tools/release_notes.sh Unreleased >/dev/null

echo "Bare roots" >&2
for wheel in "$dist"/*x86_64.whl; do
    tag=$(sed -E 's/.*-cp([0-9]+)-(abi3|cp[0-9]+t?)-.*/\1 \2/' <<<"$wheel")
    case $tag in
        *abi3) versions=(3.12 3.13 3.14 3.15) ;;
        *t) versions=("3.${tag:1:2}t") ;;
        *) versions=("3.${tag:1:2}") ;;
    esac
    for each in "${versions[@]}"; do
        if interpreter=$(tools/find_python.sh "$each"); then
            tools/bare.sh "$interpreter" "$dist" >"$build/bare-$each.log" 2>&1 || { cat "$build/bare-$each.log" >&2; die "${wheel##*/} fails in a bare root of Python $each"; }
            told "${wheel##*/}" "run: Python $each alone, $(grep -oE '[0-9]+ passed' "$build/bare-$each.log")"
        else
            told "${wheel##*/}" "Python $each is not here"
        fi
    done
done
for wheel in "$dist"/*aarch64.whl; do
    if [[ -n ${AARCH64_ROOT:-} ]]; then
        tools/emulated.sh "$AARCH64_ROOT" "$wheel" >&2 && told "${wheel##*/}" "run: stored answers, under an emulator"
    else
        told "${wheel##*/}" "built: no root of that machine (AARCH64_ROOT)"
    fi
done

echo "An index of Python" >&2
python -m venv "$build/index"
quietly "$build/index/bin/python" -m pip -q install pypiserver twine
port=$(free_port)
mkdir "$build/packages"
"$build/index/bin/pypi-server" run -i 127.0.0.1 -p "$port" -P . -a . --disable-fallback "$build/packages" >"$build/index.log" 2>&1 &
servers+=($!)
wait_for "http://127.0.0.1:$port/simple/"
quietly "$build/index/bin/twine" upload --non-interactive --repository-url "http://127.0.0.1:$port/" -u - -p - "${source_archive[0]}" "$dist"/*.whl
tools/try_wheel.sh "$(tools/find_python.sh 3.12 || tools/find_python.sh)" "http://127.0.0.1:$port/simple/" >&2
told "pip install from a local index" "run: commands, pictures and page of the README"

echo "A registry of npm" >&2
port=$(free_port)
npm --prefix "$build/npm" install --silent --no-audit --no-fund verdaccio
cat >"$build/npm/verdaccio.yaml" <<YAML
storage: ./storage
packages: { "**": { access: \$all, publish: \$all } }
log: { type: stdout, level: warn }
YAML
"$build/npm/node_modules/.bin/verdaccio" --config "$build/npm/verdaccio.yaml" --listen "127.0.0.1:$port" >"$build/npm.log" 2>&1 &
servers+=($!)
wait_for "http://127.0.0.1:$port/-/ping"
mkdir "$build/user"
printf '//127.0.0.1:%s/:_authToken=nobody\nregistry=http://127.0.0.1:%s/\n' "$port" "$port" >"$build/user/.npmrc"
(
    cd "$build/user"
    npm publish --silent "${npm_archive[0]}"
    npm install --silent --no-audit --no-fund stereodel
    awk '/^```js/ { inside = 1; next } /^```/ { if (inside) exit } inside' node_modules/stereodel/README.md >first.mjs
    node first.mjs
)
told "npm install from a local registry" "run: the README's first lines"

echo "The source archive" >&2
for each in 3.11 3.12 3.13 3.14 3.15 3.14t 3.15t; do
    if interpreter=$(tools/find_python.sh "$each"); then
        "$interpreter" -m venv "$build/source-$each"
        quietly "$build/source-$each/bin/python" -m pip -q install --constraint constraints.txt "${source_archive[0]}"
        "$build/source-$each/bin/python" -W error tools/try_kernel.py >&2
        told "the source archive on Python $each" "run: built by the machine's compiler, stored answers"
    fi
done
if command -v rattler-build >/dev/null; then
    quietly rattler-build build --recipe conda/recipe.yaml --output-dir "$build/conda" && told "the recipe of conda" "built"
else
    told "the recipe of conda" "not tried: no rattler-build here"
fi
told "musl, macOS, Windows: the kernel" "compiled and linked by make cross"
told "musl, macOS, Windows, Pyodide: wheels" "in the workflow only"

printf '%s\n' "" "${table[@]}"
