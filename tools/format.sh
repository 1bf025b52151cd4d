#!/bin/sh
# Rewrites all sources in the project's style: make format.
set -eu
cd "$(dirname "$0")/.."
. tools/sources.sh

clang-format -i $(cpp_sources)
gersemi --in-place --quiet $(cmake_sources)
ruff check --fix --quiet
ruff format
