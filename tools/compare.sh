#!/bin/sh
# Sets cdcr beside other software, in an environment of its own, build/compare. cdcr, which set-up
# has built, and what it needs are those of .venv; all others are pinned in
# bench/compare/requirements.txt. One that cannot be installed is named, and left out.
#
# Usage: tools/compare.sh [what bench/compare/run.py takes]
set -eu
cd "$(dirname "$0")/.."

venv=${VENV:-.venv}
own=build/compare
requirements=bench/compare/requirements.txt
stamp=$own/.installed

[ -x "$own/bin/python" ] || "$venv/bin/python" -m venv "$own"
if [ ! "$stamp" -nt "$requirements" ]; then
  echo "installing what cdcr is set beside into $own: 1.5 GB"
  for package in $(grep -v '^#' "$requirements"); do
    "$own/bin/python" -m pip install --quiet --disable-pip-version-check -c "$requirements" \
      "$package" </dev/null || echo "could not be installed, and is left out: $package"
  done
  # After its own packages in the order of search.
  purelib='import sysconfig; print(sysconfig.get_path("purelib"))'
  "$venv/bin/python" -c "$purelib" >"$("$own/bin/python" -c "$purelib")/cdcr.pth"
  touch "$stamp"
fi
PYTHONPATH=bench exec "$own/bin/python" bench/compare/run.py "$@"
