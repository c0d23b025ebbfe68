# Sourced by the scripts that make archives: the time that stands in them is that of the last commit, so that the same
# sources give the same bytes whenever they are built. In an unpacked source archive it is that of its settings.
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || stat -c %Y pyproject.toml)}
