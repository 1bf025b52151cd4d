#!/bin/sh
# Builds and tests cdcr in the ways that CI has no time for, each in build/NAME: make builds.
# clang: another compiler. avx2: another instruction set, C++ and Python. shared: a shared library
# whose symbols are hidden but for what cdcr/export.hpp exports, with a program against it.
# no_cvode: without SUNDIALS, C++ and Python. Names as arguments run those alone.
set -eu
cd "$(dirname "$0")/.."

configure_and_test() {
  tree=build/$1
  shift
  cmake --preset release -B "$tree" "$@"
  cmake --build "$tree"
  ctest --test-dir "$tree" --output-on-failure -j 2
}

# The Python tests on a package of that build, which is installed in place of the usual one.
test_python() {
  python -m pip wheel -q --no-deps --no-index --no-build-isolation -w "$tree/wheel" \
    -C build-dir="$tree" -C build.targets="_core;cdcr_fmu" -C cmake.define.CDCR_BUILD_TESTS=ON .
  rm -f .venv/.cdcr-installed # so that the next make installs the usual one again
  python -m pip install -q --no-deps --no-index --force-reinstall "$tree"/wheel/cdcr-*.whl
  tools/test.sh python
}

# Every function of the interface is in the hidden build's table of symbols.
check_exports() {
  find "$tree/cpp/CMakeFiles/cdcr.dir" -name '*.o' -exec nm -C --defined-only {} + |
    sed -n 's/^[0-9a-f]* T \(cdcr::.*\)/\1/p' | grep -v '^cdcr::detail::' | sort -u >"$tree/defined.txt"
  nm -DC --defined-only "$tree/cpp/libcdcr.so" |
    sed -n 's/^[0-9a-f]* [TW] \(cdcr::.*\)/\1/p' | sort -u >"$tree/exported.txt"
  hidden=$(comm -23 "$tree/defined.txt" "$tree/exported.txt")
  [ -z "$hidden" ] || {
    printf 'not exported by a shared library:\n%s\n' "$hidden" >&2
    exit 1
  }
}

build_clang() { configure_and_test clang -DCMAKE_CXX_COMPILER=clang++; }
build_avx2() {
  configure_and_test avx2 -DCMAKE_CXX_FLAGS=-march=x86-64-v3
  test_python
}
build_shared() {
  configure_and_test shared -DBUILD_SHARED_LIBS=ON
  cmake -B build/shared -DCDCR_BUILD_TESTS=OFF -DCMAKE_CXX_FLAGS=-fvisibility=hidden
  cmake --build build/shared
  check_exports
  cmake --install build/shared --prefix build/shared/prefix
  cmake -S tests/consumer/core -B build/shared/program -DCMAKE_PREFIX_PATH="$PWD/build/shared/prefix"
  cmake --build build/shared/program
  build/shared/program/consumer
}
build_no_cvode() {
  configure_and_test no_cvode -DCDCR_WITH_CVODE=OFF
  test_python
}

[ $# -gt 0 ] || set -- clang avx2 shared no_cvode
for name in "$@"; do
  echo "== $name"
  "build_$name"
done
