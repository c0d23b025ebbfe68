# Sourced by the scripts that run the tests on a kernel built in another way (sanitize.sh, coverage.sh), from the
# repository's root: `instrumented VENV BUILD FLAGS CMAKE-OPTION…` builds it, with compiler flags FLAGS, into a copy of the
# tracked files, and goes there. In every process that the tests start the copy comes before the installed package.
instrumented() {
    local flags=$3
    use "$1"
    build=$PWD/$2
    tree=$build/tree
    rm -rf "$tree"
    mkdir -p "$tree"
    git ls-files -z | xargs -0 tar c | tar x -C "$tree"
    # No -DNDEBUG: assertions count as well.
    compile_for_python -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="$flags" "${@:4}"
    quietly cmake --install "$build" --prefix "$tree"
    export PYTHONPATH=$tree
    cd "$tree"
}
