# Toolchain: the clang, the linker and the C++ library of zig, which come with the Python package `ziglang`. Set ZIG to
# its program and ZIG_TARGET to what it builds for: wasm32-wasi, or x86_64-linux-gnu.2.17, whose last part is the oldest
# C library that the result runs on.
string(REGEX MATCH "^([a-z0-9_]+)-([a-z]+)" ignored "${ZIG_TARGET}")
set(CMAKE_SYSTEM_PROCESSOR "${CMAKE_MATCH_1}")
set(zig_systems wasi WASI linux Linux macos Darwin windows Windows)
list(FIND zig_systems "${CMAKE_MATCH_2}" system)
math(EXPR system "${system} + 1")
list(GET zig_systems ${system} CMAKE_SYSTEM_NAME)
set(CMAKE_CXX_COMPILER "${ZIG}" c++)
set(CMAKE_CXX_COMPILER_TARGET "${ZIG_TARGET}")
set(CMAKE_CXX_ARCHIVE_CREATE "\"${ZIG}\" ar qc <TARGET> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_FINISH "\"${ZIG}\" ranlib <TARGET>")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ZIG ZIG_TARGET)
