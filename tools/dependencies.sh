#!/bin/sh
# Eigen and CVODES of SUNDIALS from source, for wheels built where Debian's packages are not: by
# cibuildwheel, see pyproject.toml. Usage: tools/dependencies.sh PREFIX
#
# Pinned by version and hash: a commit of SUNDIALS, an archive of Eigen, of which only headers go in.
# SUNDIALS checks its errors, which it does not in a release unless told: without them memory that
# runs out ends the process.
set -eu

sundials=v7.5.0
sundials_commit=c8dabcea90ca8bf195474da120e4f3dd39aa711f
eigen=3.4.0
eigen_sha256=8586084f71f9bde545ee7fa6d00288b264a2b7ac3607b974e54d13e7162c1c72

mkdir -p "$1"
prefix=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

git clone --quiet --depth 1 --branch $sundials https://github.com/LLNL/sundials.git 2>git.log ||
  { cat git.log >&2; exit 1; }
commit=$(git -C sundials rev-parse HEAD)
if [ "$commit" != $sundials_commit ]; then
  echo "SUNDIALS $sundials is commit $commit, not $sundials_commit as expected" >&2
  exit 1
fi
cmake -S sundials -B build -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF \
  -DBUILD_ARKODE=OFF -DBUILD_CVODE=OFF -DBUILD_IDA=OFF -DBUILD_IDAS=OFF -DBUILD_KINSOL=OFF \
  -DBUILD_CVODES=ON -DSUNDIALS_ENABLE_ERROR_CHECKS=ON -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_INSTALL=OFF
cmake --build build --parallel
cmake --install build

curl -fsSL -o eigen.tar.gz https://gitlab.com/libeigen/eigen/-/archive/$eigen/eigen-$eigen.tar.gz
if command -v sha256sum >/dev/null; then sum=sha256sum; else sum="shasum -a 256"; fi
echo "$eigen_sha256  eigen.tar.gz" | $sum -c -
tar -xzf eigen.tar.gz
cmake -S eigen-$eigen -B build-eigen -DCMAKE_INSTALL_PREFIX="$prefix" -DBUILD_TESTING=OFF \
  -DEIGEN_BUILD_DOC=OFF -DEIGEN_BUILD_PKGCONFIG=OFF
cmake --install build-eigen
