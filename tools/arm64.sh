#!/bin/sh
# The C++ tests built for 64-bit ARM and run under qemu-user, and exported C built for a Cortex-M7:
# make test-arm64. Without CVODE, which Debian's cross compilers have no package of.
#
# Usage: tools/arm64.sh [TARGET TEST]...   builds and runs these alone, such as cdcr_test_c c_interface
set -eu
cd "$(dirname "$0")/.."
tree=build/arm64

for program in aarch64-linux-gnu-g++ qemu-aarch64 arm-none-eabi-gcc; do
  command -v "$program" >/dev/null || {
    echo "make test-arm64: there is no $program here; as root:" >&2
    echo "  apt-get install g++-aarch64-linux-gnu qemu-user gcc-arm-none-eabi libnewlib-arm-none-eabi" >&2
    exit 1
  }
done

# Numbers are looked at here, not speed, so that compilers optimise little and random tests are few.
cmake --preset release -B "$tree" --toolchain cmake/aarch64-linux-gnu.cmake \
  -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DCDCR_WITH_CVODE=OFF -DCDCR_PRECOMPILE_HEADERS=OFF
export CDCR_TEST_COUNT="${CDCR_TEST_COUNT:-2}"
if [ $# -eq 0 ]; then
  cmake --build "$tree" --target cdcr_tests cdcr_test_robot_file cdcr_test_c
  ctest --test-dir "$tree" --output-on-failure -R '^cpp\.' -j 2
fi
while [ $# -gt 1 ]; do
  cmake --build "$tree" --target "$1"
  ctest --test-dir "$tree" --output-on-failure -R "^cpp\.$2\$"
  shift 2
done

# Exported C, as a controller's processor takes it: of single and of double precision.
python -m cdcr export-c three-sections --out "$tree/c" --name arm --overwrite
for real in float double; do
  arm-none-eabi-gcc -std=c99 -O3 -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16 \
    -Wall -Wextra -Wdouble-promotion -Werror -DARM_REAL=$real -c "$tree/c/arm.c" -o "$tree/c/$real.o"
  arm-none-eabi-size "$tree/c/$real.o"
done
