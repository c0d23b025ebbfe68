# Toolchain: WebAssembly by the clang and the C++ library of zig, which come with the Python package `ziglang`. Set ZIG
# to its program.
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER "${ZIG}" c++)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ZIG)
