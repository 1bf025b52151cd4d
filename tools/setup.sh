#!/bin/sh
# Brings a fresh machine to where cdcr runs: system packages, .venv, the package itself.
# Looks first and does only what is missing, so a second run takes a second or two.
#
# Usage: tools/setup.sh demo|dev|docs     dev adds what tests and linters need, docs what the
#                                         documentation site is built with
# Environment: PYTHON (python3), VENV (.venv), CVODE (ON; OFF does without SUNDIALS, and so without
# the methods bdf and adams: it saves some 300 Debian packages)
set -eu
cd "$(dirname "$0")/.."

goal=${1:-demo}
python=${PYTHON:-python3}
venv=${VENV:-.venv}
cvode=${CVODE:-ON}
log=build/setup.log
tree=build/release
case $goal in demo) steps=4 ;; *) steps=3 ;; esac

step() { echo "[$1/$steps] $2"; }
note() { echo "      $1"; }
die() {
  echo "cdcr set-up stopped: $1" >&2
  exit 1
}
quietly() { "$@" >>"$log" 2>&1 </dev/null; }

# Runs a command into the log and shows how far it is, in one place on a terminal, else in tenths:
# by ninja's "[12/53]", or by apt's three lines for each of so many packages.
followed() {
  what=$1
  packages_due=$2
  shift 2
  { code=0 && "$@" || code=$?; echo "$code" >build/status; } 2>&1 </dev/null | {
    done=0
    shown=""
    while IFS= read -r line; do
      printf '%s\n' "$line" >>"$log"
      case $line in
        *\[[0-9]*/[0-9]*\]*)
          done=${line#*\[}
          all=${done#*/}
          done=${done%%/*}
          all=${all%%\]*}
          ;;
        Get:* | Unpacking\ * | Setting\ up\ *)
          done=$((done + 1))
          all=$((3 * packages_due))
          ;;
        *) continue ;;
      esac
      case $done$all in *[!0-9]* | 0*) continue ;; esac
      percent=$((100 * done / all))
      if [ -t 1 ]; then
        printf '\r      %s: %3d %%' "$what" "$percent"
      elif [ "$((percent / 10))" != "$shown" ]; then
        shown=$((percent / 10))
        note "$what: $percent %"
      fi
    done
    if [ -t 1 ]; then echo; fi
  }
  return "$(cat build/status)"
}

{ mkdir -p build && : >"$log"; } 2>/dev/null ||
  die "$(pwd)/build cannot be written; work in a copy that belongs to you."

# 1. System packages ---------------------------------------------------------------------------

# True where one of the patterns exists under a prefix that CMake searches.
installed() {
  for prefix in $(echo "${CMAKE_PREFIX_PATH:-}" | tr ':;' '  ') /usr/local /usr; do
    for pattern in "$@"; do
      for file in "$prefix"/$pattern; do
        if [ -e "$file" ]; then return 0; fi
      done
    done
  done
  return 1
}

packages=""
need() {
  [ -n "$packages" ] || note "to be installed:"
  packages="$packages $1"
  printf '        %-18s %s\n' "$1" "$2"
}

check_python() {
  oldest=10
  [ "$goal" != docs ] || oldest=11 # of Sphinx
  command -v "$python" >/dev/null || die "there is no $python here; cdcr needs Python 3.$oldest or \
newer: apt-get install python3 python3-venv, or name one with PYTHON=/path/to/python3."
  "$python" -c "import sys; sys.exit(sys.version_info < (3, $oldest))" ||
    die "cdcr's \"$goal\" needs Python 3.$oldest or newer, $python is $("$python" -V 2>&1); \
name another one with PYTHON=/path/to/python3."
}

# The Debian package with a part of this Python, such as python3.11-dev for "dev".
python_package() {
  "$python" -c 'import sys; sys.exit(sys.base_prefix != "/usr")' ||
    die "$python, which is not the system's own, was installed without its $2; \
add that, or name another one with PYTHON=/usr/bin/python3."
  "$python" -c "import sys; print('python%d.%d-$1' % sys.version_info[:2])"
}

find_missing_packages() {
  command -v "${CXX:-c++}" >/dev/null || need g++ "compiles the C++ core"
  installed share/eigen3/cmake/Eigen3Config.cmake 'lib*/cmake/eigen3/Eigen3Config.cmake' ||
    need libeigen3-dev "vectors and matrices of the C++ core"
  [ "$cvode" = OFF ] || installed include/cvodes/cvodes.h ||
    need libsundials-dev "CVODE, the default integrator; \"make CVODE=OFF ...\" does without"
  if ! "$python" -c 'import os, sys, sysconfig
sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))'; then
    package=$(python_package dev "header files (Python.h)")
    need "$package" "Python.h, to bind the core to Python"
  fi
  if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
    package=$(python_package venv "modules venv and ensurepip")
    need "$package" "makes $venv"
  fi
  [ "$goal" != dev ] || installed 'lib*/cmake/doctest/doctestConfig.cmake' ||
    need doctest-dev "runs the C++ tests"
  [ "$goal" != dev ] || installed include/toml++/toml.h ||
    need libtomlplusplus-dev "reads robot files in C++"
  [ "$goal" != docs ] || command -v doxygen >/dev/null ||
    need doxygen "reads the C++ headers for the reference"
}

install_packages() {
  command="apt-get install --no-install-recommends$packages"
  command -v apt-get >/dev/null ||
    die "this machine has no apt-get; install these by its own means:$packages."
  if [ "$(id -u)" -eq 0 ]; then
    sudo=""
  elif command -v sudo >/dev/null && quietly sudo true; then
    sudo=sudo
  else
    die "installing system packages takes root's rights; run as root: $command"
  fi
  note "by: ${sudo:+sudo }$command"
  # A package list that is missing or old is the usual cause of a first failure.
  try_install || { note "reading Debian's package lists" && quietly apt_get update && try_install; } ||
    die "apt-get could not install$packages; is the network up? Its own words are in $log."
}

# Says first how much it will be: these packages bring others.
try_install() {
  plan=$(apt_get install --assume-no --no-install-recommends $packages 2>>"$log" </dev/null || true)
  due=$(echo "$plan" | sed -n 's/^.* upgraded, \([0-9]*\) newly installed.*/\1/p')
  [ -n "$due" ] || return 1
  note "$due packages with what they need. $(echo "$plan" | grep '^Need to get\|^After' | tr '\n' ' ')"
  followed installing "$due" apt_get install -y --no-install-recommends $packages
}

apt_get() {
  $sudo env LC_ALL=C DEBIAN_FRONTEND=noninteractive NEEDRESTART_SUSPEND=1 \
    apt-get -o DPkg::Lock::Timeout=120 "$@"
}

step 1 "system packages"
check_python
find_missing_packages
[ -z "$packages" ] || install_packages

# 2. Python environment ------------------------------------------------------------------------

identity='import sys; print(sys.version, sys.base_prefix)'
# A .venv without pip, or of a Python that has gone or is not the one asked for, is made anew.
same_python() {
  [ -x "$venv/bin/python" ] && "$venv/bin/python" -c 'import pip' 2>/dev/null &&
    [ "$("$venv/bin/python" -c "$identity")" = "$("$python" -c "$identity")" ]
}

export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_RETRIES="${PIP_RETRIES:-2}"
pip() { "$venv/bin/python" -m pip "$@"; }
not_downloaded() {
  die "pip could not download the Python packages; is the network up? Its own words are in $log."
}

# Installs tools/lock/NAME.txt, which names all that is needed. Python compiles what it imports,
# which is a part of what they bring.
pip_install() {
  exec "$venv/bin/python" -m pip install --no-compile --no-deps --require-hashes \
    -r "tools/lock/$1.txt" </dev/null
}
# True where that file has changed since it was installed.
is_due() { [ ! "$venv/.cdcr-$1" -nt "tools/lock/$1.txt" ]; }

install_build_tools() {
  is_due build || return 0
  note "installing what builds cdcr: tools/lock/build.txt"
  (pip_install build) >>"$log" 2>&1 || not_downloaded
  touch "$venv/.cdcr-build"
}

# The other packages are installed beside each other, while cdcr is built, by processes that end
# with this one; their words are in the log when they are done.
case $goal in
  dev) others="demo test lint" ;;
  docs) others="demo docs" ;;
  *) others=demo ;;
