#!/bin/sh
# All tests, or a part of them: tools/test.sh [cpp|types|python]. Expects what make setup-dev brings.
set -eu
cd "$(dirname "$0")/.."

cpp() { cmake --preset release && cmake --build --preset release && ctest --preset release; }
types() {
  mypy && python tools/stubtest.py
}
python_tests() {
  pytest -n auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder \
    --doctest-modules --pyargs cdcr tests/python
}

case ${1:-all} in
  cpp) cpp ;;
  types) types ;;
  python) python_tests ;;
  all) # types take one processor, and so stand beside C++, but are told after it
    mkdir -p build
    types >build/types.log 2>&1 &
    beside=$!
    failed=""
    cpp || failed=yes
    wait "$beside" || failed=yes
    cat build/types.log
    [ -z "$failed" ]
    python_tests
    ;;
  *)
    echo "tools/test.sh: '$1' is no part of the tests; cpp, types and python are" >&2
    exit 2
    ;;
esac
