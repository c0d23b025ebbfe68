#!/usr/bin/env bash
# Usage: tools/install.sh VENV WHAT [PYTHON]
# Create the environment, install the package with those pinned libraries that WHAT needs, and build its kernel, unless that
# was done already: VENV/installed-WHAT holds what it was done with. An environment grows with what is asked of it.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
venv=$1
what=$2
case $what in # extras of pyproject.toml
    kernel) extras= ;;             # NumPy alone, and what builds
    figures) extras=cli,render ;;  # pictures; the command with its doctor
    animations) extras=cli,film ;;
    library) extras=all ;;         # whatever the library can use
    test | docs | web | wheels) extras=$what ;;
    lint) extras=dev ;;
    *) die "there is no $what" ;;
esac
stamp=$venv/installed-$what
wanted=$(cat pyproject.toml constraints.txt tools/install.sh stereodel/web/script/package-lock.json | sha256sum)
if [[ ! -x $venv/bin/python || ! -f $stamp || $(<"$stamp") != "$wanted" ]]; then
    python=${3:-$(tools/find_python.sh)}
    # Also one that was cut off before pip was in it, or whose Python is gone.
    if ! "$venv/bin/python" -m pip --version >/dev/null 2>&1; then "$python" -m venv --clear "$venv"; fi
    echo "Installing what $what needs into $venv ($("$venv/bin/python" --version))" >&2
    site=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
    # Of a library whose installation was cut off, pip would take the halves for the whole: the list of its files comes last.
    for info in "$site"/*.dist-info; do
        [[ ! -d $info || -f $info/RECORD ]] || rm -rf "$info"
    done
    rm -rf "$site"/~*
    pip=("$venv/bin/python" -m pip --disable-pip-version-check -qq)
    build=(scikit-build-core nanobind)
    command -v cmake >/dev/null || build+=(cmake)
    command -v ninja >/dev/null || build+=(ninja)
    # The build backend is pinned as well: installed first, then used without an isolated build environment.
    "${pip[@]}" install --constraint constraints.txt "${build[@]}"
    # Requirements, metadata and the command alone. The package stays here, on a plain path, with no import hook that would
    # hide another copy from PYTHONPATH; its kernel is built beside it below, so that changed sources need no network.
    "${pip[@]}" install --constraint constraints.txt --no-build-isolation \
        --config-settings wheel.cmake=false --config-settings wheel.packages='[]' --config-settings wheel.py-api=py3 \
        ".${extras:+[$extras]}"
    use "$venv"
    npm=(npm --ignore-scripts --no-audit --no-fund --silent)
    if [[ $what == test ]]; then
        "${npm[@]}" --prefix "$venv/gltf" install --no-package-lock --no-save gltf-validator@2.0.0-dev.3.10 ||
            die "npm cannot get the validator of glTF, which the tests of GLB files need"
    fi
    # What builds and checks the page's script, 55 MB: those of the lock file, to the hash.
    script=stereodel/web/script
    if [[ $what == @(test|lint|web|wheels) ]] && ! cmp -s $script/package-lock.json $script/node_modules/.installed; then
        "${npm[@]}" --prefix $script ci || die "npm cannot get what $script/package-lock.json names"
        cp $script/package-lock.json $script/node_modules/.installed
    fi
    pwd >"$site/stereodel.pth"
    printf '%s\n' "$wanted" >"$stamp"
fi
tools/build_kernel.sh "$venv"
touch "$stamp"
