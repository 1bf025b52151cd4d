#!/bin/sh
# Writes tools/lock: what set-up installs from the package index, to the version and the hash, for
# every Python that cdcr takes. demo.txt: what builds cdcr and runs its commands; dev.txt and
# docs.txt: what comes on top for tests and linters, and for the site.
# After a change of versions in pyproject.toml, or to take newer ones: make lock.
set -eu
cd "$(dirname "$0")/.."

compile() {
  uv pip compile pyproject.toml --quiet --universal --python-version 3.10 --generate-hashes \
    --no-header --no-annotate "$@"
}

mkdir -p build/lock
compile --all-extras --group dev --group docs --upgrade -o build/lock/all.txt
sed 's/ *\\$//; /^ /d' build/lock/all.txt >build/lock/versions.txt
compile --extra plot --extra data --extra cli --extra track --group build \
  -c build/lock/versions.txt -o tools/lock/demo.txt
for group in dev docs; do
  compile --all-extras --group build --group $group -c build/lock/versions.txt -o build/lock/$group.txt
  # A package begins a line, its hashes are indented.
  awk '/^[^ ]/ { is_new = FILENAME != ARGV[1] && !($0 in known); known[$0] } is_new' \
    tools/lock/demo.txt build/lock/$group.txt >tools/lock/$group.txt
done
