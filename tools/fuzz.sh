#!/bin/sh
# Fuzzes each target of tests/fuzz for so many seconds, then the readers: tools/fuzz.sh SECONDS.
# What is found stands in build/fuzz/found, and what covers more than the corpus, in
# build/fuzz/corpus. An input alone: build/fuzz/tests/fuzz/fuzz_NAME FILE.
set -eu
cd "$(dirname "$0")/.."
seconds=$1
mkdir -p build/fuzz/found
for name in robot run statics robot_file; do
  echo "== fuzz_$name"
  mkdir -p "build/fuzz/corpus/$name"
  longest=512
  if [ "$name" = robot_file ]; then longest=4096; fi
  "build/fuzz/tests/fuzz/fuzz_$name" -max_total_time="$seconds" -timeout=60 -max_len="$longest" \
    -print_final_stats=1 -artifact_prefix=build/fuzz/found/ -verbosity=0 \
    "build/fuzz/corpus/$name" tests/fuzz/corpus tests/data/robot_files
done
echo "== files"
CDCR_RANDOM_TESTS=$((1 + seconds / 10)) pytest -q tests/python/test_file_fuzz.py