esac
at_work=""
trap 'for one in $at_work; do kill "${one#*:}" 2>/dev/null || true; done' EXIT
trap 'exit 130' INT
trap 'exit 143' HUP TERM

start_others() {
  for name in $others; do
    is_due "$name" || continue
    note "installing beside that: tools/lock/$name.txt"
    pip_install "$name" >"build/pip-$name.log" 2>&1 &
    at_work="$at_work $name:$!"
  done
}
finish_others() {
  failed=""
  for one in $at_work; do
    name=${one%:*}
    if wait "${one#*:}"; then touch "$venv/.cdcr-$name"; else failed=yes; fi
    cat "build/pip-$name.log" >>"$log"
  done
  at_work=""
  [ -z "$failed" ] || not_downloaded
}

step 2 "Python environment $venv ($("$python" -V 2>&1))"
if ! same_python; then
  rm -rf "$venv"
  quietly "$python" -m venv "$venv" || die "$python could not make $venv; see $log."
fi
install_build_tools

# 3. cdcr ----------------------------------------------------------------------------------------

stamp=$venv/.cdcr-installed
up_to_date() {
  [ "$(cat "$stamp" 2>/dev/null)" = "$cvode" ] &&
    [ -z "$(find CMakeLists.txt LICENSE README.md pyproject.toml cmake cpp bindings licenses python \
      -newer "$stamp" ! -path '*/*.md' ! -path '*/__pycache__*' -print -quit)" ]
}

