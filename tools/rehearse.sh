#!/usr/bin/env bash
# Usage: tools/rehearse.sh VENV
# A release as if it were published, on this machine: source archive, wheels and npm archive are made and checked; each wheel
# is tried in a bare root; a local index of Python and a local registry of npm take the upload, and what is installed from
# them makes the README's pictures, tables and page; each interpreter builds the source archive. Ends with a table of what
# was tried. Files that exist already are taken as they are with REHEARSE_DIST=folder.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
unset PYTHONPATH
shopt -s nullglob
build=$PWD/build/rehearsal
rm -rf "$build"
mkdir -p "$build"/{packages,user,sources,npm}
servers=$build/servers
exec 3>&2

# Parts run beside each other, each a function with a log; the first that fails ends the rehearsal.
set -m # each in a process group of its own, which ends as a whole
declare -A parts=()
trap 'for each in $(jobs -p); do kill -- "-$each" 2>/dev/null || true; done' EXIT
begin() { "$@" >"$build/$1.log" 2>&1 & parts[$!]=$1; }
finish() { # all that was begun
    local ended log
    while ((${#parts[@]})); do
        wait -n -p ended "${!parts[@]}" || { log=$build/${parts[$ended]}.log; cat "$log" >&2; die "${parts[$ended]}: $(tail -1 "$log")"; }
        echo "$SECONDS s: ${parts[$ended]} done" >&2
        unset "parts[$ended]"
    done
}
told() { printf '%-52s %s\n' "$1" "$2" | tee -a "$build/table" >&3; } # WHAT HOW
free_port() { python -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
wait_for() { # ADDRESS: until a server answers
    for _ in {1..120}; do
        if python -c 'import sys, urllib.request; urllib.request.urlopen(sys.argv[1], timeout=5)' "$1" 2>/dev/null; then return; fi
        sleep 0.5
    done
    cat "$servers"/*.log >&2
    die "no server answers at $1"
}

version=$(sed -nE 's/^__version__ = "(.+)"$/\1/p' stereodel/__init__.py)
tag=$(git tag --points-at HEAD 'v*')
[[ -z $tag || $tag == "v$version" ]] || die "the tag is $tag, but the version of stereodel/__init__.py is $version"
for file in CITATION.cff conda/recipe.yaml stereodel/web/script/package.json; do
    grep -qE "version\"?: \"?$version\"?,?$" "$file" || die "the version of $file is not $version, that of stereodel/__init__.py"
done
if [[ -z $tag ]] && ! grep -qF "## [$version]" CHANGELOG.md; then notes=Unreleased; else notes=$version; fi
tools/release_notes.sh "$notes" >/dev/null

archives() {
    tools/wheels.sh "$venv" x86_64 aarch64
    tools/npm_archive.sh "$venv" dist
}
programs() { # of the servers: what is fetched, while others compile
    python -m venv "$servers"
    "$servers/bin/python" -m pip -q install pypiserver py-rattler-build
    # Some mirrors know versions and no tags, and one of its libraries asks for a tag.
    echo '{ "overrides": { "node-fetch": "2.7.0" } }' >"$build/npm/package.json"
    npm --prefix "$build/npm" install --silent --no-audit --no-fund verdaccio
}
begin programs
dist=$PWD/dist
if [[ -n ${REHEARSE_DIST:-} ]]; then dist=$(cd "$REHEARSE_DIST" && pwd); else begin archives; fi
finish

source_archive=$(echo "$dist"/*.tar.gz)
npm_archive=$(echo "$dist"/*.tgz)
wheels=("$dist"/*.whl)
for archive in "$source_archive" "$npm_archive" "${wheels[@]}"; do
    [[ ${archive##*/} == stereodel-"$version"[-.]* ]] || die "${archive##*/} is not of version $version"
done
python tools/archives.py "$source_archive" "${wheels[@]}" || die "the archives do not hold what they must"

roots() {
    local wheel tag versions each interpreter log said
    for wheel in "$dist"/*x86_64.whl; do
        tag=$(sed -E 's/.*-cp([0-9]+)-(abi3|cp[0-9]+t?)-.*/\1 \2/' <<<"$wheel")
        case $tag in
            *abi3) versions=(3.12 3.13 3.14 3.15) ;;
            *t) versions=("3.${tag:1:2}t") ;;
            *) versions=("3.${tag:1:2}") ;;
        esac
        for each in "${versions[@]}"; do
            if ! interpreter=$(tools/find_python.sh "$each"); then
                told "${wheel##*/}" "not run: Python $each is not here"
                continue
            fi
            log=$build/bare-$each.log
            tools/bare.sh "$interpreter" "$dist" >"$log" 2>&1 || { cat "$log"; die "${wheel##*/} fails in a bare root of Python $each"; }
            told "${wheel##*/}" "run: Python $each alone, $(grep -oE '[0-9]+ passed' "$log")"
        done
    done
    for wheel in "$dist"/*aarch64.whl; do
        said=$(tools/emulated.sh "$wheel")
        told "${wheel##*/}" "built; ${said##*$'\n'}"
    done
}
index() {
    twine upload --non-interactive --repository-url "http://127.0.0.1:$1/" -u - -p - "$source_archive" "${wheels[@]}"
    tools/try_wheel.sh "$(tools/find_python.sh 3.12 || tools/find_python.sh)" "http://127.0.0.1:$1/simple/"
    told "pip install from a local index" "run: commands, pictures and page of the README"
}
registry() {
    printf '//127.0.0.1:%s/:_authToken=nobody\nregistry=http://127.0.0.1:%s/\n' "$1" "$1" >"$build/user/.npmrc"
    cd "$build/user"
    npm publish --silent "$npm_archive"
    npm install --silent --no-audit --no-fund stereodel
    awk '/^```js/ { inside = 1; next } /^```/ { if (inside) exit } inside' node_modules/stereodel/README.md >first.mjs
    [[ -s first.mjs ]] || die "the README of the npm package has no lines of JavaScript"
    node first.mjs
    told "npm install from a local registry" "run: the README's first lines"
}
sources() {
    local each interpreter
    tar -xzmf "$source_archive" -C "$build/sources" --strip-components=1
    for each in 3.11 3.12 3.13 3.14 3.15 3.13t 3.14t 3.15t; do
        if ! interpreter=$(tools/find_python.sh "$each"); then continue; fi
        "$interpreter" -m venv "$build/source-$each"
        # The kernel proper is compiled once for all, as in tools/wheels.sh.
        rm -f "$build"/compiled/{CMakeCache.txt,.skbuild-info.json}
        "$build/source-$each/bin/python" -m pip -q install --constraint constraints.txt -Cbuild-dir="$build/compiled" "$build/sources"
        "$build/source-$each/bin/python" -W error tools/try_kernel.py
        told "the source archive on Python $each" "run: built by the machine's compiler, stored answers"
    done
}
recipe() {
    if command -v rattler-build >/dev/null; then
        rattler-build build --recipe conda/recipe.yaml --output-dir "$build/conda"
        told "the recipe of conda" "built"
    else
        "$servers/bin/python" -c 'from rattler_build import Stage0Recipe, VariantConfig
assert Stage0Recipe.from_file("conda/recipe.yaml").render(VariantConfig({"c_stdlib": ["sysroot"]}))'
        told "the recipe of conda" "rendered, not built: that needs a channel of conda"
    fi
}
of_python=$(free_port)
"$servers/bin/pypi-server" run -i 127.0.0.1 -p "$of_python" -P . -a . --disable-fallback "$build/packages" >"$servers/index.log" 2>&1 &
of_npm=$(free_port)
cat >"$build/npm/verdaccio.yaml" <<YAML
storage: ./storage
packages: { "**": { access: \$all, publish: \$all } }
log: { type: stdout, level: warn }
YAML
"$build/npm/node_modules/.bin/verdaccio" --config "$build/npm/verdaccio.yaml" --listen "127.0.0.1:$of_npm" >"$servers/npm.log" 2>&1 &
wait_for "http://127.0.0.1:$of_python/simple/"
wait_for "http://127.0.0.1:$of_npm/-/ping"
users() { index "$of_python"; registry "$of_npm"; }
machines() { recipe; sources; }
begin roots
begin users
begin machines
finish
told "musl, macOS, Windows: wheels" "in the workflow only; make cross compiles and links the kernel"
told "Pyodide: wheel" "in the workflow only"
printf '\n%s: rehearsed in %s minutes\n' "$version" "$((SECONDS / 60 + 1))"
sort "$build/table"
