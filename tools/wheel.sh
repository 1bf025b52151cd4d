#!/bin/sh
# Builds the wheel in isolation, as a package index would, and puts the repaired one into dist/.
set -eu
cd "$(dirname "$0")/.."

python -m pip install --quiet --group package
rm -rf build/dist
python -m build --outdir build/dist .
auditwheel repair --wheel-dir dist build/dist/cdcr-*.whl
mv build/dist/cdcr-*.tar.gz dist
ls -l dist