# The tree of preset release, so that nothing is compiled twice: the tests link the same library.
# It keeps the tests it has, and builds the extension and the FMU alone; a wheel of a developer's needs no more.
# The tools are already in .venv, so this needs no network: a failure is the build's own.
build_wheel() {
  tests=$(sed -n 's/^CDCR_BUILD_TESTS:BOOL=//p' "$tree/CMakeCache.txt" 2>/dev/null || true)
  failed_after=$(wc -l <"$log")
  followed building 0 pip wheel -v --no-deps --no-index --no-build-isolation -w build/wheel \
    -C build-dir="$tree" -C build.targets="_core;cdcr_fmu" -C cmake.define.CDCR_BUILD_TESTS="${tests:-OFF}" \
    -C cmake.define.CDCR_WITH_CVODE="$cvode" \
    -C cmake.define.CDCR_PRECOMPILE_HEADERS=ON -C cmake.define.CDCR_WARNINGS_AS_ERRORS="$1" .
}

# What the project's own compilers let pass may be a warning elsewhere: no reason to refuse a demo.
build_demo() {
  build_wheel ON || { grep -q '\[-Werror' "$log" && note "again, with warnings" && build_wheel OFF; }
}

build_failed() {
  tail -n "+$((failed_after + 1))" "$log" >build/failed.log
  grep -m 1 -A 5 -E 'error: |CMake Error' build/failed.log >&2 || tail -n 5 build/failed.log >&2
  die "cdcr could not be built; the whole log is $log."
}

step 3 "cdcr"
start_others
if up_to_date; then
  note "unchanged since it was installed"
  finish_others
else
  rm -rf "$stamp" build/wheel
  : >build/started
  case $goal in dev) build_wheel ON ;; *) build_demo ;; esac || build_failed
  finish_others
  quietly pip uninstall -y cdcr
  quietly pip install --no-deps --no-index build/wheel/cdcr-*.whl ||
    die "pip could not install cdcr; see $log."
  echo "$cvode" >"$stamp"
  touch -r build/started "$stamp"
fi
