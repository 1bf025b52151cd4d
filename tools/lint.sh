#!/bin/sh
# Every linter to its end, cheap ones first; fails when one of them complains.
# Expects the tools of pyproject.toml's group "lint" on PATH: make lint.
set -eu
cd "$(dirname "$0")/.."
. tools/sources.sh

failed=""
check() {
  name=$1
  shift
  echo "== $name"
  "$@" || failed="$failed $name"
}

# The library never prints.
silent_library() {
  ! grep -rnE '\b(std::(cout|cerr|clog)|f?printf|puts) *[(<]' cpp/include cpp/src
}

# One word for one thing: see cpp/README.md. Where a foreign format asks for another, the line says
# whose it is.
one_vocabulary() {
  ! grep -rniwE 'tendons?|wires?' cpp bindings python --include='*.[chp]pp' --include='*.py*' |
    grep -v "# MuJoCo's word$"
}

clang_tidy() {
  cmake --preset tidy -DPython_EXECUTABLE="$(command -v python)" \
    -Dpybind11_DIR="$(python -m pybind11 --cmakedir)" >build/tidy.log ||
    { cat build/tidy.log; return 1; }
  make --no-print-directory --keep-going --output-sync=target -j "$(nproc)" -f tools/tidy.mk
}

check ruff ruff check
check ruff-format ruff format --check
check codespell codespell
check words one_vocabulary
check silence silent_library
check gersemi gersemi --check --quiet $(cmake_sources)
check clang-format clang-format --dry-run -Werror $(cpp_sources)
check mypy mypy
check imports env PYTHONPATH=python lint-imports --no-cache
check clang-tidy clang_tidy

if [ -n "$failed" ]; then
  echo "lint: complaints from:$failed" >&2
  exit 1
fi
echo "lint: no complaints"
