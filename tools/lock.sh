#!/bin/sh
# Writes tools/lock: what set-up installs from the package index, to the version and the hash, for
# every Python that cdcr takes. build.txt: what builds cdcr; demo.txt: what runs its commands, on top
# of that; test.txt, lint.txt and docs.txt: what comes on top for tests, for linters, for the site.
# After a change of versions in pyproject.toml, or to take newer ones: make lock.
set -eu
cd "$(dirname "$0")/.."

compile() {
  uv pip compile "$@" --quiet --universal --python-version 3.10 --generate-hashes --no-header \
    --no-annotate
}

# lock NAME "OTHERS" WHAT...: tools/lock/NAME.txt, less what is in those of OTHERS.
lock() {
  name=$1
  others=""
  for other in $2; do others="$others tools/lock/$other.txt"; done
  shift 2
  compile "$@" -c build/lock/versions.txt -o "build/lock/$name.txt"
  # A package begins a line, its hashes are indented.
  awk -v of="build/lock/$name.txt" \
    '/^[^ ]/ { is_new = FILENAME == of && !($0 in known); known[$0] } is_new' \
    $others "build/lock/$name.txt" >"tools/lock/$name.txt"
}

mkdir -p build/lock
compile pyproject.toml --all-extras --group dev --group docs --upgrade -o build/lock/all.txt
sed 's/ *\\$//; /^ /d' build/lock/all.txt >build/lock/versions.txt
lock build "" --group build
lock demo build pyproject.toml --extra plot --extra data --extra cli --extra track
lock test "build demo" pyproject.toml --all-extras --group test
lock lint "build demo test" --group lint
lock docs "build demo" pyproject.toml --all-extras --group docs
